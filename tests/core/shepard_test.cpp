#include "core/interpolation/shepard.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <string>

#include "scattered.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

constexpr unsigned seed = 1968;

Shepard make(const Matrix& points, const Matrix& values, double power, double epsilon = 0) {
  auto made = Shepard::create(points, values, {power, epsilon});
  REQUIRE(made);
  return std::move(*made);
}

hb_status code_of(const Matrix& points, const Matrix& values, double power, double epsilon = 0) {
  auto made = Shepard::create(points, values, {power, epsilon});
  return made ? HB_OK : made.error().code;
}

Matrix row(std::initializer_list<double> numbers) {
  Matrix out(1, std::ssize(numbers));
  std::copy(numbers.begin(), numbers.end(), out.data());
  return out;
}

}  // namespace

TEST_CASE("Shepard agrees with the formula in 50 digits to 1e-12, gradients too, at every scale") {
  std::ifstream file(HANDLEBODY_TEST_DATA "/shepard.json");
  REQUIRE(file.good());
  int cases = 0;
  double worst_value = 0, worst_gradient = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.size() < 3) continue;
    const auto dimension = static_cast<Index>(numbers(line, "dimension").at(0));
    const auto outputs = static_cast<Index>(numbers(line, "outputs").at(0));
    auto f = make(matrix_of(numbers(line, "points"), dimension), matrix_of(numbers(line, "values"), outputs),
                  numbers(line, "power").at(0), numbers(line, "epsilon").at(0));
    const Matrix queries = matrix_of(numbers(line, "queries"), dimension);
    const Matrix expected = matrix_of(numbers(line, "expected"), outputs);
    const Matrix gradients = matrix_of(numbers(line, "gradients"), outputs * dimension);
    const double value = (values_at(f, queries) - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
    const double gradient =
        (gradients_at(f, queries) / gradients.cwiseAbs().maxCoeff() - gradients / gradients.cwiseAbs().maxCoeff())
            .cwiseAbs()
            .maxCoeff();
    CAPTURE(cases);
    CHECK(value < 1e-12);
    CHECK(gradient < 1e-12);
    worst_value = std::max(worst_value, value);
    worst_gradient = std::max(worst_gradient, gradient);
    ++cases;
  }
  CHECK(cases == 44);
  MESSAGE("worst value " << worst_value << ", worst gradient " << worst_gradient);
}

TEST_CASE("Shepard interpolates, its weights are a partition of unity within [0, 1], in any order (seed 1968)") {
  std::mt19937 random(seed);
  for (const Index d : {1, 2, 3, 7})
    for (const double power : {0.3, 1.0, 2.0, 9.0}) {
      const Matrix points = random_points(random, 25, d), values = random_points(random, 25, 3),
                   queries = random_points(random, 20, d);
      auto f = make(points, values, power), reversed = make(points.colwise().reverse(), values.colwise().reverse(), power);
      CHECK((values_at(f, points) - values).cwiseAbs().maxCoeff() == 0);
      CHECK((values_at(f, queries) - values_at(reversed, queries)).cwiseAbs().maxCoeff() < 1e-14);
      for (Index q = 0; q < queries.rows(); ++q) {
        const Vector w = weights_at(f, queries.row(q));
        CHECK(std::abs(w.sum() - 1) < 1e-14);
        CHECK(w.minCoeff() >= 0);
        CHECK(std::abs(w.dot(values.col(1)) - values_at(f, queries.row(q))(0, 1)) < 1e-14);
      }
    }
}

TEST_CASE("Shepard gradients agree with central differences (seed 1968)") {
  std::mt19937 random(seed);
  for (const Index d : {1, 2, 5})
    for (const double power : {0.7, 1.0, 2.0, 4.5})
      for (const double epsilon : {0.0, 0.1}) {
        auto f = make(random_points(random, 15, d), random_points(random, 15, 2), power, epsilon);
        CHECK(gradient_error(f, random_points(random, 30, d), 1e-6) < 2e-6);
      }
}

