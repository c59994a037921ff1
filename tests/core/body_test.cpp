#include "core/irbf/body.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>

#include "made_body.hpp"

using namespace handlebody;

namespace {

void check_body_error(const Result<Done>& checked, hb_status code, hb_culprit culprit = HB_CULPRIT_NONE, std::int64_t index = -1) {
  REQUIRE_FALSE(checked);
  CAPTURE(checked.error().message);
  CHECK(checked.error().code == code);
  CHECK(checked.error().culprit == culprit);
  CHECK(checked.error().index == index);
  CHECK(!checked.error().remedy.empty());
}

}  // namespace

TEST_CASE("solver space is the model about its box's middle, with a diagonal of 1") {
  Points positions(4, 3);
  positions << 1, 2, 3, 3, 2, 3, 1, 5, 3, 2, 3, 9;  // a box of 2 × 3 × 6, whose diagonal is 7
  const Normalization found = normalize(positions);
  CHECK(found.diagonal == doctest::Approx(7));
  CHECK((found.center - Vector3(2, 3.5, 6)).norm() < 1e-14);
  CHECK((found.to_solver({3, 5, 9}) - Vector3(1, 1.5, 3) / 7).norm() < 1e-14);
  CHECK((found.to_model(found.to_solver({-4, 8, 1.5})) - Vector3(-4, 8, 1.5)).norm() < 1e-13);

  Body body;
  body.positions = positions;
  body.normalization = found;
  body.centers = {3, 1};
  const Points solver = body.solver_positions();
  CHECK((solver.colwise().maxCoeff() + solver.colwise().minCoeff()).norm() < 1e-14);
  CHECK((solver.colwise().maxCoeff() - solver.colwise().minCoeff()).norm() == doctest::Approx(1));
  for (Index v = 0; v < 4; ++v) CHECK((found.to_solver(positions.row(v).transpose()) - solver.row(v).transpose()).norm() < 1e-14);
  CHECK((body.center_position(0) - solver.row(3).transpose()).norm() < 1e-14);
  CHECK((body.center_position(1) - solver.row(1).transpose()).norm() < 1e-14);
}

TEST_CASE("meshes of four million vertices and eight million triangles are taken, and not one more") {
  CHECK(check_mesh_size(4'000'000, 8'000'000));
  check_body_error(check_mesh_size(4'000'001, 1), HB_ERROR_MESH_TOO_LARGE);
  check_body_error(check_mesh_size(4, 8'000'001), HB_ERROR_MESH_TOO_LARGE);
  CHECK(check_mesh_size(4'000'001, 1).error().message.find("4000001") != std::string::npos);
}

TEST_CASE("meshes that cannot be baked or deformed are named") {
  const test::MadeMesh good = test::made_box({1, 1, 1}, {1, 1, 1});
  CHECK(check_mesh(good.positions, good.triangles));
  const Triangles none(0, 3);
  check_body_error(check_mesh(good.positions.topRows(3), none, true), HB_ERROR_MESH_TOO_FEW_VERTICES);
  CHECK(check_mesh(good.positions.topRows(1), none).error().message.find("1 vertex;") != std::string::npos);
  check_body_error(check_mesh(good.positions, none), HB_ERROR_MESH_NO_TRIANGLES);
  CHECK(check_mesh(good.positions, none, true));  // a cloud

  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL}) {
    Points positions = good.positions;
    positions(5, 2) = bad;
    check_body_error(check_mesh(positions, good.triangles), HB_ERROR_MESH_NOT_FINITE, HB_CULPRIT_VERTEX, 5);
  }
  Triangles triangles = good.triangles;
  triangles(7, 1) = 8;
  check_body_error(check_mesh(good.positions, triangles), HB_ERROR_MESH_INDEX_OUT_OF_RANGE, HB_CULPRIT_TRIANGLE, 7);
  check_body_error(check_extent(normalize(1e160 * good.positions)), HB_ERROR_MESH_NOT_FINITE);
  check_body_error(check_extent(normalize(1e-160 * good.positions)), HB_ERROR_MESH_ZERO_EXTENT);
  check_body_error(check_extent(normalize(Points::Constant(5, 3, 2))), HB_ERROR_MESH_ZERO_EXTENT);
}

TEST_CASE("bodies whose arrays contradict each other are refused") {
  const Body good = test::made_bar_body(5);
  CHECK(check_body(good));
  const auto refused = [&](const std::function<void(Body&)>& spoil, const char* word) {
    CAPTURE(word);
    Body body = good;
    spoil(body);
    const auto checked = check_body(body);
    check_body_error(checked, HB_ERROR_BODY_INVALID);
    CHECK(checked.error().message.find(word) != std::string::npos);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([&](Body& b) { b.normalization.center.y() = nan; }, "normalization");
  refused([&](Body& b) { b.normalization.diagonal = 0; }, "normalization");
  refused([&](Body& b) { b.normalization.diagonal = nan; }, "normalization");
  refused([&](Body& b) { b.normalization.diagonal = HUGE_VAL; }, "normalization");
  refused([&](Body& b) { b.centers.clear(), b.distances.clear(); }, "no centers");
  refused([&](Body& b) { b.spheres.clear(); }, "no spheres");
  refused([&](Body& b) { b.domain = VoxelDomain(), b.distances.clear(); }, "no voxels");
  refused([&](Body& b) { b.centers[3] = static_cast<std::uint32_t>(b.positions.rows()); }, "Center 3");
  refused([&](Body& b) { b.distances.pop_back(); }, "distances");
  refused([&](Body& b) { b.distances.push_back(0); }, "distances");
  refused([&](Body& b) { b.distance_scale = 0; }, "distances");
  refused([&](Body& b) { b.distance_scale = -1; }, "distances");
  refused([&](Body& b) { b.distance_scale = nan; }, "distances");
  refused([&](Body& b) { b.spheres[1].radius = 0; }, "Sphere 1");
  refused([&](Body& b) { b.spheres[2].radius = HUGE_VAL; }, "Sphere 2");
  refused([&](Body& b) { b.spheres[0].center.z() = nan; }, "Sphere 0");

  Body broken = good;  // its mesh is checked as any other
  broken.triangles(2, 0) = 1000;
  check_body_error(check_body(broken), HB_ERROR_MESH_INDEX_OUT_OF_RANGE, HB_CULPRIT_TRIANGLE, 2);
  broken = good;
  broken.triangles.resize(0, 3);
  CHECK(check_body(broken));  // a cloud's body
}
