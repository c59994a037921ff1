// Against Eigen's LU with full pivoting of the whole equations, which this file writes down by itself. Products are called, not
// spelled: each kind of expression of Eigen's takes seconds to compile.
#include "core/interpolation/linear_fit.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "core/numerics/decompositions.hpp"
#include "core/numerics/products.hpp"
#include "scattered.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

RadialBasis basis_of(const Matrix& points, const Matrix& centers, const RadialBasisOptions& options) {
  auto basis = RadialBasis::create(points, centers, options);
  REQUIRE(basis);
  return std::move(*basis);
}

/** Every kernel but the caller's, each with every tail that it takes, at a width that keeps condition numbers moderate. */
std::vector<RadialBasisOptions> all_options(Index dimension, double width) {
  std::vector<RadialBasisOptions> all;
  for (unsigned k = 0; k < static_cast<unsigned>(KernelKind::custom); ++k) {
    const auto kind = static_cast<KernelKind>(k);
    const bool plate = kind == KernelKind::clamped_plate, compact = k >= 9 && k <= 12;
    RadialBasisOptions options;
    options.order = static_cast<int>(dimension) / 2 + 1;
    options.kernel = Kernel::of(kind, plate ? 5 : compact ? 5 * width : width, dimension, options.order);
    for (options.degree = options.kernel.minimum_degree(); options.degree <= 2; ++options.degree) all.push_back(options);
  }
  return all;
}

/** All functions of the basis at the points (n×size). */
MatrixXd functions_at(RadialBasis& basis, const Matrix& points) {
  MatrixXd out(points.rows(), basis.size());
  Vector row(basis.size());
  for (Index i = 0; i < points.rows(); ++i) {
    basis.values(&points(i, 0), row.data());
    out.row(i) = row.transpose();
  }
  return out;
}

/** The block matrix of interpolation. */
MatrixXd saddle(RadialBasis& basis, const Matrix& points, double smoothing) {
  const Index n = points.rows(), tail = basis.tail();
  MatrixXd k = MatrixXd::Zero(n + tail, n + tail);
  k.topRows(n) = functions_at(basis, points);
  k.bottomLeftCorner(tail, n) = k.topRightCorner(n, tail).transpose();
  k.topLeftCorner(n, n).diagonal().array() += basis.kernel().sign() * basis.amplitude_of_scale() * smoothing;
  return k;
}

MatrixXd known(const Matrix& values, Index tail) {
  MatrixXd rhs = MatrixXd::Zero(values.rows() + tail, values.cols());
  rhs.topRows(values.rows()) = values;
  return rhs;
}

double largest(const MatrixXd& a) {
  return a.size() == 0 ? 0 : a.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

/** What is left of K X − B, in units of rounding errors of a solution that is as good as doubles allow. */
double backward_error(const MatrixXd& k, const MatrixXd& x, const MatrixXd& b) {
  const double size = one_norm(k.transpose()) * largest(x) + largest(b);
  return largest(product(k, x) - b) / size / std::numeric_limits<double>::epsilon();
}

MatrixXd inverse_of(const MatrixXd& a) {
  return a.fullPivLu().inverse();
}

/** The orthogonal projector on what is perpendicular to P's columns. */
MatrixXd projector_off(const MatrixXd& p) {
  MatrixXd projector = MatrixXd::Identity(p.rows(), p.rows());
  if (p.cols() == 0) return projector;
  const MatrixXd basis = column_span(p).basis;
  projector -= product(basis, basis.transpose());
  return projector;
}

Matrix random_values(std::mt19937& random, Index n) {
  return random_points(random, n, 2);
}

}  // namespace

TEST_CASE("interpolation solves the block equations: every kernel, tail and dimension, with and without smoothing (seed 71)") {
  std::mt19937 random(71);
  int compared = 0, near = 0, held = 0;
  for (const Index dimension : {1, 2, 3}) {
    const Matrix points = random_points(random, 24, dimension), values = random_values(random, 24);
    for (const auto& options : all_options(dimension, dimension == 1 ? 0.1 : 0.4)) {
      for (const double smoothing : {0.0, 0.05}) {
        CAPTURE(dimension);
        CAPTURE(static_cast<unsigned>(options.kernel.kind));
        CAPTURE(options.degree);
        CAPTURE(smoothing);
        RadialBasis basis = basis_of(points, points, options);
        const MatrixXd k = saddle(basis, points, smoothing), b = known(values, basis.tail());
        const auto fit = fit_interpolant(basis, points, smoothing);
        const MatrixXd x = fit->coefficients(values).transpose(), one = fit->coefficients(values.leftCols(1)).transpose();
        REQUIRE(x.rows() == k.rows());
        CHECK(backward_error(k, x, b) < 50);
        CHECK(backward_error(k, one, b.leftCols(1)) < 50);
        if (const auto fitted = fit->fitted(x.transpose())) {
          ++held;
          CHECK(largest(*fitted - product(functions_at(basis, points), x)) < 1e-14 * one_norm(k.transpose()) * largest(x));
        }

        const MatrixXd inverse = inverse_of(k);
        const double norm = one_norm(k), condition = norm * one_norm(inverse);
        CHECK(fit->norm() == doctest::Approx(norm).epsilon(1e-12));
        if (condition > 1e8) continue;  // the inverse itself is vague then
        ++compared;
        CHECK(fit->condition() <= 1.0001 * condition);
        CHECK(fit->condition() >= condition / 100);
        near += fit->condition() >= condition / 3;
        CHECK(largest(x - product(inverse, b)) < 1e-14 * condition * largest(x));
      }
    }
  }
  CHECK(compared > 200);
  CHECK(held > 200);             // all that a theorem says are definite
  CHECK(near > 0.9 * compared);  // the estimate is a lower bound, far off where the largest column of the inverse hides
}

