// Who holds what, and where parts without a handle go.
#include "core/skinning/held_vertices.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <utility>

using namespace handlebody;

namespace {

/** `parts` separate triangles in a row, one unit apart, in the plane. */
SimplexMesh triangles_in_a_row(Index parts) {
  SimplexMesh mesh{Matrix(3 * parts, 2), Simplices(parts, 3)};
  for (Index p = 0; p < parts; ++p) {
    const auto x = static_cast<double>(p);
    mesh.positions.middleRows(3 * p, 3) << x, 0, x + 0.4, 0, x, 0.5;
    for (Index k = 0; k < 3; ++k) mesh.simplices(p, k) = static_cast<std::uint32_t>(3 * p + k);
  }
  return mesh;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> pairs(const HeldVertices& held) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> result;
  for (std::size_t k = 0; k < held.vertices.size(); ++k) result.emplace(held.vertices[k], held.owners[k]);
  CHECK(result.size() == held.vertices.size());
  return result;
}

hb_status code_of(HeldVertices held, const SimplexMesh& mesh, std::int64_t culprit = -1) {
  const auto done = complete(held, mesh, connected_parts(mesh));
  if (done) return HB_OK;
  if (culprit >= 0) CHECK(done.error().index == culprit);
  return done.error().code;
}

}  // namespace

TEST_CASE("a part without a handle goes with the nearest one, by its first vertex") {
  const SimplexMesh mesh = triangles_in_a_row(4);
  HeldVertices held{{10, 1, 1}, {1, 0, 0}, 2};  // handle 0 holds the first part, twice said, handle 1 the last
  const auto islands = complete(held, mesh, connected_parts(mesh));
  REQUIRE(islands);
  REQUIRE(islands->size() == 2);
  CHECK(pairs(held) == std::set<std::pair<std::uint32_t, std::uint32_t>>{{1, 0}, {10, 1}, {3, 0}, {6, 1}});
  for (const Island& island : *islands) {
    CHECK(island.count == 3);
    CHECK(island.handle == (island.first == 3 ? 0 : 1));
  }
}

TEST_CASE("where every part has a handle there are no islands, and held vertices stay as they were") {
  const SimplexMesh mesh = triangles_in_a_row(2);
  HeldVertices held{{4, 0}, {0, 1}, 2};
  const auto islands = complete(held, mesh, connected_parts(mesh));
  REQUIRE(islands);
  CHECK(islands->empty());
  CHECK(pairs(held) == std::set<std::pair<std::uint32_t, std::uint32_t>>{{4, 0}, {0, 1}});
}

TEST_CASE("handles that hold nothing, what is not there, or what another holds are refused by number") {
  const SimplexMesh mesh = triangles_in_a_row(2);
  CHECK(code_of({{}, {}, 0}, mesh) == HB_ERROR_HANDLES_MISSING);
  CHECK(code_of({{0}, {0}, 2}, mesh, 1) == HB_ERROR_HANDLE_OUT_OF_RANGE);        // handle 1 holds nothing
  CHECK(code_of({{0, 6}, {0, 1}, 2}, mesh, 1) == HB_ERROR_HANDLE_OUT_OF_RANGE);  // there are 6 vertices
  CHECK(code_of({{0, 0}, {0, 1}, 2}, mesh, 1) == HB_ERROR_HANDLE_CONFLICT);
  CHECK(code_of({{0}, {5}, 1}, mesh) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of({{5}, {0}, 1}, mesh) == HB_OK);
}
