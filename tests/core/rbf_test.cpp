#include "core/interpolation/rbf.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "oracle_lines.hpp"

using namespace handlebody;

namespace {

constexpr unsigned seed = 20140728;

Matrix random_places(std::mt19937& random, Index count, Index dimension) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(count, dimension, [&] { return uniform(random); });
}

Vector weights_at(Rbf& rbf, const Vector& query) {
  Vector out(rbf.size());
  rbf.weights(query.data(), out.data());
  return out;
}

/** Kernel, degree and the like of a fit through the points. */
RbfOptions plain(const Kernel& kernel, int degree, bool normalized = false) {
  RbfOptions options;
  options.basis.kernel = kernel;
  options.basis.degree = degree;
  options.basis.normalized = normalized;
  return options;
}

/** A fit for its weights: the values do not matter. */
Result<Rbf> fit(const Matrix& places, const RbfOptions& options) {
  return Rbf::create(places, Matrix::Zero(places.rows(), 1), options);
}

Matrix matrix_of(const std::vector<double>& values, Index columns) {
  return Eigen::Map<const Matrix>(values.data(), std::ssize(values) / columns, columns);
}

hb_status code_of(const Matrix& places, const RbfOptions& options) {
  auto rbf = fit(places, options);
  if (rbf) return HB_OK;
  CHECK(!rbf.error().message.empty());
  CHECK(!rbf.error().remedy.empty());
  return rbf.error().code;
}

/** Every kernel with every tail it takes, plain and normalized. */
std::vector<RbfOptions> all_options(double width, Index dimension) {
  std::vector<RbfOptions> all;
  for (unsigned k = 0; k < static_cast<unsigned>(KernelKind::custom); ++k) {
    const auto kind = static_cast<KernelKind>(k);
    const bool plate = kind == KernelKind::clamped_plate, harmonic = kind == KernelKind::polyharmonic;
    const int order = static_cast<int>(dimension) / 2 + 1;
    const bool compact = k >= 9 && k <= 12;
    const Kernel kernel = Kernel::of(kind, plate ? 5 : compact ? 5 * width : width, dimension, order);
    for (int degree = kernel.minimum_degree(); degree <= 1; ++degree) {
      all.push_back(plain(kernel, degree));
      if (plate || harmonic) all.back().basis.order = order;
    }
    if (!kernel.vanishes_at_center() && !plate && k < 9)
      for (int degree = -1; degree <= 1; ++degree) all.push_back(plain(kernel, degree, true));
  }
  return all;
}

}  // namespace

// Tolerance: both sides solve systems of condition up to 1e5 in double precision, so they agree to about 1e-11.
TEST_CASE("RBF interpolation agrees with SciPy's RBFInterpolator and a textbook solve to 1e-9") {
  std::ifstream file(HANDLEBODY_TEST_DATA "/rbf.json");
  REQUIRE(file.good());
  std::string line;
  int cases = 0;
  while (std::getline(file, line)) {
    if (line.size() < 3) continue;
    const auto kind = static_cast<KernelKind>(static_cast<unsigned>(oracle_numbers(line, "kernel").at(0)));
    RbfOptions options = plain({kind, oracle_numbers(line, "width").at(0)}, static_cast<int>(oracle_numbers(line, "degree").at(0)),
                               oracle_numbers(line, "normalized").at(0) != 0);
    const auto dimension = static_cast<Index>(oracle_numbers(line, "dimension").at(0));
    const auto widths = oracle_numbers(line, "widths");
    options.basis.widths = Eigen::Map<const Vector>(widths.data(), std::ssize(widths));
    const Matrix points = matrix_of(oracle_numbers(line, "points"), dimension);
    const Matrix values = matrix_of(oracle_numbers(line, "values"), 1);
    const Matrix queries = matrix_of(oracle_numbers(line, "queries"), dimension);
    const Matrix expected = matrix_of(oracle_numbers(line, "expected"), 1);
    CAPTURE(cases);
    REQUIRE(values.rows() == points.rows());
    REQUIRE(queries.rows() == expected.rows());
    auto rbf = Rbf::create(points, values, options);
    REQUIRE(rbf);
    Matrix evaluated(queries.rows(), 1);
    rbf->evaluate(queries.data(), queries.rows(), evaluated.data());
    for (Index i = 0; i < queries.rows(); ++i) {
      const double value = weights_at(*rbf, queries.row(i).transpose()).dot(values.col(0));
      CHECK(std::abs(value - evaluated(i, 0)) <= 1e-9 * std::max(1.0, expected.lpNorm<Eigen::Infinity>()));
      CHECK(std::abs(value - expected(i, 0)) <= 1e-9 * std::max(1.0, expected.lpNorm<Eigen::Infinity>()));
    }
    ++cases;
  }
  CHECK(cases == 13);
}

