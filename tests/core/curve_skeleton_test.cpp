#include "core/irbf/curve_skeleton.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "capsule_trees.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

double nearest_node(const CurveSkeleton& skeleton, const Vector3& place) {
  double nearest = 1e300;
  for (const SkeletonNode& node : skeleton.nodes) nearest = std::min(nearest, (node.place - place).norm());
  return nearest;
}

double farthest_apart(const CurveSkeleton& a, const CurveSkeleton& b) {
  double farthest = 0;
  for (const SkeletonNode& node : a.nodes) farthest = std::max(farthest, nearest_node(b, node.place));
  for (const SkeletonNode& node : b.nodes) farthest = std::max(farthest, nearest_node(a, node.place));
  return farthest;
}

/** How many pieces the graph has. */
int pieces(const CurveSkeleton& skeleton) {
  std::vector<std::uint32_t> above(skeleton.nodes.size());
  for (std::uint32_t n = 0; n < above.size(); ++n) above[n] = n;
  const auto root = [&](std::uint32_t n) {
    while (above[n] != n) n = above[n];
    return n;
  };
  int count = static_cast<int>(above.size());
  for (const SkeletonBranch& branch : skeleton.branches) {
    for (std::size_t i = 1; i < branch.nodes.size(); ++i) {
      const std::uint32_t a = root(branch.nodes[i - 1]), b = root(branch.nodes[i]);
      if (a != b) above[std::max(a, b)] = std::min(a, b), --count;
    }
  }
  return count;
}

/** What holds for every skeleton. */
void check_sound(const CurveSkeleton& skeleton, const Solid& body) {
  const double h = body.spacing();
  std::vector<int> used(skeleton.nodes.size());
  for (std::size_t b = 0; b < skeleton.branches.size(); ++b) {
    const SkeletonBranch& branch = skeleton.branches[b];
    REQUIRE(!branch.nodes.empty());
    CHECK(branch.parent < static_cast<std::int32_t>(b));
    if (branch.parent >= 0) {
      const Indices& before = skeleton.branches[branch.parent].nodes;
      CHECK((before.back() == branch.nodes.front() || before.front() == branch.nodes.front()));
    }
    for (std::size_t i = 0; i < branch.nodes.size(); ++i) {
      ++used[branch.nodes[i]];
      if (i > 0) CHECK((skeleton.nodes[branch.nodes[i]].place - skeleton.nodes[branch.nodes[i - 1]].place).norm() < 1.01 * h);
    }
  }
  CHECK(std::count(used.begin(), used.end(), 0) == 0);
  for (const SkeletonNode& node : skeleton.nodes) {
    CHECK(std::isfinite(node.radius));
    CHECK((body.domain.center(body.domain.nearest(node.place)) - node.place).norm() < 0.9 * h);
  }
  const auto parts = face_components(body.domain);
  CHECK(pieces(skeleton) == *std::max_element(parts.begin(), parts.end()) + 1);
}

/** Nodes run along every limb, from the skin of the first capsule on, and end where it ends; and all of them are inside. */
void check_limbs(const CurveSkeleton& skeleton, const Solid& body, const Capsules& capsules) {
  check_sound(skeleton, body);
  const double h = body.spacing();
  const Indices ends = tips(skeleton);
  for (std::size_t c = 1; c < capsules.size(); ++c) {
    const Capsule& limb = capsules[c];
    CAPTURE(c);
    double nearest_tip = 1e300;
    for (const std::uint32_t tip : ends) nearest_tip = std::min(nearest_tip, (skeleton.nodes[tip].place - limb.to).norm());
    CHECK(nearest_tip < limb.radius);
    for (double t = 0; t <= 1; t += 0.02) {
      const Vector3 place = limb.from + t * (limb.to - limb.from);
      if (capsules[0].depth(place) < -limb.radius) CHECK(nearest_node(skeleton, place) < 2 * h);
    }
  }
  for (const SkeletonNode& node : skeleton.nodes) {
    CHECK(node.radius > depth_in(capsules, node.place) - h);
    CHECK(sphere_inside(capsules, node.place, 0.98 * node.radius));
  }
}

