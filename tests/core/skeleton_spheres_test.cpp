#include "core/irbf/skeleton_spheres.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "capsule_trees.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

struct Packed {
  Solid body;
  CurveSkeleton skeleton;
  std::vector<SkeletonSphere> spheres;

  std::vector<int> per_branch() const {
    std::vector<int> count(skeleton.branches.size());
    for (const SkeletonSphere& s : spheres) {
      if (s.branch >= 0) ++count[s.branch];
    }
    return count;
  }
};

Packed packed(const Capsules& capsules, int resolution, const SkeletonSphereOptions& options) {
  Packed made{solid_of(capsules, resolution), {}, {}};
  made.skeleton = curve_skeleton(made.body.domain, made.body.depth);
  made.spheres = skeleton_spheres(made.body.domain, made.body.depth, made.skeleton, options);
  return made;
}

SkeletonSphereOptions options_for(int max_spheres, double max_overlap = 0, bool fill = false) {
  SkeletonSphereOptions options;
  options.packing.max_spheres = max_spheres, options.packing.max_overlap = max_overlap, options.fill = fill;
  return options;
}

/** The most that two spheres overlap, in parts of the smaller radius; negative where all are apart. */
double most_overlap(const std::vector<SkeletonSphere>& spheres) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double r = spheres[i].radius, t = spheres[j].radius;
      most = std::max(most, (r + t - (spheres[i].center - spheres[j].center).norm()) / std::min(r, t));
    }
  }
  return most;
}

bool same(const std::vector<SkeletonSphere>& a, const std::vector<SkeletonSphere>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SkeletonSphere& s, const SkeletonSphere& t) {
    return s.branch == t.branch && (s.center - t.center).norm() < 1e-12 && std::abs(s.radius - t.radius) < 1e-12;
  });
}

}  // namespace

TEST_CASE("three spheres a limb, inside, within the overlap and the number allowed, largest first (random bodies: seeds 1 to 3)") {
  std::vector<Capsules> bodies{star(8), quadruped()};
  for (const unsigned seed : {1u, 2u, 3u}) bodies.push_back(random_tree(seed));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (const double max_overlap : {-0.3, 0., 0.3}) {
      for (const int max_spheres : {1, 40, 200}) {
        for (const bool fill : {false, true}) {
          CAPTURE(b);
          CAPTURE(max_overlap);
          CAPTURE(max_spheres);
          CAPTURE(fill);
          const Packed made = packed(bodies[b], 56, options_for(max_spheres, max_overlap, fill));
          for (const int count : made.per_branch()) CHECK(count >= 3);
          CHECK(made.spheres.size() <= std::max<std::size_t>(max_spheres, 3 * made.skeleton.branches.size()));
          CHECK(most_overlap(made.spheres) <= max_overlap + 1e-9);
          for (std::size_t s = 0; s < made.spheres.size(); ++s) {
            const SkeletonSphere& sphere = made.spheres[s];
            CHECK(sphere.radius > 0);
            CHECK(sphere_inside(bodies[b], sphere.center, sphere.radius));
            if (s > 0) CHECK(sphere.radius <= made.spheres[s - 1].radius + 1e-5 * made.body.spacing());
          }
        }
      }
    }
  }
}

TEST_CASE("spheres of a branch are on its nodes, 90% of the depth where nothing is short") {
  const Packed made = packed(star(8), 80, options_for(200));
  for (const SkeletonSphere& sphere : made.spheres) {
    Indices nodes = made.skeleton.hubs;
    if (sphere.branch >= 0) nodes = made.skeleton.branches[sphere.branch].nodes;
    const bool on_one = std::any_of(nodes.begin(), nodes.end(), [&](std::uint32_t n) {
      const SkeletonNode& node = made.skeleton.nodes[n];
      return node.place == sphere.center && sphere.radius == doctest::Approx(0.9 * node.radius);
    });
    CHECK(on_one);
  }
  CHECK(std::count_if(made.spheres.begin(), made.spheres.end(), [](const SkeletonSphere& s) { return s.branch < 0; }) == 1);
}

TEST_CASE("where few are allowed, a limb's spheres are spread from its root to its tip") {
  const Capsules capsules = star(5);
  const Packed made = packed(capsules, 80, options_for(15));
  CHECK(made.spheres.size() == 15);
  for (std::size_t c = 1; c < capsules.size(); ++c) {
    const Vector3 along = capsules[c].to.normalized();
    double low = 1e300, high = -1e300;
    for (const SkeletonSphere& s : made.spheres) {
      if ((s.center - s.center.dot(along) * along).norm() > 0.05 || s.center.dot(along) < 0) continue;
      low = std::min(low, s.center.dot(along)), high = std::max(high, s.center.dot(along));
    }
    CHECK(low < 0.6);
    CHECK(high > 0.85);
  }
}