TEST_CASE("cardinal weights are 1 at their own place and 0 at the others to 1e-9, every kernel and tail (seed 20140728)") {
  std::mt19937 random(seed);
  int checked = 0, ill_conditioned = 0;
  for (const Index dimension : {1, 2, 3, 5}) {
    const Matrix places = random_places(random, 14, dimension);
    for (const auto& options : all_options(dimension == 1 ? 0.1 : 0.4, dimension)) {
      CAPTURE(dimension);
      CAPTURE(static_cast<unsigned>(options.basis.kernel.kind));
      CAPTURE(options.basis.degree);
      CAPTURE(options.basis.normalized);
      auto rbf = fit(places, options);
      REQUIRE(rbf);
      // Wide kernels on crowded places lose digits, as the condition number says.
      if (rbf->fit().condition() > 1e6) {
        ++ill_conditioned;
        continue;
      }
      ++checked;
      for (Index i = 0; i < places.rows(); ++i) {
        const Vector error = weights_at(*rbf, places.row(i).transpose()) - Vector::Unit(places.rows(), i);
        CHECK(error.lpNorm<Eigen::Infinity>() < 1e-9);
      }
    }
  }
  CHECK(checked > 120);
  CHECK(ill_conditioned < 20);
  MESSAGE(checked << " interpolants checked, " << ill_conditioned << " of condition above 1e6 left out");
}

TEST_CASE("the estimated condition number is the matrix's own within a factor of 3, or a little below (seed 20140728)") {
  std::mt19937 random(seed);
  for (const double width : {0.2, 0.5, 1.0, 2.0}) {
    const Matrix places = random_places(random, 20, 2);
    auto rbf = fit(places, plain({KernelKind::gaussian, width}, -1));
    REQUIRE(rbf);
    MatrixXd r(20, 20);
    for (Index i = 0; i < 20; ++i)
      for (Index j = 0; j < 20; ++j) r(i, j) = Kernel{KernelKind::gaussian, width}((places.row(i) - places.row(j)).norm());
    const double exact = r.cwiseAbs().colwise().sum().maxCoeff() * r.inverse().cwiseAbs().colwise().sum().maxCoeff();
    CAPTURE(width);
    CHECK(rbf->fit().condition() <= 1.01 * exact);
    CHECK(rbf->fit().condition() >= exact / 3);
  }
}

TEST_CASE("a tail reproduces its polynomials, and normalizing reproduces constants, far away too (seed 20140728)") {
  std::mt19937 random(seed);
  const Matrix places = random_places(random, 12, 2);
  for (const auto& options : all_options(0.4, 2)) {
    CAPTURE(static_cast<unsigned>(options.basis.kernel.kind));
    CAPTURE(options.basis.degree);
    auto rbf = fit(places, options);
    REQUIRE(rbf);
    for (const double far : {0.5, 1.0, 20.0}) {
      const Vector query = far * random_places(random, 1, 2).row(0).transpose();
      const Vector w = weights_at(*rbf, query);
      // Rounding grows with the weights, and those of cubics with the cube of the distance.
      const double tolerance = 1e-12 * rbf->fit().condition() * std::max(1.0, w.lpNorm<1>());
      if (options.basis.degree >= 0 || options.basis.normalized) CHECK(std::abs(w.sum() - 1) < tolerance);
      if (options.basis.degree >= 1) CHECK((places.transpose() * w - query).norm() < tolerance);
    }
  }
}

