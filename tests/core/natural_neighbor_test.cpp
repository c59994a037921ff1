#include "core/interpolation/natural_neighbor.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace handlebody;

namespace {

constexpr unsigned seed = 19811118;
using Point = Eigen::Vector2d;

Matrix random_points(std::mt19937& random, Index count, Index columns = 2) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(count, columns, [&] { return uniform(random); });
}

/** A place in the hull: a random convex combination, close to a few of the points as a rule. */
Point inside(std::mt19937& random, const Matrix& points) {
  std::exponential_distribution<double> exponential(1);
  Vector parts = Vector::NullaryExpr(points.rows(), [&] { return std::pow(exponential(random), 3); });
  return points.transpose() * (parts / parts.sum());
}

Matrix grid(Index side) {
  Matrix points(side * side, 2);
  for (Index i = 0; i < points.rows(); ++i) points.row(i) << static_cast<double>(i % side), static_cast<double>(i / side);
  return points;
}

Matrix circle(Index count) {
  Matrix points(count, 2);
  for (Index i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(count);
    points.row(i) << std::cos(angle), std::sin(angle);
  }
  return points;
}

/** Values that make the answers the weights, and the gradients theirs. */
NaturalNeighbor cardinal(const Matrix& points, OutsideHull outside = OutsideHull::nearest) {
  auto made = NaturalNeighbor::create(points, Matrix::Identity(points.rows(), points.rows()), outside);
  REQUIRE(made);
  return std::move(*made);
}

Vector weights_at(NaturalNeighbor& f, const Point& query) {
  Vector out(f.size());
  f.weights(query.data(), out.data());
  return out;
}

/** n×2 */
Matrix slopes_at(NaturalNeighbor& f, const Point& query) {
  Matrix out(f.outputs(), 2);
  f.gradient(query.data(), 1, out.data());
  return out;
}

double largest(const Matrix& m) {
  return m.array().isNaN().any() ? NAN : m.cwiseAbs().maxCoeff();
}

/** The numbers of `"key": [1, 2, 3]` in a line of the oracle file. */
std::vector<double> numbers(const std::string& line, const std::string& key) {
  std::vector<double> found;
  const std::size_t start = line.find('"' + key + "\": [");
  if (start == std::string::npos) return found;
  const char* at = line.c_str() + start + key.size() + 5;
  for (char* end = nullptr; *at != ']'; at = end + std::strspn(end, ", ")) found.push_back(std::strtod(at, &end));
  return found;
}

Matrix matrix(const std::string& line, const std::string& key, Index columns) {
  const auto values = numbers(line, key);
  return Eigen::Map<const Matrix>(values.data(), std::ssize(values) / columns, columns);
}

/** What rounding the coordinates of the points to doubles does to a gradient near a query: nothing that it could be blamed for. */
double slope_tolerance(const Matrix& points, const Point& query) {
  const double size = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  double close = (points.rowwise() - query.transpose()).rowwise().norm().minCoeff();
  for (Index i = 0; i < points.rows(); ++i) {
    for (Index j = 0; j < points.rows(); ++j) {  // the edges of the hull
      const Point edge = (points.row(j) - points.row(i)).transpose();
      if (i == j) continue;
      const auto height = [&](const Point& p) {
        return (edge[0] * (p[1] - points(i, 1)) - edge[1] * (p[0] - points(i, 0))) / edge.norm();
      };
      bool of_hull = true;
      for (Index k = 0; k < points.rows() && of_hull; ++k) of_hull = height(points.row(k).transpose()) > -1e-9 * size;
      if (of_hull) close = std::min(close, height(query));
    }
  }
  return 1e-14 * size / close;
}

}  // namespace

