#include "core/interpolation/tension_spline_1d.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "oracle_lines.hpp"

using namespace handlebody;

namespace {

constexpr unsigned seed = 20140728;
const double betas[] = {0, 1e-20, 1e-6, 0.3, 1, 40, 1e4, 1e10, 1e16};  // α = 1

Matrix column(const std::vector<double>& numbers) {
  return Eigen::Map<const Matrix>(numbers.data(), std::ssize(numbers), 1);
}

TensionSpline1d make(const Matrix& points, const Matrix& values, double beta, double alpha = 1) {
  auto spline = TensionSpline1d::create(points, values, {alpha, beta});
  REQUIRE(spline);
  return std::move(*spline);
}

Vector at(TensionSpline1d& spline, double x) {
  Vector out(spline.outputs());
  spline.evaluate(&x, 1, out.data());
  return out;
}

Vector slope_at(TensionSpline1d& spline, double x) {
  Vector out(spline.outputs());
  spline.gradient(&x, 1, out.data());
  return out;
}

struct Random {
  std::mt19937 engine{seed};
  Matrix numbers(Index rows, Index columns, double low = -1, double high = 1) {
    std::uniform_real_distribution<double> uniform(low, high);
    return Matrix::NullaryExpr(rows, columns, [&] { return uniform(engine); });
  }
};

}  // namespace

// Tolerance: four times what the minimization on ever finer grids says of its own accuracy, and 1e-12 for rounding.
TEST_CASE("the spline in tension agrees with SciPy's clamped cubic and with minimizing its functional on a fine grid") {
  int cases = 0;
  double worst_cubic = 0;
  for (const std::string& line : oracle_lines("tension_spline_1d.json")) {
    const double beta = oracle_numbers(line, "beta").at(0), accuracy = oracle_numbers(line, "accuracy").at(0);
    TensionSpline1d spline = make(column(oracle_numbers(line, "points")), column(oracle_numbers(line, "values")), beta,
                                  oracle_numbers(line, "alpha").at(0));
    const auto queries = oracle_numbers(line, "queries"), expected = oracle_numbers(line, "expected"),
               slopes = oracle_numbers(line, "slopes");
    CAPTURE(line.substr(0, 60));
    const double tolerance = 4 * accuracy + 1e-12;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      CHECK(std::abs(at(spline, queries[i])[0] - expected.at(i)) <= tolerance);
      if (i > 0 && i + 1 < queries.size()) CHECK(std::abs(slope_at(spline, queries[i])[0] - slopes.at(i)) <= 10 * tolerance);
      if (beta == 0) worst_cubic = std::max(worst_cubic, std::abs(at(spline, queries[i])[0] - expected[i]));
    }
    ++cases;
  }
  CHECK(cases == 9);
  MESSAGE("worst difference from SciPy's cubics " << worst_cubic);
}

TEST_CASE("it passes through its points exactly, flat at the ends and constant beyond, whatever the tension (seed 20140728)") {
  Random random;
  for (const double beta : betas) {
    const Matrix points = random.numbers(15, 1, -3, 5), values = random.numbers(15, 3);
    TensionSpline1d spline = make(points, values, beta);
    CAPTURE(beta);
    for (Index i = 0; i < 15; ++i)
      for (Index j = 0; j < 3; ++j) CHECK(at(spline, points(i, 0))[j] == doctest::Approx(values(i, j)).epsilon(1e-15));
    Index first = 0, last = 0;
    points.col(0).minCoeff(&first);
    points.col(0).maxCoeff(&last);
    for (const double beyond : {0.0, 1e-9, 1.0, 1e300}) {
      CHECK(at(spline, points(first, 0) - beyond)[1] == values(first, 1));
      CHECK(at(spline, points(last, 0) + beyond)[1] == values(last, 1));
      CHECK(std::abs(slope_at(spline, points(first, 0) - beyond)[1]) < 1e-12);
      CHECK(slope_at(spline, points(last, 0) + beyond)[1] == 0);
    }
  }
}

