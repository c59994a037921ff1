#include "core/interpolation/delaunay_cell.hpp"

#include <doctest/doctest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/interpolation/nearest_in_hull.hpp"
#include "scattered.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

constexpr unsigned seed = 19340101;

/** Points in the unit ball around the origin, as the class wants them. */
Matrix ball_points(std::mt19937& random, Index count, Index dimension) {
  Matrix points = random_points(random, count, dimension);
  points.rowwise() -= points.colwise().mean().eval();
  return points / (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

Matrix rows_of(const Matrix& points, const Indices& members) {
  Matrix rows(std::ssize(members), points.cols());
  for (Index m = 0; m < rows.rows(); ++m) rows.row(m) = points.row(members[m]);
  return rows;
}

/** The center of the sphere through all `members`. */
Vector center_of(const Matrix& members) {
  const Matrix edges = members.bottomRows(members.rows() - 1).rowwise() - members.row(0);
  const Vector halves = edges.rowwise().squaredNorm() / 2;
  return members.row(0).transpose() + edges.colPivHouseholderQr().solve(halves);
}

}  // namespace

TEST_CASE("a Delaunay cell holds its place and has an empty sphere through all its points (seed 19340101)") {
  std::mt19937 random(seed);
  int found = 0, missed = 0;
  for (const Index dimension : {1, 2, 3, 4, 6}) {
    for (const Index count : {dimension + 1, Index{12}, Index{80}}) {
      const Matrix points = ball_points(random, count, dimension);
      DelaunayCell cell(points);
      NearestInHull hull(points);
      for (int repeat = 0; repeat < 10; ++repeat) {
        const Vector place = 0.25 * random_points(random, 1, dimension).row(0).transpose();
        Vector nearest(dimension);
        const bool inside = hull(place.data(), nearest.data(), nullptr) == 0;
        REQUIRE(cell.find(place.data()) == inside);
        ++(inside ? found : missed);
        if (!inside) continue;
        const Matrix members = rows_of(points, cell.members());
        CHECK(members.rows() == dimension + 1);
        NearestInHull simplex(members);
        CHECK(simplex(place.data(), nearest.data(), nullptr) < 1e-11);
        const Vector center = center_of(members);
        const double radius = (members.row(0).transpose() - center).norm();
        for (Index i = 0; i < points.rows(); ++i) CHECK((points.row(i).transpose() - center).norm() > radius * (1 - 1e-12));
      }
    }
  }
  CHECK(found > 50);
  CHECK(missed > 20);
}

TEST_CASE("every place between points has its cell, with a point at the origin and in crowds as well (seed 19340101)") {
  std::mt19937 random(seed + 3);
  for (int repeat = 0; repeat < 600; ++repeat) {
    const Index dimension = 2 + repeat % 7, count = dimension + 1 + repeat / 7 % 4;
    Matrix points = ball_points(random, count, dimension);
    points.rowwise() -= points.row(repeat % count).eval();
    if (repeat % 3 == 1) points *= 1e-4;
    if (repeat % 3 == 2) points.topRows(count / 2) *= 1e-4;
    DelaunayCell cell(points);
    for (int query = 0; query < 10; ++query) {
      Vector shares = random_points(random, count, 1).cwiseAbs();
      shares /= shares.sum();
      const Vector place = points.transpose() * shares;
      CAPTURE(repeat);
      REQUIRE(cell.find(place.data()));
    }
  }
}

TEST_CASE("cospherical points are found together, all of them, from every place in their hull (seed 19340101)") {
  std::mt19937 random(seed + 1);
  Matrix grid(125, 3);
  for (Index i = 0; i < 125; ++i) grid.row(i) << double(i % 5) - 2, double(i / 5 % 5) - 2, double(i / 25) - 2;
  grid *= 0.144;
  DelaunayCell cells(grid);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const Vector place = 0.28 * random_points(random, 1, 3).row(0).transpose();
    REQUIRE(cells.find(place.data()));
    REQUIRE(cells.members().size() == 8);
    for (const std::uint32_t member : cells.members())
      CHECK((grid.row(member).transpose() - place).cwiseAbs().maxCoeff() < 0.144 * (1 + 1e-9));
  }
  Matrix circle(300, 2);
  for (Index i = 0; i < 300; ++i) circle.row(i) << std::cos(M_PI * double(i) / 150) / 3, std::sin(M_PI * double(i) / 150) / 3;
  DelaunayCell whole(circle);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Vector place = 0.22 * random_points(random, 1, 2).row(0).transpose();
    REQUIRE(whole.find(place.data()));
    CHECK(whole.members().size() == 300);
  }
}

TEST_CASE("a Delaunay cell depends on the place alone, not on what was asked before (seed 19340101)") {
  std::mt19937 random(seed + 2);
  const Matrix points = ball_points(random, 60, 3);
  DelaunayCell one(points);
  std::vector<Vector> places;
  std::vector<Indices> answers;
  for (int repeat = 0; repeat < 60; ++repeat) {
    places.emplace_back(0.1 * random_points(random, 1, 3).row(0).transpose());
    REQUIRE(one.find(places.back().data()));
    answers.push_back(one.members());
  }
  for (std::size_t k = places.size(); k-- > 0;) {
    DelaunayCell other(points);
    REQUIRE(other.find(places[k].data()));
    CHECK(other.members() == answers[k]);
    REQUIRE(one.find(places[k].data()));
    CHECK(one.members() == answers[k]);
  }
  // At a point, that point; with one point there is nothing else.
  REQUIRE(one.find(&points(17, 0)));
  CHECK(one.members() == Indices{17});
  DelaunayCell single(Matrix::Zero(1, 0));
  const double nowhere = 0;
  REQUIRE(single.find(&nowhere));
  CHECK(single.members() == Indices{0});
}
