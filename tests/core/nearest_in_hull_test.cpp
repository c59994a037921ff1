#include "core/interpolation/nearest_in_hull.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace handlebody;

namespace {

constexpr unsigned seed = 19760101;

Matrix random_points(std::mt19937& random, Index count, Index dimension) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(count, dimension, [&] { return uniform(random); });
}

struct Answer {
  double distance;
  Vector nearest, weights;
};

Answer ask(NearestInHull& hull, Index count, const Vector& query) {
  Answer answer{0, Vector(query.size()), Vector(count)};
  answer.distance = hull(query.data(), answer.nearest.data(), answer.weights.data());
  return answer;
}

/** How far the answer is from being right, relative to the size of the points: it is a point of the hull, at the distance told, and
 * the plane through it across the way to the query has no point in front, which proves that nothing of the hull is nearer. */
double error_of(const Matrix& points, const Vector& query, const Answer& answer) {
  const double size = std::max(1e-300, (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm());
  const Vector mean = points.transpose() * answer.weights, across = query - answer.nearest;
  double error = std::max(-answer.weights.minCoeff(), std::abs(answer.weights.sum() - 1));
  error = std::max(error, (mean - answer.nearest).norm() / size);
  if (answer.distance == 0) return std::max(error, across.norm() / size);
  error = std::max(error, std::abs(across.norm() - answer.distance) / std::max(size, answer.distance));
  const Vector heights = (points.rowwise() - mean.transpose()) * (across / across.norm());
  return std::max(error, heights.maxCoeff() / size);
}

double error_at(NearestInHull& hull, const Matrix& points, const Vector& query) {
  return error_of(points, query, ask(hull, points.rows(), query));
}

/** Corners of the cube [−1, 1]ᵈ. */
Matrix cube(Index dimension) {
  Matrix corners(Index{1} << dimension, dimension);
  for (Index i = 0; i < corners.rows(); ++i)
    for (Index axis = 0; axis < dimension; ++axis) corners(i, axis) = (i >> axis) & 1 ? 1 : -1;
  return corners;
}

Matrix cross_polytope(Index dimension) {
  Matrix corners(2 * dimension, dimension);
  corners << Matrix::Identity(dimension, dimension), -Matrix::Identity(dimension, dimension);
  return corners;
}

}  // namespace

TEST_CASE("nearest in hull: random points in 1 to 64 dimensions have no point in front of the answer (seed 19760101)") {
  std::mt19937 random(seed);
  double worst = 0;
  int inside = 0, outside = 0;
  for (const Index dimension : {1, 2, 3, 4, 5, 8, 16, 64}) {
    for (const Index count : {1, 2, 3, 7, 40, 300}) {
      const Matrix points = random_points(random, count, dimension);
      NearestInHull hull(points);
      for (const double far : {0.1, 0.5, 1.0, 1.5, 10.0, 1e6}) {
        for (int repeat = 0; repeat < 5; ++repeat) {
          const Vector query = far * random_points(random, 1, dimension).row(0).transpose();
          const Answer answer = ask(hull, count, query);
          ++(answer.distance == 0 ? inside : outside);
          CAPTURE(dimension);
          CAPTURE(count);
          CAPTURE(far);
          const double error = error_of(points, query, answer);
          CHECK(error < 1e-12 * std::max(1.0, 1e-2 * far));
          if (far < 100) worst = std::max(worst, error);
        }
      }
    }
  }
  CHECK(inside > 100);
  CHECK(outside > 500);
  MESSAGE(inside << " queries inside, " << outside << " outside, worst error " << worst);
}

TEST_CASE("nearest in hull: a cross-polytope's faces, left along their normals (seed 19760101)") {
  std::mt19937 random(seed + 1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Index dimension : {2, 3, 5, 12}) {
    Matrix points = cross_polytope(dimension);
    NearestInHull hull(points);
    for (int repeat = 0; repeat < 50; ++repeat) {
      // A face of the cross-polytope: one corner ±eₐ for each axis; its normal is the vector of the signs.
      Vector z(dimension), normal(dimension);
      for (Index axis = 0; axis < dimension; ++axis) {
        normal[axis] = uniform(random) < 0.5 ? -1 : 1;
        z[axis] = uniform(random);
      }
      z = (z / z.sum()).cwiseProduct(normal);
      const double away = 3 * uniform(random);
      const Answer answer = ask(hull, points.rows(), z + away * normal);
      CHECK((answer.nearest - z).norm() < 1e-13);
      CHECK(std::abs(answer.distance - away * normal.norm()) < 1e-13);
    }
  }
}

