#include "core/kernels/tension_kernel.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "oracle_lines.hpp"

using namespace handlebody;

namespace {

constexpr unsigned seed = 20140728;
constexpr double pi = 3.14159265358979323846;

struct Weights {
  double alpha, beta, gamma;
};

TensionKernel make(const Weights& weights, Index dimension) {
  auto kernel = TensionKernel::create(weights.alpha, weights.beta, weights.gamma, dimension);
  REQUIRE(kernel);
  return *kernel;
}

hb_status code_of(const Weights& weights, Index dimension = 1) {
  auto kernel = TensionKernel::create(weights.alpha, weights.beta, weights.gamma, dimension);
  if (kernel) return HB_OK;
  CHECK(!kernel.error().message.empty());
  CHECK(!kernel.error().remedy.empty());
  return kernel.error().code;
}

/** Area of the sphere of radius r. */
double sphere(Index dimension, double r) {
  return dimension == 1 ? 2 : dimension == 2 ? 2 * pi * r : 4 * pi * r * r;
}

/** ΔG by fourth-order differences of G′. */
double laplacian(const TensionKernel& kernel, Index dimension, double r, double h) {
  const double second =
      (8 * (kernel.slope(r + h) - kernel.slope(r - h)) - kernel.slope(r + 2 * h) + kernel.slope(r - 2 * h)) / (12 * h);
  return second + static_cast<double>(dimension - 1) / r * kernel.slope(r);
}

// Two real roots, equal ones, a complex pair; without γ; without β.
const Weights all_weights[] = {{1, 5, 4}, {0.5, 40, 1}, {1, 2, 1}, {1, 0.5, 1}, {2, 0, 3}, {1, 1, 0}, {0.1, 3, 0}, {2, 0, 0}};

}  // namespace

// Tolerance: rounding kr and e^{−kr} alone makes errors of that order in rG′, for G′ in rG″ (more than G where it oscillates or
// decays).
TEST_CASE("the kernel and its slope agree with mpmath to 1e-14 in 1, 2 and 3 dimensions") {
  int checked = 0;
  double worst = 0, worst_slope = 0;
  for (const std::string& line : oracle_lines("tension_kernel.json")) {
    const auto r = oracle_numbers(line, "r"), value = oracle_numbers(line, "value"), slope = oracle_numbers(line, "slope"),
               second = oracle_numbers(line, "second");
    if (r.empty()) continue;
    const auto weight = [&](const char* name) { return oracle_numbers(line, name).at(0); };
    const auto dimension = static_cast<Index>(weight("dimension"));
    const TensionKernel kernel = make({weight("alpha"), weight("beta"), weight("gamma")}, dimension);
    CAPTURE(line.substr(0, 70));
    for (std::size_t i = 0; i < r.size(); ++i, ++checked) {
      CAPTURE(r[i]);
      const double error = std::abs(kernel.value(r[i]) - value.at(i)), error_slope = std::abs(kernel.slope(r[i]) - slope.at(i));
      const double size = std::abs(value[i]) + r[i] * std::abs(slope[i]);
      const double size_slope = std::abs(slope[i]) + r[i] * std::abs(second.at(i));
      CHECK(error <= 1e-14 * size + 1e-300);
      CHECK(error_slope <= 1e-14 * size_slope + 1e-300);
      if (size > 1e-290) worst = std::max(worst, error / size);
      if (size_slope > 1e-290) worst_slope = std::max(worst_slope, error_slope / size_slope);
    }
  }
  CHECK(checked > 800);
  MESSAGE(checked << " values, worst error " << worst << ", of the slope " << worst_slope);
}

TEST_CASE("the slope is the value's derivative, by central differences to 1e-6") {
  for (const Weights& weights : all_weights)
    for (Index dimension = 1; dimension <= 3; ++dimension) {
      const TensionKernel kernel = make(weights, dimension);
      for (double r = 0.02; r < 12; r *= 1.17) {
        CAPTURE(r);
        const double h = 1e-5 * r, difference = (kernel.value(r + h) - kernel.value(r - h)) / (2 * h);
        CHECK(std::abs(kernel.slope(r) - difference) <= 1e-6 * (std::abs(difference) + std::abs(kernel.value(r))));
      }
    }
}

