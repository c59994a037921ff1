#include "core/interpolation/moving_least_squares.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/interpolation/polynomial.hpp"
#include "core/interpolation/shepard.hpp"
#include "scattered.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

constexpr unsigned seed = 1981;
constexpr auto inverse = MovingWeight::inverse_distance;
constexpr auto gaussian = MovingWeight::gaussian;
constexpr auto wendland = MovingWeight::wendland;

MovingLeastSquares make(const Matrix& points, const Matrix& values, const MovingLeastSquaresOptions& options) {
  auto made = MovingLeastSquares::create(points, values, options);
  REQUIRE(made);
  return std::move(*made);
}

hb_status code_of(const Matrix& points, const Matrix& values, const MovingLeastSquaresOptions& options) {
  auto made = MovingLeastSquares::create(points, values, options);
  return made ? HB_OK : made.error().code;
}

/** All weights, singular or not, at one degree. */
std::vector<MovingLeastSquaresOptions> all_options(int degree) {
  return {{degree, inverse, 4, 0, 0},    {degree, inverse, 1.5, 0, 0}, {degree, inverse, 3, 0.1, 0}, {degree, gaussian, 4, 0, 0},
          {degree, gaussian, 4, 0, 1.5}, {degree, wendland, 4, 0, 0},  {degree, wendland, 4, 0, 0.3}};
}

/** Values of a polynomial with coefficients of its own. */
Matrix polynomial_of(const Matrix& x, int degree, const Matrix& coefficients) {
  Matrix out(x.rows(), 1);
  Vector monomials(polynomial_count(degree, x.cols()));
  for (Index i = 0; i < x.rows(); ++i) {
    polynomial_values(&x(i, 0), x.cols(), degree, monomials.data());
    out(i, 0) = monomials.dot(coefficients.row(0).head(monomials.size()));
  }
  return out;
}

}  // namespace

TEST_CASE("moving least squares agrees with numpy's weighted fits to 1e-9") {
  std::ifstream file(HANDLEBODY_TEST_DATA "/moving_least_squares.json");
  REQUIRE(file.good());
  int cases = 0;
  double worst = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.size() < 3) continue;
    const auto number = [&](const char* key) { return numbers(line, key).at(0); };
    const auto dimension = static_cast<Index>(number("dimension"));
    auto f = make(matrix_of(numbers(line, "points"), dimension), matrix_of(numbers(line, "values"), 1),
                  {static_cast<int>(number("degree")), static_cast<MovingWeight>(static_cast<unsigned>(number("weight"))),
                   number("power"), number("epsilon"), number("width")});
    const Matrix expected = matrix_of(numbers(line, "expected"), 1);
    const Matrix found = values_at(f, matrix_of(numbers(line, "queries"), dimension));
    const double error = (found - expected).cwiseAbs().maxCoeff() / std::max(1.0, expected.cwiseAbs().maxCoeff());
    CAPTURE(cases);
    CHECK(error < 1e-9);
    worst = std::max(worst, error);
    ++cases;
  }
  CHECK(cases == 87);
  MESSAGE("worst " << worst);
}

TEST_CASE("moving least squares of degree 0 is Shepard's method (seed 1981)") {
  std::mt19937 random(seed);
  for (const Index d : {1, 3})
    for (const double power : {0.5, 1.0, 2.0, 4.0})
      for (const double epsilon : {0.0, 0.1}) {
        const Matrix points = random_points(random, 20, d), values = random_points(random, 20, 2);
        Matrix queries = random_points(random, 25, d);
        queries.row(0) = points.row(0);
        queries.row(1) = points.row(1).array() + 1e-9;
        auto f = make(points, values, {0, inverse, power, epsilon, 0});
        auto g = Shepard::create(points, values, {power, epsilon});
        CHECK((values_at(f, queries) - values_at(*g, queries)).cwiseAbs().maxCoeff() < 1e-14);
        const Matrix a = gradients_at(f, queries), b = gradients_at(*g, queries);
        for (Index i = 0; i < a.size(); ++i) {
          const double x = a.data()[i], y = b.data()[i];
          CHECK((std::isnan(x) ? std::isnan(y) : std::abs(x - y) < 1e-12 * std::max(1.0, std::abs(y))));
        }
      }
}

