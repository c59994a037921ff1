#include "core/skinning/bounded_weights.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "core/skinning/polyharmonic_weights.hpp"
#include "oracle_lines.hpp"

using namespace handlebody;

namespace {

struct Problem {
  SparseMatrix energy;
  Vector mass;
  HeldVertices held;
  Matrix unbounded;
};

Problem made(const SimplexMesh& mesh, const HeldVertices& held) {
  auto weights = PolyharmonicWeights::create(mesh, 2, Mass::voronoi);
  REQUIRE(weights);
  PolyharmonicWeights& made = **weights;
  REQUIRE(made.set_handles(held));
  return {made.energy(), made.mass(), made.held(), made.weights()};
}

BoundedWeights created(const Problem& problem, const BoundedWeightsOptions& options = {}) {
  auto weights = BoundedWeights::create(problem.energy, problem.mass, problem.held, problem.unbounded, options);
  REQUIRE(weights);
  return std::move(**weights);
}

BoundedWeights finished(const Problem& problem, const BoundedWeightsOptions& options = {}) {
  BoundedWeights weights = created(problem, options);
  while (!weights.done()) weights.step();
  return weights;
}

Matrix forces(const Problem& problem, const Matrix& w) {
  return problem.energy * w;
}

double energy_of(const Problem& problem, const Matrix& w) {
  return w.cwiseProduct(forces(problem, w)).sum() / 2;
}

void check_feasible(const Problem& problem, const Matrix& w) {
  CHECK(w.minCoeff() >= 0);
  CHECK(w.maxCoeff() <= 1);
  CHECK((w.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-14);
  for (std::size_t k = 0; k < problem.held.vertices.size(); ++k) CHECK(w(problem.held.vertices[k], problem.held.owners[k]) == 1);
}

Indices whole(const std::vector<double>& from) {
  return {from.begin(), from.end()};
}

Problem oracle_problem(const std::string& line) {
  const std::vector<double> positions = oracle_numbers(line, "positions"), simplices = oracle_numbers(line, "simplices");
  const auto d = static_cast<Index>(oracle_numbers(line, "dimension").at(0));
  const auto corners = static_cast<Index>(oracle_numbers(line, "corners").at(0));
  SimplexMesh mesh;
  mesh.positions = Eigen::Map<const Matrix>(positions.data(), std::ssize(positions) / d, d);
  mesh.simplices = Eigen::Map<const Matrix>(simplices.data(), std::ssize(simplices) / corners, corners).cast<std::uint32_t>();
  HeldVertices held{whole(oracle_numbers(line, "vertices")), whole(oracle_numbers(line, "owners")), 0};
  held.handle_count = held.owners.back() + 1;
  return made(mesh, held);
}

/** A square of (cells + 1)² vertices, two triangles a cell, moved inside by up to a fifth of a cell, of that width. */
SimplexMesh square(Index cells, double width, std::mt19937& random) {
  const Index side = cells + 1;
  SimplexMesh mesh;
  mesh.positions.resize(side * side, 2);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (Index i = 0; i < side; ++i) {
    for (Index j = 0; j < side; ++j) {
      const bool inner = i > 0 && j > 0 && i < cells && j < cells;
      mesh.positions(i * side + j, 0) = width / static_cast<double>(cells) * (static_cast<double>(j) + (inner ? shift(random) : 0));
      mesh.positions(i * side + j, 1) = width / static_cast<double>(cells) * (static_cast<double>(i) + (inner ? shift(random) : 0));
    }
  }
  mesh.simplices.resize(2 * cells * cells, 3);
  for (Index i = 0, t = 0; i < cells; ++i) {
    for (Index j = 0; j < cells; ++j) {
      const auto a = static_cast<std::uint32_t>(i * side + j), up = static_cast<std::uint32_t>(side);
      mesh.simplices.row(t++) << a, a + 1, a + 1 + up;
      mesh.simplices.row(t++) << a, a + 1 + up, a + up;
    }
  }
  return mesh;
}

/** Some handles at different vertices, one of them of two. */
HeldVertices scattered_handles(Index vertices, std::uint32_t count, std::mt19937& random) {
  HeldVertices held;
  held.handle_count = count;
  while (held.vertices.size() <= count) {
    const auto vertex = static_cast<std::uint32_t>(random() % static_cast<std::uint32_t>(vertices));
    if (std::find(held.vertices.begin(), held.vertices.end(), vertex) != held.vertices.end()) continue;
    held.owners.push_back(static_cast<std::uint32_t>(held.vertices.size()) % count);
    held.vertices.push_back(vertex);
  }
  return held;
}

/** How far W is from the minimum's conditions Yᵢⱼ = μᵢⱼ − λᵢ, μ ≥ 0, μᵢⱼ wᵢⱼ = 0 with Y = B W at the free vertices: what the energy
 * could fall by, at first order, if every vertex gave all to the handle that pulls most. */
double stationarity(const Problem& problem, const Matrix& w) {
  const Matrix y = forces(problem, w);
  std::vector<bool> held(w.rows(), false);
  for (const std::uint32_t vertex : problem.held.vertices) held[vertex] = true;
  double sum = 0;
  for (Index i = 0; i < w.rows(); ++i)
    if (!held[i]) sum += y.row(i).dot(w.row(i)) - y.row(i).minCoeff();
  return sum;
}

}  // namespace

TEST_CASE("bounded weights: no more energy than libigl's, and the least that an interior point method finds") {
  for (const std::string& line : oracle_lines("bounded_weights.json")) {
    CAPTURE(line.substr(0, 40));
    const Problem problem = oracle_problem(line);
    const BoundedWeights weights = finished(problem);
    const Matrix w = weights.weights();
    check_feasible(problem, w);
    const double energy = weights.report().energy, least = oracle_numbers(line, "least").at(0);
    CHECK(energy == doctest::Approx(energy_of(problem, w)).epsilon(1e-9));
    // With two handles, libigl's are the least too: equal to our tolerance then, which is 1e-6.
    CHECK(energy <= oracle_numbers(line, "libigl").at(0) * (1 + 1e-7));
    CHECK(std::abs(energy - least) < 1e-6 * least);
    CHECK(weights.report().gap < 2e-6 * energy);
    const std::vector<double> theirs = oracle_numbers(line, "weights");
    // Energy to 1e-6 leaves the softest modes free to about the root of that.
    CHECK((w - Eigen::Map<const Matrix>(theirs.data(), w.rows(), w.cols())).cwiseAbs().maxCoeff() < 1e-3);
  }
}

TEST_CASE("bounded weights fulfil the minimum's conditions (seeds 1 to 8)") {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    DOCTEST_SUBCASE(("seed " + std::to_string(seed)).c_str()) {
      std::mt19937 random(seed);
      const SimplexMesh mesh = square(12 + seed, 1, random);
      const Problem problem = made(mesh, scattered_handles(mesh.positions.rows(), 2 + seed % 5, random));
      const BoundedWeights weights = finished(problem, {.tolerance = 1e-9});
      const Matrix w = weights.weights();
      check_feasible(problem, w);
      CHECK(stationarity(problem, w) < 1e-4 * weights.report().energy);
      CHECK(weights.report().gap < 1e-7 * weights.report().energy);
      CHECK(weights.report().newton_steps > 0);
      CHECK(problem.unbounded.minCoeff() < -1e-3);  // bounds matter
    }
  }
}