TEST_CASE("two derivatives are continuous at the points, and between them f'''' = b^2 f'' (seed 20140728)") {
  Random random;
  Matrix points(6, 1);
  points << 0, 0.4, 1.1, 1.3, 2.2, 3;
  const Matrix values = random.numbers(6, 1);
  for (const double beta : {0.0, 1e-3, 1.0, 4.0, 60.0}) {
    CAPTURE(beta);
    TensionSpline1d spline = make(points, values, beta);
    const double h = 1e-4;
    for (Index i = 1; i < 5; ++i) {
      const double x = points(i, 0);
      const auto second = [&](double h_) {  // one-sided, of second order
        return (-3 * slope_at(spline, x)[0] + 4 * slope_at(spline, x + h_)[0] - slope_at(spline, x + 2 * h_)[0]) / (2 * h_);
      };
      const double before = std::nextafter(x, -1), jump = slope_at(spline, x)[0] - slope_at(spline, before)[0];
      CHECK(std::abs(jump) < 1e-12);
      CHECK(second(h) == doctest::Approx(second(-h)).epsilon(1e-4));
      const double middle = (points(i, 0) + points(i - 1, 0)) / 2, step = (points(i, 0) - points(i - 1, 0)) / 12;
      const auto f = [&](int k) { return slope_at(spline, middle + k * step)[0]; };
      const double first = (f(1) - f(-1)) / (2 * step), third = (f(2) - 2 * f(1) + 2 * f(-1) - f(-2)) / (2 * step * step * step);
      const double size = std::abs(beta * first) + std::abs(first) / (step * step);
      CHECK(std::abs(third - beta * first) < 0.02 * size);
    }
  }
}

TEST_CASE("the gradient is the derivative, by central differences to 1e-6 (seed 20140728)") {
  Random random;
  const Matrix points = random.numbers(12, 1, 0, 10), values = random.numbers(12, 2);
  for (const double beta : {0.0, 1e-6, 1.0, 50.0, 2000.0}) {
    TensionSpline1d spline = make(points, values, beta);
    for (int k = 0; k < 300; ++k) {
      const double x = random.numbers(1, 1, -0.5, 10.5)(0, 0), h = 1e-6;
      const Vector difference = (at(spline, x + h) - at(spline, x - h)) / (2 * h);
      CHECK((slope_at(spline, x) - difference).norm() < 1e-6 * (1 + std::sqrt(beta)) * (1 + difference.norm()));
    }
  }
}

TEST_CASE("weights give the same values and slopes, sum to 1, and are 1 at their own point (seed 20140728)") {
  Random random;
  for (const double beta : betas) {
    const Matrix points = random.numbers(9, 1, 0, 4), values = random.numbers(9, 2);
    TensionSpline1d spline = make(points, values, beta);
    CAPTURE(beta);
    Vector w(9);
    for (int k = 0; k < 60; ++k) {
      const double x = random.numbers(1, 1, -0.5, 4.5)(0, 0);
      spline.weights(&x, w.data());
      CHECK(w.sum() == doctest::Approx(1).epsilon(1e-13));
      CHECK((values.transpose() * w - at(spline, x)).norm() < 1e-12 * (1 + w.lpNorm<1>()));
      Vector flat(2);
      spline.Interpolant::gradient(&x, 1, flat.data());  // from the weights' slopes
      CHECK((flat - slope_at(spline, x)).norm() < 1e-11 * (1 + slope_at(spline, x).norm()));
    }
    for (Index i = 0; i < 9; ++i) {
      spline.weights(&points(i, 0), w.data());
      CHECK((w - Vector::Unit(9, i)).lpNorm<Eigen::Infinity>() < 1e-14);
    }
  }
}

TEST_CASE("more tension, less overshoot; without tension the cubic, in the limit the polyline") {
  Matrix points(6, 1), values(6, 1);
  points << 0, 1, 2, 3, 4, 5;
  values << 0, 0, 0, 1, 1, 1;
  double before = std::numeric_limits<double>::infinity();
  for (const double beta : {0.0, 1.0, 10.0, 100.0, 1e4}) {  // overshoots by 10.6% to 0.5%
    TensionSpline1d spline = make(points, values, beta);
    double overshoot = 0;
    for (double x = 0; x <= 5; x += 0.01) overshoot = std::max({overshoot, at(spline, x)[0] - 1, -at(spline, x)[0]});
    CHECK(overshoot < 0.97 * before);
    before = overshoot;
  }
  CHECK(before < 0.005);
  TensionSpline1d cubic = make(points, values, 0), nearly = make(points, values, 1e-12), stiff = make(points, values, 1e16);
  for (double x = 0.005; x < 5; x += 0.01) {
    CHECK(at(nearly, x)[0] == doctest::Approx(at(cubic, x)[0]).epsilon(1e-11));
    const double polyline = std::clamp(x - 2, 0.0, 1.0);
    CHECK(std::abs(at(stiff, x)[0] - polyline) < 1e-7);
  }
}