TEST_CASE("moving least squares: gradients agree with central differences, every weight and degree (seed 1981)") {
  std::mt19937 random(seed);
  for (const Index d : {1, 2, 3})
    for (int degree = 0; degree <= 2; ++degree)
      for (const auto& options : all_options(degree)) {
        CAPTURE(d);
        CAPTURE(degree);
        CAPTURE(static_cast<unsigned>(options.weight));
        CAPTURE(options.width);
        auto f = make(random_points(random, 30, d), random_points(random, 30, 2), options);
        // Sparse in one dimension only, points come close; steps are small against that.
        CHECK(gradient_error(f, random_points(random, 25, d), d == 1 ? 1e-7 : 1e-6) < 1e-5);
      }
}

TEST_CASE("moving least squares interpolates with singular weights, and its gradient there is the limit (seed 1981)") {
  std::mt19937 random(seed);
  for (const Index d : {1, 2, 3})
    for (int degree = 0; degree <= 2; ++degree)
      for (const double power : {1.5, 2.0, 4.0, 9.0}) {
        CAPTURE(d);
        CAPTURE(degree);
        CAPTURE(power);
        Matrix points = random_points(random, 25, d);
        const Matrix values = random_points(random, 25, 1);
        if (d == 1)  // not too close
          for (Index i = 0; i < 25; ++i) points(i, 0) = (static_cast<double>(i) + 0.3 * points(i, 0)) / 12;
        auto f = make(points, values, {degree, inverse, power, 0, 0});
        CHECK((values_at(f, points) - values).cwiseAbs().maxCoeff() == 0);
        const Matrix limit = gradients_at(f, points);
        if (degree == 0) CHECK(limit.cwiseAbs().maxCoeff() == 0);
        const double size = limit.cwiseAbs().maxCoeff() + 1;
        double before = std::numeric_limits<double>::infinity();
        for (const double step : {1e-4, 1e-6, 1e-8}) {
          // From both sides, and the gradient itself close by: no digits are lost to the singularity.
          Matrix left = points, right = points;
          left.array() -= step;
          right.array() += step;
          const double apart = (gradients_at(f, right) - limit).cwiseAbs().maxCoeff();
          CHECK(apart < 0.2 * before + 1e-9 * size);
          before = apart;
          const Matrix difference = (values_at(f, right) - values_at(f, left)) / (2 * step);
          for (Index i = 0; i < 25; ++i)
            CHECK(std::abs(difference(i, 0) - limit.row(i).sum()) < 10 * apart + 1e-14 / step + 1e-9 * size);
        }
        CHECK(before < (power > 1.9 ? 1e-4 : 0.2) * size);  // like step^(p − 1)
      }
  auto cusp = make(random_points(random, 9, 2), random_points(random, 9, 1), {1, inverse, 1, 0, 0});
  CHECK(gradients_at(cusp, cusp.data().points).array().isNaN().all());
  CHECK(values_at(cusp, cusp.data().points) == cusp.data().values);
}

TEST_CASE("moving least squares reproduces polynomials of its degree, and its weights sum to 1 (seed 1981)") {
  std::mt19937 random(seed);
  for (const Index d : {1, 2, 4})
    for (int degree = 0; degree <= 2; ++degree)
      for (const auto& options : all_options(degree)) {
        CAPTURE(d);
        CAPTURE(degree);
        CAPTURE(static_cast<unsigned>(options.weight));
        const Matrix points = random_points(random, 40, d), coefficients = random_points(random, 1, 20);
        const Matrix queries = 1.3 * random_points(random, 20, d);
        auto f = make(points, polynomial_of(points, degree, coefficients), options);
        CHECK((values_at(f, queries) - polynomial_of(queries, degree, coefficients)).cwiseAbs().maxCoeff() < 1e-10);
        const Matrix gradients = gradients_at(f, queries);
        Matrix expected(polynomial_count(degree, d), d);
        for (Index q = 0; q < queries.rows(); ++q) {
          CHECK(std::abs(weights_at(f, queries.row(q)).sum() - 1) < 1e-12);
          polynomial_gradients(&queries(q, 0), d, degree, expected.data());
          for (Index axis = 0; axis < d; ++axis)
            CHECK(std::abs(gradients(q, axis) - expected.col(axis).dot(coefficients.row(0).head(expected.rows()).transpose())) <
                  1e-8);
        }
      }
}

