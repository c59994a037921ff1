#include "core/distance/merged_limbs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "made_domains.hpp"
#include "made_meshes.hpp"

using namespace handlebody;

namespace {

/** The crossed links of all axes of boxes [low, high], whose voxels are those inside any of them. */
std::vector<CrossedLink> links_of_boxes(const VoxelDomain& domain, const std::vector<std::pair<Vector3, Vector3>>& boxes,
                                        bool closed) {
  std::vector<CrossedLink> links;
  for (int axis = 0; axis < 3; ++axis) {
    SurfaceCrossings crossings(domain.grid(), axis);
    for (const auto& [low, high] : boxes) {
      test::MadeMesh box = test::made_box(high - low, {1, 1, 1});
      box.positions.rowwise() += low.transpose();
      for (Index t = 0; t < box.triangles.rows(); ++t) REQUIRE(crossings.add(box.positions, box.triangles.row(t).data()));
    }
    crossings.finish();
    find_crossed_links(domain, crossings, closed, links);
  }
  return links;
}

VoxelDomain domain_of_boxes(const Grid& grid, const std::vector<std::pair<Vector3, Vector3>>& boxes) {
  return test::domain_where(grid, [&](const Vector3& p) {
    for (const auto& [low, high] : boxes)
      if ((p.array() > low.array()).all() && (p.array() < high.array()).all()) return true;
    return false;
  });
}

/** A comb's gap: voxels 0 ≤ i < 2·width that are joined below `bottom` only, and the links across between width − 1 and width. */
struct Slot {
  VoxelDomain domain;
  std::vector<CrossedLink> links;
};

Slot slot(int width, int height, int depth, int bottom) {
  const Grid grid{{0, 0, 0}, 1, {2 * width, height, depth}};
  Slot made{test::domain_where(grid, [](const Vector3&) { return true; }), {}};
  for (int k = 0; k < depth; ++k)
    for (int j = bottom; j < height; ++j)
      made.links.push_back({made.domain.number(width - 1, j, k), made.domain.number(width, j, k), 0.5});
  return made;
}

}  // namespace

TEST_CASE("voxels on both sides of a gap between two boxes are a crossed link each, with the gap's width") {
  const Grid grid{{0, 0, 0}, 1, {12, 8, 7}};
  const std::vector<std::pair<Vector3, Vector3>> boxes{{{.5, .5, .5}, {5.3, 6.5, 5.5}}, {{5.7, 2.5, 1.5}, {10.5, 6.5, 4.5}}};
  const VoxelDomain domain = domain_of_boxes(grid, boxes);
  for (const bool closed : {true, false}) {
    const auto links = links_of_boxes(domain, boxes, closed);
    CHECK(links.size() == 4 * 3);  // the faces that look at each other
    for (const CrossedLink& link : links) {
      const Vector3 from = domain.center(link.from), to = domain.center(link.to);
      CHECK(from.x() == 5);
      CHECK((to - from - Vector3::UnitX()).norm() < 1e-12);
      CHECK(link.gap == doctest::Approx(.4));
    }
  }
}

TEST_CASE("boxes that cross have nothing between them where they are known to be closed") {
  const Grid grid{{0, 0, 0}, 1, {12, 8, 7}};
  const std::vector<std::pair<Vector3, Vector3>> boxes{{{.5, .5, .5}, {5.7, 6.5, 5.5}}, {{5.3, 2.5, 1.5}, {10.5, 6.5, 4.5}}};
  const VoxelDomain domain = domain_of_boxes(grid, boxes);
  CHECK(links_of_boxes(domain, boxes, true).empty());
  CHECK(links_of_boxes(domain, boxes, false).size() == 4 * 3);
}

TEST_CASE("a gap counts where the way round is longer than eight voxels, a crease does not") {
  // From depth m of the slot the way round is m down, one across, m up.
  for (int height = 1; height <= 12; ++height) {
    CAPTURE(height);
    const auto [domain, links] = slot(6, 2 + height, 3, 2);
    const MergedLimbs merged = find_merged_limbs(domain, links);
    CHECK(merged.links == 3 * std::max(0, height - 3));
    if (merged.links > 0) CHECK(merged.gap == .5);
  }
  const auto [domain, links] = slot(6, 10, 3, 0);  // no way round at all
  CHECK(find_merged_limbs(domain, links).links == 30);
}

TEST_CASE("the largest cluster is named by its middle, and by its narrowest gap but for a tenth") {
  // Two gaps in one row of limbs: 3 × 5 links, and 3 × 9.
  const Grid grid{{10, 20, 30}, .5, {9, 9, 3}};
  const VoxelDomain domain = test::domain_where(grid, [](const Vector3&) { return true; });
  std::vector<CrossedLink> links;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 9; ++j) {
      if (j < 5) links.push_back({domain.number(2, j, k), domain.number(3, j, k), .01});
      // From end to end, so that there is no way round. Gaps 1 to 27.
      links.push_back({domain.number(5, j, k), domain.number(6, j, k), 1. + 9 * k + (j * 4) % 9});
    }
  const MergedLimbs merged = find_merged_limbs(domain, links);
  CHECK(merged.links == 27 + 6);  // the other gap's links have a way round, but for the six farthest from its end
  CHECK((merged.place - (grid.origin + .5 * Vector3(5.5, 4, 1))).norm() < 1e-12);
  CHECK(merged.gap == 3);  // the third of 27
}

TEST_CASE("of very many links a sample is looked at, and stands for all") {
  const auto [domain, links] = slot(2, 100, 100, 0);
  const MergedLimbs merged = find_merged_limbs(domain, links);
  CHECK(merged.links >= 10'000);
  CHECK(merged.links < 10'003);
  CHECK((merged.place - Vector3(1.5, 49.5, 49.5)).norm() < 3);
}

TEST_CASE("no links, no merged limbs") {
  const VoxelDomain domain = test::domain_where(test::cube_grid(4), [](const Vector3&) { return true; });
  const MergedLimbs merged = find_merged_limbs(domain, {});
  CHECK(merged.links == 0);
  CHECK(merged.gap == 0);
  CHECK(merged.place == Vector3::Zero());
}