TEST_CASE("a limb too short for three spheres of 90% gets three smaller ones") {
  const Capsules capsules{{{0, 0, 0}, {0, 0, 0}, 0.4}, {{0, 0, 0}, {0.62, 0, 0}, 0.15}, {{0, 0, 0}, {-1.4, 0, 0}, 0.15}};
  SkeletonSphereOptions options = options_for(100);
  options.least_per_branch = 1;
  const auto stubs = [](const Packed& made) {
    return std::count_if(made.spheres.begin(), made.spheres.end(), [](const SkeletonSphere& s) { return s.center[0] > 0.3; });
  };
  const Packed few = packed(capsules, 90, options);
  CHECK(stubs(few) < 3);
  options.least_per_branch = 3;
  const Packed made = packed(capsules, 90, options);
  for (const int count : made.per_branch()) CHECK(count >= 3);
  CHECK(most_overlap(made.spheres) <= 1e-9);
}

TEST_CASE("what is wide is filled beside the skeleton, if wanted and if there are any left") {
  // A plate with an arm: the skeleton is a line, and most of the plate is beside it.
  const Capsule arm{{0, 0, 0}, {3, 0, 0}, 0.2};
  const auto depth = [&](const Vector3& p) {
    const Vector3 half(1, 0.3, 1);
    return std::max(arm.depth(p), (half - p.cwiseAbs()).minCoeff());
  };
  const Solid body = solid_on(*make_grid({-1, -1, -1}, {3.2, 1, 1}, 84), depth);
  const CurveSkeleton skeleton = curve_skeleton(body.domain, body.depth);
  const auto bare = skeleton_spheres(body.domain, body.depth, skeleton, options_for(100, 0, false));
  const auto filled = skeleton_spheres(body.domain, body.depth, skeleton, options_for(100, 0, true));
  CHECK(filled.size() > bare.size() + 2);
  CHECK(filled.size() <= 100);
  CHECK(most_overlap(filled) <= 1e-9);
  for (const SkeletonSphere& s : filled) {
    CHECK(depth(s.center) > s.radius);
    if (s.branch < 0 && std::none_of(bare.begin(), bare.end(), [&](const SkeletonSphere& t) { return t.center == s.center; }))
      CHECK(s.radius >= 2 * body.spacing());
  }
  for (const SkeletonSphere& s : bare) {
    CHECK(std::any_of(filled.begin(), filled.end(), [&](const SkeletonSphere& t) { return t.center == s.center; }));
  }
  const int allowed = static_cast<int>(bare.size());
  CHECK(same(skeleton_spheres(body.domain, body.depth, skeleton, options_for(allowed, 0, true)), bare));
}

TEST_CASE("a ball gets one sphere, a thin limb and a part without depth one at least") {
  const Capsules ball{{{0, 0, 0}, {0, 0, 0}, 1}, {{4, 0, 0}, {4, 0, 0}, 0.5}};
  const Packed two = packed(ball, 60, options_for(100));
  REQUIRE(two.spheres.size() == 2);
  CHECK(two.spheres[0].radius == doctest::Approx(0.9).epsilon(0.06));
  CHECK(two.spheres[0].center.norm() < 1.5 * two.body.spacing());

  // A hair of one voxel, far below the least radius.
  const Capsules hair{{{0, 0, 0}, {0, 0, 0}, 0.5}, {{0, 0, 0}, {2, 0, 0}, 0.04}};
  const Packed thin = packed(hair, 50, options_for(1));
  REQUIRE(!thin.skeleton.branches.empty());
  for (const int count : thin.per_branch()) CHECK(count >= 1);
  CHECK(most_overlap(thin.spheres) <= 1e-9);

  const Solid body = solid_of({{{0, 0, 0}, {1, 0, 0}, 0.1}}, 20);
  const std::vector<double> nothing(body.depth.size(), 0);
  const CurveSkeleton skeleton = curve_skeleton(body.domain, nothing);
  CHECK(!skeleton_spheres(body.domain, nothing, skeleton, options_for(10, 0, true)).empty());
  CHECK(skeleton_spheres(VoxelDomain(body.domain.grid(), {}), {}, {}, options_for(10, 0, true)).empty());
}

TEST_CASE("packing along a skeleton is deterministic and blind to rounding") {
  const Solid body = solid_of(quadruped(), 64);
  auto noisy = body.depth;
  for (std::size_t v = 0; v < noisy.size(); ++v) noisy[v] += static_cast<double>(v * 7919 % 13) * 1e-15;
  for (const int max_spheres : {10, 40, 120}) {
    const auto options = options_for(max_spheres, 0, true);
    const auto spheres = skeleton_spheres(body.domain, body.depth, curve_skeleton(body.domain, body.depth), options);
    CHECK(same(spheres, skeleton_spheres(body.domain, noisy, curve_skeleton(body.domain, noisy), options)));
  }
}
