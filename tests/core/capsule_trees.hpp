// Bodies of capsules, whose skeletons are known, as voxels with their depths.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"
#include "made_domains.hpp"

namespace handlebody::test {

struct Capsule {
  Vector3 from, to;
  double radius;

  Vector3 nearest(const Vector3& p) const {
    const Vector3 along = to - from;
    const double length2 = along.squaredNorm();
    return from + (length2 > 0 ? std::clamp((p - from).dot(along) / length2, 0., 1.) : 0.) * along;
  }
  double depth(const Vector3& p) const { return radius - (p - nearest(p)).norm(); }
};
using Capsules = std::vector<Capsule>;

/** Positive inside; there, how far the surface is at least: exact but where capsules meet. */
inline double depth_in(const Capsules& capsules, const Vector3& p) {
  double depth = -std::numeric_limits<double>::infinity();
  for (const Capsule& capsule : capsules) depth = std::max(depth, capsule.depth(p));
  return depth;
}

struct Solid {
  VoxelDomain domain;
  std::vector<double> depth;

  double spacing() const { return domain.grid().spacing; }
};

/** The voxels of a grid where `depth` is positive. */
template <typename Depth>
Solid solid_on(const Grid& grid, Depth depth) {
  Solid solid;
  solid.domain = domain_where(grid, [&](const Vector3& p) { return depth(p) > 0; });
  for (Index v = 0; v < solid.domain.size(); ++v) solid.depth.push_back(depth(solid.domain.center(v)));
  return solid;
}

inline Solid solid_of(const Capsules& capsules, int resolution) {
  Vector3 low = capsules[0].from, high = low;
  for (const Capsule& c : capsules) {
    low = low.cwiseMin((c.from.cwiseMin(c.to).array() - c.radius).matrix());
    high = high.cwiseMax((c.from.cwiseMax(c.to).array() + c.radius).matrix());
  }
  return solid_on(*make_grid(low, high, resolution), [&](const Vector3& p) { return depth_in(capsules, p); });
}

/** A ball with `arms` arms in a slanted plane: the first capsule is the ball. */
inline Capsules star(int arms) {
  Capsules capsules{{Vector3::Zero(), Vector3::Zero(), 0.3}};
  for (int a = 0; a < arms; ++a) {
    const double angle = 2 * std::numbers::pi * a / arms + 0.1;
    capsules.push_back({Vector3::Zero(), Vector3(std::cos(angle), std::sin(angle), 0.2 * std::cos(angle)), 0.09});
  }
  return capsules;
}

/** Torso first, then four legs, neck and tail. */
inline Capsules quadruped() {
  return {{{-0.7, 0, 0}, {0.7, 0, 0}, 0.25},    {{-0.7, 0, 0}, {-0.8, -0.8, 0.2}, 0.1}, {{-0.7, 0, 0}, {-0.8, -0.8, -0.2}, 0.1},
          {{0.7, 0, 0}, {0.7, -0.8, 0.2}, 0.1}, {{0.7, 0, 0}, {0.7, -0.8, -0.2}, 0.1},  {{0.7, 0, 0}, {1.1, 0.7, 0.05}, 0.12},
          {{-0.7, 0, 0}, {-1.5, 0.3, 0}, 0.06}};
}

/** A ball with limbs in random directions at least 70° apart. */
inline Capsules random_tree(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  Capsules capsules{{Vector3::Zero(), Vector3::Zero(), 0.35}};
  std::vector<Vector3> directions;
  for (int tried = 0; tried < 40; ++tried) {
    const Vector3 direction = random_direction(random);
    const auto close = [&](const Vector3& other) { return other.dot(direction) > std::cos(70 * std::numbers::pi / 180); };
    if (std::any_of(directions.begin(), directions.end(), close)) continue;
    directions.push_back(direction);
    capsules.push_back({Vector3::Zero(), (0.8 + 0.5 * part(random)) * direction, 0.07 + 0.08 * part(random)});
  }
  return capsules;
}

inline Capsules moved(Capsules capsules, const Vector3& scale, const Vector3& shift) {
  for (Capsule& c : capsules) {
    c.from = c.from.cwiseProduct(scale) + shift;
    c.to = c.to.cwiseProduct(scale) + shift;
  }
  return capsules;
}

/** Whether points all over a sphere are inside. */
inline bool sphere_inside(const Capsules& capsules, const Vector3& center, double radius) {
  constexpr int points = 300;
  for (int i = 0; i < points; ++i) {
    const double z = 1 - (2 * i + 1.) / points, angle = i * std::numbers::pi * (3 - std::sqrt(5.)), r = std::sqrt(1 - z * z);
    if (depth_in(capsules, center + radius * Vector3(r * std::cos(angle), r * std::sin(angle), z)) <= 0) return false;
  }
  return true;
}

}  // namespace handlebody::test
