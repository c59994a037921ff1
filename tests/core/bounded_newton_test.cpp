#include "core/skinning/bounded_newton.hpp"

#include <cmath>
#include <string>

#include "core/skinning/bounded_sweeps.hpp"
#include "core/skinning/polyharmonic_weights.hpp"
#include "plane_meshes.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

/** What the energy could fall by, at first order, if every vertex gave all to the handle whose force there is least. */
double slack(const PolyharmonicWeights& weights, const BoundedProblem& problem) {
  const Matrix w = problem.weights(), forces = weights.energy() * w;
  double sum = 0;
  for (const std::uint32_t v : problem.free()) sum += forces.row(v).dot(w.row(v)) - forces.row(v).minCoeff();
  return sum;
}

}  // namespace

TEST_CASE("bounded weights by Newton's method: from a rough guess to the minimum, where nothing changes any more (seeds 1 to 4)") {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    DOCTEST_SUBCASE(("seed " + std::to_string(seed)).c_str()) {
      std::mt19937 random(seed);
      auto made = PolyharmonicWeights::create(jittered_grid(random, 10, 6), 2, Mass::voronoi);
      REQUIRE(made);
      const PolyharmonicWeights& weights = **made;
      REQUIRE((*made)->set_handles({{0, 76, 38, 20}, {0, 1, 2, 3}, 4}));
      BoundedProblem problem(weights.energy(), weights.held(), weights.weights());
      const Indices order = minimum_degree_order(problem.energy());
      auto sweeps = BoundedSweeps::create(problem, weights.mass(), order);
      REQUIRE(sweeps);
      for (int sweep = 0; sweep < 40; ++sweep) (*sweeps)->sweep();
      problem.evaluate((*sweeps)->x());
      const double rough = problem.gap(), rough_slack = slack(weights, problem);

      BoundedNewton newton(problem, (*sweeps)->projected(), order);
      int steps = 0;
      Index changed = 1;
      for (; changed > 0 && steps < 40; ++steps) {
        for (Index handle = 0; handle < 4; ++handle) REQUIRE(newton.factor(handle));
        changed = newton.step(1e-10);
      }
      CHECK(steps < 20);
      CHECK(problem.gap() < 1e-3 * rough);
      CHECK(problem.gap() < 1e-8 * problem.best_energy());
      CHECK(slack(weights, problem) < 1e-4 * problem.best_energy());
      CHECK(slack(weights, problem) < 0.1 * rough_slack);
    }
  }
}