// Tolerances: MetPy and SciPy's cells are good to about 1e-13 and 1e-11; the exact weights are doubles rounded once, and ours about
// as good, but where points crowd or form a needle their own rounding (1e-16) counts, relative to its size.
TEST_CASE("natural neighbor: MetPy, areas of SciPy's Voronoi cells, and rational arithmetic agree to 1e-12, 1e-9 and 1e-14") {
  std::ifstream file(HANDLEBODY_TEST_DATA "/natural_neighbor.json");
  REQUIRE(file.good());
  std::string line;
  int metpy = 0, voronoi = 0, exact = 0;
  double worst_metpy = 0, worst_voronoi = 0, worst_exact = 0, worst_slope = 0;
  while (std::getline(file, line)) {
    if (line.size() < 3) continue;
    CAPTURE(line.substr(0, 60));
    const Matrix points = matrix(line, "points", 2), queries = matrix(line, "queries", 2), values = matrix(line, "values", 1);
    const Matrix expected = matrix(line, "expected", 1), weights = matrix(line, "weights", points.rows());
    const Matrix gradients = matrix(line, "gradients", 2);
    REQUIRE(queries.rows() > 4);
    auto f = NaturalNeighbor::create(points, values.rows() ? values : Matrix::Ones(points.rows(), 1), OutsideHull::nan);
    REQUIRE(f);
    for (Index q = 0; q < queries.rows(); ++q) {
      const Point query = queries.row(q).transpose();
      CAPTURE(query);
      if (expected.rows()) {
        double value = 0;
        f->evaluate(query.data(), 1, &value);
        const double error = std::abs(value - expected(q, 0));
        CHECK(error < 1e-12);
        worst_metpy = std::max(worst_metpy, error);
        ++metpy;
        continue;
      }
      const double error = largest(weights_at(*f, query) - weights.row(q).transpose());
      if (line.find("voronoi") != std::string::npos) {
        CHECK(error < 1e-9);
        worst_voronoi = std::max(worst_voronoi, error);
        ++voronoi;
        continue;
      }
      const bool delicate = line.find("needle") != std::string::npos || line.find("crowd") != std::string::npos;
      CHECK(error < (delicate ? 1e-10 : 1e-14));
      if (!delicate) worst_exact = std::max(worst_exact, error);
      ++exact;
      const double slope = largest(slopes_at(*f, query) - gradients.row(q)) / std::max(1.0, largest(gradients.row(q)));
      CHECK(slope < slope_tolerance(points, query));
      worst_slope = std::max(worst_slope, slope / slope_tolerance(points, query));
    }
  }
  CHECK(metpy == 48);
  CHECK(voronoi == 32);
  CHECK(exact == 43);
  MESSAGE("worst: MetPy " << worst_metpy << ", SciPy " << worst_voronoi << ", exact " << worst_exact << ", gradient " << worst_slope
                          << " of its tolerance");
}

TEST_CASE("natural neighbor: at the center of a regular polygon all weigh the same") {
  for (const Index count : {3, 4, 5, 6, 7, 12, 100}) {
    auto f = cardinal(circle(count));
    const Vector w = weights_at(f, Point(0, 0));
    CHECK(largest(w - Vector::Constant(count, 1 / static_cast<double>(count))) < 1e-14);
  }
}

// The bisectors of x and two adjacent corners (±1, ±1) meet on the axis between these, so the cell is a quadrilateral with its
// diagonals on the axes, and what it takes from a corner is a right triangle of legs |x|²−2 over 2(1 ∓ x₀) and 2(1 ∓ x₁).
TEST_CASE("natural neighbor: in a rectangle weights and gradients are bilinear") {
  Matrix corners(4, 2);
  corners << 1, 1, -1, 1, -1, -1, 1, -1;
  for (const double height : {1.0, 0.3}) {
    Matrix points = corners;
    points.col(1) *= height;
    auto f = cardinal(points);
    for (double x = -0.95; x < 1; x += 0.19) {
      for (double y = -0.95; y < 1; y += 0.19) {
        Vector expected(4);
        Matrix slopes(4, 2);
        for (Index i = 0; i < 4; ++i) {
          const double a = corners(i, 0), b = corners(i, 1);
          expected[i] = (1 + a * x) * (1 + b * y) / 4;
          slopes.row(i) << a * (1 + b * y) / 4, (1 + a * x) * b / 4 / height;
        }
        CHECK(largest(weights_at(f, Point(x, height * y)) - expected) < 1e-15);
        CHECK(largest(slopes_at(f, Point(x, height * y)) - slopes) < 1e-13);
      }
    }
  }
}

