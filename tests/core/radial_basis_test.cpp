#include "core/interpolation/radial_basis.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "core/interpolation/polynomial.hpp"
#include "scattered.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

RadialBasis basis_of(const Matrix& points, const Matrix& centers, const RadialBasisOptions& options) {
  auto basis = RadialBasis::create(points, centers, options);
  REQUIRE(basis);
  return std::move(*basis);
}

Vector values_at(RadialBasis& basis, const Vector& query) {
  Vector out(basis.size());
  basis.values(query.data(), out.data());
  return out;
}

RadialBasisOptions plain(KernelKind kind, double width, int degree = -1) {
  RadialBasisOptions options;
  options.kernel = {kind, width};
  options.degree = degree;
  return options;
}

}  // namespace

TEST_CASE("the kernels are those of the distances to the centers, times a power of the scale for homogeneous ones (seed 91)") {
  std::mt19937 random(91);
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const Matrix points = unit * random_points(random, 12, 3), centers = unit * random_points(random, 5, 3);
    const Vector query = unit * random_points(random, 1, 3).transpose();
    for (const KernelKind kind : {KernelKind::linear, KernelKind::cubic, KernelKind::gaussian, KernelKind::multiquadric,
                                  KernelKind::inverse_multiquadric, KernelKind::inverse_quadratic, KernelKind::quintic}) {
      CAPTURE(unit);
      CAPTURE(static_cast<unsigned>(kind));
      const RadialBasisOptions options = plain(kind, 0.4 * unit, 2);
      RadialBasis basis = basis_of(points, centers, options);
      const Vector values = values_at(basis, query);
      REQUIRE(values.size() == 5 + 10);
      for (Index k = 0; k < 5; ++k) {
        const double expected = options.kernel((query - centers.row(k).transpose()).norm());
        CHECK(values[k] == doctest::Approx(basis.amplitude_of_scale() * expected).epsilon(1e-12));
      }
      Vector polynomials(10);
      polynomial_values(basis.to_inner(query.transpose()).data(), 3, 2, polynomials.data());
      CHECK(values.tail(10) == polynomials);
    }
  }
}

TEST_CASE("kernels from a center on are the last of all values, of the clamped plate and of own widths too (seed 92)") {
  std::mt19937 random(92);
  const Matrix points = random_points(random, 9, 2);
  std::vector<RadialBasisOptions> all{plain(KernelKind::thin_plate, 1, 1), plain(KernelKind::clamped_plate, 5),
                                      plain(KernelKind::multiquadric, 1, 0)};
  all.back().widths = Vector::LinSpaced(9, 0.1, 1);
  for (std::size_t at = 0; at < all.size(); ++at) {
    CAPTURE(at);
    RadialBasis basis = basis_of(points, points, all[at]);
    const Vector query = 0.5 * random_points(random, 1, 2).transpose(), values = values_at(basis, query);
    for (Index first = 0; first <= 9; ++first) {
      Vector some(9 - first);
      basis.kernels_from(first, query.data(), some.data());
      CHECK(some == values.segment(first, 9 - first));
    }
  }
}

TEST_CASE("normalized kernels are a partition of unity, far away and beyond their reach as well as nearby (seed 93)") {
  std::mt19937 random(93);
  const Matrix points = random_points(random, 9, 2);
  for (const KernelKind kind : {KernelKind::gaussian, KernelKind::multiquadric, KernelKind::inverse_multiquadric}) {
    RadialBasisOptions options = plain(kind, 0.2);
    options.normalized = true;
    RadialBasis basis = basis_of(points, points, options);
    CHECK(!basis.symmetric());
    for (const double far : {0.1, 1.0, 1e3, 1e9}) {
      const Vector values = values_at(basis, far * random_points(random, 1, 2).transpose());
      CHECK(values.sum() == doctest::Approx(1).epsilon(1e-14));
      CHECK(values.minCoeff() >= 0);
      MatrixXd gradients(9, 2);
      basis.gradients(points.data(), gradients.data());
      CHECK(gradients.colwise().sum().norm() < 1e-12 * std::max(1.0, gradients.norm()));
    }
  }
  RadialBasisOptions compact = plain(KernelKind::wendland_c2, 0.2);
  compact.kernel = Kernel::of(KernelKind::wendland_c2, 0.2, 2);
  compact.normalized = true;
  RadialBasis basis = basis_of(points, points, compact);
  // Beyond all supports, the nearest center counts alone.
  const Vector beyond = values_at(basis, Eigen::Vector2d(50, 50));
  Index nearest = 0;
  (points.rowwise() - Eigen::RowVector2d(50, 50)).rowwise().squaredNorm().minCoeff(&nearest);
  CHECK(beyond == Vector::Unit(9, nearest));
}

TEST_CASE("a metric measures as stretching space does: values and gradients (seed 94)") {
  std::mt19937 random(94);
  const Index d = 3;
  const Matrix points = random_points(random, 15, d), query = random_points(random, 1, d);
  const MatrixXd root = MatrixXd(random_points(random, d, d)) + 2 * MatrixXd::Identity(d, d);  // M = AᵀA, stretched by A
  RadialBasisOptions options = plain(KernelKind::gaussian, 1.5);
  RadialBasis stretched = basis_of(points * root.transpose(), points * root.transpose(), options);
  options.metric = root.transpose() * root;
  RadialBasis measured = basis_of(points, points, options);
  const Vector there = (root * query.transpose()).eval();
  CHECK((values_at(measured, query.transpose()) - values_at(stretched, there)).lpNorm<Eigen::Infinity>() < 1e-13);
  MatrixXd gradients(15, d), expected(15, d);
  measured.gradients(query.data(), gradients.data());
  stretched.gradients(there.data(), expected.data());
  CHECK((gradients - expected * root).lpNorm<Eigen::Infinity>() < 1e-13 * std::max(1.0, expected.norm()));
}

