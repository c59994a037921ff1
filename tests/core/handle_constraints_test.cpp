#include "core/irbf/handle_constraints.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "made_body.hpp"

using namespace handlebody;

namespace {

constexpr double grip = 0.04;

/** Handles of a bar whose basis is an inverse multiquadric of five centers. */
struct HeldBar {
  Body body = test::made_bar_body(5);
  Basis basis{body, Kernel::of(KernelKind::inverse_multiquadric, 2, 3)};
  std::unique_ptr<TriangleTree> surface;

  Result<HandleConstraints> hold(const Points& places, const std::vector<HandleKind>& kinds) {
    return HandleConstraints::create(body, basis, surface, places, kinds, grip);
  }
};

const std::vector<HandleKind> point_and_grip{HandleKind::position, HandleKind::rotation};

Points handle_places() {
  Points places(2, 3);
  places << 1.5, 2.5, 3.5, 4, 2.5, 3.5;
  return places;
}

}  // namespace

TEST_CASE("the structure of a sphere: the ends of three perpendicular edges, −x +x −y +y −z +z") {
  const Vector3 middle(1, 2, 3);
  const double ends[6][3] = {{.5, 2, 3}, {1.5, 2, 3}, {1, 1.5, 3}, {1, 2.5, 3}, {1, 2, 2.5}, {1, 2, 3.5}};
  for (Index i = 0; i < 6; ++i) CHECK(structure_point(middle, .5, i) == Vector3(ends[i][0], ends[i][1], ends[i][2]));
}

TEST_CASE("a position handle is one point and one row, a rotation handle seven points and four rows, of eq. (4)") {
  HeldBar bar;
  const Points places = handle_places();
  const auto held = bar.hold(places, point_and_grip);
  REQUIRE(held);
  CHECK(held->handles() == 2);
  CHECK(held->repeated() == -1);
  const Points& points = held->points();
  const MatrixXd& rows = held->rows();
  REQUIRE(points.rows() == 8);
  REQUIRE(rows.rows() == 5);
  REQUIRE(rows.cols() == 4 + 5);
  for (Index k = 0; k < 2; ++k)
    CHECK((points.row(k).transpose() - bar.body.normalization.to_solver(places.row(k).transpose())).norm() < 1e-14);
  for (Index i = 0; i < 6; ++i)
    CHECK((points.row(2 + i).transpose() - structure_point(points.row(1).transpose(), grip, i)).norm() < 1e-14);

  InteriorSamples samples;
  for (Index i = 0; i < 8; ++i) samples.add(bar.body.domain, points.row(i).transpose());
  Matrix phi(8, 5);
  REQUIRE(bar.basis.evaluate<double>(samples, phi));
  MatrixXd expected = MatrixXd::Zero(5, 9);
  for (Index k = 0; k < 2; ++k) expected.row(k) << points.row(k), 1, phi.row(k);
  for (Index e = 0; e < 3; ++e)
    expected.row(2 + e) << points.row(3 + 2 * e) - points.row(2 + 2 * e), 0, phi.row(3 + 2 * e) - phi.row(2 + 2 * e);
  CHECK((rows - expected).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("at rest the targets are where the handles are, and moved, turned and scaled ones where they say") {
  HeldBar bar;
  const Points places = handle_places();
  const auto held = bar.hold(places, point_and_grip);
  REQUIRE(held);
  std::vector<double> targets = held->rest(places);
  CHECK(targets == std::vector<double>{1.5, 2.5, 3.5, 0, 0, 0, 1, 1, 1, 1, 4, 2.5, 3.5, 0, 0, 0, 1, 1, 1, 1});
  Points moved(8, 3);
  REQUIRE(held->read_targets(targets.data(), bar.body.normalization, moved));
  CHECK((moved - held->points()).cwiseAbs().maxCoeff() < 1e-14);

  const Vector3 to(2, 4, 5), scale(1, 2, 3);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.8, Vector3(1, -2, 2).normalized()));
  Eigen::Map<Eigen::Matrix<double, 10, 1>>(targets.data() + 10) << to, 5 * turn.coeffs(), scale;  // of any length
  Eigen::Map<Eigen::Matrix<double, 10, 1>>(targets.data()) << to, 0, 0, 0, 0, 9, 9, 9;            // a point does not turn
  REQUIRE(held->read_targets(targets.data(), bar.body.normalization, moved));
  const Vector3 place = bar.body.normalization.to_solver(to);
  CHECK((moved.row(0).transpose() - place).norm() < 1e-14);
  CHECK((moved.row(1).transpose() - place).norm() < 1e-14);
  for (Index i = 0; i < 6; ++i) {
    const Vector3 arm = (held->points().row(2 + i) - held->points().row(1)).transpose();
    CHECK((moved.row(2 + i).transpose() - place - turn * scale.cwiseProduct(arm)).norm() < 1e-14);
  }
}