TEST_CASE("normalized Gaussians survive where every Gaussian underflows") {
  Matrix places(3, 2);
  places << 0, 0, 1, 0, 0, 1;
  auto rbf = fit(places, plain({KernelKind::gaussian, 0.2}, -1, true));
  REQUIRE(rbf);
  const Vector w = weights_at(*rbf, Eigen::Vector2d(1e6, 1));
  CHECK(w.allFinite());
  CHECK(w.sum() == doctest::Approx(1));
  CHECK(w[1] == doctest::Approx(1));  // the nearest one wins
}

TEST_CASE("gradients are central differences of values, every kernel and tail, normalized and with a metric (seed 20140728)") {
  std::mt19937 random(seed);
  int checked = 0;
  for (const Index dimension : {1, 2, 3}) {
    const Matrix places = random_places(random, 14, dimension);
    const Matrix values = random_places(random, 14, 2);
    auto all = all_options(dimension == 1 ? 0.1 : 0.4, dimension);
    RbfOptions stretched = plain({KernelKind::gaussian, 0.5}, 1);
    stretched.basis.metric = MatrixXd::Identity(dimension, dimension);
    stretched.basis.metric(0, 0) = 4;
    if (dimension > 1) stretched.basis.metric(0, 1) = stretched.basis.metric(1, 0) = 0.7;
    all.push_back(stretched);
    for (const auto& options : all) {
      auto rbf = Rbf::create(places, values, options);
      REQUIRE(rbf);
      if (rbf->fit().condition() > 1e7) continue;  // differences of large canceling terms
      ++checked;
      CAPTURE(dimension);
      CAPTURE(static_cast<unsigned>(options.basis.kernel.kind));
      CAPTURE(options.basis.degree);
      CAPTURE(options.basis.normalized);
      const Matrix query = 0.8 * random_places(random, 1, dimension);
      Matrix gradient(2, dimension), high(1, 2), low(1, 2);
      rbf->gradient(query.data(), 1, gradient.data());
      constexpr double h = 1e-5;
      for (Index axis = 0; axis < dimension; ++axis) {
        Matrix moved = query;
        moved(0, axis) += h;
        rbf->evaluate(moved.data(), 1, high.data());
        moved(0, axis) -= 2 * h;
        rbf->evaluate(moved.data(), 1, low.data());
        for (Index j = 0; j < 2; ++j) {
          const double difference = (high(0, j) - low(0, j)) / (2 * h);
          CHECK(std::abs(gradient(j, axis) - difference) < 2e-6 * std::max(1.0, std::abs(difference)));
        }
      }
    }
  }
  CHECK(checked > 90);
}

TEST_CASE(
    "leave-one-out errors are those of a refit to 1e-9, every kernel, with and without a tail, smoothing and widths (seed "
    "20140728)") {
  std::mt19937 random(seed);
  const Matrix places = random_places(random, 12, 2), values = random_places(random, 12, 2);
  auto all = all_options(0.4, 2);
  all.push_back(plain({KernelKind::thin_plate, 1}, 1));
  all.back().smoothing = 0.1;
  all.push_back(plain({KernelKind::gaussian, 0.6}, -1));
  all.back().smoothing = 1e-3;
  all.push_back(plain({KernelKind::multiquadric, 1}, 0));
  all.back().basis.widths = Vector::LinSpaced(12, 0.2, 0.6);
  int checked = 0;
  for (const auto& options : all) {
    if (options.basis.normalized) continue;
    auto rbf = Rbf::create(places, values, options);
    REQUIRE(rbf);
    if (rbf->fit().condition() > 1e6) continue;
    const auto errors = rbf->leave_one_out();
    REQUIRE(errors);
    for (Index out = 0; out < places.rows(); ++out) {
      Matrix rest(11, 2), rest_values(11, 2);
      RbfOptions others = options;
      if (options.basis.widths.size()) others.basis.widths.resize(11);
      for (Index i = 0, k = 0; i < 12; ++i) {
        if (i == out) continue;
        if (options.basis.widths.size()) others.basis.widths[k] = options.basis.widths[i];
        rest.row(k) = places.row(i);
        rest_values.row(k++) = values.row(i);
      }
      // The clamped plate's ball is centered on the points: leaving out one that spans the box would move it.
      if (options.basis.kernel.kind == KernelKind::clamped_plate &&
          (rest.colwise().maxCoeff() != places.colwise().maxCoeff() || rest.colwise().minCoeff() != places.colwise().minCoeff()))
        continue;
      auto without = Rbf::create(rest, rest_values, others);
      REQUIRE(without);
      Matrix predicted(1, 2);
      without->evaluate(places.row(out).data(), 1, predicted.data());
      CAPTURE(static_cast<unsigned>(options.basis.kernel.kind));
      CAPTURE(options.basis.degree);
      for (Index j = 0; j < 2; ++j) {
        const double expected = values(out, j) - predicted(0, j);
        CHECK(std::abs((*errors)(out, j) - expected) < 1e-9 * std::max(1.0, std::abs(expected)));
        ++checked;
      }
    }
  }
  CHECK(checked > 500);
  CHECK(!fit(places, plain({KernelKind::gaussian, 0.4}, -1, true))->leave_one_out());
}