TEST_CASE("Shepard is flat at the points for p > 1 and has cusps for p <= 1 (Figs. 9 and 10; seed 1968)") {
  std::mt19937 random(seed);
  const Matrix points = random_points(random, 12, 2), values = random_points(random, 12, 1);
  for (const double power : {1.5, 2.0, 3.0}) {
    auto f = make(points, values, power);
    CHECK(gradients_at(f, points).cwiseAbs().maxCoeff() == 0);
    double before = std::numeric_limits<double>::infinity();
    for (const double step : {1e-3, 1e-5, 1e-7, 1e-9}) {  // slopes on both sides shrink like step^(p − 1)
      Matrix beside = points;
      beside.col(0).array() += step;
      const double slope = ((values_at(f, beside) - values) / step).cwiseAbs().maxCoeff();
      CHECK(slope <= 0.3 * before);
      CHECK(slope < 2000 * std::exp((power - 1) * std::log(step)) + 1e-15 / step);
      before = slope;
      // The gradient's own rounding is relative to itself, not to the steep weight that it comes from.
      CHECK(gradients_at(f, beside).cwiseAbs().maxCoeff() < 5000 * std::exp((power - 1) * std::log(step)));
    }
  }
  for (const double power : {0.5, 1.0}) {
    auto f = make(points, values, power);
    CHECK(gradients_at(f, points).array().isNaN().all());
    Matrix left = points, right = points;
    left.col(0).array() -= 1e-7;
    right.col(0).array() += 1e-7;
    const Matrix rise = (values_at(f, right) - values) / 1e-7, fall = (values - values_at(f, left)) / 1e-7;
    CHECK((rise - fall).cwiseAbs().minCoeff() > 0.01);
  }
}

