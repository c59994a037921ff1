#include "core/skinning/bounded_problem.hpp"

#include <algorithm>
#include <cmath>

#include "core/skinning/polyharmonic_weights.hpp"
#include "plane_meshes.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

const HeldVertices four_handles{{0, 34, 16, 17, 30}, {0, 1, 2, 2, 3}, 4};

std::unique_ptr<PolyharmonicWeights> unbounded(std::mt19937& random) {
  auto made = PolyharmonicWeights::create(jittered_grid(random, 6, 4), 2, Mass::voronoi);
  REQUIRE(made);
  REQUIRE((*made)->set_handles(four_handles));
  return std::move(*made);
}

}  // namespace

TEST_CASE("projection to a simplex: feasible, and no nearer point on a line to any corner (seed 1108)") {
  std::mt19937 random(1108);
  std::normal_distribution<double> normal(0, 2);
  for (int trial = 0; trial < 200; ++trial) {
    const Index h = 1 + trial % 7;
    Vector given(h);
    for (Index j = 0; j < h; ++j) given[j] = normal(random);
    Vector w = given;
    project_to_simplex(w.data(), h);
    CHECK(w.minCoeff() >= 0);
    CHECK(w.sum() == doctest::Approx(1).epsilon(1e-15));
    // (given − w)·(c − w) ≤ 0 for every corner c.
    for (Index j = 0; j < h; ++j) CHECK(given[j] - w[j] - (given - w).dot(w) < 1e-13);
    Vector again = w;
    project_to_simplex(again.data(), h);
    CHECK((again - w).cwiseAbs().maxCoeff() < 1e-15);
  }
}

TEST_CASE("projection to a simplex: ends, and on the simplex, where 1 is nothing beside the numbers") {
  for (const double size : {1e15, 1e16, 1e17, 1e300, -1e17}) {
    for (Vector w : {Vector::Constant(3, size).eval(), Vector{{size, size, 0}}, Vector{{0, size, -size}}}) {
      CAPTURE(w);
      project_to_simplex(w.data(), w.size());
      CHECK(w.minCoeff() >= 0);
      CHECK(w.sum() == doctest::Approx(1).epsilon(1e-15));
    }
  }
}

TEST_CASE("bounded problem: its energy and forces are those of all vertices' weights (seed 1109)") {
  std::mt19937 random(1109);
  const auto weights = unbounded(random);
  BoundedProblem problem(weights->energy(), weights->held(), weights->weights());
  const Matrix x = problem.free_start() + 0.1 * Matrix::Random(problem.load().rows(), 4);
  Matrix all = problem.start();
  for (std::size_t k = 0; k < problem.free().size(); ++k) all.row(problem.free()[k]) = x.row(static_cast<Index>(k));
  const Matrix image = weights->energy() * all;
  CHECK(problem.value(x) == doctest::Approx(all.cwiseProduct(image).sum() / 2).epsilon(1e-12));
  problem.evaluate(x);
  for (std::size_t k = 0; k < problem.free().size(); ++k)
    CHECK((problem.forces().row(static_cast<Index>(k)) - image.row(problem.free()[k])).cwiseAbs().maxCoeff() <
          1e-12 * image.cwiseAbs().maxCoeff());
}

TEST_CASE("bounded problem: the best is feasible and only gets better, and nothing feasible is below the bound (seed 1110)") {
  std::mt19937 random(1110);
  const auto weights = unbounded(random);
  BoundedProblem problem(weights->energy(), weights->held(), weights->weights());
  double best = problem.best_energy(), gap = problem.gap();
  CHECK(best >= problem.value(problem.free_start()));  // bounds cost energy
  double least = best;
  for (int trial = 0; trial < 50; ++trial) {
    Matrix x = problem.free_start() + 0.02 * Matrix::Random(problem.load().rows(), 4);
    problem.evaluate(x);
    CHECK(problem.best_energy() <= best);
    CHECK(problem.gap() <= gap);
    best = problem.best_energy();
    gap = problem.gap();
    for (Index i = 0; i < x.rows(); ++i) project_to_simplex(&x(i, 0), 4);
    least = std::min(least, problem.value(x));
  }
  CHECK(least >= best - gap);
  const Matrix w = problem.weights();
  CHECK(w.minCoeff() >= 0);
  CHECK((w.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-14);
  for (std::size_t k = 0; k < four_handles.vertices.size(); ++k) CHECK(w(four_handles.vertices[k], four_handles.owners[k]) == 1);
  CHECK(w.cwiseProduct(weights->energy() * w).sum() / 2 == doctest::Approx(best).epsilon(1e-12));
  CHECK(!problem.solved(0.5 * gap / best));
  CHECK(problem.solved(2 * gap / best));
}
