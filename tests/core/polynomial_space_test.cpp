#include "core/interpolation/polynomial_space.hpp"

#include <doctest/doctest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/interpolation/polynomial.hpp"
#include "scattered.hpp"

using namespace handlebody;
using handlebody::test::random_points;

namespace {

constexpr unsigned seed = 20140728;

Matrix functions_at(PolynomialSpace& space, const Matrix& points) {
  Matrix out(points.rows(), space.size());
  Vector z(points.cols());
  for (Index i = 0; i < points.rows(); ++i) {
    space.coordinates(&points(i, 0), z.data());
    space.values(z.data(), out.data() + i * out.cols());
  }
  return out;
}

Matrix monomials_at(const Matrix& points, int degree) {
  Matrix out(points.rows(), polynomial_count(degree, points.cols()));
  for (Index i = 0; i < points.rows(); ++i) polynomial_values(&points(i, 0), points.cols(), degree, out.data() + i * out.cols());
  return out;
}

Index rank_of(const Matrix& matrix) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
  qr.setThreshold(1e-9);
  return qr.rank();
}

struct Degenerate {
  const char* name;
  Matrix points;
};

/** Sets that do not determine all polynomials of degree 2, and most not of degree 1 either. */
std::vector<Degenerate> degenerate_sets() {
  std::mt19937 random(seed);
  const Matrix free = random_points(random, 30, 3);
  Matrix line(30, 3), plane = free, ellipse(30, 2), two_places(30, 1), sphere = free;
  for (Index i = 0; i < 30; ++i) {
    const auto angle = static_cast<double>(i);
    line.row(i) << free(i, 0), 1 - 2 * free(i, 0), free(i, 0) / 3;
    plane(i, 2) = 0.3 + free(i, 0) - 0.2 * free(i, 1);
    ellipse.row(i) << 0.2 + 0.7 * std::cos(angle), 0.1 + 1e-4 * std::sin(angle);
    two_places(i, 0) = i % 2 ? 0.3 : -0.4;
    sphere.row(i) /= free.row(i).norm();
  }
  return {{"a line", line},
          {"a plane", plane},
          {"one place", Matrix::Constant(30, 3, 0.7)},
          {"a long ellipse", ellipse},
          {"two places", two_places},
          {"a sphere", sphere},
          {"two points", free.topRows(2)},
          {"a single point", free.topRows(1)}};
}

}  // namespace

TEST_CASE("points in general position, thin or not, determine all polynomials (seed 20140728)") {
  std::mt19937 random(seed);
  for (const Index d : {1, 2, 3, 6})
    for (int degree = -1; degree <= 2; ++degree) {
      Matrix points = random_points(random, std::max<Index>(1, polynomial_count(degree, d)), d);
      for (const double thin : {1.0, 1e-8, 1e-20}) {
        points.col(0) *= thin;
        CAPTURE(d);
        CAPTURE(degree);
        PolynomialSpace space(points, degree);
        CHECK(space.size() == polynomial_count(degree, d));
        CHECK(functions_at(space, points) == monomials_at(points, degree));
      }
    }
}

TEST_CASE("of other points, the space has just the polynomials that they tell apart (seed 20140728)") {
  for (auto& [set, points] : degenerate_sets())
    for (int degree = 0; degree <= 2; ++degree) {
      const std::string name = set;
      CAPTURE(name);
      CAPTURE(degree);
      PolynomialSpace space(points, degree);
      const Matrix functions = functions_at(space, points), monomials = monomials_at(points, degree);
      CHECK(space.size() == rank_of(functions));  // independent at the points
      Matrix both(points.rows(), functions.cols() + monomials.cols());
      Matrix even = monomials;
      for (Index j = 0; j < even.cols(); ++j) even.col(j) /= std::max(1e-300, even.col(j).norm());
      both << functions, even;
      if (name != "a long ellipse") CHECK(rank_of(both) == space.size());
      for (int lower = 0; lower <= degree; ++lower) CHECK(space.count(lower) == PolynomialSpace(points, lower).size());
    }
  CHECK(PolynomialSpace(degenerate_sets()[3].points, 2).size() == 5);
  CHECK(PolynomialSpace(degenerate_sets()[5].points, 2).size() == 9);
}

TEST_CASE("which polynomials they are does not depend on how points are moved, turned and scaled (seed 20140728)") {
  std::mt19937 random(seed);
  for (auto& [set, points] : degenerate_sets()) {
    if (points.rows() < 3) continue;
    for (int degree = 1; degree <= 2; ++degree) {
      const std::string name = set;
      CAPTURE(name);
      const Index d = points.cols();
      const Eigen::MatrixXd turn = Eigen::HouseholderQR<Eigen::MatrixXd>(random_points(random, d, d)).householderQ();
      const Matrix queries = random_points(random, 40, d), shift = random_points(random, 1, d);
      const auto moved = [&](const Matrix& x) { return Matrix((0.3 * x * turn).rowwise() + shift.row(0)); };
      PolynomialSpace space(points, degree), other(moved(points), degree);
      REQUIRE(space.size() == other.size());
      // Fitted to the same values, both say the same everywhere else.
      const Matrix values = random_points(random, points.rows(), 1);
      const auto fit = [&](PolynomialSpace& s, const Matrix& at, const Matrix& x) {
        return Matrix(functions_at(s, x) * functions_at(s, at).colPivHouseholderQr().solve(Eigen::MatrixXd(values)));
      };
      const Matrix a = fit(space, points, queries), b = fit(other, moved(points), moved(queries));
      CHECK((a - b).cwiseAbs().maxCoeff() < 1e-8 * (1 + a.cwiseAbs().maxCoeff()));
    }
  }
}

TEST_CASE("gradients agree with central differences, which are exact up to degree 2 (seed 20140728)") {
  std::mt19937 random(seed);
  for (auto& [set, points] : degenerate_sets())
    for (int degree = 0; degree <= 2; ++degree) {
      const std::string name = set;
      CAPTURE(name);
      PolynomialSpace space(points, degree);
      const Index d = points.cols();
      Matrix x = random_points(random, 1, d), gradients = Matrix::Constant(space.size(), d, 7);
      Vector z(d);
      space.coordinates(x.data(), z.data());
      space.gradients(z.data(), gradients.data());
      for (Index axis = 0; axis < d; ++axis) {
        Matrix left = x, right = x;
        left(0, axis) -= 0.5;
        right(0, axis) += 0.5;
        const Matrix slope = functions_at(space, right) - functions_at(space, left);
        const double size = functions_at(space, right).cwiseAbs().maxCoeff();
        CHECK((slope.transpose() - gradients.col(axis)).cwiseAbs().maxCoeff() < 1e-12 * (1 + size));
      }
    }
}

TEST_CASE("across a line the functions are constant: the least-norm slope") {
  Matrix line(4, 2);
  line << 0, 0, 1, 2, 2, 4, 3, 6;
  PolynomialSpace space(line, 1);
  REQUIRE(space.size() == 2);
  Matrix off = line;
  off.col(0).array() += 2;
  off.col(1).array() -= 1;
  CHECK((functions_at(space, line) - functions_at(space, off)).cwiseAbs().maxCoeff() < 1e-14);
}
