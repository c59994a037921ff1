#include "core/distance/surface_crossings.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "core/distance/filled_shell.hpp"
#include "core/mesh/consistent_orientation.hpp"
#include "core/mesh/triangle_tree.hpp"
#include "made_domains.hpp"
#include "made_meshes.hpp"

using namespace handlebody;

namespace {

SurfaceCrossings crossed(const Grid& grid, int axis, const Points& positions, const Triangles& triangles) {
  SurfaceCrossings crossings(grid, axis);
  for (Index t = 0; t < triangles.rows(); ++t) CHECK(crossings.add(positions, triangles.row(t).data()));
  crossings.finish();
  return crossings;
}

/** A closed surface that crosses itself: a box, crumpled. */
test::MadeMesh crumpled(unsigned seed, double much) {
  test::MadeMesh mesh = test::made_box({2, 2, 2}, {5, 4, 3});
  mesh.positions.array() -= 1;
  std::mt19937 random(seed);
  for (Index v = 0; v < mesh.positions.rows(); ++v) {
    mesh.positions.row(v) = .7 * mesh.positions.row(v) + much * test::random_direction(random).transpose();
  }
  return mesh;
}

}  // namespace

TEST_CASE("a closed surface winds about the voxels that its crossings enclose, and every line leaves it (seeds 1 to 8)") {
  const Grid grid = test::cube_grid(24);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    const auto [positions, triangles] = crumpled(seed, .05 * seed);
    const TriangleTree tree(positions, triangles);
    for (int axis = 0; axis < 3; ++axis) {
      const SurfaceCrossings crossings = crossed(grid, axis, positions, triangles);
      for (std::size_t line = 0; line < crossings.lines(); ++line) {
        int winding = 0;
        const auto* next = crossings.begin(line);
        for (int i = 0; i < grid.dims[axis]; ++i) {
          for (; next != crossings.end(line) && next->at < i; ++next) winding += next->sign;
          const double exact = tree.winding_number(grid.center(crossings.first_voxel(line) + i * crossings.stride()));
          CHECK(std::abs(winding - exact) < .05);
        }
        for (; next != crossings.end(line); ++next) winding += next->sign;
        CHECK(winding == 0);
      }
      if (axis > 0) continue;
      for (const std::uint32_t v : enclosed_voxels(grid, crossings)) CHECK(std::abs(tree.winding_number(grid.center(v))) > .5);
    }
  }
}

TEST_CASE("lines through vertices and along edges and faces cross a closed surface in pairs") {
  // Corners, edges and faces of this box lie on lines of voxel centers.
  const Grid grid{{0, 0, 0}, 1, {9, 9, 9}};
  test::MadeMesh mesh = test::made_box({4, 4, 4}, {4, 2, 4});
  mesh.positions.array() += 2;
  for (int axis = 0; axis < 3; ++axis) {
    const SurfaceCrossings crossings = crossed(grid, axis, mesh.positions, mesh.triangles);
    int met = 0;
    for (std::size_t line = 0; line < crossings.lines(); ++line) {
      int sum = 0;
      for (const auto* c = crossings.begin(line); c != crossings.end(line); ++c) sum += c->sign;
      CHECK(sum == 0);
      met += crossings.begin(line) != crossings.end(line);
    }
    CHECK(met == 16);  // of the 5 × 5 lines that touch it, those along two of its sides count as beside it
  }
}

TEST_CASE("triangles are turned to agree, and closed parts face outward (seed 4)") {
  const test::MadeMesh box = test::made_box({2, 1, 1}, {6, 3, 3});
  Triangles triangles = box.triangles;
  CHECK(orient_consistently(box.positions, triangles).closed);
  CHECK(triangles == box.triangles);
  std::mt19937 random(4);
  for (Index t = 0; t < triangles.rows(); ++t) {
    if (random() % 2) std::swap(triangles(t, 1), triangles(t, 2));
  }
  const Orientation repaired = orient_consistently(box.positions, triangles);
  CHECK(repaired.closed);
  CHECK(repaired.open_edges == 0);
  CHECK(repaired.turned > 30);
  CHECK(enclosed_volume(box.positions, triangles) == doctest::Approx(2));

  Triangles open = box.triangles.bottomRows(box.triangles.rows() - 1);
  CHECK(orient_consistently(box.positions, open).open_edges == 3);
  CHECK(open == box.triangles.bottomRows(box.triangles.rows() - 1));
}

TEST_CASE("a shell of voxels with small holes is filled, one with a missing side is not") {
  const Grid grid{{0, 0, 0}, 1, {20, 20, 20}};
  const auto shell = [&](int hole) {
    std::vector<std::uint32_t> voxels;
    for (std::int64_t c = 0; c < grid.size(); ++c) {
      const auto [i, j, k] = grid.cell(c);
      const bool within = std::min({i, j, k}) >= 3 && std::max({i, j, k}) <= 16;
      const bool deep = std::min({i, j, k}) > 3 && std::max({i, j, k}) < 16;
      const bool open = k == 16 && std::abs(i - 9) <= hole && std::abs(j - 9) <= hole;
      if (within && !deep && !open) voxels.push_back(static_cast<std::uint32_t>(c));
    }
    return voxels;
  };
  CHECK(filled_shell(grid, shell(-1)).size() == 14 * 14 * 14);
  CHECK(filled_shell(grid, shell(1)).size() == 14 * 14 * 14);
  CHECK(filled_shell(grid, shell(9)).empty());
  CHECK(filled_shell(grid, {}).empty());
}
