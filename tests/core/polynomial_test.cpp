#include "core/interpolation/polynomial.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace handlebody;

namespace {

constexpr unsigned seed = 20140728;

Matrix random_points(std::mt19937& random, Index count, Index dimension) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(count, dimension, [&] { return uniform(random); });
}

hb_status code_of(const Matrix& points, int degree) {
  auto checked = check_unisolvent(points, degree);
  if (checked) return HB_OK;
  CHECK(!checked.error().remedy.empty());
  return checked.error().code;
}

std::string message_of(const Matrix& points, int degree) {
  auto checked = check_unisolvent(points, degree);
  return checked ? "" : checked.error().message;
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

TEST_CASE("polynomials: points in general position are unisolvent, with one fewer they are too few (seed 20140728)") {
  std::mt19937 random(seed);
  for (const Index d : {1, 2, 3, 6})
    for (int degree = 0; degree <= 2; ++degree) {
      const Matrix points = random_points(random, polynomial_count(degree, d), d);
      CAPTURE(d);
      CAPTURE(degree);
      CHECK(code_of(points, degree) == HB_OK);
      CHECK(code_of(points.topRows(points.rows() - 1), degree) == HB_ERROR_POINTS_TOO_FEW);
      CHECK(code_of(points.topRows(0), -1) == HB_OK);
      Matrix thin = points;  // proportions do not matter
      thin.col(0) *= 1e-8;
      CHECK(code_of(thin, degree) == HB_OK);
    }
  CHECK(message_of(random_points(random, 1, 2), 1) == "1 point does not determine a linear function of 2 dimensions.");
}

TEST_CASE("polynomials: degenerate points are named (seed 20140728)") {
  std::mt19937 random(seed);
  const Matrix free = random_points(random, 30, 3);
  Matrix line(30, 3), plane = free, circle(30, 2), two_places(30, 1), sphere = free;
  for (Index i = 0; i < 30; ++i) {
    line.row(i) << free(i, 0), 1 - 2 * free(i, 0), free(i, 0) / 3;
    plane(i, 2) = 0.3 + free(i, 0) - 0.2 * free(i, 1);
    circle.row(i) << 0.2 + 0.7 * std::cos(i), 0.1 + 1e-4 * std::sin(i);  // a long ellipse
    two_places(i, 0) = i % 2 ? 0.3 : -0.4;
    sphere.row(i) /= free.row(i).norm();
  }
  CHECK(message_of(line, 1).find("1 dimension only (they lie on one line)") != std::string::npos);
  CHECK(message_of(plane, 2).find("2 dimensions only (they lie on one plane)") != std::string::npos);
  CHECK(message_of(Matrix::Constant(30, 3, 0.7), 1).find("coincide") != std::string::npos);
  CHECK(message_of(circle, 2) ==
        "The points determine only 5 of the 6 coefficients of a quadratic function of 2 dimensions: they lie on one conic.");
  CHECK(message_of(two_places, 2).find("two places") != std::string::npos);
  CHECK(message_of(sphere, 2).find("9 of the 10") != std::string::npos);
  for (const Matrix& points : {line, plane, Matrix(Matrix::Constant(30, 3, 0.7)), circle, two_places, sphere}) {
    CHECK(code_of(points, 2) == HB_ERROR_POINTS_DEGENERATE);
    CHECK(code_of(points, 0) == HB_OK);
  }
  CHECK(code_of(circle, 1) == HB_OK);
  CHECK(code_of(two_places, 1) == HB_OK);
  CHECK(code_of(sphere, 1) == HB_OK);
  circle(3, 1) += 0.01;
  CHECK(code_of(circle, 2) == HB_OK);
}
