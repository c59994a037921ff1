#include "core/mesh/triangle_sides.hpp"

#include <doctest/doctest.h>

#include <map>
#include <random>
#include <vector>

#include "made_meshes.hpp"

using namespace handlebody;

TEST_CASE("every side comes once, with those of its own edge, its ends and the corner across (seed 8)") {
  std::mt19937 random(8);
  const test::MadeMesh box = test::made_box({2, 1, 3}, {3, 2, 4});
  Triangles triangles = box.triangles;
  for (Index t = 0; t < triangles.rows(); ++t)
    if (random() % 2) std::swap(triangles(t, 1), triangles(t, 2));
  triangles.row(7) << 3, 3, 5;  // has no sides
  const TriangleSides sides(triangles, box.positions.rows());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> expected;
  for (std::uint32_t side = 0; side < triangles.size(); ++side) {
    if (side / 3 == 7) continue;
    const std::uint32_t from = triangles(side / 3, side % 3), to = triangles(side / 3, (side + 1) % 3);
    expected[{std::min(from, to), std::max(from, to)}].push_back(side);
    CHECK(sides.ends(side) == std::pair(std::min(from, to), std::max(from, to)));
    CHECK(sides.direction(side) == (from < to ? 1 : -1));
    CHECK(sides.opposite(side) == triangles(side / 3, (side + 2) % 3));
  }
  auto next = expected.begin();
  sides.for_each_edge([&](const std::uint32_t* first, const std::uint32_t* last) {
    REQUIRE(next != expected.end());
    CHECK(std::vector(first, last) == next->second);
    ++next;
  });
  CHECK(next == expected.end());
}