CurveSkeleton skeleton_of(const Solid& body) {
  return curve_skeleton(body.domain, body.depth);
}

Solid bar(int resolution) {
  const Vector3 low(0, 0, 0), high(10, 2, 2);
  return solid_on(*make_grid(low, high, resolution), [=](const Vector3& p) { return (p - low).cwiseMin(high - p).minCoeff(); });
}

void check_rounding(const Solid& body) {
  Solid noisy = body;
  for (std::size_t v = 0; v < noisy.depth.size(); ++v) noisy.depth[v] *= 1 + static_cast<double>(v * 7919 % 13) * 1e-15;
  const CurveSkeleton skeleton = skeleton_of(body), again = skeleton_of(noisy);
  REQUIRE(again.nodes.size() == skeleton.nodes.size());
  for (std::size_t n = 0; n < again.nodes.size(); ++n) CHECK((again.nodes[n].place - skeleton.nodes[n].place).norm() < 1e-12);
}

Solid ring(int resolution, double thickness) {
  return solid_on(*make_grid({-1.3, -1.3, -0.3}, {1.3, 1.3, 0.3}, resolution),
                  [=](const Vector3& p) { return thickness - (p - Vector3(p[0], p[1], 0).normalized()).norm(); });
}

}  // namespace

TEST_CASE("a star of arms has a branch into each, from one hub") {
  for (const int arms : {3, 5, 8}) {
    for (const int resolution : {48, 80}) {
      CAPTURE(arms);
      CAPTURE(resolution);
      const Capsules capsules = star(arms);
      const Solid body = solid_of(capsules, resolution);
      const CurveSkeleton skeleton = skeleton_of(body);
      CHECK(std::ssize(skeleton.branches) == arms);
      CHECK(std::ssize(tips(skeleton)) == arms);
      CHECK(skeleton.hubs.size() == 1);
      check_limbs(skeleton, body, capsules);
    }
  }
}

TEST_CASE("a quadruped has branches for legs, neck and tail, and one for the torso between two hubs") {
  for (const int resolution : {48, 64, 96}) {
    CAPTURE(resolution);
    const Capsules capsules = quadruped();
    const Solid body = solid_of(capsules, resolution);
    const CurveSkeleton skeleton = skeleton_of(body);
    CHECK(skeleton.branches.size() == 7);
    CHECK(tips(skeleton).size() == 6);
    CHECK(skeleton.hubs.size() == 2);
    check_limbs(skeleton, body, capsules);
    for (double x = -0.6; x <= 0.6; x += 0.05) CHECK(nearest_node(skeleton, {x, 0, 0}) < 2 * body.spacing());
  }
}

TEST_CASE("a Y has three branches, a bar one with two free ends") {
  const Capsules capsules{{{0, 0, 0}, {0, -1, 0}, 0.12}, {{0, 0, 0}, {0.7, 0.8, 0}, 0.12}, {{0, 0, 0}, {-0.7, 0.8, 0.1}, 0.12}};
  const Solid fork = solid_of(capsules, 64);
  const CurveSkeleton skeleton = skeleton_of(fork);
  CHECK(skeleton.branches.size() == 3);
  CHECK(tips(skeleton).size() == 3);
  CHECK(skeleton.hubs.size() == 1);
  check_limbs(skeleton, fork, capsules);
  CHECK((skeleton.nodes[skeleton.hubs[0]].place - Vector3(0, 0, 0)).norm() < 0.12);

  for (const int resolution : {20, 37, 64}) {
    CAPTURE(resolution);
    const Solid body = bar(resolution);
    const CurveSkeleton line = skeleton_of(body);
    check_sound(line, body);
    REQUIRE(line.branches.size() == 1);
    CHECK(line.branches[0].starts_free);
    CHECK(line.branches[0].ends_free);
    CHECK(line.hubs.empty());
    for (double x = 1; x <= 9; x += 0.2) CHECK(nearest_node(line, {x, 1, 1}) < 2 * body.spacing());
  }
}

