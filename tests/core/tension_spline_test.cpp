#include "core/interpolation/tension_spline.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "oracle_lines.hpp"

using namespace handlebody;

namespace {

constexpr unsigned seed = 20140728;

// Two real roots, equal ones, complex pairs; without γ; without β and γ.
const TensionSplineOptions all_options[] = {{1, 5, 4},   {0.01, 1, 0.1}, {1, 2, 1},    {1, 0.5, 4},
                                            {0.1, 0, 3}, {1, 3, 0},      {0.05, 1, 0}, {2, 0, 0}};

Rbf make(const Matrix& points, const Matrix& values, const TensionSplineOptions& options) {
  auto spline = tension_spline(points, values, options);
  REQUIRE(spline);
  return std::move(*spline);
}

double at(Rbf& spline, const Vector& query) {
  Vector out(spline.outputs());
  spline.evaluate(query.data(), 1, out.data());
  return out[0];
}

struct Random {
  std::mt19937 engine{seed};
  Matrix numbers(Index rows, Index columns, double low = -1, double high = 1) {
    std::uniform_real_distribution<double> uniform(low, high);
    return Matrix::NullaryExpr(rows, columns, [&] { return uniform(engine); });
  }
  Vector vector(Index size) { return numbers(1, size).row(0).transpose(); }
  MatrixXd rotation(Index size) {  // Gram–Schmidt
    MatrixXd q = numbers(size, size);
    for (Index j = 0; j < size; ++j) {
      for (Index k = 0; k < j; ++k) q.col(j) -= q.col(k).dot(q.col(j)) * q.col(k);
      q.col(j).normalize();
    }
    return q;
  }
};

/** Runs `check` for every option in 1, 2 and 3 dimensions, with a few points and values. */
template <typename Check>
void everywhere(const Check& check) {
  Random random;
  for (Index dimension = 1; dimension <= 3; ++dimension) {
    for (const TensionSplineOptions& options : all_options) {
      CAPTURE(dimension);
      CAPTURE(options.alpha);
      CAPTURE(options.beta);
      CAPTURE(options.gamma);
      Matrix points = random.numbers(12, dimension, -2, 2);
      const Matrix values = random.numbers(12, 1);
      if (dimension == 1)  // not too close
        for (Index i = 0; i < 12; ++i) points(i, 0) = (static_cast<double>(i) - 5.5 + points(i, 0) / 8) / 3;
      check(random, dimension, options, points, values);
    }
  }
}

}  // namespace

// Tolerance: what minimizing the functional on ever finer grids says of its own accuracy (the misfit is a tenth of it), and
// rounding. sides.
TEST_CASE("splines with tension agree with minimizing eq. (2) on ever finer grids in 1D and 2D") {
  int cases = 0;
  std::string told;
  for (const std::string& line : oracle_lines("tension_spline.json")) {
    const auto number = [&](const char* name) { return oracle_numbers(line, name).at(0); };
    const auto dimension = static_cast<Index>(number("dimension"));
    const auto matrix = [&](const char* name, Index columns) -> Matrix {
      const auto numbers = oracle_numbers(line, name);
      return Eigen::Map<const Matrix>(numbers.data(), std::ssize(numbers) / columns, columns);
    };
    Rbf spline = make(matrix("points", dimension), matrix("values", 1),
                      {number("alpha"), number("beta"), number("gamma"), number("smoothing")});
    const Matrix queries = matrix("queries", dimension), expected = matrix("expected", 1);
    REQUIRE(queries.rows() == expected.rows());
    CAPTURE(line.substr(0, 80));
    double worst = 0;
    for (Index i = 0; i < queries.rows(); ++i)
      worst = std::max(worst, std::abs(at(spline, queries.row(i).transpose()) - expected(i, 0)));
    CHECK(worst <= number("accuracy") + 1e-10);
    told += join({"\n", dimension, "D ", number("alpha"), " ", number("beta"), " ", number("gamma"), ": ", worst, " of ",
                  number("accuracy")});
    ++cases;
  }
  CHECK(cases == 17);
  MESSAGE("differences, and the grid's own accuracy:" << told);
}

TEST_CASE("without smoothing they pass through their points, and weights are 1 and 0 there (seed 20140728)") {
  double worst = 0;
  everywhere([&](Random&, Index, const TensionSplineOptions& options, const Matrix& points, const Matrix& values) {
    Rbf spline = make(points, values, options);
    Vector w(12);
    for (Index i = 0; i < 12; ++i) {
      worst = std::max(worst, std::abs(at(spline, points.row(i).transpose()) - values(i, 0)));
      spline.weights(&points(i, 0), w.data());
      CHECK((w - Vector::Unit(12, i)).lpNorm<Eigen::Infinity>() < 1e-9);
    }
  });
  CHECK(worst < 1e-10);
  MESSAGE("worst misfit " << worst);
}