TEST_CASE("bounded weights are the unbounded ones where these are within bounds already") {
  // A strip held along both ends: linear in between.
  std::mt19937 random(5);
  SimplexMesh mesh = square(8, 1, random);
  HeldVertices held;
  held.handle_count = 2;
  for (std::uint32_t i = 0; i < 9; ++i) {
    for (const std::uint32_t j : {0u, 8u}) {
      held.vertices.push_back(9 * i + j);
      held.owners.push_back(j / 8);
    }
  }
  Problem problem = made(mesh, held);
  REQUIRE(problem.unbounded.minCoeff() > -1e-12);
  const BoundedWeights weights = created(problem);
  CHECK(weights.done());
  CHECK((weights.weights() - problem.unbounded).cwiseAbs().maxCoeff() < 1e-12);

  SUBCASE("also of one handle, 1 everywhere") {
    std::fill(held.owners.begin(), held.owners.end(), 0u);
    held.handle_count = 1;
    problem = made(mesh, held);
    CHECK(created(problem).done());
    CHECK(created(problem).weights().isOnes());
  }
  SUBCASE("and where handles hold every vertex") {
    held.vertices.clear();
    held.owners.clear();
    for (std::uint32_t v = 0; v < 81; ++v) {
      held.vertices.push_back(v);
      held.owners.push_back(v % 2);
    }
    problem = made(mesh, held);
    const BoundedWeights all = created(problem);
    CHECK(all.done());
    CHECK(all.weights()(3, 1) == 1);
  }
}