TEST_CASE("a smooth length is half of a limb where limbs meet, weighted by length, and the whole of what has none") {
  const auto line = [](CurveSkeleton& skeleton, const Vector3& to, double radius) {
    SkeletonBranch branch;
    for (int i = 0; i <= 4; ++i) {
      branch.nodes.push_back(static_cast<std::uint32_t>(skeleton.nodes.size()));
      skeleton.nodes.push_back({i / 4. * to, radius});
    }
    skeleton.branches.push_back(branch);
  };
  CurveSkeleton skeleton;
  CHECK(smooth_length(skeleton) == 0);
  line(skeleton, {0, 0, 3}, 0.5);
  CHECK(smooth_length(skeleton) == doctest::Approx(4));
  line(skeleton, {0, 1, 0}, 0.1);
  skeleton.hubs = {0};
  CHECK(smooth_length(skeleton) == doctest::Approx(0.5 * (9 + 1) / (3 + 1)));
  CurveSkeleton ball;
  ball.nodes.push_back({Vector3::Zero(), 2});
  ball.branches.push_back({{0}});
  CHECK(smooth_length(ball) == 4);
}

TEST_CASE("a ring closes, and an arm on it hangs on a hub") {
  for (const int resolution : {40, 64}) {
    for (const double thickness : {0.12, 0.25}) {
      CAPTURE(resolution);
      CAPTURE(thickness);
      const Solid body = ring(resolution, thickness);
      const CurveSkeleton skeleton = skeleton_of(body);
      check_sound(skeleton, body);
      REQUIRE(skeleton.branches.size() == 1);
      CHECK(tips(skeleton).empty());
      CHECK(skeleton.branches[0].nodes.front() == skeleton.branches[0].nodes.back());
      for (double angle = 0; angle < 6.3; angle += 0.1) {
        CHECK(nearest_node(skeleton, {std::cos(angle), std::sin(angle), 0}) < 2 * body.spacing());
      }
    }
  }
  const Capsule arm{{1, 0, 0}, {2.2, 0.2, 0}, 0.15};
  const Solid body = solid_on(*make_grid({-1.3, -1.3, -0.3}, {2.4, 1.3, 0.3}, 80), [&](const Vector3& p) {
    return std::max(arm.depth(p), 0.15 - (p - Vector3(p[0], p[1], 0).normalized()).norm());
  });
  const CurveSkeleton skeleton = skeleton_of(body);
  check_sound(skeleton, body);
  CHECK(skeleton.branches.size() == 2);
  CHECK(tips(skeleton).size() == 1);
  CHECK(skeleton.hubs.size() == 1);
}

TEST_CASE("every part has a skeleton in one piece; a ball's is one node") {
  Capsules capsules = star(5);
  const Capsules beside{{{3, 0, 0}, {3, 1, 0}, 0.1}, {{0, 2, 0}, {0, 2, 0}, 0.4}};
  capsules.insert(capsules.end(), beside.begin(), beside.end());
  const Solid body = solid_of(capsules, 120);
  const CurveSkeleton skeleton = skeleton_of(body);
  check_sound(skeleton, body);
  CHECK(skeleton.branches.size() == 7);
  CHECK(tips(skeleton).size() == 5 + 2 + 1);
  const auto single = std::find_if(skeleton.branches.begin(), skeleton.branches.end(),
                                   [](const SkeletonBranch& branch) { return branch.nodes.size() == 1; });
  REQUIRE(single != skeleton.branches.end());
  const SkeletonNode& ball = skeleton.nodes[single->nodes[0]];
  CHECK((ball.place - Vector3(0, 2, 0)).norm() < 1.5 * body.spacing());
  CHECK(ball.radius == doctest::Approx(0.4).epsilon(0.1));
}

