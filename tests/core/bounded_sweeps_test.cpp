#include "core/skinning/bounded_sweeps.hpp"

#include <cmath>
#include <string>

#include "core/skinning/bounded_weights.hpp"
#include "core/skinning/polyharmonic_weights.hpp"
#include "plane_meshes.hpp"

using namespace handlebody;
using namespace handlebody::test;

TEST_CASE("bounded weights by sweeps alone come within 1e-4 of the least energy (seeds 1 to 3)") {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    DOCTEST_SUBCASE(("seed " + std::to_string(seed)).c_str()) {
      std::mt19937 random(seed);
      auto made = PolyharmonicWeights::create(jittered_grid(random, 10, 6), 2, Mass::voronoi);
      REQUIRE(made);
      const PolyharmonicWeights& weights = **made;
      REQUIRE((*made)->set_handles({{0, 76, 38, 20}, {0, 1, 2, 3}, 4}));
      auto exact = BoundedWeights::create(weights.energy(), weights.mass(), weights.held(), weights.weights(), {.tolerance = 1e-9});
      REQUIRE(exact);
      while (!(*exact)->done()) (*exact)->step();
      const double least = (*exact)->report().energy;

      BoundedProblem problem(weights.energy(), weights.held(), weights.weights());
      const double first = problem.best_energy();
      auto sweeps = BoundedSweeps::create(problem, weights.mass(), minimum_degree_order(problem.energy()));
      REQUIRE(sweeps);
      for (int sweep = 0; sweep < 2000; ++sweep) (*sweeps)->sweep();
      const Matrix &x = (*sweeps)->x(), z = (*sweeps)->projected();
      CHECK(z.minCoeff() >= 0);
      CHECK((z.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-14);
      CHECK((x.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-9);
      CHECK(problem.value(x) < least * (1 + 1e-4));
      problem.evaluate(x);
      CHECK(first > 1.01 * least);
      CHECK(problem.best_energy() >= least * (1 - 1e-9));
      CHECK(problem.best_energy() < least * (1 + 1e-4));
    }
  }
}
