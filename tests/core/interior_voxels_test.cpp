// Which voxels are inside, against shapes whose inside is known. What a whole bake makes of them is tested in bake_test.cpp.
#include "core/irbf/interior_voxels.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "made_meshes.hpp"

using namespace handlebody;
using test::made_box;
using test::MadeMesh;

namespace {

/** Steps to the end; progress grows. Returns the code of the failure, or HB_OK. */
hb_status finish(InteriorVoxels& interior) {
  double progress = 0;
  while (progress < 1) {
    const auto step = interior.step();
    if (!step) return step.error().code;
    CHECK(*step >= progress);
    progress = *step;
  }
  return HB_OK;
}

Grid grid_over(const Points& positions, int resolution) {
  return *make_grid(positions.colwise().minCoeff(), positions.colwise().maxCoeff(), resolution);
}

InteriorOptions surface_options(int resolution) {
  InteriorOptions options;
  options.resolution = resolution, options.centers = 1;
  return options;
}

/** Two meshes as one. */
MadeMesh both(const MadeMesh& a, const MadeMesh& b) {
  MadeMesh mesh;
  mesh.positions.resize(a.positions.rows() + b.positions.rows(), 3);
  mesh.positions << a.positions, b.positions;
  mesh.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
  mesh.triangles << a.triangles, (b.triangles.array() + static_cast<std::uint32_t>(a.positions.rows())).matrix();
  return mesh;
}

}  // namespace

TEST_CASE("the voxels inside a box are those whose centers are, for triangles that agree, are mixed or inside out") {
  for (const int turned : {0, 3, 1}) {  // none, each third, every one
    MadeMesh box = made_box({2, 1.1, 0.7}, {4, 3, 2});
    for (Index t = 0; turned && t < box.triangles.rows(); t += turned) std::swap(box.triangles(t, 0), box.triangles(t, 1));
    const Grid grid = grid_over(box.positions, 30);
    InteriorVoxels interior(box.positions, box.triangles, grid, surface_options(30));
    REQUIRE(finish(interior) == HB_OK);
    std::vector<std::uint32_t> expected;
    for (std::int64_t v = 0; v < grid.size(); ++v) {
      const Vector3 center = grid.center(v);
      if ((center.array() > 0).all() && center.x() < 2 && center.y() < 1.1 && center.z() < 0.7)
        expected.push_back(static_cast<std::uint32_t>(v));
    }
    CHECK(interior.domain().voxels() == expected);
    CHECK(!interior.sheet());
    CHECK(std::count(interior.on_bridge().begin(), interior.on_bridge().end(), 1) == 0);
    CHECK(interior.tree().distance({1, 0.5, 0.3}) == doctest::Approx(0.3));
    REQUIRE(interior.warnings().size() == (turned ? 1 : 0));
    if (turned) CHECK(interior.warnings()[0].code == (turned == 1 ? HB_WARNING_MESH_INSIDE_OUT : HB_WARNING_ORIENTATION_MIXED));
  }
}

TEST_CASE("parts that do not touch are joined by a bridge, whose voxels are marked and lie between them") {
  MadeMesh right = made_box({1, 1, 1}, {1, 1, 1});
  right.positions.col(0).array() += 2;
  MadeMesh mesh = both(made_box({1, 1, 1}, {1, 1, 1}), right);
  const Grid grid = grid_over(mesh.positions, 30);
  InteriorVoxels interior(mesh.positions, mesh.triangles, grid, surface_options(30));
  REQUIRE(finish(interior) == HB_OK);
  Index bridge = 0;
  for (Index v = 0; v < interior.domain().size(); ++v) {
    const double x = interior.domain().center(v).x();
    const bool between = x > 1 && x < 2;
    CHECK(bool(interior.on_bridge()[v]) == between);
    bridge += between;
  }
  CHECK(bridge == 10);  // one spacing is a tenth
}

TEST_CASE("an open sheet has no inside: it fails, or is its own voxels where that is allowed") {
  MadeMesh sheet;
  sheet.positions.resize(4, 3);
  sheet.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  sheet.triangles.resize(2, 3);
  sheet.triangles << 0, 1, 2, 0, 2, 3;
  const Grid grid = grid_over(sheet.positions, 16);
  InteriorVoxels refused(sheet.positions, sheet.triangles, grid, surface_options(16));
  CHECK(finish(refused) == HB_ERROR_MESH_NO_INTERIOR);
  InteriorOptions options = surface_options(16);
  options.allow_sheet = true;
  InteriorVoxels allowed(sheet.positions, sheet.triangles, grid, options);
  REQUIRE(finish(allowed) == HB_OK);
  CHECK(allowed.sheet());
  for (Index v = 0; v < allowed.domain().size(); ++v) CHECK(std::abs(allowed.domain().center(v).z()) <= grid.spacing);
  REQUIRE(allowed.warnings().size() == 1);
  CHECK(allowed.warnings()[0].code == HB_WARNING_SURFACE_OPEN);
  CHECK(allowed.warnings()[0].count == 4);  // edges without a triangle on the other side
}

TEST_CASE("voxels that are given are taken as they are; none at all are refused, as are codes that would not fit") {
  MadeMesh box = made_box({1, 1, 1}, {1, 1, 1});
  const Grid grid = grid_over(box.positions, 10);
  InteriorOptions options = surface_options(10);
  options.source = InteriorSource::voxels;
  for (int i = 3; i < 7; ++i) options.voxels.push_back(static_cast<std::uint32_t>(grid.linear(i, 5, 5)));
  InteriorVoxels interior(box.positions, box.triangles, grid, options);
  REQUIRE(finish(interior) == HB_OK);
  CHECK(interior.domain().voxels() == options.voxels);

  options.centers = 1'000'000'000;
  InteriorVoxels too_large(box.positions, box.triangles, grid, options);
  CHECK(finish(too_large) == HB_ERROR_OUT_OF_MEMORY);
  options.voxels.clear();
  InteriorVoxels empty(box.positions, box.triangles, grid, options);
  CHECK(finish(empty) == HB_ERROR_MESH_NO_INTERIOR);
}
