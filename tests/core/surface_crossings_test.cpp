#include "core/distance/surface_crossings.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

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
      for (const std::uint32_t v : enclosed_voxels(grid, crossings).voxels)
        CHECK(std::abs(tree.winding_number(grid.center(v))) > .5);
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
