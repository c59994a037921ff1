#include "core/irbf/bones.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "capsule_trees.hpp"
#include "core/irbf/sphere_structure.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

/** A leg of two parts that meet at a right angle, thick enough for some voxels. */
Capsules knee() {
  return {{{0, 0, 0}, {1, 0, 0}, 0.1}, {{1, 0, 0}, {1, 1, 0}, 0.1}};
}

}  // namespace

TEST_CASE("an ellipsoid ends at the bone's ends, and its widest ring keeps to the part of the depth") {
  const Solid body = solid_of({{{0, 0, 0}, {1, 0, 0}, 0.1}}, 80);
  const auto bone = bone_ellipsoid(body.domain, body.depth, {{0.1, 0, 0}, {0.9, 0, 0}}, 0.9);
  REQUIRE(bone);
  CHECK((bone->center - Vector3(0.5, 0, 0)).norm() < 1e-15);
  CHECK((bone->axis - Vector3(0.4, 0, 0)).norm() < 1e-15);
  CHECK(bone->radius == doctest::Approx(0.09).epsilon(0.08));  // depths are those of voxels
  for (int i = -20; i <= 20; ++i) {
    const double part = i / 20.;
    CHECK(depth_in({{{0, 0, 0}, {1, 0, 0}, 0.1}}, bone->center + part * bone->axis) >=
          bone->radius * std::sqrt(1 - part * part) - 1e-12);
  }
}

TEST_CASE("an ellipsoid is as thick as the narrowest place on its way allows, and as a ball at most") {
  const Capsules waist{{{0, 0, 0}, {0.4, 0, 0}, 0.2}, {{0.4, 0, 0}, {0.8, 0, 0}, 0.05}, {{0.8, 0, 0}, {1.2, 0, 0}, 0.2}};
  const Solid body = solid_of(waist, 100);
  const auto bone = bone_ellipsoid(body.domain, body.depth, {{0, 0, 0}, {1.2, 0, 0}}, 0.9);
  REQUIRE(bone);
  CHECK(bone->radius == doctest::Approx(0.045).epsilon(0.15));
  const auto small = bone_ellipsoid(body.domain, body.depth, {{0.1, 0, 0}, {0.2, 0, 0}}, 0.9);
  REQUIRE(small);
  CHECK(small->radius == doctest::Approx(small->axis.norm()));
}

TEST_CASE("there is none between places that the body is not between, and none without length") {
  const Solid body = solid_of(knee(), 60);
  CHECK(bone_ellipsoid(body.domain, body.depth, {{0.1, 0, 0}, {0.9, 0, 0}}, 0.9));
  CHECK_FALSE(bone_ellipsoid(body.domain, body.depth, {{0.1, 0, 0}, {1, 0.9, 0}}, 0.9));
  CHECK_FALSE(bone_ellipsoid(body.domain, body.depth, {{0.1, 0, 0}, {-0.9, 0, 0}}, 0.9));
  CHECK_FALSE(bone_ellipsoid(body.domain, body.depth, {{0.5, 0, 0}, {0.5, 0, 0}}, 0.9));
}

TEST_CASE("a skeleton is cut where it bends: two bones for a knee, one a limb of a quadruped (also turned and moved: seed 7)") {
  const auto bones_of = [](const Capsules& capsules) {
    const Solid body = solid_of(capsules, 70);
    return straight_bones(curve_skeleton(body.domain, body.depth));
  };
  const std::vector<Bone> two = bones_of(knee());
  REQUIRE(two.size() == 2);
  for (const Bone& bone : two) {
    const Vector3 along = (bone.to - bone.from).cwiseAbs();
    CHECK(along.maxCoeff() == doctest::Approx(1).epsilon(0.15));
    CHECK(along.maxCoeff() > 5 * (along.sum() - along.maxCoeff()));
  }
  for (const bool turned : {false, true}) {
    Capsules capsules = quadruped();
    if (turned) {
      const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, 0.7, -0.2, 0.6).normalized();
      for (Capsule& c : capsules) c.from = turn * c.from + Vector3(3, 1, 2), c.to = turn * c.to + Vector3(3, 1, 2);
    }
    const std::vector<Bone> bones = bones_of(capsules);
    // Every limb has one that runs along it.
    for (std::size_t limb = 1; limb < capsules.size(); ++limb) {
      const Vector3 along = (capsules[limb].to - capsules[limb].from).normalized();
      const bool found = std::any_of(bones.begin(), bones.end(), [&](const Bone& bone) {
        return std::abs((bone.to - bone.from).normalized().dot(along)) > 0.97 &&
               capsules[limb].depth((bone.from + bone.to) / 2) > 0.5 * capsules[limb].radius;
      });
      CAPTURE(limb);
      CHECK(found);
    }
  }
}

TEST_CASE("bones come first, on their branches; what they overlap goes, bones that meet at their ends stay") {
  const Solid body = solid_of(knee(), 60);
  const CurveSkeleton skeleton = curve_skeleton(body.domain, body.depth);
  std::vector<Sphere> spheres{{{0.5, 0, 0}, 0.09}, {{1, 0.5, 0}, 0.05}, {{-0.05, 0, 0}, 0.04}, {{5, 5, 5}, 1}};
  std::vector<std::int32_t> branches{0, 0, 0, -1};
  std::vector<Sphere> ellipsoids;
  for (const Bone& bone : {Bone{{0, 0, 0}, {1, 0, 0}}, Bone{{1, 0, 0}, {1, 1, 0}}, Bone{{0.1, 0, 0}, {0.9, 0, 0}}})
    ellipsoids.push_back(*bone_ellipsoid(body.domain, body.depth, bone, 0.9));
  add_bones(ellipsoids, skeleton, spheres, branches);
  REQUIRE(spheres.size() == 4);  // two bones, what is beyond an end, and what is far away
  REQUIRE(branches.size() == 4);
  CHECK(spheres[0].center == Vector3(0.5, 0, 0));
  CHECK(spheres[1].center == Vector3(1, 0.5, 0));
  CHECK(spheres[2].radius == 0.04);
  CHECK(spheres[3].radius == 1);
  CHECK(branches[0] >= 0);
  CHECK(branches[3] == -1);

  std::vector<Sphere> none;
  std::vector<std::int32_t> of_none;
  add_bones(ellipsoids, {}, none, of_none);
  CHECK(none.size() == 2);
  CHECK(of_none == std::vector<std::int32_t>{-1, -1});
}