// The scale of G, and the equation: by Gauss's theorem the flux of α∇ΔG − β∇G out of a ball of radius R, and γ∫G in it, make 1.
TEST_CASE("alpha L^2 G - beta L G + gamma G = delta: its integral over balls is 1 to 1e-6") {
  for (const Weights& weights : all_weights)
    for (Index dimension = 1; dimension <= 3; ++dimension) {
      const TensionKernel kernel = make(weights, dimension);
      CAPTURE(weights.alpha);
      CAPTURE(weights.beta);
      CAPTURE(weights.gamma);
      CAPTURE(dimension);
      for (const double radius : {0.3, 1.0, 2.5, 5.0}) {
        constexpr int panels = 2000;
        double inside = 0;  // Simpson's rule, in t with r = t², which smooths r ln r
        for (int i = 0; i <= panels; ++i) {
          const double t = std::sqrt(radius) * i / panels, weight = i == 0 || i == panels ? 1 : i % 2 ? 4 : 2;
          inside += weight * (i == 0 ? 0 : kernel.value(t * t) * sphere(dimension, t * t) * 2 * t);
        }
        inside *= std::sqrt(radius) / panels / 3;
        const double h = 0.02 * radius;
        const auto at = [&](double offset) { return laplacian(kernel, dimension, radius + offset * h, h / 4); };
        const double jerk = (8 * (at(1) - at(-1)) - at(2) + at(-2)) / (12 * h);
        const double flux = (weights.alpha * jerk - weights.beta * kernel.slope(radius)) * sphere(dimension, radius);
        CHECK(flux + weights.gamma * inside == doctest::Approx(1).epsilon(1e-6));
      }
    }
}

TEST_CASE("the cases join: close roots, and gamma -> 0 up to a constant") {
  for (Index dimension = 1; dimension <= 3; ++dimension) {
    const TensionKernel equal = make({1, 2, 1}, dimension), none = make({1, 2, 0}, dimension), plate = make({1, 0, 0}, dimension);
    for (const double change : {1e-4, 1e-7, 1e-10, 1e-13, -1e-13, -1e-10, -1e-7, -1e-4}) {
      const TensionKernel close = make({1, 2 + change, 1}, dimension);
      for (const double r : {0.01, 0.5, 1.3, 1.9, 2.1, 4.0, 10.0}) {
        CAPTURE(change);
        CAPTURE(r);
        CHECK(close.value(r) == doctest::Approx(equal.value(r)).epsilon((1 + r) * std::abs(change) + 1e-14));
        CHECK(close.slope(r) == doctest::Approx(equal.slope(r)).epsilon((1 + r) * std::abs(change) + 1e-14));
      }
    }
    const TensionKernel nearly = make({1, 2, 1e-14}, dimension);
    for (const double r : {0.01, 0.5, 0.7, 0.8, 1.4, 1.5, 2.1, 10.0}) {
      CAPTURE(r);
      CHECK(nearly.slope(r) == doctest::Approx(none.slope(r)).epsilon(1e-6));
      CHECK(nearly.value(r) - nearly.value(1) == doctest::Approx(none.value(r) - none.value(1)).epsilon(1e-6));
    }
    // β → 0 is the plate up to multiples of 1 and r², which the side conditions of its tail make linear functions.
    const TensionKernel slack = make({1, 1e-14, 0}, dimension);
    const auto third = [](const TensionKernel& kernel) {
      return kernel.value(4) - 3 * kernel.value(3) + 3 * kernel.value(2) - kernel.value(1);
    };
    CHECK(third(slack) == doctest::Approx(third(plate)).epsilon(1e-6));
  }
}

