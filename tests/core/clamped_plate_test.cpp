#include "core/kernels/clamped_plate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <vector>

using namespace handlebody;

namespace {

/** ∫ from low to high, smooth: Simpson's rule. */
double plate_simpson(double low, double high, const std::function<double(double)>& f) {
  constexpr int steps = 4000;
  const double h = (high - low) / steps;
  double sum = f(low) + f(high);
  for (int i = 1; i < steps; ++i) sum += (i % 2 ? 4 : 2) * f(low + i * h);
  return sum * h / 3;
}

/** Boggio's formula as it stands, v = eᵘ: k ‖x−y‖^(2m−d) ∫₁^(A/‖x−y‖) (v² − 1)^(m−1) v^(1−d) dv. */
double boggio(const ClampedPlate& plate, double squared, double b) {
  const double m = plate.order, d = static_cast<double>(plate.dimension), distance = std::sqrt(squared);
  const double integral = plate_simpson(0, std::log(std::sqrt(squared + b) / distance), [&](double u) {
    const double v = std::exp(u);
    return std::pow(v * v - 1, m - 1) * std::pow(v, 2 - d);
  });
  return (2 * m - d) * std::pow(distance, 2 * m - d) * integral;
}

/** All orders up to 5 that are defined in up to four dimensions. */
std::vector<ClampedPlate> plates() {
  std::vector<ClampedPlate> all;
  for (int order = 1; order <= 5; ++order)
    for (Index dimension = 1; dimension <= 4 && dimension < 2 * order; ++dimension) all.push_back({order, dimension});
  return all;
}

double plate_between(const ClampedPlate& plate, const Eigen::Vector2d& x, const Eigen::Vector2d& y) {
  return plate.value((x - y).squaredNorm(), (1 - x.squaredNorm()) * (1 - y.squaredNorm()));
}

}  // namespace

TEST_CASE("the clamped plate in closed form: a string, a plate and its analog in space") {
  for (const double q : {1e-6, 0.01, 0.3, 1.0, 3.5})
    for (const double b : {1e-5, 0.02, 0.4, 1.0}) {
      CAPTURE(q);
      CAPTURE(b);
      const double root = std::sqrt(q), high = std::sqrt(q + b);
      CHECK(ClampedPlate{1, 1}.value(q, b) == doctest::Approx(b / (high + root)).epsilon(1e-12));
      if (b > 0.1 * q) {  // else these differences lose their digits
        CHECK(ClampedPlate{2, 2}.value(q, b) == doctest::Approx(b - q * std::log1p(b / q)).epsilon(1e-11));
        CHECK(ClampedPlate{2, 3}.value(q, b) == doctest::Approx(high + q / high - 2 * root).epsilon(1e-11));
        CHECK(ClampedPlate{2, 2}.slope(q, b) == doctest::Approx(b / (q + b) - std::log1p(b / q)).epsilon(1e-10));
      }
      CHECK(ClampedPlate{2, 2}.boundary_slope(q, b) == doctest::Approx(b / (q + b)).epsilon(1e-13));
    }
}

TEST_CASE("the clamped plate is Boggio's integral, in every order and dimension, on both sides of the change of method") {
  for (const ClampedPlate& plate : plates()) {
    CAPTURE(plate.order);
    CAPTURE(plate.dimension);
    for (const double ratio : {0.01, 0.5, 3.9, 4.1, 20.0, 1e4}) {
      CAPTURE(ratio);
      for (const double b : {0.02, 0.9})
        CHECK(plate.value(b / ratio, b) == doctest::Approx(boggio(plate, b / ratio, b)).epsilon(1e-9));
    }
  }
}

TEST_CASE("slopes of the clamped plate are differences of its values") {
  for (const ClampedPlate& plate : plates()) {
    CAPTURE(plate.order);
    CAPTURE(plate.dimension);
    for (const double q : {0.004, 0.1, 0.7})
      for (const double b : {0.1, 0.5, 0.9}) {
        const double h = 1e-4 * q, g = 1e-4 * b;
        CHECK(plate.slope(q, b) == doctest::Approx((plate.value(q + h, b) - plate.value(q - h, b)) / (2 * h)).epsilon(1e-6));
        CHECK(plate.boundary_slope(q, b) ==
              doctest::Approx((plate.value(q, b + g) - plate.value(q, b - g)) / (2 * g)).epsilon(1e-6));
      }
  }
}

TEST_CASE("at one place the clamped plate is b^(m−d/2), 1 in the middle, and it comes there without a jump") {
  for (const ClampedPlate& plate : plates()) {
    CAPTURE(plate.order);
    CAPTURE(plate.dimension);
    CHECK(plate.value(0, 1) == doctest::Approx(1));
    for (const double b : {0.1, 0.7}) {
      const double there = std::pow(b, plate.order - static_cast<double>(plate.dimension) / 2);
      CHECK(plate.value(0, b) == doctest::Approx(there).epsilon(1e-13));
      CHECK(plate.value(1e-28, b) == doctest::Approx(there).epsilon(1e-12));
    }
    CHECK(plate.slope(0, 0.5) == 0);
  }
}

TEST_CASE("on the sphere the clamped plate and its derivatives below m vanish: it falls as b^m does") {
  for (const ClampedPlate& plate : plates()) {
    CHECK(plate.value(0.5, 0) == 0);
    CHECK(plate.slope(0.5, 0) == 0);
    CHECK(plate.boundary_slope(0.5, 0) == 0);
    CHECK(plate.value(0.5, -1e-17) == 0);  // a point on it, with rounding
    const double near = plate.value(0.5, 1e-4), nearer = plate.value(0.5, 1e-5);
    CHECK(std::log10(near / nearer) == doctest::Approx(plate.order).epsilon(1e-4));
  }
}

TEST_CASE("away from its load the clamped plate of the plane is biharmonic") {
  const ClampedPlate plate{2, 2};
  const Eigen::Vector2d load(0.3, -0.2);
  constexpr double h = 0.01;
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(-0.4, 0.5), Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(-0.1, -0.7)}) {
    const auto f = [&](int i, int j) { return plate_between(plate, at + h * Eigen::Vector2d(i, j), load); };
    const double twice = 20 * f(0, 0) - 8 * (f(1, 0) + f(-1, 0) + f(0, 1) + f(0, -1)) +
                         2 * (f(1, 1) + f(1, -1) + f(-1, 1) + f(-1, -1)) + f(2, 0) + f(-2, 0) + f(0, 2) + f(0, -2);
    const double fourth = f(2, 0) - 4 * f(1, 0) + 6 * f(0, 0) - 4 * f(-1, 0) + f(-2, 0);  // one of its terms, for comparison
    CHECK(std::abs(twice) < 1e-2 * std::abs(fourth));
  }
}
