#include "core/interpolation/simplex_linear.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "scattered.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

constexpr unsigned seed = 20140728;

Matrix rotation(std::mt19937& random, Index dimension) {
  Matrix axes = random_points(random, dimension, dimension);
  for (Index i = 0; i < dimension; ++i) {
    for (int pass = 0; pass < 2; ++pass)
      for (Index j = 0; j < i; ++j) axes.row(i) -= axes.row(i).dot(axes.row(j)) * axes.row(j);
    axes.row(i) /= axes.row(i).norm();
  }
  return axes;
}

Matrix grid(Index steps, Index dimension) {
  Index count = 1;
  for (Index axis = 0; axis < dimension; ++axis) count *= steps;
  Matrix points(count, dimension);
  for (Index i = 0, rest = 0; i < count; ++i) {
    rest = i;
    for (Index axis = 0; axis < dimension; ++axis, rest /= steps) points(i, axis) = static_cast<double>(rest % steps);
  }
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

Matrix cross_polytope(Index dimension) {
  Matrix corners(2 * dimension, dimension);
  corners << Matrix::Identity(dimension, dimension), -Matrix::Identity(dimension, dimension);
  return corners;
}

/** Points in general position and cospherical ones, straight and turned. */
std::vector<Matrix> many_sets(std::mt19937& random) {
  std::vector<Matrix> sets{grid(12, 1), grid(7, 2),        grid(4, 3),        grid(3, 4),        grid(2, 5),
                           circle(5),   circle(16),        circle(300),       cross_polytope(3), cross_polytope(7),
                           grid(2, 3),  cross_polytope(2), cross_polytope(20)};
  for (std::size_t k = 0, straight = sets.size(); k < straight; ++k) {
    sets.emplace_back(3 * sets[k] * rotation(random, sets[k].cols()));
    sets.back().rowwise() += 2 * random_points(random, 1, sets[k].cols()).row(0);
  }
  for (const Index dimension : {1, 2, 3, 4, 5, 8})
    for (const Index count : {dimension + 1, dimension + 2, Index{40}, Index{200}})
      sets.push_back(random_points(random, count, dimension));
  Matrix sphere = random_points(random, 80, 3);
  sphere.rowwise().normalize();
  sets.push_back(sphere);
  return sets;
}

double size_of(const Matrix& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

/** Means of a few of the points, every other near all of them. */
Matrix inside(std::mt19937& random, const Matrix& points, Index count) {
  Matrix queries(count, points.cols());
  for (Index q = 0; q < count; ++q) {
    const Index terms = q % 2 ? 1 + q % (points.cols() + 2) : 3 * points.cols();
    const Vector weights = random_points(random, terms, 1).cwiseAbs();
    queries.row(q).setZero();
    for (Index k = 0; k < terms; ++k)
      queries.row(q) +=
          weights[k] / weights.sum() * points.row(static_cast<Index>(random() % static_cast<unsigned>(points.rows())));
  }
  return queries;
}

/** Around the points, most of them outside. */
Matrix around(std::mt19937& random, const Matrix& points, Index count, double far) {
  Matrix queries =
      far * size_of(points) / std::sqrt(static_cast<double>(points.cols())) * random_points(random, count, points.cols());
  queries.rowwise() += points.colwise().mean();
  return queries;
}

SimplexLinear made(const Matrix& points, const Matrix& values, OutsideHull outside = OutsideHull::nearest) {
  auto result = SimplexLinear::create(points, values, outside);
  REQUIRE(result);
  return std::move(*result);
}

double largest_difference(const Matrix& a, const Matrix& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

hb_status code_of(const Matrix& points, const Matrix& values) {
  auto made = SimplexLinear::create(points, values);
  if (made) return HB_OK;
  CHECK(!made.error().message.empty());
  CHECK(!made.error().remedy.empty());
  return made.error().code;
}

}  // namespace

// Tolerance: values about 1, and simplices whose condition costs SciPy up to five digits.
TEST_CASE("simplex linear agrees with SciPy and quadprog to 1e-9, on what is inside too") {
  std::ifstream file(HANDLEBODY_TEST_DATA "/simplex_linear.json");
  REQUIRE(file.good());
  std::string line;
  int cases = 0;
  double worst_inside = 0, worst_outside = 0;
  while (std::getline(file, line)) {
    if (line.size() < 3) continue;
    const auto dimension = static_cast<Index>(numbers(line, "dimension").at(0));
    const Matrix points = matrix_of(numbers(line, "points"), dimension), values = matrix_of(numbers(line, "values"), 1);
    const Matrix queries = matrix_of(numbers(line, "queries"), dimension), expected = matrix_of(numbers(line, "expected"), 1);
    const auto within = numbers(line, "inside");
    CAPTURE(cases);
    REQUIRE(values.rows() == points.rows());
    REQUIRE(queries.rows() == expected.rows());
    auto f = made(points, values), strict = made(points, values, OutsideHull::nan);
    const Matrix nearest = values_at(f, queries), or_nan = values_at(strict, queries);
    for (Index q = 0; q < queries.rows(); ++q) {
      const bool is_inside = within.at(static_cast<std::size_t>(q)) != 0;
      const double error = std::abs(nearest(q, 0) - expected(q, 0));
      CHECK(error < 1e-9);
      CHECK(std::isnan(or_nan(q, 0)) == !is_inside);
      if (is_inside) CHECK(std::abs(or_nan(q, 0) - expected(q, 0)) < 1e-9);
      (is_inside ? worst_inside : worst_outside) = std::max(is_inside ? worst_inside : worst_outside, error);
    }
    ++cases;
  }
  CHECK(cases == 18);
  MESSAGE("worst error inside " << worst_inside << ", outside " << worst_outside);
}

TEST_CASE("simplex linear passes through the points and reproduces linear functions with convex weights (seed 20140728)") {
  std::mt19937 random(seed);
  double worst = 0;
  for (const Matrix& points : many_sets(random)) {
    CAPTURE(points.cols());
    CAPTURE(points.rows());
    const double size = size_of(points);
    auto f = made(points, points);
    CHECK(!f.differentiable());
    CHECK(largest_difference(values_at(f, points), points) < 1e-11 * size);
    const Matrix queries = inside(random, points, 40);
    const double error = largest_difference(values_at(f, queries), queries) / size;
    worst = std::max(worst, error);
    CHECK(error < 1e-11);
    for (const double far : {0.0, 0.5, 3.0}) {
      const Matrix asked = far > 0 ? around(random, points, 20, far) : queries;
      for (Index q = 0; q < asked.rows(); ++q) {
        const Vector w = weights_at(f, asked.row(q));
        CHECK(w.minCoeff() >= 0);
        CHECK(std::abs(w.sum() - 1) < 1e-14);
      }
    }
  }
  MESSAGE("worst error of a linear function " << worst);
}

TEST_CASE("simplex linear never overshoots, inside or out (seed 20140728)") {
  std::mt19937 random(seed + 1);
  for (const Matrix& points : many_sets(random)) {
    const Matrix values = random_points(random, points.rows(), 2);
    auto f = made(points, values);
    for (const double far : {0.4, 1.0, 100.0}) {
      const Matrix out = values_at(f, around(random, points, 30, far));
      for (Index j = 0; j < 2; ++j) {
        CHECK(out.col(j).maxCoeff() <= values.col(j).maxCoeff() + 1e-15);
        CHECK(out.col(j).minCoeff() >= values.col(j).minCoeff() - 1e-15);
      }
    }
  }
}

TEST_CASE("simplex linear turns, moves and grows with the points, cospherical ones included (seed 20140728)") {
  std::mt19937 random(seed + 2);
  for (const Matrix& points : many_sets(random)) {
    CAPTURE(points.cols());
    CAPTURE(points.rows());
    const Matrix values = random_points(random, points.rows(), 1);
    Matrix queries(60, points.cols());
    queries << inside(random, points, 40), around(random, points, 20, 0.7);
    auto f = made(points, values);
    const Matrix expected = values_at(f, queries);
    const Matrix turn = rotation(random, points.cols()), shift = random_points(random, 1, points.cols());
    for (const double scale : {1.0, 1e-6, 1e9}) {
      Matrix moved = scale * points * turn, asked = scale * queries * turn;
      moved.rowwise() += scale * shift.row(0);
      asked.rowwise() += scale * shift.row(0);
      auto g = made(moved, values);
      // Thin simplices turn rounding into differences of values.
      CHECK(largest_difference(values_at(g, asked), expected) < 1e-9);
    }
  }
}

TEST_CASE("simplex linear does not depend on the order of points, nor on that of queries (seed 20140728)") {
  std::mt19937 random(seed + 3);
  for (const Matrix& points : many_sets(random)) {
    CAPTURE(points.cols());
    CAPTURE(points.rows());
    const Index n = points.rows();
    const Matrix values = random_points(random, n, 1);
    Matrix queries(60, points.cols());
    queries << inside(random, points, 40), around(random, points, 20, 0.7);
    auto f = made(points, values);
    const Matrix expected = values_at(f, queries);
    // The same object and another, from the last query to the first: the same bits.
    auto g = made(points, values);
    for (Index q = queries.rows(); q-- > 0;) {
      CHECK(values_at(f, queries.row(q))(0, 0) == expected(q, 0));
      CHECK(values_at(g, queries.row(q))(0, 0) == expected(q, 0));
    }
    std::vector<Index> order(n);
    for (Index i = 0; i < n; ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    Matrix shuffled(n, points.cols()), their_values(n, 1);
    for (Index i = 0; i < n; ++i) {
      shuffled.row(i) = points.row(order[i]);
      their_values.row(i) = values.row(order[i]);
    }
    auto h = made(shuffled, their_values);
    CHECK(largest_difference(values_at(h, queries), expected) < 1e-10);
  }
}

TEST_CASE("simplex linear weighs the corners evenly at centers, and by symmetry elsewhere") {
  for (const Index dimension : {1, 2, 3, 4, 5}) {
    const Matrix cube = grid(2, dimension), cross = cross_polytope(dimension);
    auto f = made(cube, Matrix::Zero(cube.rows(), 1));
    const Vector center = weights_at(f, Matrix::Constant(1, dimension, 0.5));
    CHECK((center.array() - 1 / static_cast<double>(cube.rows())).abs().maxCoeff() < 1e-14);
    auto g = made(cross, Matrix::Zero(cross.rows(), 1));
    const Vector origin = weights_at(g, Matrix::Zero(1, dimension));
    CHECK((origin.array() - 0.5 / static_cast<double>(dimension)).abs().maxCoeff() < 1e-14);
  }
  auto f = made(circle(100), Matrix::Zero(100, 1));
  CHECK((weights_at(f, Matrix::Zero(1, 2)).array() - 0.01).abs().maxCoeff() < 1e-14);
  const Vector w = weights_at(f, Matrix::Constant(1, 2, 0.3));  // mirrored by the diagonal
  for (Index i = 0; i < 100; ++i) CHECK(std::abs(w[i] - w[(125 - i) % 100]) < 1e-13);
  // On the way from the center to an edge's middle the square's weights stay two and two.
  auto square = made(grid(2, 2), Matrix::Zero(4, 1));
  Matrix query(1, 2);
  query << 0.5, 0.8;
  CHECK((weights_at(square, query) - Eigen::Vector4d(0.1, 0.1, 0.4, 0.4)).norm() < 1e-14);
}

TEST_CASE("simplex linear is continuous along segments through cospherical cells and out of the hull (seed 20140728)") {
  std::mt19937 random(seed + 4);
  for (const Matrix& points : many_sets(random)) {
    if (points.rows() > 400) continue;
    CAPTURE(points.cols());
    CAPTURE(points.rows());
    const Matrix values = random_points(random, points.rows(), 1);
    auto f = made(points, values);
    // Halve whichever interval of a segment still holds a jump: a continuous function's vanishes with the interval.
    for (int repeat = 0; repeat < 5; ++repeat) {
      const Matrix ends = around(random, points, 2, 0.5);
      const auto at = [&](double t) { return values_at(f, (1 - t) * ends.row(0) + t * ends.row(1))(0, 0); };
      double left = 0, width = 1;
      for (int k = 0; k < 300; ++k) {
        const double t = k / 300.0;
        if (std::abs(at(t + 1 / 300.0) - at(t)) > std::abs(at(left + width) - at(left)) || width == 1) {
          left = t;
          width = 1 / 300.0;
        }
      }
      while (width > 1e-9) {
        width /= 2;
        if (std::abs(at(left + width) - at(left)) < std::abs(at(left + 2 * width) - at(left + width))) left += width;
      }
      CHECK(std::abs(at(left + width) - at(left)) < 1e-4);
    }
  }
}

TEST_CASE("outside the hull: constant along its normals, or NaN (seed 20140728)") {
  std::mt19937 random(seed + 5);
  for (const Matrix& points : many_sets(random)) {
    const Matrix values = random_points(random, points.rows(), 1);
    auto f = made(points, values), strict = made(points, values, OutsideHull::nan);
    NearestInHull hull(points);
    const Matrix queries = around(random, points, 40, 0.8);
    for (Index q = 0; q < queries.rows(); ++q) {
      Matrix foot(1, points.cols());
      const double distance = hull(queries.row(q).eval().data(), foot.data(), nullptr);
      CHECK(std::isnan(values_at(strict, queries.row(q))(0, 0)) == (distance > 0));
      const double value = values_at(f, queries.row(q))(0, 0);
      CHECK(std::abs(value - values_at(f, foot)(0, 0)) < 1e-8);
      CHECK(std::abs(value - values_at(f, foot + 7 * (queries.row(q) - foot))(0, 0)) < 1e-8);
    }
    // Means of points are inside, on the hull's faces too, and so are the points.
    CHECK(values_at(strict, inside(random, points, 30)).allFinite());
    CHECK(values_at(strict, points).allFinite());
    CHECK(weights_at(strict, points.colwise().maxCoeff() + points.colwise().maxCoeff() - points.colwise().minCoeff()).hasNaN());
  }
  auto far = made(grid(3, 2), grid(3, 2));
  for (const double t : {1e3, 1e10, 1e100, 1e200, 1.7e308}) {
    Matrix query(1, 2);
    query << t, -t;
    CHECK(largest_difference(values_at(far, query), Eigen::RowVector2d(2, 0)) < 1e-11);
  }
}

TEST_CASE("points that span less than the space are interpolated in their span (seed 20140728)") {
  std::mt19937 random(seed + 6);
  for (const Index dimension : {2, 3, 5}) {
    for (Index span = 1; span < dimension; ++span) {
      const Matrix flat = random_points(random, 30, span), axes = rotation(random, dimension).topRows(span);
      const Matrix values = random_points(random, 30, 1), shift = random_points(random, 1, dimension);
      Matrix points = flat * axes;
      points.rowwise() += shift.row(0);
      auto f = made(points, values), strict = made(points, values, OutsideHull::nan), expected = made(flat, values);
      CHECK(largest_difference(values_at(f, points), values) < 1e-11);
      CHECK(largest_difference(values_at(strict, points), values) < 1e-11);
      const Matrix asked = inside(random, flat, 20);
      Matrix queries = asked * axes;
      queries.rowwise() += shift.row(0);
      CHECK(largest_difference(values_at(f, queries), values_at(expected, asked)) < 1e-9);
      CHECK(values_at(strict, queries).allFinite());
      // Off the span nothing changes, but for the strict one.
      Matrix off = random_points(random, 1, dimension);
      off -= off * axes.transpose() * axes;
      queries.rowwise() += off.row(0);
      CHECK(largest_difference(values_at(f, queries), values_at(expected, asked)) < 1e-9);
      CHECK(values_at(strict, queries).array().isNaN().all());
    }
  }
  Matrix one(1, 3), two(2, 3), query(1, 3);
  one << 1, 2, 3;
  two << 1, 2, 3, 3, 2, 3;
  query << 2.5, 7, 1;
  auto point = made(one, Matrix::Constant(1, 1, 4)), strict = made(one, Matrix::Constant(1, 1, 4), OutsideHull::nan);
  CHECK(values_at(point, query)(0, 0) == 4);
  CHECK(std::isnan(values_at(strict, query)(0, 0)));
  CHECK(values_at(strict, one)(0, 0) == 4);
  auto segment = made(two, Eigen::Vector2d(0, 8));
  CHECK(values_at(segment, query)(0, 0) == doctest::Approx(6));
}

// Coordinates far from the origin lose digits: what lies in a plane lies beside it by their rounding, and so does a mean of such
// points.
TEST_CASE("points as few as the space has dimensions, or in a plane, have convex weights far from the origin too (seed 20140728)") {
  std::mt19937 random(seed + 8);
  for (const Index dimension : {2, 3, 5, 8})
    for (const double apart : {1e-1, 1e-4, 1e-7, 1e-10})
      for (const Index count : {Index{2}, dimension, dimension + 1, Index{30}}) {
        CAPTURE(dimension);
        CAPTURE(apart);
        CAPTURE(count);
        const Index span = count <= dimension ? dimension : dimension - 1;
        Matrix points = apart * random_points(random, count, span) * rotation(random, dimension).topRows(span);
        points.rowwise() += random_points(random, 1, dimension).row(0);
        auto f = made(points, points);
        const Matrix queries = inside(random, points, 40);
        CHECK(largest_difference(values_at(f, queries), queries) < 1e-10 * apart + 1e-15);
        for (Index q = 0; q < queries.rows(); ++q) {
          const Vector w = weights_at(f, queries.row(q));
          CHECK(w.minCoeff() >= 0);
          CHECK(std::abs(w.sum() - 1) < 1e-14);
        }
        CHECK(values_at(f, around(random, points, 20, 10)).allFinite());
      }
}

TEST_CASE("nearly cospherical, thin and crowded points still have convex weights that reproduce the place (seed 20140728)") {
  std::mt19937 random(seed + 7);
  std::vector<Matrix> sets;
  for (const double small : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13}) {
    sets.emplace_back(grid(5, 3) + small * random_points(random, 125, 3));
    sets.emplace_back(grid(3, 4) * rotation(random, 4) + small * random_points(random, 81, 4));
    sets.emplace_back(circle(200) + small * random_points(random, 200, 2));
    if (small < 1e-8) continue;
    sets.emplace_back(random_points(random, 60, 3));
    sets.back().col(1) *= small;
    sets.emplace_back(random_points(random, 60, 2));
    sets.back().topRows(30) *= small;
  }
  double worst = 0;
  for (const Matrix& points : sets) {
    const double size = size_of(points);
    auto f = made(points, points);
    const Matrix queries = inside(random, points, 100);
    const double error = largest_difference(values_at(f, queries), queries) / size;
    CHECK(error < 1e-10);
    worst = std::max(worst, error);
    for (Index q = 0; q < queries.rows(); ++q) {
      const Vector w = weights_at(f, queries.row(q));
      CHECK(w.minCoeff() >= 0);
      CHECK(std::abs(w.sum() - 1) < 1e-14);
    }
    CHECK(values_at(f, around(random, points, 50, 1)).allFinite());
  }
  MESSAGE("worst error of a linear function " << worst);
}

TEST_CASE("simplex linear merges equal points, and refuses what no method accepts") {
  Matrix points(4, 2), values(4, 1);
  points << 0, 0, 1, 0, 0, 1, 1, 0;
  values << 1, 2, 3, 2;
  auto f = made(points, values);
  CHECK(f.size() == 4);
  CHECK(f.data().points.rows() == 3);
  const Vector w = weights_at(f, Eigen::RowVector2d(0.5, 0.25));
  CHECK((w - Eigen::Vector4d(0.25, 0.5, 0.25, 0)).norm() < 1e-15);
  double slopes[2];
  f.gradient(points.data(), 1, slopes);
  CHECK(std::isnan(slopes[0]));

  values(3, 0) = 5;
  CHECK(code_of(points, values) == HB_ERROR_POINT_DUPLICATE);
  CHECK(code_of(Matrix(0, 2), Matrix(0, 1)) == HB_ERROR_POINTS_TOO_FEW);
  points(2, 1) = std::numeric_limits<double>::infinity();
  CHECK(code_of(points, values) == HB_ERROR_POINT_NOT_FINITE);
  points(2, 1) = 1;
  values(1, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(code_of(points, values) == HB_ERROR_VALUE_NOT_FINITE);
}