TEST_CASE("no step where the methods change, in the tension") {
  Matrix points(4, 1), values(4, 1);
  points << 0, 2, 3, 5;  // ω = 2b and b: series end at b = 1 and at b = 2
  values << 0.3, -1, 2, 0.5;
  for (const double b : {1.0, 2.0, 0.5e-8, 1e-8}) {
    TensionSpline1d below = make(points, values, b * b * (1 - 1e-13)), above = make(points, values, b * b * (1 + 1e-13));
    for (double x = 0.1; x < 5; x += 0.1) {
      CHECK(std::abs(at(below, x)[0] - at(above, x)[0]) < 1e-12);
      CHECK(std::abs(slope_at(below, x)[0] - slope_at(above, x)[0]) < 1e-12);
    }
  }
}

TEST_CASE("it moves and scales with its points and does not mind their order (seed 20140728)") {
  Random random;
  const Matrix points = random.numbers(10, 1, 0, 3), values = random.numbers(10, 1);
  const double scale = 7, shift = -20, beta = 5;
  TensionSpline1d spline = make(points, values, beta);
  // α ∫f″² + β ∫f′² over sx is s⁻³ times that over x with β s²: minimizers are equal for β/s².
  TensionSpline1d moved = make((scale * points.array() + shift).matrix(), values, beta / (scale * scale));
  TensionSpline1d reversed = make(points.colwise().reverse(), values.colwise().reverse(), beta);
  TensionSpline1d mirrored = make(-points, values, beta);
  for (double x = -0.1; x < 3.1; x += 0.037) {
    CHECK(std::abs(at(moved, scale * x + shift)[0] - at(spline, x)[0]) < 1e-12);
    CHECK(at(reversed, x)[0] == at(spline, x)[0]);
    CHECK(std::abs(at(mirrored, -x)[0] - at(spline, x)[0]) < 1e-12);
  }
}

TEST_CASE("one point makes a constant, two an S; bad input is named") {
  Matrix points(3, 1), values(3, 1);
  points << 1, 2, 2;
  values << 3, 5, 5;
  TensionSpline1d one = make(points.topRows(1), values.topRows(1), 2), two = make(points, values, 2);
  CHECK(at(one, -9)[0] == 3);
  CHECK(slope_at(one, 1)[0] == 0);
  CHECK(at(two, 1.5)[0] == doctest::Approx(4));
  CHECK(two.data().twin_of[2] == 1);
  double x = 1.5;
  Vector w(3);
  two.weights(&x, w.data());
  CHECK((w - Eigen::Vector3d(0.5, 0.5, 0)).norm() < 1e-15);

  const auto code = [&](const TensionSpline1dOptions& options) {
    auto spline = TensionSpline1d::create(points, values, options);
    return spline ? HB_OK : spline.error().code;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const TensionSpline1dOptions& bad :
       {TensionSpline1dOptions{0, 1}, {-1, 1}, {nan, 1}, {infinity, 1}, {1, -1}, {1, nan}, {1, infinity}})
    CHECK(code(bad) == HB_ERROR_INVALID_OPTION);
  CHECK(code({1, 1}) == HB_OK);
  values(2, 0) = 4;
  CHECK(code({1, 1}) == HB_ERROR_POINT_DUPLICATE);
  CHECK(TensionSpline1d::create(Matrix::Zero(2, 2), Matrix::Zero(2, 1)).error().code == HB_ERROR_INVALID_SHAPE);
  CHECK(TensionSpline1d::create(Matrix(0, 1), Matrix(0, 1)).error().code == HB_ERROR_POINTS_TOO_FEW);
}
