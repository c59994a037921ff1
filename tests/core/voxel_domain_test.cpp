#include "core/distance/voxel_domain.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace handlebody;

namespace {

Grid unit_grid(int nx, int ny, int nz) {
  return {Vector3::Zero(), 1, {nx, ny, nz}};
}

template <typename Inside>
std::vector<std::uint32_t> voxels_where(const Grid& grid, Inside inside) {
  std::vector<std::uint32_t> voxels;
  for (std::int64_t c = 0; c < grid.size(); ++c) {
    const auto [i, j, k] = grid.cell(c);
    if (inside(i, j, k)) voxels.push_back(static_cast<std::uint32_t>(c));
  }
  return voxels;
}

int count_components(const Grid& grid, const std::vector<std::uint32_t>& voxels) {
  const auto components = face_components(VoxelDomain(grid, voxels));
  return components.empty() ? 0 : *std::max_element(components.begin(), components.end()) + 1;
}

}  // namespace

TEST_CASE("a grid has the resolution along the longest side, two empty voxels all round, and is centered on the box") {
  const auto grid = make_grid({1, 2, 3}, {11, 4, 5.5}, 20);
  REQUIRE(grid);
  CHECK(grid->spacing == doctest::Approx(.5));
  CHECK(grid->dims == std::array<std::int32_t, 3>{24, 8, 9});
  CHECK((grid->origin - Vector3(.25, 1.25, 2.25)).norm() < 1e-12);
  const Vector3 last = grid->center(grid->size() - 1);
  CHECK(((grid->origin + last) / 2 - Vector3(6, 3, 4.25)).norm() < 1e-12);
}

TEST_CASE("linear indices and cells are inverse to each other") {
  const Grid grid = unit_grid(5, 7, 3);
  for (std::int64_t c = 0; c < grid.size(); ++c) {
    const auto [i, j, k] = grid.cell(c);
    CHECK(grid.linear(i, j, k) == c);
    CHECK(grid.center(c) == Vector3(i, j, k));
  }
}

TEST_CASE("a flat box still gets a layer of voxels") {
  const auto grid = make_grid({0, 0, 1}, {1, 1, 1}, 8);
  REQUIRE(grid);
  CHECK(grid->dims == std::array<std::int32_t, 3>{12, 12, 5});
  CHECK(grid->center(grid->linear(0, 0, 2))[2] == doctest::Approx(1));
}

TEST_CASE("boxes that no grid fits are refused") {
  CHECK(make_grid({1, 1, 1}, {1, 1, 1}, 64).error().code == HB_ERROR_MESH_ZERO_EXTENT);
  CHECK(make_grid({1e20, 1, 1}, {1e20, 1 + 1e-3, 1}, 64).error().code == HB_ERROR_MESH_ZERO_EXTENT);
  CHECK(make_grid({0, 0, 0}, {1, 1, 1}, 0).error().code == HB_ERROR_INVALID_OPTION);
  CHECK(make_grid({0, 0, 0}, {1, std::nan(""), 1}, 64).error().code == HB_ERROR_MESH_NOT_FINITE);
  CHECK(make_grid({-1e308, 0, 0}, {1e308, 1, 1}, 64).error().code == HB_ERROR_MESH_NOT_FINITE);
  const auto large = make_grid({0, 0, 0}, {1, 1, 1}, 512);
  CHECK(large.error().code == HB_ERROR_MESH_TOO_LARGE);
  CHECK(large.error().message.find("516 x 516 x 516") != std::string::npos);
  CHECK(make_grid({0, 0, 0}, {1, 1, 1}, std::numeric_limits<int>::max()).error().code == HB_ERROR_MESH_TOO_LARGE);
  CHECK(make_grid({0, 0, 0}, {1, .3, .3}, 512));
}