// A kite (±1, 0), (0, h), (0, −k) with hk > 1, so that left and right, not top and bottom, are strangers, and x = (0, b). The cell
// is a trapezoid between the heights (b−k)/2 and (b+h)/2 and of half width (1−b²)/2 + by, of area (h+k)(2 + b(h−k))/4; what it
// takes from the top is a triangle of half width (1+hb)/2 and height (1+hb)/2h. So the top weighs (1+hb)²/(h (h+k)(2 + b(h−k))),
// and the bottom likewise with k and −b, while 1+hb and 1−kb are positive; beyond, x is in a triangle with three neighbors.
TEST_CASE("natural neighbor: the axis of a kite") {
  const double h = 2, k = 1;
  Matrix points(4, 2);
  points << 1, 0, 0, h, -1, 0, 0, -k;
  auto f = cardinal(points);
  for (double b = -0.96; b < 2; b += 0.04) {
    const Vector w = weights_at(f, Point(0, b));
    const Matrix slopes = slopes_at(f, Point(0, b));
    const double width = 2 + b * (h - k), up = 1 + h * b, down = 1 - k * b;
    double top, top_slope;
    if (up > 0 && down > 0) {
      top = up * up / (h * (h + k) * width);
      top_slope = (2 * h * up * width - up * up * (h - k)) / (h * (h + k) * width * width);
    } else {
      top = up > 0 ? b / h : 0;
      top_slope = up > 0 ? 1 / h : 0;
    }
    const double bottom = (h * top - b) / k, side = (1 - top - bottom) / 2;
    CAPTURE(b);
    CHECK(std::abs(w[1] - top) < 1e-15);
    CHECK(std::abs(w[3] - bottom) < 1e-15);
    CHECK(std::abs(w[0] - side) < 1e-15);
    CHECK(std::abs(w[2] - side) < 1e-15);
    CHECK(std::abs(slopes(1, 1) - top_slope) < 1e-13);
    CHECK(std::abs(slopes(1, 0)) < 1e-13);
  }
}

TEST_CASE("natural neighbor: weights are none below 0, sum to 1, average to the query; gradients likewise (seed 19811118)") {
  std::mt19937 random(seed);
  double worst = 0, worst_slope = 0;
  std::vector<Matrix> sets{grid(7), circle(40)};
  for (const Index count : {3, 4, 8, 30, 300, 1000}) sets.push_back(random_points(random, count));
  for (const Matrix& points : sets) {
    auto f = NaturalNeighbor::create(points, points);  // so the value is the query, and the gradient the identity
    REQUIRE(f);
    CAPTURE(points.rows());
    for (int repeat = 0; repeat < 60; ++repeat) {
      const Point query = inside(random, points);
      const Vector w = weights_at(*f, query);
      const double error = std::max(std::abs(w.sum() - 1), largest(points.transpose() * w - query));
      CHECK(w.minCoeff() >= 0);
      CHECK((w.array() > 0).count() >= 3);
      CHECK(error < 1e-13 * largest(points));  // three or four random points can be a needle
      worst = std::max(worst, error);
      const double slope = largest(slopes_at(*f, query) - Matrix::Identity(2, 2));
      if (points.rows() <= 50) CHECK(slope < slope_tolerance(points, query) * largest(points));
      if (points.rows() > 50) CHECK(slope < 1e-9);
      worst_slope = std::max(worst_slope, slope);
    }
  }
  MESSAGE("worst error " << worst << ", of the gradient " << worst_slope);
}

