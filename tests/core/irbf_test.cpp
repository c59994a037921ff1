#include "core/irbf/irbf.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

#include "core/irbf/bake.hpp"
#include "made_meshes.hpp"

using namespace handlebody;
using test::made_box;

namespace {

/** The bar of paper 001, Fig. 2, at a tenth of its vertices. */
Body bar(Index centers = 60, double scale = 1) {
  test::MadeMesh mesh = made_box({10, 2, 2}, {30, 6, 6});
  mesh.positions *= scale;
  BakeOptions options;
  options.centers = centers;
  options.resolution = 40;
  options.max_spheres = 9;
  auto bake = Bake::begin(mesh.positions, mesh.triangles, options);
  REQUIRE(bake);
  double progress = 0;
  while (progress < 1) {
    auto step = (*bake)->step();
    REQUIRE(step);
    CHECK(*step >= progress);
    progress = *step;
  }
  return (*bake)->body();
}

std::unique_ptr<Irbf> prepared(const Body& body, const Points& handles, const IrbfOptions& options = {}) {
  auto irbf = Irbf::create(body, options);
  REQUIRE(irbf);
  REQUIRE((*irbf)->set_handles(handles, std::vector<HandleKind>(static_cast<std::size_t>(handles.rows()), HandleKind::position)));
  return std::move(*irbf);
}

/** The eight corners of a body's box. */
Points corners(const Body& body) {
  Points points(8, 3);
  const Vector3 low = body.positions.colwise().minCoeff(), high = body.positions.colwise().maxCoeff();
  for (Index i = 0; i < 8; ++i) points.row(i) << (i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z();
  return points;
}

void set_target(Irbf& irbf, Index handle, const Vector3& place) {
  Eigen::Map<Vector3>(irbf.targets() + handle * Irbf::target_size) = place;
}

Points deformed(Irbf& irbf) {
  PointsF out(irbf.vertex_count(), 3);
  irbf.deform(out.data(), nullptr, nullptr);
  return out.cast<double>();
}

/** Bends the bar along a circular arc of `angle` in the xy plane: the centerline keeps its length. */
void bend(Irbf& irbf, const Points& handles, double angle) {
  const double radius = 10 / angle;
  for (Index k = 0; k < handles.rows(); ++k) {
    const double turn = angle * handles(k, 0) / 10, height = radius - (handles(k, 1) - 1);
    set_target(irbf, k, {height * std::sin(turn), 1 + radius - height * std::cos(turn), handles(k, 2)});
  }
}

}  // namespace

TEST_CASE("handles at rest give back the rest shape exactly") {
  const Body body = bar();
  auto irbf = prepared(body, corners(body));
  const auto report = irbf->solve({30, 1e-6});
  REQUIRE(report);
  CHECK(report->energy < 1e-20);
  CHECK((deformed(*irbf) - body.positions).cwiseAbs().maxCoeff() < 1e-6 * body.normalization.diagonal);
}

TEST_CASE("a rigid motion of all handles gives that rigid motion") {
  const Body body = bar();
  auto irbf = prepared(body, corners(body));
  for (const double angle : {0.3, 1.5, 3.1}) {
    CAPTURE(angle);
    const Matrix3 turn = Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    const Vector3 shift(3, -2, 1);
    const Points rest = corners(body);
    for (Index k = 0; k < 8; ++k) set_target(*irbf, k, turn * rest.row(k).transpose() + shift);
    REQUIRE(irbf->solve({30, 1e-6}));
    const Points expected = (body.positions * turn.transpose()).rowwise() + shift.transpose();
    CHECK((deformed(*irbf) - expected).cwiseAbs().maxCoeff() < 1e-6 * body.normalization.diagonal);
  }
}

TEST_CASE("a bent bar reaches its anchors and keeps its volume") {
  const Body body = bar(100);
  const Points rest = corners(body);
  auto irbf = prepared(body, rest);
  bend(*irbf, rest, 1.0);
  const auto report = irbf->solve({300, 1e-7});
  REQUIRE(report);
  CHECK(report->anchor_error < 1e-3 * body.normalization.diagonal);
  const double ratio = enclosed_volume(deformed(*irbf), body.triangles) / enclosed_volume(body.positions, body.triangles);
  CHECK(ratio > 0.95);
  CHECK(ratio < 1.05);
}

TEST_CASE("frames agree with the double evaluation: in float to 1e-6 of the diagonal, in fixed point to 1e-4") {
  const Body body = bar();
  const Points rest = corners(body);
  for (const FramePrecision precision : {FramePrecision::fixed, FramePrecision::floating}) {
    IrbfOptions options;
    options.precision = precision;
    auto irbf = prepared(body, rest, options);
    bend(*irbf, rest, 0.8);
    REQUIRE(irbf->solve({50, 1e-6}));
    const Points reference = *irbf->evaluate(body.positions);
    const double error = (deformed(*irbf) - reference).rowwise().norm().maxCoeff() / body.normalization.diagonal;
    MESSAGE("largest error " << error);
    CHECK(error < (precision == FramePrecision::fixed ? 1e-4 : 1e-6));
  }
}

TEST_CASE("iterations never raise the energy, and a solution is kept warm") {
  const Body body = bar();
  const Points rest = corners(body);
  auto irbf = prepared(body, rest);
  bend(*irbf, rest, 1.2);
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 12; ++step) {
    const auto report = irbf->solve({3, 0});
    REQUIRE(report);
    CHECK(report->energy <= last * (1 + 1e-9));
    last = report->energy;
  }
}

