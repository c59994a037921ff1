#include "core/interpolation/least_norm_weights.hpp"

#include <doctest/doctest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>

#include "scattered.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

constexpr unsigned seed = 19830901;

/** How far the weights of `points` around `place` are from optimal: feasible, and the truncation of one affine function, which is
 * fitted here to the positive ones and must not be positive at the others. (That is the theorem of Karush, Kuhn and Tucker.) */
double error_of(const Matrix& points, const Vector& place, const Vector& weights) {
  const Vector mean = points.transpose() * weights;
  double error = std::max({-weights.minCoeff(), std::abs(weights.sum() - 1), (mean - place).norm()});
  Matrix equations(0, points.cols() + 1);
  Vector values(0);
  for (Index i = 0; i < points.rows(); ++i) {
    if (!(weights[i] > 1e-10)) continue;
    equations.conservativeResize(equations.rows() + 1, Eigen::NoChange);
    values.conservativeResize(values.size() + 1);
    equations.bottomRows(1) << 1, points.row(i);
    values[values.size() - 1] = weights[i];
  }
  const Vector affine = equations.colPivHouseholderQr().solve(values);
  error = std::max(error, (equations * affine - values).cwiseAbs().maxCoeff());
  if (equations.rows() > points.cols())  // otherwise the function is not determined at the others
    for (Index i = 0; i < points.rows(); ++i)
      if (!(weights[i] > 1e-10)) error = std::max(error, affine[0] + points.row(i).dot(affine.tail(points.cols())));
  return error;
}

Vector solve(LeastNormWeights& solver, const Matrix& points, const Vector& place) {
  for (Index i = 0; i < points.rows(); ++i)
    for (Index axis = 0; axis < points.cols(); ++axis) solver.point(i)[axis] = points(i, axis) - place[axis];
  REQUIRE(solver.solve(points.rows()));
  Vector weights(points.rows());
  for (Index i = 0; i < points.rows(); ++i) weights[i] = solver.weight(i);
  return weights;
}

/** A mean of the points with weights that lean toward few of them, the more the higher the `power`. */
Vector mean_of(std::mt19937& random, const Matrix& points, double power) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Vector weights = Vector::NullaryExpr(points.rows(), [&] { return std::pow(uniform(random), power); });
  return points.transpose() * (weights / weights.sum());
}

}  // namespace

TEST_CASE("least norm weights satisfy the conditions of the optimum (seed 19830901)") {
  std::mt19937 random(seed);
  double worst = 0;
  int clipped = 0;
  for (const Index dimension : {1, 2, 3, 5}) {
    for (const Index count : {dimension + 1, dimension + 3, Index{20}}) {
      const Matrix points = random_points(random, count, dimension);
      LeastNormWeights solver(count, dimension);
      for (const double power : {0.5, 4.0, 20.0}) {
        for (int repeat = 0; repeat < 5; ++repeat) {
          const Vector place = mean_of(random, points, power);
          const Vector weights = solve(solver, points, place);
          clipped += (weights.array() == 0).any();
          const double error = error_of(points, place, weights);
          CHECK(error < 1e-8);
          worst = std::max(worst, error);
        }
      }
    }
  }
  CHECK(clipped > 50);
  MESSAGE("worst error " << worst << "; some weights zero in " << clipped << " of 180");
}

TEST_CASE("least norm weights that are known: cubes inside their cross, a segment, corners") {
  for (const Index dimension : {1, 2, 3, 4}) {
    Matrix cube(Index{1} << dimension, dimension);
    for (Index i = 0; i < cube.rows(); ++i)
      for (Index axis = 0; axis < dimension; ++axis) cube(i, axis) = (i >> axis) & 1 ? 1 : -1;
    LeastNormWeights solver(cube.rows(), dimension);
    const Vector even = solve(solver, cube, Vector::Zero(dimension));
    CHECK((even.array() - 1 / static_cast<double>(cube.rows())).abs().maxCoeff() < 1e-15);
    // As long as none is negative, w = (1 + Σ xₐ pₐ)/2ᵈ.
    const Vector place = Vector::Constant(dimension, 0.9 / static_cast<double>(dimension));
    const Vector expected = ((cube * place).array() + 1) / static_cast<double>(cube.rows());
    CHECK((solve(solver, cube, place) - expected).cwiseAbs().maxCoeff() < 1e-15);
    // On a face only its corners have weight; at a corner, that corner.
    Vector face = Vector::Constant(dimension, 0.2);
    face[0] = 1;
    const Vector on_face = solve(solver, cube, face);
    for (Index i = 0; i < cube.rows(); ++i)
      if (cube(i, 0) < 0) CHECK(on_face[i] == doctest::Approx(0).epsilon(1e-14));
    const Vector corner = solve(solver, cube, cube.row(0).transpose());
    CHECK((corner - Vector::Unit(cube.rows(), 0)).cwiseAbs().maxCoeff() < 1e-15);
  }
  // Collinear in one dimension: the three of −1, 0 and 3 at 1 by hand, v(p) = a + b p with Σ v = 1 and Σ v p = 1.
  Matrix line(3, 1);
  line << -1, 0, 3;
  LeastNormWeights solver(3, 1);
  const Vector weights = solve(solver, line, Vector::Constant(1, 1));
  const double b = 1 / 26.0 * (3 - 2), a = (1 - 2 * b) / 3;
  CHECK((weights - Eigen::Vector3d(a - b, a, a + 3 * b)).norm() < 1e-15);
}

TEST_CASE("least norm weights: places outside are refused, places outside by rounding are not") {
  Matrix square(4, 2);
  square << 0, 0, 1, 0, 0, 1, 1, 1;
  LeastNormWeights solver(4, 2);
  const auto accepts = [&](double x, double y) {
    for (Index i = 0; i < 4; ++i) {
      solver.point(i)[0] = square(i, 0) - x;
      solver.point(i)[1] = square(i, 1) - y;
    }
    return solver.solve(4);
  };
  CHECK(accepts(0.5, 1));
  CHECK(accepts(0.5, 1 + 1e-13));
  CHECK(solver.weight(0) == 0);
  CHECK(solver.weight(2) == doctest::Approx(0.5));
  CHECK(!accepts(0.5, 1 + 1e-6));
  CHECK(!accepts(-3, 0.5));
  CHECK(!accepts(2, 2));
  CHECK(accepts(0.5, 0.5));
}