TEST_CASE("natural neighbor: the data are interpolated, and have no gradient (seed 19811118)") {
  std::mt19937 random(seed + 1);
  for (const Matrix& points : {grid(5), circle(9), Matrix(1e6 * random_points(random, 50)), Matrix(random_points(random, 1))}) {
    const Matrix values = random_points(random, points.rows(), 3);
    for (const auto outside : {OutsideHull::nearest, OutsideHull::nan}) {
      auto f = NaturalNeighbor::create(points, values, outside);
      REQUIRE(f);
      Matrix found(points.rows(), 3), slopes(points.rows(), 6);
      f->evaluate(points.data(), points.rows(), found.data());
      f->gradient(points.data(), points.rows(), slopes.data());
      CHECK(found == values);
      CHECK(slopes.array().isNaN().all());
      // As close as 1e-13 diagonals, in the hull and at its corners.
      const double close = points.rows() > 1 ? 1e-13 * f->data().diagonal : 0;
      for (const Point& step : {Point(close, 0), Point(-close, 0), Point(0, close), Point(0, -close)})
        for (Index i = 0; i < points.rows(); ++i) {
          const Point query = points.row(i).transpose() + step;
          CHECK(slopes_at(*f, query).array().isNaN().all());
        }
    }
  }
}

TEST_CASE("natural neighbor: gradients are those of central differences, smooth across every circle (seed 19811118)") {
  std::mt19937 random(seed + 2);
  for (const Matrix& points : {grid(4), Matrix(random_points(random, 15)), Matrix(random_points(random, 120))}) {
    auto f = NaturalNeighbor::create(points, random_points(random, points.rows(), 2));
    REQUIRE(f);
    int checked = 0;
    for (int repeat = 0; repeat < 200; ++repeat) {
      const Point query = inside(random, points);
      const double step = 1e-6;
      if ((points.rowwise() - query.transpose()).rowwise().norm().minCoeff() < 0.05) continue;
      if (weights_at(*f, query).maxCoeff() > 0.99) continue;
      ++checked;
      const Matrix slopes = slopes_at(*f, query);
      Matrix differences(2, 2);
      for (Index axis = 0; axis < 2; ++axis) {
        Point ahead = query, behind = query;
        ahead[axis] += step;
        behind[axis] -= step;
        Vector high(2), low(2);
        f->evaluate(ahead.data(), 1, high.data());
        f->evaluate(behind.data(), 1, low.data());
        differences.col(axis) = (high - low) / (2 * step);
      }
      CHECK(largest(slopes - differences) < 1e-4 * std::max(1.0, largest(slopes)));  // the second derivative jumps
    }
    CHECK(checked > 50);
  }
}

TEST_CASE("natural neighbor: rotation, translation, scale, reflection and order of the points do not matter (seed 19811118)") {
  std::mt19937 random(seed + 3);
  for (const Matrix& points : {grid(4), circle(12), Matrix(random_points(random, 40))}) {
    const double c = std::cos(0.7), s = std::sin(0.7);
    const Eigen::Matrix2d turn = (Eigen::Matrix2d() << c, s, s, -c).finished();
    auto f = cardinal(points);
    for (const double scale : {1.0, 1e-3, 1e5}) {
      const Point shift(3 * scale, -2 * scale);
      Matrix moved(points.rows(), 2);
      for (Index i = 0; i < points.rows(); ++i)
        moved.row(points.rows() - 1 - i) = (scale * (turn * points.row(i).transpose()) + shift).transpose();
      auto g = cardinal(moved);
      for (int repeat = 0; repeat < 40; ++repeat) {
        const Point query = repeat % 4 ? inside(random, points) : Point(3 * random_points(random, 1).row(0).transpose());
        const Point there = scale * (turn * query) + shift;
        const Matrix w = weights_at(f, query), v = weights_at(g, there);
        CHECK(largest(w - v.colwise().reverse()) < 1e-13);
        const Matrix a = slopes_at(f, query), b = slopes_at(g, there).colwise().reverse() * turn * scale;
        if (w.maxCoeff() < 0.99 && repeat % 4) CHECK(largest(a - b) < 1e-7 * std::max(1.0, largest(a)));
      }
    }
  }
}