TEST_CASE("nearly singular equations, which Cholesky refuses, are solved all the same, as well as LU can (seed 72)") {
  std::mt19937 random(72);
  const Matrix points = random_points(random, 40, 2), values = random_values(random, 40);
  for (const KernelKind kind : {KernelKind::gaussian, KernelKind::inverse_multiquadric, KernelKind::multiquadric}) {
    RadialBasisOptions options;
    options.kernel = {kind, kind == KernelKind::gaussian ? 6.0 : 30.0};
    for (options.degree = options.kernel.minimum_degree(); options.degree <= 1; ++options.degree) {
      CAPTURE(static_cast<unsigned>(kind));
      CAPTURE(options.degree);
      RadialBasis basis = basis_of(points, points, options);
      const MatrixXd k = saddle(basis, points, 0);
      const Index n = points.rows(), tail = basis.tail();
      MatrixXd projected = basis.kernel().sign() * k.topLeftCorner(n, n);
      Qr(k.topRightCorner(n, tail)).conjugate(projected);
      REQUIRE(!Cholesky(projected.bottomRightCorner(n - tail, n - tail)).succeeded());
      const auto fit = fit_interpolant(basis, points, 0);
      const MatrixXd x = fit->coefficients(values).transpose();
      REQUIRE(x.allFinite());
      CHECK(backward_error(k, x, known(values, tail)) < 50);
      CHECK(fit->condition() > 1e14);
    }
  }
}

TEST_CASE("kernels of unknown definiteness, unequal widths and normalized kernels are solved too (seed 73)") {
  std::mt19937 random(73);
  const Matrix points = random_points(random, 20, 2), values = random_values(random, 20);
  std::vector<RadialBasisOptions> all(4);
  all[0].kernel.kind = KernelKind::custom;  // negative definite
  all[0].kernel.width = 0.5;
  all[0].kernel.custom.function = [](const void*, double s, bool derivative) {
    return (derivative ? 2 * s : -1) * std::exp(-s * s);
  };
  all[1] = all[0];  // of no sign: eigenvalues on both sides of zero
  all[1].kernel.custom.function = [](const void*, double s, bool) { return std::cos(3 * s); };
  all[1].degree = 1;
  all[2].kernel = {KernelKind::multiquadric, 1};
  all[2].widths = Vector::LinSpaced(20, 0.1, 0.5);
  all[2].degree = 0;
  all[3].kernel = {KernelKind::gaussian, 0.3};
  all[3].normalized = true;
  for (std::size_t at = 0; at < all.size(); ++at) {
    CAPTURE(at);
    RadialBasis basis = basis_of(points, points, all[at]);
    const MatrixXd k = saddle(basis, points, 0), x = fit_interpolant(basis, points, 0)->coefficients(values).transpose();
    CHECK(backward_error(k, x, known(values, basis.tail())) < 50);
  }
}

TEST_CASE("a kernel that gives no number shows in the norm") {
  Matrix points(3, 1);
  points << 0, 1, 2;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    RadialBasisOptions options;
    options.kernel.kind = KernelKind::custom;
    options.kernel.custom = {[](const void* context, double s, bool) { return s > 0.7 ? *static_cast<const double*>(context) : 1; },
                             &bad};
    RadialBasis basis = basis_of(points, points, options);
    CHECK(!std::isfinite(fit_interpolant(basis, points, 0)->norm()));
  }
}

TEST_CASE("one point, and as many points as the tail has polynomials, leave nothing to factor") {
  Matrix points(3, 2);
  points << 0, 0, 1, 0, 0, 1;
  Matrix values(3, 1);
  values << 1, 3, 4;
  RadialBasisOptions options;
  options.kernel = {KernelKind::thin_plate, 1};
  options.degree = 1;
  RadialBasis plane = basis_of(points, points, options);
  const auto fit = fit_interpolant(plane, points, 0);
  const MatrixXd x = fit->coefficients(values);
  CHECK(largest(x.leftCols(3)) < 1e-14);
  const MatrixXd at = functions_at(plane, points);
  CHECK(largest(product(at, x.transpose()) - values) < 1e-14);
  options.degree = 0;
  options.kernel = {KernelKind::linear, 1};
  RadialBasis one = basis_of(points.topRows(1), points.topRows(1), options);
  CHECK(fit_interpolant(one, points.topRows(1), 0)->coefficients(values.topRows(1)) ==
        MatrixXd((MatrixXd(1, 2) << 0, 1).finished()));
}