TEST_CASE("a single voxel, a row of voxels, voxels without depth, and none") {
  const Grid grid = *make_grid({0, 0, 0}, {1, 1, 1}, 8);
  const auto row = [&](int length) {
    std::vector<std::uint32_t> voxels;
    for (int i = 0; i < length; ++i) voxels.push_back(static_cast<std::uint32_t>(grid.linear(2 + i, 5, 5)));
    return VoxelDomain(grid, voxels);
  };
  CHECK(curve_skeleton(row(0), {}).branches.empty());
  for (const double depth : {0., 0.3}) {
    const CurveSkeleton one = curve_skeleton(row(1), {depth * grid.spacing});
    REQUIRE(one.branches.size() == 1);
    CHECK(one.nodes.size() == 1);
    CHECK(tips(one).size() == 1);
    CHECK(one.nodes[0].place.isApprox(row(1).center(0)));
    CHECK(one.nodes[0].radius == doctest::Approx(depth * grid.spacing));
    const CurveSkeleton line = curve_skeleton(row(8), std::vector<double>(8, depth * grid.spacing));
    CHECK(line.branches.size() == 1);
    CHECK(tips(line).size() == 2);
    CHECK(nearest_node(line, row(8).center(0)) < 1.5 * grid.spacing);
    CHECK(nearest_node(line, row(8).center(7)) < 1.5 * grid.spacing);
  }
}

TEST_CASE("limbs in random directions are found, mirrored and shifted ones at the same places (seeds 1 to 8)") {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    const Capsules capsules = random_tree(seed);
    const Solid body = solid_of(capsules, 72);
    const CurveSkeleton skeleton = skeleton_of(body);
    CHECK(std::ssize(tips(skeleton)) == std::ssize(capsules) - 1);
    CHECK(skeleton.hubs.size() == 1);
    check_limbs(skeleton, body, capsules);
    for (const Vector3& scale : {Vector3(1, 1, 1), Vector3(-1, 1, 1), Vector3(-1, -1, -1)}) {
      const Vector3 shift(3, -2, 5);
      const Solid other = solid_of(moved(capsules, scale, shift), 72);
      CurveSkeleton back = skeleton_of(other);
      for (SkeletonNode& node : back.nodes) node.place = (node.place - shift).cwiseProduct(scale);
      CHECK(tips(back).size() == tips(skeleton).size());
      CHECK(back.branches.size() == skeleton.branches.size());
      CHECK(farthest_apart(skeleton, back) < 2 * body.spacing());
    }
  }
}

TEST_CASE("thin ears on a thick head get branches, the corners of a box none") {
  const Capsules capsules{{{0, 0, 0}, {0, 0, 0}, 0.6},
                          {{0, 0, 0}, {0.5, 0.7, 0}, 0.07},
                          {{0, 0, 0}, {-0.5, 0.7, 0}, 0.07},
                          {{0, 0, 0}, {0, -1.5, 0.1}, 0.15}};
  const Solid body = solid_of(capsules, 80);
  const CurveSkeleton skeleton = skeleton_of(body);
  CHECK(tips(skeleton).size() == 3);
  check_limbs(skeleton, body, capsules);

  for (const Vector3& half : {Vector3(1, 1, 1), Vector3(2, 1, 1)}) {
    const Solid box = solid_on(*make_grid(-half, half, 41), [&](const Vector3& p) { return (half - p.cwiseAbs()).minCoeff(); });
    CHECK(skeleton_of(box).branches.size() == 1);
  }
}

