#include "core/skinning/held_vertices.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

using namespace handlebody;

namespace {

/** `count` triangles in the plane without a vertex in common, each near a place of its own. */
SimplexMesh separate_triangles(const std::vector<Eigen::RowVector2d>& places) {
  SimplexMesh mesh{Matrix(3 * std::ssize(places), 2), Simplices(std::ssize(places), 3)};
  for (Index t = 0; t < mesh.simplices.rows(); ++t) {
    const auto first = static_cast<std::uint32_t>(3 * t);
    mesh.positions.row(3 * t) = places[t];
    mesh.positions.row(3 * t + 1) = places[t] + Eigen::RowVector2d(1, 0);
    mesh.positions.row(3 * t + 2) = places[t] + Eigen::RowVector2d(0, 1);
    mesh.simplices.row(t) << first, first + 1, first + 2;
  }
  return mesh;
}

Error completion_error(HeldVertices held) {
  const SimplexMesh mesh = separate_triangles({{0, 0}, {5, 0}});
  const auto islands = complete(held, mesh, connected_parts(mesh));
  REQUIRE_FALSE(islands);
  CHECK(!islands.error().remedy.empty());
  return islands.error();
}

}  // namespace

TEST_CASE("where every part is held there are no islands, repetitions are dropped, and vertices come in order with their handles") {
  const SimplexMesh mesh = separate_triangles({{0, 0}, {5, 0}});
  HeldVertices held{{4, 2, 4, 0, 2}, {1, 0, 1, 0, 0}, 2};
  const auto islands = complete(held, mesh, connected_parts(mesh));
  REQUIRE(islands);
  CHECK(islands->empty());
  CHECK(held.vertices == Indices{0, 2, 4});
  CHECK(held.owners == Indices{0, 0, 1});
  CHECK(held.handle_count == 2);
}

TEST_CASE("an island goes with the handle that has a vertex nearest to any of its own, not of another island's") {
  // Handles 0 at x = 0 and 1 at x = 20. The islands at 6 and 14 are nearest to these; that at 11 is nearest to an island.
  const SimplexMesh mesh = separate_triangles({{0, 0}, {6, 0}, {20, 0}, {14, 0}, {11, 0}});
  HeldVertices held{{0, 6}, {0, 1}, 2};
  const auto islands = complete(held, mesh, connected_parts(mesh));
  REQUIRE(islands);
  REQUIRE(islands->size() == 3);
  const std::uint32_t expected[3][3] = {{3, 3, 0}, {9, 3, 1}, {12, 3, 1}};  // first vertex, count, handle
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK((*islands)[k].first == expected[k][0]);
    CHECK((*islands)[k].count == expected[k][1]);
    CHECK((*islands)[k].handle == expected[k][2]);
  }
  CHECK(held.vertices == Indices{0, 6, 3, 9, 12});  // the first vertex of each is held too
  CHECK(held.owners == Indices{0, 1, 0, 1, 1});
}

TEST_CASE("islands by comparing all vertices with all that are held, single vertices too (seeds 191 to 196)") {
  for (unsigned seed = 191; seed <= 196; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 40);
    std::vector<Eigen::RowVector2d> places;
    for (int k = 0; k < 12; ++k) {
      const double x = uniform(random);
      places.emplace_back(x, uniform(random));
    }
    SimplexMesh mesh = separate_triangles(places);
    mesh.simplices.conservativeResize(10, 3);  // the last six vertices are parts of their own
    const Indices parts = connected_parts(mesh);
    const HeldVertices given{{1, 10, 16}, {2, 0, 1}, 3};
    HeldVertices held = given;
    const auto islands = complete(held, mesh, parts);
    REQUIRE(islands);
    CHECK(islands->size() == 7 + 6);
    for (const Island& island : *islands) {
      std::uint32_t count = 0, handle = no_index;
      double least = HUGE_VAL;
      for (std::size_t v = 0; v < parts.size(); ++v) {
        if (parts[v] != parts[island.first]) continue;
        CHECK(v >= island.first);
        ++count;
        for (std::size_t k = 0; k < 3; ++k) {
          const double apart = (mesh.positions.row(static_cast<Index>(v)) - mesh.positions.row(given.vertices[k])).norm();
          if (apart < least) least = apart, handle = given.owners[k];
        }
      }
      CHECK(island.count == count);
      CHECK(island.handle == handle);
    }
  }
}

TEST_CASE("a vertex in no simplex whose distance is no number goes with the first handle") {
  SimplexMesh mesh = separate_triangles({{0, 0}, {5, 0}});
  mesh.positions.conservativeResize(8, 2);
  mesh.positions.bottomRows(2) << std::nan(""), 0, 1e200, 0;
  HeldVertices held{{3, 0}, {0, 1}, 2};
  const auto islands = complete(held, mesh, connected_parts(mesh));
  REQUIRE(islands);
  REQUIRE(islands->size() == 2);
  for (const Island& island : *islands) CHECK(island.handle < 2);
}

TEST_CASE("handles that cannot be are named") {
  CHECK(completion_error({{}, {}, 0}).code == HB_ERROR_HANDLES_MISSING);
  const auto check_named = [](const HeldVertices& held, hb_status code, std::int64_t handle) {
    const Error error = completion_error(held);
    CAPTURE(error.message);
    CHECK(error.code == code);
    CHECK(error.culprit == HB_CULPRIT_HANDLE);
    CHECK(error.index == handle);
  };
  check_named({{0, 6}, {0, 1}, 2}, HB_ERROR_HANDLE_OUT_OF_RANGE, 1);
  check_named({{0, 3}, {0, 2}, 3}, HB_ERROR_HANDLE_OUT_OF_RANGE, 1);  // holds nothing
  check_named({{0, 3, 0}, {0, 1, 1}, 2}, HB_ERROR_HANDLE_CONFLICT, 1);
  CHECK(completion_error({{0, 3}, {0, 2}, 2}).code == HB_ERROR_INVALID_OPTION);
}
