#include "core/interpolation/discrete_green.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "scattered.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

constexpr unsigned seed = 20140728;
constexpr auto free_ends = GridBoundary::free;
constexpr GridBoundary boundaries[] = {free_ends, GridBoundary::dirichlet, GridBoundary::neumann, GridBoundary::periodic};

DiscreteGreen make(Index size, int order, GridBoundary boundary, const std::vector<std::uint32_t>& samples,
                   const std::vector<double>& values) {
  auto made = DiscreteGreen::create(size, order, boundary, samples.data(), values.data(), std::ssize(samples));
  REQUIRE(made);
  return std::move(*made);
}

Vector on_grid(const DiscreteGreen& green) {
  Vector f(green.size());
  green.solve_grid(f.data());
  return f;
}

Vector radial(const DiscreteGreen& green) {
  Vector f(green.size());
  green.solve_radial(f.data());
  return f;
}

double largest(const Matrix& m) {
  return m.size() ? m.cwiseAbs().maxCoeff() : 0;
}

hb_status code_of(Index size, int order, GridBoundary boundary, const std::vector<std::uint32_t>& samples,
                  const std::vector<double>& values) {
  auto made = DiscreteGreen::create(size, order, boundary, samples.data(), values.data(), std::ssize(samples));
  if (made) return HB_OK;
  CHECK(!made.error().remedy.empty());
  return made.error().code;
}

std::vector<std::uint32_t> whole(const std::vector<double>& numbers) {
  return {numbers.begin(), numbers.end()};
}

}  // namespace

TEST_CASE(
    "discrete Green's functions agree with exact fractions to 1e-9: D, G, and the curve on the grid and by radial functions") {
  std::ifstream file(HANDLEBODY_TEST_DATA "/discrete_green.json");
  REQUIRE(file.good());
  int cases = 0;
  double worst_green = 0, worst_grid = 0, worst_radial = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.find("\"size\"") == std::string::npos) continue;
    const auto number = [&](const char* key) { return numbers(line, key).at(0); };
    const auto size = static_cast<Index>(number("size"));
    const auto boundary = boundaries[static_cast<std::size_t>(number("boundary"))];
    const auto green =
        make(size, static_cast<int>(number("order")), boundary, whole(numbers(line, "samples")), numbers(line, "values"));
    CAPTURE(line.substr(0, 60));
    const Matrix d = matrix_of(numbers(line, "operator"), size), curve = matrix_of(numbers(line, "curve"), 1);
    REQUIRE(green.difference().rows() == d.rows());
    CHECK(green.difference() == d);
    CHECK(green.squared() == Matrix(d.transpose() * d));
    if (size < 12) {
      const Matrix expected = matrix_of(numbers(line, "green"), size);
      worst_green = std::max(worst_green, largest(green.green() - expected) / largest(expected));
    }
    worst_grid = std::max(worst_grid, largest(on_grid(green) - curve) / largest(curve));
    worst_radial = std::max(worst_radial, largest(radial(green) - curve) / largest(curve));
    ++cases;
  }
  CHECK(cases == 24);
  CHECK(worst_green < 1e-12);
  CHECK(worst_grid < 1e-9);
  CHECK(worst_radial < 1e-9);
  MESSAGE("worst of G " << worst_green << ", grid " << worst_grid << ", radial " << worst_radial);
}

TEST_CASE("discrete Green's functions: the null space, and G as the corner of the bordered inverse") {
  for (const auto boundary : boundaries)
    for (int order = 1; order <= 3; ++order) {
      const Index size = 30;
      const auto green = make(size, order, boundary, {0, 1, 2}, {0, 0, 0});
      const Matrix& n = green.null_space();
      CHECK(n.cols() == (boundary == free_ends ? order : boundary == GridBoundary::dirichlet ? 0 : 1));
      CHECK(largest(n.transpose() * n - Matrix::Identity(n.cols(), n.cols())) < 1e-14);
      CHECK(largest(green.difference() * n) < 1e-13);
      const Index whole_size = size + n.cols();
      Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(whole_size, whole_size);
      bordered.topLeftCorner(size, size) = green.squared();
      bordered.topRightCorner(size, n.cols()) = n;
      bordered.bottomLeftCorner(n.cols(), size) = n.transpose();
      const Matrix inverse = Eigen::FullPivLU<Eigen::MatrixXd>(bordered).inverse();
      CHECK(largest(inverse.topLeftCorner(size, size) - green.green()) < 1e-7 * largest(green.green()));
      // DᵀD G = I − N Nᵀ, the identity where DᵀD is regular.
      const Matrix identity = Matrix::Identity(size, size) - n * n.transpose();
      CHECK(largest(green.squared() * green.green() - identity) < 1e-13 * largest(green.green()) * 64);
      CHECK(largest(green.green() - green.green().transpose()) < 1e-13 * largest(green.green()));
    }
}