TEST_CASE("Shepard: what epsilon does at the points is what the formula says (seed 1968)") {
  std::mt19937 random(seed);
  const Matrix points = random_points(random, 10, 2), values = random_points(random, 10, 1);
  for (const double power : {1.0, 2.0, 4.0}) {
    double before = 0;
    for (const double epsilon : {1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
      auto f = make(points, values, power, epsilon);
      const Matrix error = values_at(f, points) - values;
      for (Index i = 0; i < 10; ++i) {
        double above = 0, below = 1;
        for (Index k = 0; k < 10; ++k) {
          if (k == i) continue;
          const double q = std::exp(power * std::log(epsilon / ((points.row(i) - points.row(k)).norm() + epsilon)));
          above += q * (values(k, 0) - values(i, 0));
          below += q;
        }
        CHECK(std::abs(error(i, 0) - above / below) < 1e-14);
      }
      CHECK(error.norm() > before);
      before = error.norm();
      CHECK(gradients_at(f, points).array().isNaN().all());  // a small cusp at every point
    }
  }
}

TEST_CASE("Shepard far away is the average, and a huge power follows the nearest point (seed 1968)") {
  std::mt19937 random(seed);
  const Matrix points = random_points(random, 9, 3), values = random_points(random, 9, 2);
  for (const double power : {0.5, 2.0, 6.0})
    for (const double far : {1e9, 1e160, 1.7e308}) {
      auto f = make(points, values, power);
      const Matrix query = row({far, -far, far});
      CHECK((values_at(f, query) - values.colwise().mean()).cwiseAbs().maxCoeff() < 1e-8);
      CHECK(gradients_at(f, query).cwiseAbs().maxCoeff() < 1e-8);
    }
  for (const double power : {1e4, 1e100, 1.7e308}) {
    auto f = make(points, values, power);
    const Matrix queries = random_points(random, 50, 3), found = values_at(f, queries);
    for (Index q = 0; q < 50; ++q) {
      Index nearest = 0;
      (points.rowwise() - queries.row(q)).rowwise().squaredNorm().minCoeff(&nearest);
      CHECK((found.row(q) - values.row(nearest)).norm() < 1e-6);
    }
    CHECK(gradients_at(f, queries).allFinite());
    CHECK((values_at(f, points) - values).norm() == 0);
  }
}

TEST_CASE("Shepard does not depend on place, orientation or scale, up to the largest and smallest numbers (seed 1968)") {
  std::mt19937 random(seed);
  const Matrix points = random_points(random, 14, 2), values = random_points(random, 14, 1), queries = random_points(random, 12, 2);
  auto f = make(points, values, 2.5);
  const Matrix expected = values_at(f, queries), slopes = gradients_at(f, queries);
  Matrix turn(2, 2);
  turn << std::cos(0.7), std::sin(0.7), -std::sin(0.7), std::cos(0.7);
  const auto moved = [&](const Matrix& x) -> Matrix {
    Matrix out(x.rows(), 2);
    for (Index i = 0; i < x.rows(); ++i)
      for (Index a = 0; a < 2; ++a) out(i, a) = 3 * (x(i, 0) * turn(0, a) + x(i, 1) * turn(1, a)) + 5 - 9 * static_cast<double>(a);
    return out;
  };
  auto g = make(moved(points), values, 2.5);
  CHECK((values_at(g, moved(queries)) - expected).cwiseAbs().maxCoeff() < 1e-13);
  const Matrix turned = gradients_at(g, moved(queries));
  for (Index q = 0; q < 12; ++q)
    for (Index a = 0; a < 2; ++a)
      CHECK(std::abs(3 * turned(q, a) - slopes(q, 0) * turn(0, a) - slopes(q, 1) * turn(1, a)) <
            1e-12 * slopes.cwiseAbs().maxCoeff());
  for (const double scale : {1e-300, 1e-170, 1e170, 1e300}) {
    CAPTURE(scale);
    auto scaled = make(points * scale, values, 2.5);
    CHECK((values_at(scaled, queries * scale) - expected).cwiseAbs().maxCoeff() < 1e-13);
    CHECK((gradients_at(scaled, queries * scale) * scale - slopes).cwiseAbs().maxCoeff() < 1e-11 * slopes.cwiseAbs().maxCoeff());
    CHECK((values_at(scaled, points * scale) - values).cwiseAbs().maxCoeff() == 0);
  }
}

TEST_CASE("Shepard: one point, equal points and bad input") {
  auto one = make(row({1, 2}), row({7}), 1);
  CHECK(values_at(one, row({1, 2}))(0, 0) == 7);
  CHECK(values_at(one, row({1e300, 2}))(0, 0) == 7);
  CHECK(gradients_at(one, row({1, 2})).norm() == 0);
  CHECK(gradients_at(one, row({5, 2})).norm() == 0);

  Matrix twins(3, 1), values(3, 1), equal(3, 1);
  twins << 0, 1, 0;
  values << 1, 2, 3;
  equal << 1, 2, 1;
  CHECK(code_of(twins, values, 2) == HB_ERROR_POINT_DUPLICATE);
  CHECK(weights_at(*Shepard::create(twins, equal, {2, 0}), row({0.5})) == Vector(Eigen::Vector3d(0.5, 0.5, 0)));
  CHECK(code_of(twins, values, 2, 0.1) == HB_OK);
  auto kept = make(Matrix::Zero(3, 1), values, 2, 0.1);
  CHECK(values_at(kept, row({0}))(0, 0) == doctest::Approx(2));
  CHECK(gradients_at(kept, row({0})).norm() == 0);

  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const Matrix points = row({0, 1, 2}).transpose();
  for (const double power : {0.0, -1.0, nan, infinity}) CHECK(code_of(points, values, power) == HB_ERROR_INVALID_OPTION);
  for (const double epsilon : {-1.0, nan, infinity}) CHECK(code_of(points, values, 2, epsilon) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(points, row({0, nan, 1}).transpose(), 2) == HB_ERROR_VALUE_NOT_FINITE);
  CHECK(code_of(row({0, nan, 1}).transpose(), values, 2) == HB_ERROR_POINT_NOT_FINITE);
  CHECK(code_of(row({-1.7e308, 0, 1.7e308}).transpose(), values, 2) == HB_ERROR_POINTS_DEGENERATE);
}