TEST_CASE("equivariance: turned targets give the turned shape, in any order of the handles (seed 7)") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Body body = bar();
  const Points rest = corners(body);
  const Matrix3 turn = Eigen::AngleAxisd(2.1, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  const Vector3 shift(4, 5, -6);
  IrbfOptions options;
  options.precision = FramePrecision::floating;
  auto original = prepared(body, rest, options), turned = prepared(body, rest.colwise().reverse(), options);
  for (Index k = 0; k < 8; ++k) {
    const Vector3 target = rest.row(k).transpose() + 0.5 * Vector3(uniform(random), uniform(random), uniform(random));
    set_target(*original, k, target);
    set_target(*turned, 7 - k, turn * target + shift);
  }
  REQUIRE(original->solve({100, 0}));
  REQUIRE(turned->solve({100, 0}));
  const Points expected = (deformed(*original) * turn.transpose()).rowwise() + shift.transpose();
  CHECK((expected - deformed(*turned)).cwiseAbs().maxCoeff() < 1e-5 * body.normalization.diagonal);
}

TEST_CASE("a scaled model deforms as the original does") {
  // A power of two changes no digit of the computation in solver space.
  const Body body = bar(), large = bar(60, 4);
  const Points rest = corners(body);
  auto original = prepared(body, rest), copy = prepared(large, 4 * rest);
  set_target(*original, 1, Vector3(9, 1, 2));
  set_target(*copy, 1, Vector3(36, 4, 8));
  REQUIRE(original->solve({50, 0}));
  REQUIRE(copy->solve({50, 0}));
  CHECK((4 * deformed(*original) - deformed(*copy)).cwiseAbs().maxCoeff() < 1e-6 * large.normalization.diagonal);
}

TEST_CASE("a rotation handle turns and scales its surroundings") {
  const Body body = bar();
  auto created = Irbf::create(body, {});
  REQUIRE(created);
  Irbf& irbf = **created;
  Points handles(2, 3);
  handles << 1, 1, 1, 9, 1, 1;
  REQUIRE(irbf.set_handles(handles, {HandleKind::rotation, HandleKind::rotation}));
  const Eigen::Quaterniond twist(Eigen::AngleAxisd(0.7, Vector3::UnitX()));
  Eigen::Map<Eigen::Vector4d>(irbf.targets() + Irbf::target_size + 3) = twist.coeffs();
  const auto report = irbf.solve({200, 1e-8});
  REQUIRE(report);
  CHECK(report->anchor_error < 1e-3 * body.normalization.diagonal);
  Points probe(2, 3);
  probe << 9, 1, 1.2, 9, 1, 0.8;
  const Points moved = *irbf.evaluate(probe);
  const Vector3 edge = (moved.row(0) - moved.row(1)).transpose().normalized();
  CHECK(edge.dot(twist * Vector3::UnitZ()) > 0.995);
}