TEST_CASE("moving least squares does not depend on order, place, orientation or scale (seed 1981)") {
  std::mt19937 random(seed);
  const Matrix points = random_points(random, 30, 2), values = random_points(random, 30, 1), queries = random_points(random, 20, 2);
  Matrix turn(2, 2);
  turn << std::cos(0.7), std::sin(0.7), -std::sin(0.7), std::cos(0.7);
  for (int degree = 0; degree <= 2; ++degree)
    for (const auto& options : all_options(degree))
      for (const double scale : {3.0, 1e-200, 1e200}) {
        CAPTURE(degree);
        CAPTURE(static_cast<unsigned>(options.weight));
        CAPTURE(scale);
        const auto moved = [&](const Matrix& x) -> Matrix {
          Matrix out(x.rows(), 2);
          for (Index i = 0; i < x.rows(); ++i)
            for (Index a = 0; a < 2; ++a) out(i, a) = scale * (x(i, 0) * turn(0, a) + x(i, 1) * turn(1, a) + (a ? 5 : -9));
          return out;
        };
        MovingLeastSquaresOptions scaled = options;
        scaled.width *= scale;
        scaled.epsilon *= scale;
        auto f = make(points, values, options), reversed = make(points.colwise().reverse(), values.colwise().reverse(), options);
        auto g = make(moved(points), values, scaled);
        const Matrix expected = values_at(f, queries), slopes = gradients_at(f, queries), turned = gradients_at(g, moved(queries));
        CHECK(g.width() == doctest::Approx(f.width() * scale));
        CHECK((values_at(reversed, queries) - expected).cwiseAbs().maxCoeff() < 1e-11);
        CHECK((values_at(g, moved(queries)) - expected).cwiseAbs().maxCoeff() < 1e-11);
        for (Index q = 0; q < queries.rows(); ++q)
          for (Index a = 0; a < 2; ++a)
            CHECK(std::abs(scale * turned(q, a) - slopes(q, 0) * turn(0, a) - slopes(q, 1) * turn(1, a)) <
                  1e-9 * slopes.cwiseAbs().maxCoeff());
      }
}

TEST_CASE("moving least squares falls back to a lower degree where the points near by are on a line or too few (seed 1981)") {
  // A row of points along the first axis, and a cloud far away that determines the plane.
  std::mt19937 random(seed);
  Matrix points(30, 2), values(30, 1);
  for (Index i = 0; i < 30; ++i) {
    points(i, 0) = static_cast<double>(i % 15) + (i < 15 ? 0 : 100);
    points(i, 1) = i < 15 ? 0.5 : random_points(random, 1, 1)(0, 0) * 5;
    values(i, 0) = 3 + 2 * points(i, 0) - points(i, 1);
  }
  for (const auto weight : {gaussian, wendland}) {
    auto f = make(points, values, {1, weight, 4, 0, weight == gaussian ? 1.0 : 4.0});
    Matrix query(1, 2);
    query << 7.3, 0.5;  // a constant: the weighted mean of the points near by
    double mean = 0, sum = 0;
    for (Index i = 0; i < 15; ++i) {
      const double r = std::abs(query(0, 0) - points(i, 0)), s = r / 4;
      const double w = weight == gaussian ? std::exp(-r * r) : s < 1 ? (1 - s) * (1 - s) * (1 - s) * (1 - s) * (4 * s + 1) : 0;
      sum += w;
      mean += w * values(i, 0);
    }
    CHECK(values_at(f, query)(0, 0) == doctest::Approx(mean / sum).epsilon(1e-12));
    CHECK(std::abs(weights_at(f, query).sum() - 1) < 1e-12);
    CHECK(gradient_error(f, query, 1e-6) < 1e-6);
  }
  // Inverse distances reach the cloud from everywhere.
  auto g = make(points, values, {1, inverse, 4, 0, 0});
  Matrix query(1, 2);
  query << 7.3, 0.5;
  CHECK(values_at(g, query)(0, 0) == doctest::Approx(17.1).epsilon(1e-10));

  // Where all but one of the weights vanish, the nearest point is all there is.
  auto narrow = make(points, values, {2, gaussian, 4, 0, 1e-3});
  CHECK(values_at(narrow, query)(0, 0) == doctest::Approx(values(7, 0)));
  auto steep = make(points, values, {2, inverse, 1e6, 0, 0});
  CHECK(values_at(steep, query)(0, 0) == doctest::Approx(values(7, 0)));
  for (auto* f : {&narrow, &steep}) CHECK(gradients_at(*f, query).allFinite());
}

