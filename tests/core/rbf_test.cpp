#include "core/interpolation/rbf.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace handlebody;

namespace {

constexpr unsigned seed = 20140728;

Matrix random_places(std::mt19937& random, Index count, Index dimension) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(count, dimension, [&] { return uniform(random); });
}

Vector weights_at(RadialBasisInterpolant& rbf, const Vector& query) {
  Vector out(rbf.size());
  rbf.weights(query, out);
  return out;
}

/** The numbers of `"key": 1.5` or `"key": [1, 2, 3]` in `line`. The oracle file is our own: no more of JSON is needed. */
std::vector<double> numbers(const std::string& line, const std::string& key) {
  std::vector<double> found;
  const std::size_t start = line.find('"' + key + "\": ");
  if (start == std::string::npos) return found;
  const char* at = line.c_str() + start + key.size() + 4;
  const bool list = *at == '[';
  if (list) ++at;
  for (char* end = nullptr; *at != ']'; at = end + std::strspn(end, ", ")) {
    found.push_back(std::strtod(at, &end));
    if (!list || end == at) break;
  }
  return found;
}

Matrix matrix_of(const std::vector<double>& values, Index columns) {
  return Eigen::Map<const Matrix>(values.data(), static_cast<Index>(values.size()) / columns, columns);
}

hb_status code_of(const Matrix& places, const RadialBasisOptions& options) {
  auto rbf = RadialBasisInterpolant::create(places, options);
  if (rbf) return HB_OK;
  CHECK(!rbf.error().message.empty());
  CHECK(!rbf.error().remedy.empty());
  return rbf.error().code;
}

// Every kernel with every tail it takes, plain and normalized.
std::vector<RadialBasisOptions> all_options(double width) {
  std::vector<RadialBasisOptions> all;
  for (unsigned k = 0; k < kernel_count; ++k) {
    const Kernel kernel{static_cast<KernelKind>(k), width};
    for (int degree = kernel.minimum_degree(); degree <= 1; ++degree) all.push_back({kernel, degree, false, {}});
    if (k >= 3)
      for (int degree = -1; degree <= 1; ++degree) all.push_back({kernel, degree, true, {}});
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
    RadialBasisOptions options;
    options.kernel.kind = static_cast<KernelKind>(static_cast<unsigned>(numbers(line, "kernel").at(0)));
    options.kernel.width = numbers(line, "width").at(0);
    options.degree = static_cast<int>(numbers(line, "degree").at(0));
    options.normalized = numbers(line, "normalized").at(0) != 0;
    const auto dimension = static_cast<Index>(numbers(line, "dimension").at(0));
    const auto widths = numbers(line, "widths");
    options.widths = Eigen::Map<const Vector>(widths.data(), static_cast<Index>(widths.size()));
    const Matrix points = matrix_of(numbers(line, "points"), dimension);
    const Matrix values = matrix_of(numbers(line, "values"), 1);
    const Matrix queries = matrix_of(numbers(line, "queries"), dimension);
    const Matrix expected = matrix_of(numbers(line, "expected"), 1);
    CAPTURE(cases);
    REQUIRE(values.rows() == points.rows());
    REQUIRE(queries.rows() == expected.rows());
    auto rbf = RadialBasisInterpolant::create(points, options);
    REQUIRE(rbf);
    for (Index i = 0; i < queries.rows(); ++i) {
      const double value = weights_at(*rbf, queries.row(i).transpose()).dot(values.col(0));
      CHECK(std::abs(value - expected(i, 0)) <= 1e-9 * std::max(1.0, expected.lpNorm<Eigen::Infinity>()));
    }
    ++cases;
  }
  CHECK(cases == 13);
}

