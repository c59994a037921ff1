#include "core/irbf/counted_mesh.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "made_meshes.hpp"

using namespace handlebody;

namespace {

/** A box with a split vertex (a copy of vertex 2), a vertex of no triangle and one that only a flat triangle uses. */
struct Cluttered {
  test::MadeMesh box = test::made_box({1, 2, 3}, {2, 2, 2});
  Index own = box.positions.rows();
  Points positions;
  Triangles triangles;

  Cluttered() {
    positions.resize(own + 3, 3);
    positions << box.positions, box.positions.row(2), 7, 8, 9, 40, 0, 0;
    triangles.resize(box.triangles.rows() + 2, 3);
    triangles << box.triangles, 0, 0, static_cast<std::uint32_t>(own + 2), box.triangles.row(4);
    for (Index t = 0; t < 6; ++t)
      for (int c = 0; c < 3; ++c)
        if (triangles(t, c) == 2) triangles(t, c) = static_cast<std::uint32_t>(own);
  }
};

}  // namespace

TEST_CASE("what counts of a mesh is what it would be without the rest, and the rest is told") {
  const Cluttered given;
  const auto counted = count_mesh(given.positions, given.triangles, {});
  REQUIRE(counted);
  CHECK(counted->positions == given.box.positions);
  CHECK(counted->triangles == given.box.triangles);
  CHECK(counted->with_area == given.box.triangles.rows());
  CHECK(std::ssize(counted->stored) == given.own + 1);  // the split vertex has two numbers
  for (std::uint32_t place = 0; place < given.own; ++place) CHECK(counted->stored_number(place) == place);
  REQUIRE(counted->warnings.size() == 3);
  CHECK(counted->warnings[0].code == HB_WARNING_VERTICES_UNUSED);
  CHECK(counted->warnings[0].count == 2);
  CHECK(counted->warnings[0].vertex == given.own + 2);
  CHECK(*counted->warnings[0].place == Vector3(40, 0, 0));
  CHECK(counted->warnings[1].code == HB_WARNING_TRIANGLES_FLAT);
  CHECK(counted->warnings[1].count == 1);
  CHECK(counted->warnings[2].code == HB_WARNING_TRIANGLES_DOUBLED);
  CHECK(counted->warnings[2].count == 1);
}

TEST_CASE("without triangles all vertices count; a list of those that do is followed") {
  const test::MadeMesh box = test::made_box({1, 1, 1}, {1, 1, 1});
  const auto cloud = count_mesh(box.positions, Triangles(0, 3), {});
  REQUIRE(cloud);
  CHECK(cloud->positions == box.positions);
  CHECK(cloud->warnings.empty());
  const auto chosen = count_mesh(box.positions, Triangles(0, 3), {1, 0, 1, 1, 0, 1, 1, 1});
  REQUIRE(chosen);
  CHECK(chosen->stored == Indices{0, 2, 3, 5, 6, 7});
  CHECK(chosen->warnings.at(0).count == 2);
}

TEST_CASE("too little left, no extent, and vertices that no float holds are refused") {
  const test::MadeMesh box = test::made_box({1, 1, 1}, {1, 1, 1});
  const auto code = [](const Result<CountedMesh>& counted) { return counted ? HB_OK : counted.error().code; };
  CHECK(code(count_mesh(box.positions, box.triangles.topRows(1), {})) == HB_ERROR_MESH_TOO_FEW_VERTICES);
  CHECK(code(count_mesh(box.positions, Triangles(0, 3), std::vector<std::uint8_t>(8))) == HB_ERROR_MESH_TOO_FEW_VERTICES);
  CHECK(code(count_mesh(Points::Constant(8, 3, 5), box.triangles, {})) == HB_ERROR_MESH_ZERO_EXTENT);
  CHECK(code(count_mesh(1e200 * box.positions, box.triangles, {})) == HB_ERROR_MESH_NOT_FINITE);
  Points positions(9, 3);
  positions << box.positions, 0, 0, 1e39;
  const auto far = count_mesh(positions, box.triangles, {});
  REQUIRE_FALSE(far);
  CHECK(far.error().code == HB_ERROR_MESH_NOT_FINITE);
  CHECK(far.error().index == 8);
  positions(8, 2) = 3e38;
  CHECK(count_mesh(positions, box.triangles, {}));
}