TEST_CASE("no step where the methods change, in r") {
  for (const Weights& weights : all_weights)
    for (Index dimension = 1; dimension <= 3; ++dimension) {
      const TensionKernel kernel = make(weights, dimension);
      for (double r = 0.05; r < 8; r *= 1.01) {
        const double next = std::nextafter(r, 9);
        CHECK(std::abs(kernel.value(next) - kernel.value(r)) <=
              4e-15 * (std::abs(kernel.value(r)) + r * std::abs(kernel.slope(r))));
      }
    }
}

TEST_CASE("at r = 0 and far away the kernel has its limits") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Weights& weights : all_weights)
    for (Index dimension = 1; dimension <= 3; ++dimension) {
      const TensionKernel kernel = make(weights, dimension);
      CAPTURE(weights.beta);
      CAPTURE(weights.gamma);
      CAPTURE(dimension);
      CHECK(kernel.minimum_degree() == (weights.gamma > 0 ? -1 : weights.beta > 0 ? 0 : 1));
      CHECK(kernel.value(0) == doctest::Approx(kernel.value(1e-12)).epsilon(1e-10));
      CHECK(kernel.slope(0) == doctest::Approx(dimension == 3 ? -1 / (8 * pi * weights.alpha) : 0));
      CHECK(kernel.slope(1e-300) == doctest::Approx(kernel.slope(0)));
      if (weights.gamma == 0) {
        CHECK(kernel.value(0) == 0);
        continue;
      }
      CHECK(kernel.value(0) > 0);
      CHECK(kernel.value(1e5) == 0);
      CHECK(kernel.slope(1e5) == 0);
      CHECK(kernel.value(infinity) == 0);
      CHECK(kernel.slope(infinity) == 0);
    }
  CHECK(make({0, 2, 8}, 1).value(0) == doctest::Approx(1.0 / 8));  // 1/(2kβ), k = 2
  CHECK(make({0, 2, 8}, 1).slope(0) == doctest::Approx(-1.0 / 4));
}

TEST_CASE("scaled: the kernel of scaled coordinates has the same values, up to the tail (seed 20140728)") {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-3, 3);
  for (const Weights& weights : all_weights)
    for (Index dimension = 1; dimension <= 3; ++dimension) {
      const double s = std::exp(exponent(random));
      const TensionKernel kernel = make(weights, dimension);
      auto scaled = kernel.scaled(s);
      REQUIRE(scaled);
      for (const double r : {0.1, 0.7, 3.0}) {
        CAPTURE(r);
        const double tolerance = 1e-13 * (std::abs(kernel.value(r)) + r * std::abs(kernel.slope(r)));
        // r² ln r alone changes, by a multiple of r².
        const double tail =
            dimension == 2 && weights.beta + weights.gamma == 0 ? std::log(s) * r * r / (8 * pi * weights.alpha) : 0;
        CHECK(std::abs(scaled->value(s * r) - kernel.value(r) - tail) <= 10 * tolerance + 1e-14 * std::abs(tail));
      }
    }
}

TEST_CASE("bad weights are named") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  CHECK(code_of({1, 1, 1}) == HB_OK);
  for (const double bad : {-1.0, nan, infinity}) {
    CHECK(code_of({bad, 1, 1}) == HB_ERROR_INVALID_OPTION);
    CHECK(code_of({1, bad, 1}) == HB_ERROR_INVALID_OPTION);
    CHECK(code_of({1, 1, bad}) == HB_ERROR_INVALID_OPTION);
  }
  CHECK(TensionKernel::create(1, -2, 0, 2).error().message.find("beta is -2") != std::string::npos);
  CHECK(code_of({0, 0, 0}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of({0, 0, 1}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of({0, 1, 1}, 1) == HB_OK);
  CHECK(code_of({0, 1, 1}, 2) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of({0, 1, 0}, 3) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of({1, 1, 1}, 0) == HB_ERROR_INVALID_SHAPE);
  CHECK(code_of({1, 1, 1}, 4) == HB_ERROR_INVALID_SHAPE);
  CHECK(code_of({1e-300, 1e300, 1}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of({1e300, 1e-300, 0}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of({1, 1, 1e-300}, 3) == HB_OK);
}