TEST_CASE("bounded weights know neither the handles' order nor the unit of length (seeds 1 to 4)") {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    DOCTEST_SUBCASE(("seed " + std::to_string(seed)).c_str()) {
      std::mt19937 random(seed), again(seed);
      const SimplexMesh mesh = square(14, 1, random), large = square(14, 1000, again);
      HeldVertices held = scattered_handles(mesh.positions.rows(), 4, random);
      const BoundedWeightsOptions exact{.tolerance = 1e-9};
      const Matrix w = finished(made(mesh, held), exact).weights();
      CHECK((finished(made(large, held), exact).weights() - w).cwiseAbs().maxCoeff() < 1e-5);
      for (std::uint32_t& owner : held.owners) owner = (owner + 1) % 4;
      const Matrix turned = finished(made(mesh, held), exact).weights();
      for (Index j = 0; j < 4; ++j) CHECK((turned.col((j + 1) % 4) - w.col(j)).cwiseAbs().maxCoeff() < 1e-5);
    }
  }
}

TEST_CASE("bounded weights are feasible and only get better at every step; progress never falls (seed 11)") {
  std::mt19937 random(11);
  const SimplexMesh mesh = square(15, 1, random);
  const Problem problem = made(mesh, scattered_handles(mesh.positions.rows(), 5, random));
  BoundedWeights weights = created(problem);
  double energy = weights.report().energy, gap = weights.report().gap, progress = 0;
  const double first = energy;
  while (!weights.done()) {
    const double now = weights.step();
    CHECK(now >= progress);
    CHECK(now <= 1);
    CHECK(weights.report().energy <= energy);
    CHECK(weights.report().gap <= gap);
    progress = now;
    energy = weights.report().energy;
    gap = weights.report().gap;
    check_feasible(problem, weights.weights());
  }
  CHECK(progress == 1);
  CHECK(energy < 0.9 * first);

  SUBCASE("and stop where the steps are used up") {
    const BoundedWeights few = finished(problem, {.most_steps = 10});
    CHECK(few.report().sweeps == 10);
    check_feasible(problem, few.weights());
    CHECK(few.report().energy <= first);
    CHECK(few.report().gap > 0);
  }
}

TEST_CASE("bounded weights need something held in every part") {
  std::mt19937 random(2);
  Problem problem = made(square(6, 1, random), {{0}, {0}, 1});
  problem.held = {{}, {}, 1};
  problem.unbounded.setConstant(0.5);  // no weights at all
  problem.energy.coeffs() = -1;
  const auto weights = BoundedWeights::create(problem.energy, problem.mass, problem.held, problem.unbounded);
  REQUIRE(!weights);
  CHECK(weights.error().code == HB_ERROR_SYSTEM_SINGULAR);
}
