#include "core/numerics/safe_norm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace handlebody;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("the safe norm of huge, tiny and broken vectors") {
  CHECK(safe_norm(Vector(Eigen::Vector2d(3e200, -4e200))) == doctest::Approx(5e200));
  CHECK(safe_norm(Vector(Eigen::Vector2d(3e-200, 4e-200))) / 5e-200 == doctest::Approx(1));
  CHECK(safe_norm(Vector(Eigen::Vector2d(3e-320, 4e-320))) / 5e-320 == doctest::Approx(1).epsilon(1e-3));
  CHECK(safe_norm(Vector::Zero(3)) == 0);
  CHECK(safe_norm(Vector()) == 0);
  CHECK(std::isnan(safe_norm(Vector(Eigen::Vector2d(1, not_a_number)))));
  CHECK(std::isnan(safe_norm(Vector(Eigen::Vector2d(not_a_number, 1)))));
  CHECK(std::isinf(safe_norm(Vector(Eigen::Vector2d(1, -infinity)))));
}

TEST_CASE("the safe distance is the norm of the difference at any size (seed 54)") {
  std::mt19937 random(54);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double size : {1e-310, 1e-200, 1e-140, 1.0, 1e140, 1e300}) {
    CAPTURE(size);
    for (const Index dimension : {1, 2, 3, 7}) {
      Vector x(dimension), y(dimension);
      for (Index i = 0; i < dimension; ++i) {
        x[i] = size * uniform(random);
        y[i] = size * uniform(random);
      }
      const double expected = safe_norm(x / 2 - y / 2) / size * 2;
      CHECK(safe_distance(x.data(), y.data(), dimension) / size == doctest::Approx(expected).epsilon(size < 1e-300 ? 1e-8 : 1e-14));
      CHECK(safe_distance(x.data(), x.data(), dimension) == 0);
    }
  }
  const double a[] = {1, 2}, b[] = {infinity, 0}, low[] = {-1.7e308, 0}, high[] = {1.7e308, 0};
  CHECK(safe_distance(a, b, 2) == infinity);
  CHECK(safe_distance(low, high, 2) == infinity);
}
