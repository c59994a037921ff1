// Target shapes of spheres (paper 001, §2.4, eq. (11)) and spheres that may grow (§4.5).
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "baked_bar.hpp"
#include "core/irbf/irbf.hpp"
#include "core/mesh/enclosed_volume.hpp"

using namespace handlebody;

namespace {

constexpr unsigned seed = 20150301;

Points corners() {
  Points points(8, 3);
  for (Index i = 0; i < 8; ++i) points.row(i) << (i & 1 ? 10 : 0), (i & 2 ? 2 : 0), (i & 4 ? 2 : 0);
  return points;
}

std::unique_ptr<Irbf> held(const Body& body, const IrbfOptions& options, const Points& places) {
  auto irbf = Irbf::create(body, options);
  REQUIRE(irbf);
  REQUIRE((*irbf)->set_handles(places, std::vector<HandleKind>(places.rows(), HandleKind::position)));
  return std::move(*irbf);
}

void move_to(Irbf& irbf, const Points& targets) {
  for (Index k = 0; k < targets.rows(); ++k)
    for (Index axis = 0; axis < 3; ++axis) irbf.targets()[k * Irbf::target_size + axis] = targets(k, axis);
}

void set_shape(Irbf& irbf, std::size_t sphere, const Matrix3& shape) {
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 3; ++j) irbf.shapes()[9 * sphere + 3 * i + j] = shape(i, j);
}

Points positions(Irbf& irbf) {
  PointsF out(irbf.vertex_count(), 3);
  irbf.deform(out.data(), nullptr, nullptr);
  return out.cast<double>();
}

/** The linear map that takes the six points of a sphere closest to their images. */
Matrix3 map_of(const Irbf& irbf, const Sphere& sphere) {
  const Normalization& normalization = irbf.body().normalization;
  Points rest(6, 3);
  for (Index i = 0; i < 6; ++i) rest.row(i) = normalization.to_model(structure_point(sphere.center, sphere.radius, i));
  const auto moved = irbf.evaluate(rest);
  REQUIRE(moved);
  Matrix3 covariance = Matrix3::Zero(), square = Matrix3::Zero();
  const Eigen::RowVector3d from = rest.colwise().mean(), to = moved->colwise().mean();
  for (Index i = 0; i < 6; ++i) {
    covariance += (moved->row(i) - to).transpose() * (rest.row(i) - from);
    square += (rest.row(i) - from).transpose() * (rest.row(i) - from);
  }
  return covariance * square.inverse();
}

Matrix3 rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
}

std::size_t middle_sphere(const Body& body) {
  std::size_t nearest = 0;
  for (std::size_t s = 0; s < body.spheres.size(); ++s)
    if (body.spheres[s].center.norm() < body.spheres[nearest].center.norm()) nearest = s;
  return nearest;
}

}  // namespace

TEST_CASE("a sphere takes the shape that it is given, along any axes, and those two radii away keep their volume") {
  const Body body = test::baked_bar(100, 9);
  const Points rest = corners();
  std::mt19937 random(seed);
  const std::size_t chosen = middle_sphere(body);
  for (int turn = 0; turn < 4; ++turn) {
    const Matrix3 axes = turn == 0 ? Matrix3(Matrix3::Identity()) : rotation(random);
    const Matrix3 shape = axes * Vector3(1.5, 1, 1).asDiagonal() * axes.transpose();
    IrbfOptions options;  // of the defaults all but the width: kernels as long as the bar cannot swell one ball of it
    options.kernel.width = 2;
    auto irbf = held(body, options, rest);
    set_shape(*irbf, chosen, shape);
    const auto report = irbf->solve({1000, 1e-5, true});
    REQUIRE(report);
    CHECK(report->converged);
    const Matrix3 found = map_of(*irbf, body.spheres[chosen]);
    const Eigen::JacobiSVD<Matrix3> sizes(found);
    CAPTURE(turn);
    CHECK(sizes.singularValues()[0] == doctest::Approx(1.5).epsilon(.02));
    CHECK(sizes.singularValues()[1] == doctest::Approx(1).epsilon(.02));
    CHECK(sizes.singularValues()[2] == doctest::Approx(1).epsilon(.02));
    for (std::size_t s = 0; s < body.spheres.size(); ++s) {
      const double apart = (body.spheres[s].center - body.spheres[chosen].center).norm();
      if (s == chosen || apart - body.spheres[s].radius < 2 * body.spheres[chosen].radius) continue;
      CHECK(map_of(*irbf, body.spheres[s]).determinant() == doctest::Approx(1).epsilon(turn == 0 ? .01 : .03));
    }
  }
}