TEST_CASE("natural neighbor: tiny and huge coordinates give the same weights (seed 19811118)") {
  std::mt19937 random(seed + 4);
  const Matrix points = random_points(random, 20);
  auto f = cardinal(points);
  for (const int power : {-1000, -500, 500, 1020}) {
    const double scale = std::ldexp(1.0, power);  // exact
    auto g = cardinal(points * scale);
    for (int repeat = 0; repeat < 30; ++repeat) {
      const Point query = 1.5 * random_points(random, 1).row(0).transpose();
      CHECK(largest(weights_at(f, query) - weights_at(g, query * scale)) < 1e-14);
    }
    CHECK(weights_at(g, Point(1.7e308, -1.7e308)).sum() == doctest::Approx(1));
  }
  CHECK(weights_at(f, Point(1.7e308, -1.7e308)).sum() == doctest::Approx(1));
  CHECK(slopes_at(f, Point(1.7e308, 1e308)).allFinite());
  // As close together as doubles can be.
  Matrix ulps(3, 2);
  ulps << 0.5, 0.15, 0.5, std::nextafter(0.15, 1), std::nextafter(0.5, 1), 0.15;
  auto g = cardinal(ulps);
  for (const double x : {0.5, 0.6, std::nextafter(0.5, 1)}) CHECK(weights_at(g, Point(x, 0.15)).sum() == doctest::Approx(1));
}

TEST_CASE("natural neighbor: nothing jumps at the hull's boundary, and outside all is constant along its normals (seed 19811118)") {
  std::mt19937 random(seed + 5);
  Matrix turned = grid(5) * (Eigen::Matrix2d() << 0.8, -0.6, 0.6, 0.8).finished();
  Matrix far = turned.array() + 1e4;
  for (const Matrix& points :
       {grid(4), turned, far, circle(10), Matrix(random_points(random, 25)), Matrix(random_points(random, 3))}) {
    auto f = cardinal(points);
    auto nan = cardinal(points, OutsideHull::nan);
    NearestInHull hull(points);
    for (int repeat = 0; repeat < 40; ++repeat) {
      const Point query = points.colwise().mean().transpose() + 9 * random_points(random, 1).row(0).transpose();
      Point foot;
      const double away = hull(query.data(), foot.data(), nullptr);
      if (away == 0) continue;
      const Point normal = (query - foot) / away;
      const Vector w = weights_at(f, query);
      CHECK(weights_at(nan, query).array().isNaN().all());
      CHECK(slopes_at(nan, query).array().isNaN().all());
      CHECK(largest(points.transpose() * w - foot) < 1e-14 * largest(points));
      CHECK((w.array() > 1e-12).count() <= 2);
      const Matrix slopes = slopes_at(f, query);
      if (!slopes.array().isNaN().any()) CHECK(largest(slopes * normal) < 1e-11 * std::max(1.0, largest(slopes)));
      // Through the boundary, at steps of every size.
      for (double step = 1e-3; step > 1e-16; step /= 10) {
        CHECK(largest(weights_at(f, foot - step * normal) - w) < 20 * step + 1e-12);
        CHECK(largest(weights_at(f, foot + step * normal) - w) < 1e-9);
      }
    }
  }
  // Around every point, inside, outside and on the boundary.
  for (const Matrix& points : {grid(4), turned, circle(10), Matrix(random_points(random, 3)), Matrix(random_points(random, 12))}) {
    auto f = cardinal(points);
    for (double radius = 1e-2; radius > 1e-16; radius /= 7) {
      for (Index i = 0; i < points.rows(); ++i) {
        const double angle = 2 * M_PI * random_points(random, 1)(0, 0);
        const Vector w = weights_at(f, points.row(i).transpose() + radius * Point(std::cos(angle), std::sin(angle)));
        CHECK(1 - w[i] < 40 * radius + 1e-12);
      }
    }
  }
  // Along a side of a grid its own points count, not the ends of the side.
  auto f = cardinal(grid(4));
  Vector expected = Vector::Zero(16);
  expected[1] = 0.25;
  expected[2] = 0.75;
  CHECK(largest(weights_at(f, Point(1.75, 0)) - expected) < 1e-15);
  CHECK(largest(weights_at(f, Point(1.75, -8)) - expected) < 1e-15);
  Matrix slope = Matrix::Zero(16, 2);
  slope.col(0).segment(1, 2) << -1, 1;
  CHECK(largest(slopes_at(f, Point(1.75, -8)) - slope) < 1e-14);
  CHECK(largest(slopes_at(f, Point(-3, -8))) == 0);  // a corner's
}