TEST_CASE("what costs nothing is kept: constants for gamma = 0, linear functions for beta = gamma = 0 (seed 20140728)") {
  everywhere([](Random& random, Index dimension, TensionSplineOptions options, const Matrix& points, const Matrix&) {
    if (options.gamma > 0) return;
    for (const double smoothing : {0.0, 0.3}) {
      options.smoothing = smoothing;
      const Vector direction = options.beta > 0 ? Vector::Zero(dimension).eval() : random.vector(dimension);
      const Matrix values = (points * direction).array() + 0.7;
      Rbf spline = make(points, values, options);
      for (const double far : {1.0, 50.0}) {
        const Vector query = far * random.vector(dimension);
        CHECK(std::abs(at(spline, query) - direction.dot(query) - 0.7) < 1e-9 * far);
        Vector w(12);
        spline.weights(query.data(), w.data());
        CHECK(w.sum() == doctest::Approx(1).epsilon(1e-8));
      }
    }
  });
}

TEST_CASE("with gamma they decay to 0, without it smoothing leads to the tail (seed 20140728)") {
  everywhere([](Random& random, Index dimension, TensionSplineOptions options, const Matrix& points, const Matrix& values) {
    const Vector direction = random.vector(dimension).normalized();
    Rbf spline = make(points, values, options);
    if (options.gamma > 0) {
      CHECK(std::abs(at(spline, 300 * direction)) < 1e-10);
      CHECK(at(spline, 1e30 * direction) == 0);
    }
    options.smoothing = 1e9;
    Rbf smooth = make(points, values, options);
    const Vector query = random.vector(dimension);
    if (options.gamma > 0)
      CHECK(std::abs(at(smooth, query)) < 1e-4);
    else if (options.beta > 0)
      CHECK(at(smooth, query) == doctest::Approx(values.mean()).epsilon(1e-4));
    else  // least squares is linear in the values and exact for linear ones: the residual is orthogonal to 1 and x
      for (Index axis = -1; axis < dimension; ++axis) {
        double sum = 0;
        for (Index i = 0; i < 12; ++i)
          sum += (values(i, 0) - at(smooth, points.row(i).transpose())) * (axis < 0 ? 1 : points(i, axis));
        CHECK(std::abs(sum) < 1e-6);
      }
  });
}

TEST_CASE("the gradient is the derivative, by central differences to 1e-6 (seed 20140728)") {
  everywhere([](Random& random, Index dimension, const TensionSplineOptions& options, const Matrix& points, const Matrix& values) {
    Rbf spline = make(points, values, options);
    for (int k = 0; k < 10; ++k) {
      const Vector query = 2 * random.vector(dimension);
      Vector gradient(dimension);
      spline.gradient(query.data(), 1, gradient.data());
      for (Index axis = 0; axis < dimension; ++axis) {
        const Vector step = 1e-5 * Vector::Unit(dimension, axis);
        const double difference = (at(spline, query + step) - at(spline, query - step)) / 2e-5;
        CHECK(std::abs(gradient[axis] - difference) < 1e-6 * (1 + gradient.norm()));
      }
    }
  });
}

TEST_CASE("more tension, less overshoot, in 1, 2 and 3 dimensions") {
  for (Index dimension = 1; dimension <= 3; ++dimension) {
    Matrix points = Matrix::Zero(6, dimension), values(6, 1);  // a step along the first axis, and points around it
    points.col(0) << 0, 1, 2, 3, 4, 5;
    values << 0, 0, 0, 1, 1, 1;
    double before = std::numeric_limits<double>::infinity();
    for (const double beta : {0.1, 3.0, 30.0, 300.0}) {
      Rbf spline = make(points, values, {1, beta, 0});
      double overshoot = 0;
      for (double x = 0; x <= 5; x += 0.02) {
        const double value = at(spline, x * Vector::Unit(dimension, 0));
        overshoot = std::max({overshoot, value - 1, -value});
      }
      CAPTURE(beta);
      CHECK(overshoot <= std::max(0.97 * before, 1e-14));  // below which it is rounding
      before = overshoot;
    }
    CHECK(before < 0.05);
  }
}