TEST_CASE("discrete Green's functions: first differences in closed form") {
  for (const Index size : {2, 17, 1024}) {
    const auto n = static_cast<double>(size);
    const auto dirichlet = make(size, 1, GridBoundary::dirichlet, {0}, {1}),
               neumann = make(size, 1, GridBoundary::neumann, {0}, {1}), periodic = make(size, 1, GridBoundary::periodic, {0}, {1}),
               free = make(size, 1, free_ends, {0}, {1});
    double worst = 0;
    for (Index i = 0; i < size; ++i)
      for (Index j = 0; j < size; ++j) {
        const auto x = static_cast<double>(i), y = static_cast<double>(j), m = std::abs(x - y), middle = (n - 1) / 2;
        // Piecewise linear with its kink at j, zero one beyond either end.
        const double hat = (std::min(x, y) + 1) * (n - std::max(x, y)) / (n + 1);
        const double flat = (n * n - 1) / (12 * n) - m / 2 + ((x - middle) * (x - middle) + (y - middle) * (y - middle)) / (2 * n);
        const double round = (n * n - 1) / (12 * n) - m * (n - m) / (2 * n);
        for (const double error : {dirichlet.green()(i, j) - hat, neumann.green()(i, j) - flat, free.green()(i, j) - flat,
                                   periodic.green()(i, j) - round})
          worst = std::max(worst, std::abs(error));
      }
    CHECK(worst < 1e-12 * n);
  }
}

TEST_CASE("discrete Green's functions: free first differences are linear interpolation, second approach the natural cubic spline") {
  const auto linear = make(12, 1, free_ends, {2, 5, 9}, {1, 4, 2});
  Vector expected(12);
  expected << 1, 1, 1, 2, 3, 4, 3.5, 3, 2.5, 2, 2, 2;
  CHECK(largest(on_grid(linear) - expected) < 1e-14);
  CHECK(largest(radial(linear) - expected) < 1e-13);

  std::ifstream file(HANDLEBODY_TEST_DATA "/discrete_green.json");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  double before = 0;
  int splines = 0;
  for (std::size_t at = text.find("\"step\""); at != std::string::npos; at = text.find("\"step\"", at + 1), ++splines) {
    const std::string line = text.substr(at, text.find('}', at) - at);
    const auto step = static_cast<std::uint32_t>(numbers(line, "step").at(0));
    const auto every = static_cast<Index>(numbers(line, "every").at(0));
    const auto curve = numbers(line, "curve");
    const auto green = make(4 * step + 1, 2, free_ends, {0, step, 2 * step, 3 * step, 4 * step}, numbers(line, "values"));
    const Vector f = on_grid(green);
    CHECK(largest(f - radial(green)) < 1e-10);
    double error = 0;
    for (std::size_t k = 0; k < curve.size(); ++k) error = std::max(error, std::abs(f[static_cast<Index>(k) * every] - curve[k]));
    if (before > 0) CHECK(before / error == doctest::Approx(4).epsilon(0.1));
    before = error;
  }
  CHECK(splines == 5);
  CHECK(before < 1e-3);
}