TEST_CASE("a shape that only turns a sphere changes nothing: its map turns it back (seed 20150301)") {
  const Body body = test::baked_bar(100, 40);
  const Points rest = corners();
  Points bent = rest;
  for (Index k = 0; k < 8; ++k)
    if (k & 1) bent(k, 1) += 3;
  std::mt19937 random(seed + 1);
  for (const SphereFit fit : {SphereFit::rigid, SphereFit::similarity}) {
    IrbfOptions options;
    options.sphere_fit = fit;
    auto plain = held(body, options, rest), turned = held(body, options, rest);
    move_to(*plain, bent);
    move_to(*turned, bent);
    for (std::size_t s = 0; s < body.spheres.size(); ++s) set_shape(*turned, s, rotation(random));
    const auto first = plain->solve({2000, 1e-10, true}), second = turned->solve({2000, 1e-10, true});
    REQUIRE(first);
    REQUIRE(second);
    CHECK(second->energy == doctest::Approx(first->energy).epsilon(1e-6));
    CHECK((positions(*plain) - positions(*turned)).cwiseAbs().maxCoeff() < 1e-3);
  }
}

TEST_CASE("spheres that may grow follow handles that are scaled about a point, without energy; rigid ones do not (seed 20150301)") {
  const Body body = test::baked_bar(100, 40);
  const double volume = enclosed_volume(body.positions, body.triangles);
  std::mt19937 random(seed + 2);
  const Points rest = corners();
  const Matrix3 turn = rotation(random);
  for (const double scale : {1.5, 0.4, 4.}) {
    Points grown = (scale * (rest.rowwise() - Eigen::RowVector3d(1, 2, 3))) * turn.transpose();
    IrbfOptions options;
    options.sphere_fit = SphereFit::similarity;
    auto similar = held(body, options, rest), rigid = held(body, {}, rest);
    move_to(*similar, grown);
    move_to(*rigid, grown);
    const auto report = similar->solve({}), stiff = rigid->solve({});
    REQUIRE(report);
    REQUIRE(stiff);
    CHECK(report->converged);
    CHECK(report->energy < 1e-9);
    CHECK(stiff->energy > 1e-4);
    const double cube = scale * scale * scale;
    CHECK(enclosed_volume(positions(*similar), body.triangles) / volume == doctest::Approx(cube).epsilon(1e-4));
    CHECK(std::abs(enclosed_volume(positions(*rigid), body.triangles) / volume / cube - 1) > .1);
  }
}

TEST_CASE("with shapes and growing spheres, accelerated iterations find what plain ones find") {
  const Body body = test::baked_bar(100, 20);
  const Points rest = corners();
  Points bent = rest;
  for (Index k = 0; k < 8; ++k)
    if (k & 1) bent.row(k) = Eigen::RowVector3d(8, 3 + 1.2 * rest(k, 1), 1.2 * rest(k, 2));
  IrbfOptions options;
  options.sphere_fit = SphereFit::similarity;
  auto fast = held(body, options, rest), slow = held(body, options, rest);
  for (Irbf* irbf : {fast.get(), slow.get()}) {
    move_to(*irbf, bent);
    set_shape(*irbf, 0, Vector3(1.3, .8, 1).asDiagonal().toDenseMatrix());
  }
  const auto least = fast->solve({5000, 1e-10, true}), plain = slow->solve({5000, 1e-9, false});
  REQUIRE(least);
  REQUIRE(plain);
  CHECK(least->converged);
  CHECK(least->energy <= plain->energy * (1 + 1e-9));
  CHECK(plain->energy == doctest::Approx(least->energy).epsilon(1e-2));
  MESSAGE("iterations: " << least->iterations << " accelerated, " << plain->iterations << " plain");
  CHECK(3 * least->iterations < plain->iterations);
}

TEST_CASE("shapes that turn inside out or are no numbers are refused by sphere, and the last solution stays") {
  const Body body = test::baked_bar(60, 9);
  auto irbf = held(body, test::paper_options(), corners());
  set_shape(*irbf, 1, 1.2 * Matrix3::Identity());
  REQUIRE(irbf->solve({}));
  const Points before = positions(*irbf);
  const auto refused = [&](const Matrix3& shape, hb_status code) {
    set_shape(*irbf, 2, shape);
    const auto report = irbf->solve({});
    REQUIRE(!report);
    CHECK(report.error().code == code);
    CHECK(report.error().culprit == HB_CULPRIT_SPHERE);
    CHECK(report.error().index == 2);
    CHECK(positions(*irbf) == before);
  };
  refused(Vector3(1, -1, 1).asDiagonal().toDenseMatrix(), HB_ERROR_SHAPE_INVERTED);
  refused(-Matrix3::Identity(), HB_ERROR_SHAPE_INVERTED);
  refused(Matrix3::Zero(), HB_ERROR_SHAPE_INVERTED);
  refused(std::numeric_limits<double>::quiet_NaN() * Matrix3::Identity(), HB_ERROR_TARGET_NOT_FINITE);
  refused(1e200 * Matrix3::Identity(), HB_ERROR_TARGET_NOT_FINITE);
  set_shape(*irbf, 2, Matrix3::Identity());
  REQUIRE(irbf->solve({}));
  CHECK((positions(*irbf) - before).cwiseAbs().maxCoeff() < 1e-4);
}