TEST_CASE("nearest in hull: cubes clamp (seed 19760101)") {
  std::mt19937 random(seed + 2);
  for (const Index dimension : {1, 2, 3, 4, 6, 9}) {
    const Matrix points = cube(dimension);
    NearestInHull hull(points);
    for (const double far : {0.9, 1.5, 4.0, 1e3}) {
      for (int repeat = 0; repeat < 20; ++repeat) {
        const Vector query = far * random_points(random, 1, dimension).row(0).transpose();
        const Vector expected = query.cwiseMax(-1).cwiseMin(1);
        const Answer answer = ask(hull, points.rows(), query);
        CAPTURE(dimension);
        CAPTURE(far);
        CHECK((answer.nearest - expected).norm() < 1e-14 * std::max(far, 10.0));
        CHECK(std::abs(answer.distance - (query - expected).norm()) < 1e-14 * std::max(far, 10.0));
        CHECK(error_of(points, query, answer) < 1e-13 * std::max(far, 1.0));
      }
    }
  }
}

TEST_CASE("nearest in hull: a rotated grid and a circle, seen from their own edges' lines (seed 19760101)") {
  std::mt19937 random(seed + 3);
  const double c = std::cos(0.4), s = std::sin(0.4);
  Matrix grid(100, 2), circle(200, 2);
  for (Index i = 0; i < 100; ++i) {
    const double x = static_cast<double>(i % 10), y = static_cast<double>(i / 10);
    grid.row(i) << c * x - s * y + 50, s * x + c * y - 20;
  }
  for (Index i = 0; i < 200; ++i) circle.row(i) << std::cos(0.01 * M_PI * double(i)), std::sin(0.01 * M_PI * double(i));
  for (const Matrix& points : {grid, circle}) {
    NearestInHull hull(points);
    for (Index i = 0; i < points.rows(); ++i) {
      const Answer own = ask(hull, points.rows(), points.row(i).transpose());
      CHECK(own.distance == 0);
      const Vector beyond = 2 * points.row(i) - points.row((i + 7) % points.rows());
      CHECK(error_at(hull, points, beyond) < 1e-12);
      const Vector middle = (points.row(i) + points.row((i + 1) % points.rows())) / 2;
      CHECK(ask(hull, points.rows(), middle).distance == 0);
    }
    for (int repeat = 0; repeat < 200; ++repeat) {
      const Vector mean = points.colwise().mean();
      const Vector query = mean + 12 * random_points(random, 1, 2).row(0).transpose();
      CHECK(error_at(hull, points, query) < 1e-12);
    }
  }
}

TEST_CASE("nearest in hull: points that coincide, lie on a line or span less than the space (seed 19760101)") {
  std::mt19937 random(seed + 4);
  for (const Index dimension : {2, 3, 7, 20}) {
    for (Index span = 0; span < dimension; span += std::max<Index>(1, dimension / 4)) {
      // Products of random matrices: `span` dimensions up to rounding, somewhere in space; the last three repeat the first.
      Matrix points = random_points(random, 30, span) * random_points(random, span, dimension);
      points.rowwise() += 3 * random_points(random, 1, dimension).row(0);
      points.bottomRows(3) = points.topRows(3);
      NearestInHull hull(points);
      for (int repeat = 0; repeat < 20; ++repeat) {
        const Vector query = points.row(0).transpose() + 2 * random_points(random, 1, dimension).row(0).transpose();
        CAPTURE(dimension);
        CAPTURE(span);
        CHECK(error_at(hull, points, query) < 1e-12);
        const Vector inside = (points.row(1) + 2 * points.row(repeat)) / 3;
        CHECK(ask(hull, 30, inside).distance == 0);
      }
    }
  }
}

TEST_CASE("nearest in hull: very thin hulls and crowded points stay right (seed 19760101)") {
  std::mt19937 random(seed + 5);
  for (const double thickness : {1e-3, 1e-6, 1e-9, 1e-12}) {
    for (const Index dimension : {2, 3, 6}) {
      Matrix points = random_points(random, 60, dimension);
      points.col(0) *= thickness;
      points.topRows(20) = thickness * random_points(random, 20, dimension);  // a crowd in the middle
      NearestInHull hull(points);
      for (const double far : {thickness, 0.3, 2.0}) {
        for (int repeat = 0; repeat < 20; ++repeat) {
          CAPTURE(thickness);
          CAPTURE(dimension);
          CAPTURE(far);
          const Vector query = far * random_points(random, 1, dimension).row(0).transpose();
          // The plane's direction is known to rounding over the distance, so the proof is, too.
          const Answer answer = ask(hull, 60, query);
          CHECK(error_of(points, query, answer) < 1e-13 + 1e-14 / std::max(answer.distance, 1e-12));
        }
      }
    }
  }
}