TEST_CASE("authored normals turn with the surface, area-weighted ones are unit") {
  const Body body = bar();
  const Points rest = corners(body);
  auto irbf = prepared(body, rest);
  bend(*irbf, rest, 0.9);
  REQUIRE(irbf->solve({50, 1e-6}));
  PointsF positions(irbf->vertex_count(), 3), normals(irbf->vertex_count(), 3), authored(irbf->vertex_count(), 3);
  authored.rowwise() = Eigen::RowVector3f(0, 0, 1);
  irbf->deform(positions.data(), nullptr, normals.data());
  for (Index v = 0; v < normals.rows(); ++v) CHECK(normals.row(v).norm() == doctest::Approx(1).epsilon(1e-4));
  irbf->deform(positions.data(), authored.data(), normals.data());
  for (Index v = 0; v < normals.rows(); ++v) CHECK(normals.row(v).norm() == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("bad handles and targets are named, and the last solution stays") {
  const Body body = bar();
  const Points rest = corners(body);
  auto irbf = prepared(body, rest);
  bend(*irbf, rest, 0.5);
  REQUIRE(irbf->solve({30, 1e-6}));
  const Points before = deformed(*irbf);

  Points outside(1, 3);
  outside << 5, 9, 1;
  const auto refused = irbf->set_handles(outside, {HandleKind::position});
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == HB_ERROR_HANDLE_OUTSIDE);
  CHECK(refused.error().index == 0);
  CHECK(irbf->handle_count() == 8);

  irbf->targets()[2 * Irbf::target_size + 1] = std::numeric_limits<double>::quiet_NaN();
  const auto nan = irbf->solve({30, 1e-6});
  REQUIRE_FALSE(nan);
  CHECK(nan.error().code == HB_ERROR_TARGET_NOT_FINITE);
  CHECK(nan.error().index == 2);
  CHECK((deformed(*irbf) - before).cwiseAbs().maxCoeff() == 0);

  Points twice(2, 3);
  twice << rest.row(0), rest.row(0);
  REQUIRE(irbf->set_handles(twice, {HandleKind::position, HandleKind::position}));
  REQUIRE(irbf->solve({30, 1e-6}));
  set_target(*irbf, 1, rest.row(0).transpose() + Vector3(0, 1, 0));
  const auto conflict = irbf->solve({30, 1e-6});
  REQUIRE_FALSE(conflict);
  CHECK(conflict.error().code == HB_ERROR_HANDLE_CONFLICT);
  CHECK(conflict.error().index == 1);

  REQUIRE(irbf->set_handles(Points(0, 3), {}));
  const auto none = irbf->solve({30, 1e-6});
  REQUIRE_FALSE(none);
  CHECK(none.error().code == HB_ERROR_HANDLES_MISSING);
}

TEST_CASE("meshes that cannot be baked are refused by name") {
  const test::MadeMesh box = made_box({1, 1, 1}, {2, 2, 2});
  const auto code = [](const Points& positions, const Triangles& triangles, const BakeOptions& options = {}) {
    auto bake = Bake::begin(positions, triangles, options);
    if (!bake) return bake.error().code;
    for (double progress = 0; progress < 1;) {
      auto step = (*bake)->step();
      if (!step) return step.error().code;
      progress = *step;
    }
    return HB_OK;
  };
  CHECK(code(box.positions, box.triangles) == HB_OK);
  CHECK(code(box.positions.topRows(1), Triangles(0, 3)) == HB_ERROR_MESH_TOO_FEW_VERTICES);
  CHECK(code(box.positions, Triangles(0, 3)) == HB_ERROR_MESH_NO_TRIANGLES);
  CHECK(code(Points::Zero(8, 3), box.triangles.topRows(1) * 0) == HB_ERROR_MESH_ZERO_EXTENT);
  CHECK(code(box.positions.topRows(6), box.triangles) == HB_ERROR_MESH_INDEX_OUT_OF_RANGE);
  Points broken = box.positions;
  broken(3, 1) = std::numeric_limits<double>::infinity();
  CHECK(code(broken, box.triangles) == HB_ERROR_MESH_NOT_FINITE);
  CHECK(code(box.positions * 1e200, box.triangles) == HB_ERROR_MESH_NOT_FINITE);
  Points flat = box.positions;
  flat.col(2).setZero();
  CHECK(code(flat, box.triangles) == HB_ERROR_MESH_NO_INTERIOR);
  BakeOptions options;
  options.resolution = 5000;
  CHECK(code(box.positions, box.triangles, options) == HB_ERROR_INVALID_OPTION);
}