TEST_CASE("an affine map meets the rows of its own image: displacements into right-hand sides") {
  HeldBar bar;
  Points places(3, 3);
  places << 1.5, 2.5, 3.5, 4, 2.5, 3.5, 3, 2.2, 3.3;
  const auto held = bar.hold(places, {HandleKind::rotation, HandleKind::position, HandleKind::rotation});
  REQUIRE(held);
  Matrix3 linear;
  linear << 0.1, -0.4, 0.2, 0.3, 0.2, 0, -0.5, 0.6, 0.7;
  const Eigen::RowVector3d translation(0.3, -0.2, 0.9);
  MatrixXd parameters = MatrixXd::Zero(9, 3);
  parameters.topRows(3) = linear.transpose();
  parameters.row(3) = translation;
  const Points displacements = (held->points() * linear.transpose()).rowwise() + translation;
  Columns3 right(held->rows().rows(), 3);
  held->right_hand_side(displacements, 1, right);
  CHECK((held->rows() * parameters - right).cwiseAbs().maxCoeff() < 1e-14);
  Columns3 weighted(right.rows(), 3);
  held->right_hand_side(displacements, 7, weighted);
  CHECK((weighted - 7 * right).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("the largest miss is that of a handle's own row, not of the edges about it") {
  HeldBar bar;
  const auto held = bar.hold(handle_places(), {HandleKind::rotation, HandleKind::position});
  REQUIRE(held);
  Columns3 missed = Columns3::Constant(5, 3, 10);
  missed.row(0) << 3, 0, 4;
  missed.row(4) << 1, 2, 2;
  CHECK(held->largest_miss(missed) == doctest::Approx(5));
  missed.row(4) << 2, 4, 4;
  CHECK(held->largest_miss(missed) == doctest::Approx(6));
  CHECK(held->largest_miss(Columns3::Zero(5, 3)) == 0);
}

TEST_CASE("handles that cannot be are named; on a vertex, near the surface and inside they can") {
  HeldBar bar;
  const auto refused = [&](const Eigen::RowVector3d& second) {
    Points places = handle_places();
    places.row(1) = second;
    const auto held = bar.hold(places, point_and_grip);
    if (held) return HB_OK;
    CHECK(held.error().culprit == HB_CULPRIT_HANDLE);
    CHECK(held.error().index == 1);
    CHECK(!held.error().remedy.empty());
    return held.error().code;
  };
  CHECK(refused({5, 3, 4}) == HB_OK);       // a corner
  CHECK(refused({3, 2.5, 4.01}) == HB_OK);  // a little outside: less than a voxel
  CHECK(refused({3, 2.5, 4.6}) == HB_ERROR_HANDLE_OUTSIDE);
  CHECK(refused({-100, 0, 0}) == HB_ERROR_HANDLE_OUTSIDE);
  CHECK(refused({3, HUGE_VAL, 3}) == HB_ERROR_HANDLE_NOT_FINITE);
  CHECK(refused({3, 2.5, std::numeric_limits<double>::quiet_NaN()}) == HB_ERROR_HANDLE_NOT_FINITE);

  const Points many = Points::Constant(1025, 3, 3);
  const auto held = bar.hold(many, std::vector<HandleKind>(1025, HandleKind::position));
  REQUIRE_FALSE(held);
  CHECK(held.error().code == HB_ERROR_INVALID_OPTION);
}

TEST_CASE("a cloud's handles: within two voxels of a voxel") {
  HeldBar bar;
  bar.body.triangles.resize(0, 3);
  const double spacing = bar.body.domain.grid().spacing * bar.body.normalization.diagonal;
  Points place(1, 3);
  place << 3, 2.5, 4 + spacing;
  CHECK(bar.hold(place, {HandleKind::position}));
  place(0, 2) = 4 + 3 * spacing;
  CHECK_FALSE(bar.hold(place, {HandleKind::position}));
}

TEST_CASE("two handles at one place must want the same: the later one is named") {
  HeldBar bar;
  Points places(3, 3);
  places << 1.5, 2.5, 3.5, 4, 2.5, 3.5, 1.5, 2.5, 3.5;
  const auto held = bar.hold(places, std::vector<HandleKind>(3, HandleKind::position));
  REQUIRE(held);
  CHECK(held->repeated() == 2);
  std::vector<double> targets = held->rest(places);
  Points moved(3, 3);
  CHECK(held->read_targets(targets.data(), bar.body.normalization, moved));
  targets[0] += 1, targets[20] += 1;
  CHECK(held->read_targets(targets.data(), bar.body.normalization, moved));
  targets[21] += 0.1;
  const auto conflict = held->read_targets(targets.data(), bar.body.normalization, moved);
  REQUIRE_FALSE(conflict);
  CHECK(conflict.error().code == HB_ERROR_HANDLE_CONFLICT);
  CHECK(conflict.error().culprit == HB_CULPRIT_HANDLE);
  CHECK(conflict.error().index == 2);
}

TEST_CASE("targets that are no numbers are named, as far as the handle reads them") {
  HeldBar bar;
  const auto held = bar.hold(handle_places(), point_and_grip);
  REQUIRE(held);
  const auto code_with = [&](std::size_t number, double value) {
    std::vector<double> targets = held->rest(handle_places());
    targets[number] = value;
    Points moved(8, 3);
    const auto read = held->read_targets(targets.data(), bar.body.normalization, moved);
    if (read) return HB_OK;
    CHECK(read.error().culprit == HB_CULPRIT_HANDLE);
    CHECK(read.error().index == static_cast<std::int64_t>(number / 10));
    return read.error().code;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::size_t number : {0u, 1u, 2u, 10u, 12u, 13u, 16u, 17u, 19u}) {
    CAPTURE(number);
    CHECK(code_with(number, nan) == HB_ERROR_TARGET_NOT_FINITE);
  }
  for (const std::size_t number : {3u, 6u, 9u}) CHECK(code_with(number, nan) == HB_OK);  // the first handle does not turn
  CHECK(code_with(16, 0) == HB_ERROR_TARGET_NOT_FINITE);                                 // a quaternion of length 0
  CHECK(code_with(0, 1e7) == HB_ERROR_TARGET_NOT_FINITE);                                // a million models away
  CHECK(code_with(0, 1e5) == HB_OK);
  CHECK(code_with(17, -1e7) == HB_ERROR_TARGET_NOT_FINITE);  // as large
  CHECK(code_with(17, -1e5) == HB_OK);
  CHECK(code_with(13, 1e200) == HB_ERROR_TARGET_NOT_FINITE);  // a quaternion whose square is none
}