TEST_CASE("nearest in hull: means of nearly coplanar points are inside (seed 19760101)") {
  // The corral's plane turns by as little as the points are off a face: its normal must be right to its own last digit.
  std::mt19937 random(seed + 8);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double jitter : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    Matrix points = jitter * random_points(random, 125, 3);
    for (Index i = 0; i < 125; ++i) points.row(i) += Eigen::RowVector3d(double(i % 5), double(i / 5 % 5), double(i / 25)) / 4;
    NearestInHull hull(points);
    for (int repeat = 0; repeat < 300; ++repeat) {
      Vector query = Vector::Zero(3);
      double sum = 0;
      for (int k = 0; k < 1 + repeat % 4; ++k) {
        const double weight = uniform(random);
        query += weight * points.row(static_cast<Index>(random() % 125)).transpose();
        sum += weight;
      }
      CAPTURE(jitter);
      CHECK(ask(hull, 125, query / sum).distance == 0);
    }
  }
}

TEST_CASE("nearest in hull: projections are no farther apart than their queries, close to the hull too (seed 19760101)") {
  std::mt19937 random(seed + 6);
  for (const Index dimension : {2, 3, 6}) {
    const Matrix points = random_points(random, 40, dimension);
    NearestInHull hull(points);
    Vector at = 2 * random_points(random, 1, dimension).row(0).transpose();
    Vector before = at, nearest_before = ask(hull, 40, at).nearest;
    for (int repeat = 0; repeat < 2000; ++repeat) {
      at += 0.01 * random_points(random, 1, dimension).row(0).transpose() - 0.002 * at;
      const Vector nearest = ask(hull, 40, at).nearest;
      CHECK((nearest - nearest_before).norm() <= (at - before).norm() * (1 + 1e-9) + 1e-12);
      before = at;
      nearest_before = nearest;
    }
    // Just off a face, at every height.
    const Vector far = 3 * random_points(random, 1, dimension).row(0).transpose();
    const Vector foot = ask(hull, 40, far).nearest;
    for (double height = 1; height > 1e-11; height /= 3) {
      const Answer answer = ask(hull, 40, foot + height * (far - foot));
      CHECK((answer.nearest - foot).norm() < 1e-13);
      CHECK(std::abs(answer.distance - height * (far - foot).norm()) < 1e-14);
    }
  }
}

TEST_CASE("nearest in hull: the order of the points, their unit and their place do not matter (seed 19760101)") {
  std::mt19937 random(seed + 7);
  for (const Index dimension : {2, 4}) {
    const Matrix points = random_points(random, 50, dimension);
    Matrix moved = points.colwise().reverse() * 1e-5;
    const Vector shift = Vector::Constant(dimension, 7);
    moved.rowwise() += shift.transpose();
    NearestInHull hull(points), other(moved);
    for (int repeat = 0; repeat < 50; ++repeat) {
      const Vector query = 2 * random_points(random, 1, dimension).row(0).transpose();
      const Answer a = ask(hull, 50, query), b = ask(other, 50, query * 1e-5 + shift);
      CHECK(((b.nearest - shift) * 1e5 - a.nearest).norm() < 1e-8);  // 7 has its digits at 1e-15, and 1e-5 of them are left
      CHECK(std::abs(b.distance * 1e5 - a.distance) < 1e-8);
    }
  }
}

TEST_CASE("nearest in hull: one point, and queries as far as numbers go") {
  Matrix one(1, 3);
  one << 1, 2, 3;
  NearestInHull point(one);
  const Answer at = ask(point, 1, Vector::Constant(3, 2));
  CHECK(at.nearest == one.row(0).transpose());
  CHECK(at.distance == doctest::Approx(std::sqrt(2)));
  CHECK(at.weights[0] == 1);
  CHECK(ask(point, 1, one.row(0).transpose()).distance == 0);

  Matrix square(4, 2);
  square << 0, 0, 1, 0, 0, 1, 1, 1;
  NearestInHull hull(square);
  for (const double far : {1e10, 1e100, 1e150, 1e200, 1.7e308}) {
    CAPTURE(far);
    CHECK((ask(hull, 4, Eigen::Vector2d(far, -far)).nearest - Eigen::Vector2d(1, 0)).norm() < 1e-15);
    CHECK(std::abs(ask(hull, 4, Eigen::Vector2d(0.25, far)).nearest[1] - 1) < 1e-15);
    const Answer diagonal = ask(hull, 4, Eigen::Vector2d(-far, 0.5 * far));
    CHECK((diagonal.nearest - Eigen::Vector2d(0, 1)).norm() < 1e-15);
    CHECK(diagonal.weights.sum() == doctest::Approx(1));
  }
  CHECK((ask(hull, 4, Eigen::Vector2d(0.25, 1e8)).nearest - Eigen::Vector2d(0.25, 1)).norm() < 1e-7);
  double nearest[2];
  CHECK(hull(Eigen::Vector2d(0.5, 3).data(), nearest, nullptr) == doctest::Approx(2));  // the weights need not be asked for
}