TEST_CASE("cardinal weights are 1 at their own place and 0 at the others to 1e-9, every kernel and tail (seed 20140728)") {
  std::mt19937 random(seed);
  int checked = 0, ill_conditioned = 0;
  for (const Index dimension : {1, 2, 3, 7}) {
    const Matrix places = random_places(random, 14, dimension);
    for (const auto& options : all_options(dimension == 1 ? 0.1 : 0.4)) {
      CAPTURE(dimension);
      CAPTURE(static_cast<unsigned>(options.kernel.kind));
      CAPTURE(options.degree);
      CAPTURE(options.normalized);
      auto rbf = RadialBasisInterpolant::create(places, options);
      // Wide kernels on crowded places lose digits, as the condition number says; how many is the next test's question.
      if (!rbf || rbf->condition() > 1e6) {
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
  CHECK(checked > 80);
  CHECK(ill_conditioned < 20);
  MESSAGE(checked << " interpolants checked, " << ill_conditioned << " of condition above 1e6 left out");
}

TEST_CASE("widths far beyond the spacing either keep the promised 1e-6 or are refused (seed 20140728)") {
  std::mt19937 random(seed);
  const Matrix places = random_places(random, 14, 2);
  int refused = 0;
  for (double width = 0.1; width < 1e4; width *= 2) {
    auto rbf = RadialBasisInterpolant::create(places, {{KernelKind::gaussian, width}, -1, false, {}});
    if (rbf) {
      CHECK(refused == 0);
      CHECK(rbf->cardinal_error() <= 1e-6);
      continue;
    }
    ++refused;
    CHECK(rbf.error().code == HB_ERROR_EXAMPLES_DEGENERATE);
    CHECK(rbf.error().remedy.find("smaller width") != std::string::npos);
  }
  CHECK(refused > 0);
}

TEST_CASE("a tail reproduces its polynomials, and normalizing reproduces constants, far away too (seed 20140728)") {
  std::mt19937 random(seed);
  const Matrix places = random_places(random, 12, 2);
  for (const auto& options : all_options(0.4)) {
    CAPTURE(static_cast<unsigned>(options.kernel.kind));
    CAPTURE(options.degree);
    auto rbf = RadialBasisInterpolant::create(places, options);
    REQUIRE(rbf);
    for (const double far : {0.5, 1.0, 20.0}) {
      const Vector query = far * random_places(random, 1, 2).row(0).transpose();
      const Vector w = weights_at(*rbf, query);
      // Rounding grows with the weights, and those of cubics with the cube of the distance.
      const double tolerance = 1e-12 * rbf->condition() * std::max(1.0, w.lpNorm<1>());
      if (options.degree >= 0 || options.normalized) CHECK(std::abs(w.sum() - 1) < tolerance);
      if (options.degree >= 1) CHECK((places.transpose() * w - query).norm() < tolerance);
    }
  }
}

TEST_CASE("normalized Gaussians survive where every Gaussian underflows") {
  Matrix places(3, 2);
  places << 0, 0, 1, 0, 0, 1;
  auto rbf = RadialBasisInterpolant::create(places, {{KernelKind::gaussian, 0.2}, -1, true, {}});
  REQUIRE(rbf);
  const Vector w = weights_at(*rbf, Eigen::Vector2d(1e6, 1));
  CHECK(w.allFinite());
  CHECK(w.sum() == doctest::Approx(1));
  CHECK(w[1] == doctest::Approx(1));  // the nearest one wins
}

TEST_CASE("degenerate places and bad options are named") {
  const Kernel multiquadric{KernelKind::multiquadric, 1}, plate{KernelKind::thin_plate, 1};
  Matrix line(4, 2);
  line << 0, 0, 1, 1, 2, 2, 3, 3;
  CHECK(code_of(line, {plate, 1, false, {}}) == HB_ERROR_EXAMPLES_DEGENERATE);
  CHECK(RadialBasisInterpolant::create(line, {plate, 1, false, {}}).error().message.find("on one line") != std::string::npos);
  CHECK(code_of(line, {multiquadric, 0, false, {}}) == HB_OK);
  CHECK(code_of(line.topRows(2), {plate, 1, false, {}}) == HB_ERROR_EXAMPLES_TOO_FEW);
  CHECK(code_of(Matrix(0, 2), {multiquadric, 0, false, {}}) == HB_ERROR_EXAMPLES_TOO_FEW);

  Matrix twins(3, 2);
  twins << 0, 0, 1, 0, 0, 0;
  CHECK(code_of(twins, {multiquadric, 0, false, {}}) == HB_ERROR_EXAMPLES_DEGENERATE);
  CHECK(code_of(line, {{KernelKind::gaussian, 1e9}, -1, false, {}}) == HB_ERROR_EXAMPLES_DEGENERATE);

  Matrix bad = line;
  bad(2, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(code_of(bad, {multiquadric, 0, false, {}}) == HB_ERROR_EXAMPLE_NOT_FINITE);
  CHECK(RadialBasisInterpolant::create(bad, {multiquadric, 0, false, {}}).error().index == 2);

  CHECK(code_of(line, {multiquadric, 2, false, {}}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(line, {plate, 0, false, {}}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(line, {plate, 1, true, {}}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(line, {{KernelKind::gaussian, 0}, -1, false, {}}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(line, {multiquadric, 0, false, Vector::Ones(3)}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(line, {multiquadric, 0, false, -Vector::Ones(4)}) == HB_ERROR_INVALID_OPTION);
}
