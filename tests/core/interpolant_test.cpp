// What all interpolants share, seen through two whose weights are known: Shepard's, and barycentric coordinates.
#include "core/interpolation/interpolant.hpp"

#include <doctest/doctest.h>

#include <random>

#include "core/interpolation/shepard.hpp"
#include "core/interpolation/simplex_linear.hpp"

using namespace handlebody;

namespace {

/** The corners of a triangle: 0, 1 and 3. The third point is the second's place, the fifth the first's. */
Matrix twin_points() {
  Matrix points(5, 2);
  points << 0, 0, 1, 0, 1, 0, 0, 1, 0, 0;
  return points;
}

Matrix twin_values() {
  Matrix values(5, 3);
  values << 1, 10, -1, 2, 20, 5, 2, 20, 5, 4, 40, 7, 1, 10, -1;
  return values;
}

/** wₖ = dₖ⁻²/Σd⁻² of the points that were kept, and its gradient: with s = d⁻², ∇s = −2 s² (x − p). */
struct ShepardWeights {
  Eigen::Vector3d w;
  Eigen::Matrix<double, 3, 2> slopes;

  explicit ShepardWeights(const Eigen::RowVector2d& x) {
    const Matrix all = twin_points();
    Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
    for (Index k = 0; k < 3; ++k) {
      const Eigen::RowVector2d apart = x - all.row(k == 2 ? 3 : k);
      w[k] = 1 / apart.squaredNorm();
      slopes.row(k) = -2 * w[k] * w[k] * apart;
      sum += slopes.row(k);
    }
    const double total = w.sum();
    for (Index k = 0; k < 3; ++k) slopes.row(k) = slopes.row(k) / total - w[k] / (total * total) * sum;
    w /= total;
  }
};

Matrix values_without_twins() {
  Matrix kept(3, 3);
  kept << twin_values().row(0), twin_values().row(1), twin_values().row(3);
  return kept;
}

}  // namespace

TEST_CASE("an interpolant knows its sizes: points as given, those that were merged included") {
  const auto f = Shepard::create(twin_points(), twin_values());
  REQUIRE(f);
  CHECK(f->size() == 5);
  CHECK(f->dimension() == 2);
  CHECK(f->outputs() == 3);
  CHECK(f->data().points.rows() == 3);
  CHECK(f->differentiable());
  const auto g = SimplexLinear::create(twin_points(), twin_values());
  REQUIRE(g);
  CHECK(g->size() == 5);
  CHECK_FALSE(g->differentiable());
}

TEST_CASE("values are the weights' combination of the values, query after query (seed 101)") {
  auto shepard = Shepard::create(twin_points(), twin_values());
  auto linear = SimplexLinear::create(twin_points(), twin_values());
  REQUIRE(shepard);
  REQUIRE(linear);
  std::mt19937 random(101);
  std::uniform_real_distribution<double> uniform(0.05, 0.45);
  const Matrix queries = Matrix::NullaryExpr(20, 2, [&] { return uniform(random); });
  Matrix smooth = Matrix::Constant(20, 3, 9), flat = smooth;
  shepard->evaluate(queries.data(), 20, smooth.data());
  linear->evaluate(queries.data(), 20, flat.data());
  for (Index q = 0; q < 20; ++q) {
    const double x = queries(q, 0), y = queries(q, 1);
    CHECK((smooth.row(q) - ShepardWeights(queries.row(q)).w.transpose() * values_without_twins()).norm() < 1e-12);
    CHECK((flat.row(q) - Eigen::RowVector3d(1 - x - y, x, y) * values_without_twins()).norm() < 1e-12);
  }
  double untouched = 5;
  shepard->evaluate(queries.data(), 0, &untouched);
  CHECK(untouched == 5);
}

TEST_CASE("gradients come output by output, and axis by axis within (seed 102)") {
  auto f = Shepard::create(twin_points(), twin_values());
  REQUIRE(f);
  std::mt19937 random(102);
  std::uniform_real_distribution<double> uniform(0.1, 0.9);
  const Matrix queries = Matrix::NullaryExpr(20, 2, [&] { return uniform(random); });
  Matrix gradients = Matrix::Constant(20, 6, 9);
  f->gradient(queries.data(), 20, gradients.data());
  for (Index q = 0; q < 20; ++q) {
    const Eigen::Matrix<double, 3, 2> expected = values_without_twins().transpose() * ShepardWeights(queries.row(q)).slopes;
    for (Index output = 0; output < 3; ++output)
      for (Index axis = 0; axis < 2; ++axis)
        CHECK(gradients(q, 2 * output + axis) == doctest::Approx(expected(output, axis)).epsilon(1e-9));
  }
}

TEST_CASE("weights come for the points as given, what was merged into another having none, and sum to 1") {
  const double query[] = {0.2, 0.5};
  Vector w = Vector::Constant(5, 99);
  auto linear = SimplexLinear::create(twin_points(), twin_values());
  REQUIRE(linear);
  linear->weights(query, w.data());
  Vector expected(5);
  expected << 0.3, 0.2, 0, 0.5, 0;
  CHECK((w - expected).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(w[2] == 0);
  CHECK(w[4] == 0);

  auto shepard = Shepard::create(twin_points(), twin_values());
  REQUIRE(shepard);
  w.setConstant(99);
  shepard->weights(query, w.data());
  const Eigen::Vector3d own = ShepardWeights({0.2, 0.5}).w;
  expected << own[0], own[1], 0, own[2], 0;
  CHECK((w - expected).cwiseAbs().maxCoeff() < 1e-14);
  Eigen::RowVector3d value;
  shepard->evaluate(query, 1, value.data());
  CHECK((w.transpose() * twin_values() - value).norm() < 1e-13);
}