TEST_CASE("combinations are coefficients times values, query by query or in blocks, of few outputs and many (seed 95)") {
  std::mt19937 random(95);
  const Matrix points = random_points(random, 20, 2);
  std::vector<RadialBasisOptions> all{plain(KernelKind::thin_plate, 1, 1), plain(KernelKind::gaussian, 0.4, 2),
                                      plain(KernelKind::multiquadric, 0.4, 0), plain(KernelKind::clamped_plate, 5)};
  all[2].widths = Vector::LinSpaced(20, 0.1, 1);
  for (std::size_t at = 0; at < all.size(); ++at) {
    RadialBasis basis = basis_of(points, points, all[at]);
    for (const Index outputs : {1, 3, 8, 9}) {
      const MatrixXd coefficients = random_points(random, outputs, basis.size());
      for (const Index count : {0, 1, 3, 4, 64, 65, 150}) {
        CAPTURE(at);
        CAPTURE(outputs);
        CAPTURE(count);
        const Matrix queries = random_points(random, count, 2);
        Matrix out(count, outputs);
        basis.combine(coefficients, queries.data(), count, out.data());
        double worst = 0;
        for (Index q = 0; q < count; ++q)
          worst = std::max(worst, (out.row(q).transpose() - coefficients * values_at(basis, queries.row(q).transpose())).norm());
        CHECK(worst < 1e-12);
      }
    }
  }
}

TEST_CASE("the matrix of a kernel with one width is symmetric and definite as the kernel says, at points of any kind (seed 96)") {
  std::mt19937 random(96);
  for (const Index dimension : {1, 2, 3, 5}) {
    const Matrix points = random_points(random, 15, dimension);
    for (unsigned number = 0; number < static_cast<unsigned>(KernelKind::custom); ++number) {
      RadialBasisOptions options;
      options.order = static_cast<int>(dimension) / 2 + 1;
      const auto kind = static_cast<KernelKind>(number);
      options.kernel = Kernel::of(kind, kind == KernelKind::clamped_plate ? 5 : 0.5, dimension, options.order);
      options.degree = options.kernel.order() - 1;
      if (options.degree > 1 || dimension > options.kernel.definite_to_dimension()) continue;
      CAPTURE(dimension);
      CAPTURE(number);
      RadialBasis basis = basis_of(points, points, options);
      REQUIRE(basis.symmetric());
      MatrixXd all(15, basis.size());
      for (Index i = 0; i < 15; ++i) all.row(i) = values_at(basis, points.row(i).transpose()).transpose();
      const MatrixXd r = all.leftCols(15), p = all.rightCols(basis.tail());
      CHECK((r - r.transpose()).norm() < 1e-14 * r.norm());
      for (int trial = 0; trial < 50; ++trial) {
        Vector c = random_points(random, 15, 1);
        if (p.cols() > 0) c -= p * (p.transpose() * p).inverse() * (p.transpose() * c);
        CHECK(options.kernel.sign() * c.dot(r * c) > 0);
      }
    }
  }
}

TEST_CASE("what a basis cannot be made of is named") {
  Matrix points(4, 2);
  points << 0, 0, 1, 0, 0, 1, 1, 1;
  const auto refused = [&](const RadialBasisOptions& options) {
    const auto basis = RadialBasis::create(points, points, options);
    REQUIRE(!basis);
    CHECK(basis.error().code == HB_ERROR_INVALID_OPTION);
    CHECK(!basis.error().remedy.empty());
    return std::string(basis.error().message.c_str());
  };
  RadialBasisOptions options = plain(KernelKind::gaussian, 1);
  for (const MatrixXd& metric :
       {MatrixXd(-MatrixXd::Identity(2, 2)), MatrixXd(MatrixXd::Identity(3, 3)), MatrixXd(MatrixXd::Ones(2, 2)),
        MatrixXd((MatrixXd(2, 2) << 2, 1, 0, 2).finished()), MatrixXd(MatrixXd::Constant(2, 2, std::nan("")))}) {
    options.metric = metric;
    CHECK(refused(options).find("metric") != std::string::npos);
  }
  CHECK(refused(plain(KernelKind::thin_plate, 1, 0)).find("degree 1") != std::string::npos);
  CHECK(refused(plain(KernelKind::gaussian, -1)).find("-1") != std::string::npos);
}

TEST_CASE("orders that a kernel cannot have are refused, however large") {
  constexpr int least = std::numeric_limits<int>::min(), most = std::numeric_limits<int>::max();
  const Matrix points = Matrix::Identity(3, 3);
  for (const int order : {least, least / 2 - 1, -1, 0, 1, 9, most / 2 + 1, most}) {
    RadialBasisOptions options;
    options.kernel = Kernel::of(KernelKind::polyharmonic, 1, 3, order);
    options.order = order;
    const auto made = RadialBasis::create(points, points, options);
    REQUIRE_FALSE(made);
    CHECK(made.error().code == HB_ERROR_INVALID_OPTION);
  }
}