TEST_CASE("they turn and move with their points, and do not mind their order (seed 20140728)") {
  everywhere([](Random& random, Index dimension, TensionSplineOptions options, const Matrix& points, const Matrix& values) {
    options.smoothing = random.numbers(1, 1, 0, 0.1)(0, 0);
    const MatrixXd turn = random.rotation(dimension);
    const Vector shift = 30 * random.vector(dimension);
    Rbf spline = make(points, values, options);
    Rbf turned = make((points * turn.transpose()).rowwise() + shift.transpose(), values, options);
    Rbf reversed = make(points.colwise().reverse(), values.colwise().reverse(), options);
    for (int k = 0; k < 5; ++k) {
      const Vector query = 3 * random.vector(dimension);
      const double value = at(spline, query);
      CHECK(std::abs(at(turned, turn * query + shift) - value) < 1e-9);
      CHECK(std::abs(at(reversed, query) - value) < 1e-9);
    }
  });
}

// In y = sx, ∫dx = s⁻ᵈ ∫dy, ∇² = s² ∇²: α, β, γ become s⁴⁻ᵈα, s²⁻ᵈβ, s⁻ᵈγ. A common factor of all three is one of 1/σ.
TEST_CASE("scaled points with scaled weights make the same function (seed 20140728)") {
  everywhere([](Random& random, Index dimension, TensionSplineOptions options, const Matrix& points, const Matrix& values) {
    for (const double s : {1e-3, 0.3, 1e4}) {
      options.smoothing = 0.02;
      const double volume = std::pow(s, dimension), factor = 17;
      Rbf spline = make(points, values, options);
      Rbf scaled = make(s * points, values,
                        {factor * options.alpha * s * s * s * s / volume, factor * options.beta * s * s / volume,
                         factor * options.gamma / volume, options.smoothing / factor});
      for (int k = 0; k < 5; ++k) {
        const Vector query = 3 * random.vector(dimension);
        CHECK(std::abs(at(scaled, s * query) - at(spline, query)) < 1e-9);
      }
      CHECK(scaled.report().condition == doctest::Approx(spline.report().condition).epsilon(1e-3));
    }
  });
}

TEST_CASE("alpha = 0 on a line: the polyline for gamma = 0, hanging chains with it") {
  Matrix points(3, 1), values(3, 1);
  points << 0, 2, 3;
  values << 1, 5, -1;
  Rbf polyline = make(points, values, {0, 3, 0}), chains = make(points, values, {0, 4, 1});
  const double k = 0.5;
  for (const double x : {-1.0, 0.5, 1.0, 2.2, 2.9, 4.0}) {
    const double t = std::clamp(x, 0.0, 3.0), chord = t < 2 ? 1 + 2 * t : 5 - 6 * (t - 2);
    CHECK(at(polyline, Vector::Constant(1, x)) == doctest::Approx(chord));
    const double chain = x < 0   ? std::exp(k * x)
                         : x < 2 ? (std::sinh(k * (2 - x)) + 5 * std::sinh(k * x)) / std::sinh(2 * k)
                         : x < 3 ? (5 * std::sinh(k * (3 - x)) - std::sinh(k * (x - 2))) / std::sinh(k)
                                 : -std::exp(k * (3 - x));
    CHECK(at(chains, Vector::Constant(1, x)) == doctest::Approx(chain));
  }
}

TEST_CASE("bad weights and too few points are named") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto code = [](const TensionSplineOptions& options, Index count, Index dimension) {
    Random random;
    auto spline = tension_spline(random.numbers(count, dimension), random.numbers(count, 1), options);
    if (!spline) CHECK(!spline.error().remedy.empty());
    return spline ? HB_OK : spline.error().code;
  };
  CHECK(code({1, 1, 1}, 5, 2) == HB_OK);
  for (const TensionSplineOptions& bad : {TensionSplineOptions{-1, 1, 1},
                                          {1, -1, 1},
                                          {1, 1, nan},
                                          {0, 0, 0},
                                          {0, 1, 1},
                                          {1, 1, 1, -1},
                                          {1, 1, 1, nan},
                                          {1e-300, 1e300, 0}})
    CHECK(code(bad, 5, 2) == HB_ERROR_INVALID_OPTION);
  CHECK(code({1, 1, 1}, 5, 4) == HB_ERROR_INVALID_SHAPE);
  CHECK(code({1, 1, 1}, 0, 2) == HB_ERROR_POINTS_TOO_FEW);
  CHECK(code({1, 1, 0}, 1, 2) == HB_OK);
  CHECK(code({1, 0, 0}, 2, 2) == HB_OK);
  Matrix line(4, 2);
  line << 0, 0, 1, 1, 2, 2, 3, 3;
  CHECK(tension_spline(line, Matrix::Ones(4, 1), {1, 0, 0}));
  CHECK(tension_spline(line, Matrix::Ones(4, 1), {1, 1e-3, 0}));
}