TEST_CASE("natural neighbor: points on a line, two, and one") {
  Matrix line(5, 2), values(5, 1);
  for (const double turned : {0.0, 0.7}) {
    const Point along(std::cos(turned), std::sin(turned)), across(-along[1], along[0]);
    const double places[] = {2, 0, 5, 1, 3};
    for (Index i = 0; i < 5; ++i) line.row(i) = places[i] * along.transpose();
    values << 7, 1, 2, -3, 4;
    auto f = NaturalNeighbor::create(line, values);
    auto nan = NaturalNeighbor::create(line, values, OutsideHull::nan);
    REQUIRE(f);
    const auto at = [&](NaturalNeighbor& g, double x, double y) {
      const Point query = x * along + y * across;
      double value = 0;
      g.evaluate(query.data(), 1, &value);
      return value;
    };
    for (const double y : {0.0, 1e-13, 0.5, -30.0}) {
      CHECK(at(*f, -1, y) == doctest::Approx(1));
      CHECK(at(*f, 0.25, y) == doctest::Approx(0));
      CHECK(at(*f, 1.5, y) == doctest::Approx(2));
      CHECK(at(*f, 2, y) == doctest::Approx(7));
      CHECK(at(*f, 4.5, y) == doctest::Approx(2.5));
      CHECK(at(*f, 99, y) == doctest::Approx(2));
      CHECK(std::isnan(at(*nan, 1.5, y)) == (std::abs(y) > 1e-3));
    }
    CHECK((slopes_at(*f, 1.5 * along + 4 * across).transpose() - 10 * along).norm() < 1e-13);
    CHECK(largest(slopes_at(*f, 9 * along)) == 0);
  }
  Matrix two(2, 2);
  two << 1, 1, 3, 1;
  auto pair = cardinal(two);
  CHECK(largest(weights_at(pair, Point(1.5, 9)) - Point(0.75, 0.25)) < 1e-15);
  auto one = cardinal(two.topRows(1));
  CHECK(weights_at(one, Point(-4, 1e9))[0] == 1);
  CHECK(largest(slopes_at(one, Point(-4, 1e9))) == 0);
}

TEST_CASE("natural neighbor: twins share one weight; bad data are named") {
  Matrix points(5, 2), values(5, 1);
  points << 0, 0, 1, 0, 1, 1, 0, 1, 1, 0;
  values << 1, 2, 3, 4, 2;
  auto f = NaturalNeighbor::create(points, values);
  REQUIRE(f);
  Vector expected(5);
  expected << 0.25, 0.25, 0.25, 0.25, 0;
  CHECK(largest(weights_at(*f, Point(0.5, 0.5)) - expected) < 1e-15);
  values(4, 0) = 9;
  CHECK(NaturalNeighbor::create(points, values).error().code == HB_ERROR_POINT_DUPLICATE);
  CHECK(NaturalNeighbor::create(Matrix(0, 2), Matrix(0, 1)).error().code == HB_ERROR_POINTS_TOO_FEW);
  points(3, 1) = std::numeric_limits<double>::infinity();
  auto bad = NaturalNeighbor::create(points, values);
  CHECK(bad.error().code == HB_ERROR_POINT_NOT_FINITE);
  CHECK(bad.error().index == 3);
  auto space = NaturalNeighbor::create(Matrix::Random(5, 3), values);
  CHECK(space.error().code == HB_ERROR_INVALID_SHAPE);
  CHECK(space.error().message.find("3 dimensions") != std::string::npos);
  CHECK(space.error().remedy.find("simplexLinear() or rbf()") != std::string::npos);
}
