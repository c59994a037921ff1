#include "core/interpolation/polynomial.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace handlebody;

namespace {

constexpr unsigned seed = 20140728;

Matrix random_points(std::mt19937& random, Index count, Index dimension) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(count, dimension, [&] { return uniform(random); });
}

}  // namespace

TEST_CASE("polynomials: monomials in the documented order") {
  const double x[] = {2, 3, 5};
  std::vector<double> values(10, -1);
  CHECK(polynomial_count(-1, 3) == 0);
  CHECK(polynomial_count(0, 3) == 1);
  CHECK(polynomial_count(1, 3) == 4);
  CHECK(polynomial_count(2, 3) == 10);
  CHECK(polynomial_count(2, 1) == 3);
  CHECK(polynomial_count(2, 64) == 2145);
  polynomial_values(x, 3, -1, values.data());
  CHECK(values[0] == -1);  // nothing is written
  polynomial_values(x, 3, 2, values.data());
  CHECK(values == std::vector<double>{1, 2, 3, 5, 4, 6, 10, 9, 15, 25});
}

TEST_CASE("polynomials: gradients agree with central differences, which are exact up to degree 2 (seed 20140728)") {
  std::mt19937 random(seed);
  for (const Index d : {1, 2, 5}) {
    for (int degree = -1; degree <= 2; ++degree) {
      const Index count = polynomial_count(degree, d);
      const Matrix x = random_points(random, 1, d);
      std::vector<double> gradients(count * d, 7.0), before(count), after(count);
      polynomial_gradients(x.data(), d, degree, gradients.data());
      for (Index axis = 0; axis < d; ++axis) {
        Matrix left = x, right = x;
        left(0, axis) -= 0.5;
        right(0, axis) += 0.5;
        polynomial_values(left.data(), d, degree, before.data());
        polynomial_values(right.data(), d, degree, after.data());
        for (Index j = 0; j < count; ++j) CHECK(std::abs(gradients[j * d + axis] - (after[j] - before[j])) < 1e-14);
      }
    }
  }
}