TEST_CASE("a limb that is thickest near an end is followed to both") {
  const Capsules capsules{{{0.34, 0, 0}, {0.34, 0, 0}, 0.24}, {{0.34, 0, 0}, {0, 0, 0}, 0.2}, {{0.34, 0, 0}, {1.5, 0, 0}, 0.2}};
  for (const int resolution : {40, 60}) {
    const CurveSkeleton skeleton = skeleton_of(solid_of(capsules, resolution));
    CHECK(skeleton.branches.size() == 1);
    CHECK(nearest_node(skeleton, {0, 0, 0}) < 0.1);
    CHECK(nearest_node(skeleton, {1.5, 0, 0}) < 0.1);
  }
}

TEST_CASE("every tip is outside the ball at the place that its branch grows from, however long a stub is") {
  for (double length = 0.3; length < 0.8; length += 0.02) {
    CAPTURE(length);
    for (const double thickness : {0.06, 0.12, 0.2}) {
      CAPTURE(thickness);
      const Solid body = solid_of({{{-1, 0, 0}, {1, 0.1, 0}, 0.3}, {{0, 0, 0}, {0.1, length, 0.05}, thickness}}, 56);
      const CurveSkeleton skeleton = skeleton_of(body);
      CHECK(skeleton.branches.size() == (skeleton.hubs.empty() ? 1 : 3));
      if (length > 0.7) CHECK(skeleton.hubs.size() == 1);
      for (const SkeletonBranch& branch : skeleton.branches) {
        const SkeletonNode &from = skeleton.nodes[branch.nodes.front()], &to = skeleton.nodes[branch.nodes.back()];
        if (branch.ends_free && !branch.starts_free) CHECK((to.place - from.place).norm() > from.radius + 0.5 * body.spacing());
      }
    }
  }
}

TEST_CASE("a slanted limb's curve is straight, without the staircase of the voxels") {
  const Capsules capsules{{{0, 0, 0}, {1, 0.43, 0.29}, 0.09}};
  const Solid body = solid_of(capsules, 60);
  const CurveSkeleton skeleton = skeleton_of(body);
  REQUIRE(skeleton.branches.size() == 1);
  double length = 0;
  const Indices& nodes = skeleton.branches[0].nodes;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    length += (skeleton.nodes[nodes[i]].place - skeleton.nodes[nodes[i - 1]].place).norm();
  CHECK(length < 1.015 * (skeleton.nodes[nodes.back()].place - skeleton.nodes[nodes.front()].place).norm());
  for (const SkeletonNode& node : skeleton.nodes)
    CHECK((node.place - capsules[0].nearest(node.place)).norm() < 1.3 * body.spacing());
}

TEST_CASE("rounding of the depths changes nothing") {
  for (const bool is_bar : {false, true}) {
    CAPTURE(is_bar);
    check_rounding(is_bar ? bar(40) : solid_of(quadruped(), 64));
  }
}

TEST_CASE("rough skin grows no hair (seeds 1 to 20)") {
  const Capsules capsules{{{0, 0, 0}, {1, 0.2, 0.1}, 0.2}};
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-0.8, 0.8);
    const Solid smooth = solid_of({{{0, 0, 0}, {1, 0.2, 0.1}, 0.24}}, 48);
    std::vector<std::uint32_t> voxels;
    std::vector<double> depth;
    for (Index v = 0; v < smooth.domain.size(); ++v) {
      const double d = depth_in(capsules, smooth.domain.center(v)) + noise(random) * smooth.spacing();
      if (d <= 0) continue;
      voxels.push_back(smooth.domain.voxels()[v]);
      depth.push_back(d);
    }
    const VoxelDomain domain(smooth.domain.grid(), voxels);
    const CurveSkeleton skeleton = curve_skeleton(domain, depth);
    const auto long_branches = std::count_if(skeleton.branches.begin(), skeleton.branches.end(),
                                             [](const SkeletonBranch& branch) { return branch.nodes.size() > 10; });
    CHECK(long_branches == 1);  // what the noise cut off are parts of their own
    CHECK(skeleton.hubs.empty());
  }
}