TEST_CASE("discrete Green's functions: grid and radial solves agree for any samples, reproduce N, and minimize (seed 20140728)") {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (const auto boundary : boundaries)
    for (int order = 1; order <= 3; ++order)
      for (const Index size : {order + 1, 10, 60}) {
        CAPTURE(static_cast<unsigned>(boundary));
        CAPTURE(order);
        CAPTURE(size);
        std::vector<std::uint32_t> samples(size);
        for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<std::uint32_t>(i);
        std::shuffle(samples.begin(), samples.end(), random);
        samples.resize(std::max<Index>(order, size / 5));
        std::vector<double> values(samples.size());
        for (double& value : values) value = normal(random);
        const auto green = make(size, order, boundary, samples, values);
        const Vector f = on_grid(green), g = radial(green);
        // What cancels among the radial functions is 1e-16 of G's largest element times λ's.
        const double lambda = largest(green.squared() * f);
        Vector again(size), weights(std::ssize(samples) + green.null_space().cols());
        green.solve_radial(again.data(), weights.data());
        CHECK(again == g);
        for (std::size_t k = 0; k < samples.size(); ++k)  // λ is the force that DᵀD f takes
          CHECK(std::abs(weights[static_cast<Index>(k)] - green.squared().row(samples[k]).dot(f)) < 1e-7 * std::max(1.0, lambda));
        CHECK(largest(f - g) < 1e-13 * std::max(1.0, largest(green.green()) * lambda));
        worst = std::max(worst, largest(f - g));
        for (std::size_t k = 0; k < samples.size(); ++k) CHECK(f[samples[k]] == values[k]);

        // Any other curve through the samples is rougher.
        Vector other = f;
        for (Index i = 0; i < size; ++i)
          if (std::find(samples.begin(), samples.end(), static_cast<std::uint32_t>(i)) == samples.end())
            other[i] += 1e-3 * normal(random);
        CHECK((green.difference() * other).squaredNorm() >= (green.difference() * f).squaredNorm() * (1 - 1e-12));

        const Matrix& n = green.null_space();
        if (n.cols() == 0) continue;
        const Vector polynomial = n * Vector::LinSpaced(n.cols(), 1, 2);
        for (std::size_t k = 0; k < samples.size(); ++k) values[k] = polynomial[samples[k]];
        const auto exact = make(size, order, boundary, samples, values);
        CHECK(largest(on_grid(exact) - polynomial) < 1e-9);
        CHECK(largest(radial(exact) - polynomial) < 1e-9);
      }
  MESSAGE("largest difference between grid and radial solves " << worst);
}

TEST_CASE("discrete Green's functions: grid and radial solves agree to 1e-7 on the largest grid") {
  double worst = 0;
  for (const auto boundary : boundaries)
    for (int order = 1; order <= 3; ++order) {
      CAPTURE(static_cast<unsigned>(boundary));
      CAPTURE(order);
      const auto green = make(1024, order, boundary, {100, 900, 511, 301, 700}, {1, -1, 0.5, 2, 0});
      const Vector f = on_grid(green), g = radial(green);
      CHECK(largest(f - g) < 1e-7 * largest(f));
      worst = std::max(worst, largest(f - g) / largest(f));
    }
  MESSAGE("largest difference " << worst);
}

TEST_CASE("discrete Green's functions: bad input is named") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(code_of(20, 0, free_ends, {1, 2}, {0, 1}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(20, 4, free_ends, {1, 2}, {0, 1}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(2, 2, free_ends, {0, 1}, {0, 1}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(1025, 2, free_ends, {0, 1}, {0, 1}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(-1, 2, free_ends, {0, 1}, {0, 1}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(20, 2, free_ends, {1}, {0}) == HB_ERROR_POINTS_TOO_FEW);
  CHECK(code_of(20, 3, free_ends, {1, 2}, {0, 1}) == HB_ERROR_POINTS_TOO_FEW);
  CHECK(code_of(20, 2, GridBoundary::neumann, {1}, {0}) == HB_OK);
  CHECK(code_of(20, 2, GridBoundary::dirichlet, {1}, {0}) == HB_OK);
  CHECK(code_of(20, 2, GridBoundary::dirichlet, {}, {}) == HB_ERROR_POINTS_TOO_FEW);
  CHECK(code_of(20, 2, free_ends, {1, 20}, {0, 1}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(20, 2, free_ends, {1, 5, 1}, {0, 1, 0}) == HB_ERROR_POINT_DUPLICATE);
  CHECK(code_of(20, 2, free_ends, {1, 5, 7}, {0, nan, 0}) == HB_ERROR_VALUE_NOT_FINITE);
  const std::uint32_t samples[] = {3, 9, 3};
  const double values[] = {1, 2, 3};
  auto made = DiscreteGreen::create(20, 1, free_ends, samples, values, 3);
  REQUIRE(!made);
  CHECK(made.error().index == 2);
  CHECK(made.error().culprit == HB_CULPRIT_POINT);
}