TEST_CASE("points on a line will do; twins and bad options are named") {
  const Kernel multiquadric{KernelKind::multiquadric, 1}, plate{KernelKind::thin_plate, 1};
  Matrix line(4, 2);
  line << 0, 0, 1, 1, 2, 2, 3, 3;
  CHECK(code_of(line, plain(plate, 1)) == HB_OK);
  CHECK(code_of(line, plain(multiquadric, 0)) == HB_OK);
  CHECK(code_of(line.topRows(2), plain(plate, 1)) == HB_OK);
  CHECK(code_of(Matrix(0, 2), plain(multiquadric, 0)) == HB_ERROR_POINTS_TOO_FEW);

  Matrix twins(3, 2);
  twins << 0, 0, 1, 0, 0, 0;
  auto merged = fit(twins, plain(multiquadric, 0));
  REQUIRE(merged);
  CHECK(merged->data().twin_of == std::vector<std::uint32_t>{0, 1, 0});
  CHECK(merged->size() == 3);
  Matrix differing(3, 1);
  differing << 1, 2, 3;
  const auto refused = Rbf::create(twins, differing, plain(multiquadric, 0));
  REQUIRE(!refused);
  CHECK(refused.error().code == HB_ERROR_POINT_DUPLICATE);
  CHECK(refused.error().index == 2);
  RbfOptions smoothed = plain(multiquadric, 0);
  smoothed.smoothing = 0.1;
  CHECK(Rbf::create(twins, differing, smoothed));

  Matrix bad = line;
  bad(2, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(code_of(bad, plain(multiquadric, 0)) == HB_ERROR_POINT_NOT_FINITE);
  CHECK(fit(bad, plain(multiquadric, 0)).error().index == 2);

  CHECK(code_of(line, plain(multiquadric, 3)) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(line, plain(plate, 0)) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(line, plain(plate, 1, true)) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(line, plain({KernelKind::gaussian, 0}, -1)) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(line, plain({KernelKind::gaussian, -1}, -1)) == HB_ERROR_INVALID_OPTION);
  RbfOptions widths = plain(multiquadric, 0);
  widths.basis.widths = Vector::Ones(3);
  CHECK(code_of(line, widths) == HB_ERROR_INVALID_OPTION);
  widths.basis.widths = -Vector::Ones(4);
  CHECK(code_of(line, widths) == HB_ERROR_INVALID_OPTION);
  CHECK(fit(line, widths).error().index == 0);
  RbfOptions metric = plain(multiquadric, 0);
  metric.basis.metric = MatrixXd::Constant(2, 2, 1);
  CHECK(code_of(line, metric) == HB_ERROR_INVALID_OPTION);
  CHECK(!check_size(1e6, 1e6, 3));
  CHECK(check_size(1e6, 1e6, 3).error().code == HB_ERROR_OUT_OF_MEMORY);
  CHECK(check_size(1e6, 50, 3));
}