TEST_CASE("coefficients follow their points when these are renumbered, and are linear in the values (seed 74)") {
  std::mt19937 random(74);
  const Matrix points = random_points(random, 30, 2), values = random_values(random, 30);
  std::vector<Index> order(30);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  const Matrix moved_points = points(order, Eigen::all), moved_values = values(order, Eigen::all);
  for (const KernelKind kind : {KernelKind::thin_plate, KernelKind::gaussian, KernelKind::multiquadric}) {
    RadialBasisOptions options;
    options.kernel = {kind, 0.4};
    options.degree = 1;
    RadialBasis basis = basis_of(points, points, options), moved = basis_of(moved_points, moved_points, options);
    const auto fit = fit_interpolant(basis, points, 0);
    const MatrixXd x = fit->coefficients(values), y = fit_interpolant(moved, moved_points, 0)->coefficients(moved_values);
    const double allowed = 1e-15 * fit->condition() * largest(x);
    for (Index i = 0; i < 30; ++i) CHECK(largest(y.col(i) - x.col(order[static_cast<std::size_t>(i)])) < allowed);
    CHECK(largest(y.rightCols(3) - x.rightCols(3)) < allowed);
    const Matrix sum = 2 * values.col(0) - 3 * values.col(1);
    CHECK(largest(fit->coefficients(sum) - (2 * x.row(0) - 3 * x.row(1))) < allowed);
  }
}

TEST_CASE(
    "least squares is where its gradient vanishes within the side conditions: weights, decay, few centers and many (seed 75)") {
  std::mt19937 random(75);
  const Matrix points = random_points(random, 150, 2), values = random_values(random, 150);
  std::uniform_real_distribution<double> uniform(0, 1);
  const Vector some_weights = Vector::NullaryExpr(150, [&] { return uniform(random); });
  for (const Index count : {1, 3, 12, 60}) {
    const Matrix centers = random_points(random, count, 2);
    for (int degree = 0; degree <= 2; ++degree) {
      for (const double decay : {0.0, 0.3}) {
        for (const bool weighted : {false, true}) {
          CAPTURE(count);
          CAPTURE(degree);
          CAPTURE(decay);
          CAPTURE(weighted);
          RadialBasisOptions options;
          options.kernel = {KernelKind::multiquadric, 0.3};
          options.degree = degree;
          RadialBasis basis = basis_of(points, centers, options);
          const Vector weights = weighted ? some_weights : Vector::Ones(150);
          const auto fit = fit_least_squares(basis, points, centers, decay, weighted ? some_weights : Vector());
          const MatrixXd x = fit->coefficients(values).transpose();
          const MatrixXd p = functions_at(basis, centers).rightCols(basis.tail()), c = x.topRows(count);
          CHECK(largest(transposed_product(p, c)) < 1e-11 * std::max(1.0, largest(c)));
          const MatrixXd all = functions_at(basis, points);
          MatrixXd misfits = product(all, x) - values;
          misfits.array().colwise() *= weights.array();
          MatrixXd gradient = transposed_product(all, misfits);
          gradient.topRows(count) += decay * c;  // the amplitude of scale is 1 here
          const double size = largest(all) * largest(all) * largest(x) * 150;
          CHECK(largest(gradient.bottomRows(basis.tail())) < 1e-13 * size);
          CHECK(largest(product(projector_off(p), gradient.topRows(count))) < 1e-12 * size);
          if (count <= basis.tail()) CHECK(largest(c) < 1e-12);
        }
      }
    }
  }
}

TEST_CASE("the design's condition number and Gram matrix are those of R, projected on the side conditions, and P (seed 76)") {
  std::mt19937 random(76);
  const Matrix points = random_points(random, 90, 2), centers = random_points(random, 15, 2);
  for (int degree = -1; degree <= 1; ++degree) {
    CAPTURE(degree);
    RadialBasisOptions options;
    options.kernel = {KernelKind::gaussian, 0.5};
    options.degree = degree;
    RadialBasis basis = basis_of(points, centers, options);
    const Index tail = basis.tail();
    const MatrixXd design = design_matrix(basis, points, centers), all = functions_at(basis, points), r = all.leftCols(15);
    REQUIRE(design.rows() == 90);
    REQUIRE(design.cols() == 15);  // one less for each polynomial, and the polynomials
    const MatrixXd projector = projector_off(functions_at(basis, centers).rightCols(tail)), p = all.rightCols(tail);
    const MatrixXd expected = product(product(r, projector), r.transpose()) + product(p, p.transpose());
    CHECK(largest(product(design, design.transpose()) - expected) < 1e-12 * largest(expected));

    const MatrixXd upper = Qr(design).r();
    const double norm = one_norm(upper), condition = norm * one_norm(inverse_of(upper));
    const auto fit = fit_least_squares(basis, points, centers, 0, {});
    CHECK(fit->norm() == doctest::Approx(norm));
    CHECK(fit->condition() <= 1.0001 * condition);
    CHECK(fit->condition() >= condition / 3);
  }
}