TEST_CASE("numbers are compact, and -1 outside the domain and outside the grid") {
  const Grid grid = unit_grid(4, 4, 4);
  const VoxelDomain domain(grid, {5, 6, 40});
  CHECK(domain.size() == 3);
  CHECK(domain.number(5) == 0);
  CHECK(domain.number(40) == 2);
  CHECK(domain.number(2, 1, 0) == 1);
  CHECK(domain.number(7) == -1);
  CHECK(domain.number(-1) == -1);
  CHECK(domain.number(64) == -1);
  CHECK(domain.number(-1, 0, 0) == -1);
  CHECK(domain.number(4, 0, 0) == -1);
  const auto neighbors = domain.face_neighbors();
  CHECK(neighbors[0] == 3);
  CHECK(neighbors[1] == 1);
  CHECK(neighbors[6] == 0);
  CHECK(std::all_of(neighbors.begin() + 12, neighbors.end(), [](int n) { return n == 3; }));
}

TEST_CASE("nearest agrees with a search over all voxels, inside and outside the grid (seed 3)") {
  std::mt19937 random(3);
  const Grid grid{Vector3(-1, 2, 0), .25, {12, 9, 7}};
  const VoxelDomain domain(grid, voxels_where(grid, [&](int, int, int) { return random() % 40 == 0; }));
  REQUIRE(domain.size() > 5);
  std::uniform_real_distribution<double> uniform(-3, 5);
  for (int n = 0; n < 500; ++n) {
    const double x = uniform(random), y = uniform(random);
    const Vector3 p(x, y, uniform(random));
    double best = std::numeric_limits<double>::infinity();
    for (Index v = 0; v < domain.size(); ++v) best = std::min(best, (domain.center(v) - p).norm());
    CHECK((domain.center(domain.nearest(p)) - p).norm() == doctest::Approx(best).epsilon(1e-12));
  }
  CHECK(VoxelDomain(grid, {}).nearest({0, 0, 0}) == -1);
}

TEST_CASE("one part needs no bridge") {
  const Grid grid = unit_grid(6, 6, 6);
  auto voxels = voxels_where(grid, [](int i, int j, int k) { return i > 0 && j == 2 && k == 2; });
  const auto before = voxels;
  CHECK(bridge_components(grid, voxels) == 0);
  CHECK(voxels == before);
  std::vector<std::uint32_t> none;
  CHECK(bridge_components(grid, none) == 0);
}

TEST_CASE("a bridge crosses the shortest gap in a straight line") {
  const Grid grid = unit_grid(12, 9, 9);
  // Two slabs, four voxels apart; one has a knob that leaves a gap of two.
  auto voxels = voxels_where(grid, [](int i, int j, int k) { return i < 3 || i > 6 || ((i == 3 || i == 4) && j == 5 && k == 7); });
  const auto before = voxels;
  CHECK(bridge_components(grid, voxels) == 1);
  CHECK(voxels.size() == before.size() + 2);
  CHECK(std::is_sorted(voxels.begin(), voxels.end()));
  const VoxelDomain domain(grid, voxels);
  CHECK(domain.number(5, 5, 7) >= 0);
  CHECK(domain.number(6, 5, 7) >= 0);
  CHECK(count_components(grid, voxels) == 1);
}

TEST_CASE("a diagonal contact is bridged by one voxel") {
  const Grid grid = unit_grid(4, 4, 3);
  auto voxels = voxels_where(grid, [](int i, int j, int k) { return k == 1 && ((i == 1 && j == 1) || (i == 2 && j == 2)); });
  CHECK(bridge_components(grid, voxels) == 1);
  CHECK(voxels.size() == 3);
}

TEST_CASE("scattered voxels become one part with one bridge fewer than parts (seed 4)") {
  std::mt19937 random(4);
  for (int round = 0; round < 5; ++round) {
    const Grid grid = unit_grid(17, 13, 11);
    auto voxels = voxels_where(grid, [&](int, int, int) { return random() % 60 == 0; });
    auto again = voxels;
    const int parts = count_components(grid, voxels);
    REQUIRE(parts > 10);
    CHECK(bridge_components(grid, voxels) == parts - 1);
    CHECK(count_components(grid, voxels) == 1);
    bridge_components(grid, again);
    CHECK(again == voxels);
  }
}