TEST_CASE("moving least squares: finite from crowded to far away, whatever the weight (seed 1981)") {
  std::mt19937 random(seed);
  Matrix points = random_points(random, 40, 2), values = random_points(random, 40, 1);
  points.topRows(10) = 1e-6 * points.topRows(10).array() + 0.3;  // crowded in one place
  for (int degree = 0; degree <= 2; ++degree)
    for (const auto& options : all_options(degree)) {
      auto f = make(points, values, options);
      for (const double far : {0.0, 1e-7, 0.1, 3.0, 1e3, 1e10, 1e50, 1e99}) {
        Matrix query(2, 2);
        query << 0.3 + far, 0.3 - far / 3, points(0, 0) + far, points(0, 1) + 2 * far;
        CAPTURE(degree);
        CAPTURE(static_cast<unsigned>(options.weight));
        CAPTURE(far);
        CHECK(values_at(f, query).allFinite());
        const bool cusps = options.weight == inverse && options.epsilon > 0 && far == 0;
        if (!cusps) CHECK(gradients_at(f, query).allFinite());
      }
    }
  // The crowd is seen at its own size: a quadratic there is found again.
  const Matrix tight = points.topRows(10).array() - 0.3, coefficients = 1e6 * random_points(random, 1, 6);
  values.topRows(10) = polynomial_of(tight, 1, coefficients);
  auto f = make(points, values, {1, inverse, 4, 0, 0});
  const Matrix inside = 0.5e-6 * random_points(random, 20, 2);
  const Matrix expected = polynomial_of(inside, 1, coefficients);
  CHECK((values_at(f, (inside.array() + 0.3).matrix()) - expected).cwiseAbs().maxCoeff() < 1e-3 * expected.cwiseAbs().maxCoeff());
}

TEST_CASE("moving least squares: bad input is named") {
  std::mt19937 random(seed);
  const Matrix points = random_points(random, 12, 2), values = random_points(random, 12, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const int degree : {-1, 3}) CHECK(code_of(points, values, {degree, inverse, 4, 0, 0}) == HB_ERROR_INVALID_OPTION);
  for (const double bad : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
    CHECK(code_of(points, values, {1, inverse, bad, 0, 0}) == HB_ERROR_INVALID_OPTION);
    CHECK(code_of(points, values, {1, inverse, 4, bad, 0}) == HB_ERROR_INVALID_OPTION);
    CHECK(code_of(points, values, {1, gaussian, 4, 0, bad}) == HB_ERROR_INVALID_OPTION);
  }
  CHECK(code_of(points, values, {1, inverse, 0, 0, 0}) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(points.topRows(5), values.topRows(5), {2, inverse, 4, 0, 0}) == HB_OK);
  CHECK(code_of(points.topRows(1), values.topRows(1), {0, inverse, 4, 0, 0}) == HB_OK);
  CHECK(code_of(points.topRows(0), values.topRows(0), {0, inverse, 4, 0, 0}) == HB_ERROR_POINTS_TOO_FEW);
  Matrix line = points;
  line.col(1) = 2 * line.col(0);
  CHECK(code_of(line, values, {1, gaussian, 4, 0, 0}) == HB_OK);
  CHECK(code_of(line, values, {0, gaussian, 4, 0, 0}) == HB_OK);
  Matrix twins = points;
  twins.row(3) = twins.row(1);
  CHECK(code_of(twins, values, {1, inverse, 4, 0, 0}) == HB_ERROR_POINT_DUPLICATE);
  CHECK(code_of(twins, values, {1, inverse, 4, 0.1, 0}) == HB_OK);
  for (const auto weight : {gaussian, wendland}) {
    auto f = make(twins, values, {1, weight, 4, 0, 0});
    CHECK(std::abs(weights_at(f, twins.row(1))[1] - weights_at(f, twins.row(1))[3]) < 1e-14);
  }
  for (const auto weight : {inverse, gaussian, wendland}) {
    auto one = make(points.topRows(1), values.topRows(1), {0, weight, 4, 0, 0});
    for (const double far : {0.0, 1.0, 1e300}) {
      const Matrix query = points.topRows(1).array() + far;
      CHECK(values_at(one, query)(0, 0) == doctest::Approx(values(0, 0)).epsilon(1e-15));
      CHECK(gradients_at(one, query).cwiseAbs().maxCoeff() < 1e-15);
    }
  }
  CHECK(code_of(Matrix::Zero(200000, 64), Matrix::Zero(200000, 1), {2, gaussian, 4, 0, 0}) == HB_ERROR_OUT_OF_MEMORY);
}
