// Plane shapes whose geodesics are known, extruded over eight voxels: a box, an L and a ring in the unit square.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/distance/voxel_domain.hpp"

namespace handlebody::test {

using Vector2 = Eigen::Vector2d;

constexpr int known_layers = 8;  // of voxels, at any resolution

/** A unit square's subset, extruded. */
template <typename Inside>
VoxelDomain extruded(int resolution, Inside inside) {
  const double height = double{known_layers} / resolution;
  const Grid grid = *make_grid({0, 0, 0}, {1, 1, height}, resolution);
  std::vector<std::uint32_t> voxels;
  for (std::int64_t c = 0; c < grid.size(); ++c) {
    const Vector3 p = grid.center(c);
    if (p.minCoeff() > 0 && p[0] < 1 && p[1] < 1 && p[2] < height && inside(Vector2(p[0], p[1]))) {
      voxels.push_back(static_cast<std::uint32_t>(c));
    }
  }
  return {grid, voxels};
}

// A multiple of 1/16, so that voxels show the corner where it is: at 64 and 128 voxels the error is the method's, not the voxels'.
constexpr double bend = .4375;

inline bool inside_box(const Vector2&) {
  return true;
}

inline bool inside_l(const Vector2& p) {
  return p[0] < bend || p[1] < bend;
}

inline bool inside_ring(const Vector2& p) {
  return (p - Vector2(.5, .5)).norm() > .3 && (p - Vector2(.5, .5)).norm() < .5;
}

inline double box_distance(const Vector2& a, const Vector2& b) {
  return (a - b).norm();
}

/** Straight, or around the corner of the quadrant beyond it. */
inline double around(const Vector2& corner, const Vector2& a, const Vector2& b) {
  const Vector2 d = b - a;
  double enter = 0, leave = 1;  // of the segment in the quadrant beyond the corner
  for (int k = 0; k < 2; ++k) {
    const double t = d[k] != 0 ? (corner[k] - a[k]) / d[k] : (a[k] > corner[k] ? 0 : 2);
    if (d[k] < 0) {
      leave = std::min(leave, t);
    } else if (d[k] > 0 || t > 1) {
      enter = std::max(enter, t);
    }
  }
  return enter < leave ? (corner - a).norm() + (b - corner).norm() : d.norm();
}

inline double l_distance(const Vector2& a, const Vector2& b) {
  return around({bend, bend}, a, b);
}

/** Straight, or along two tangents and an arc of the hole of radius .3 about (.5, .5). */
inline double ring_distance(const Vector2& p, const Vector2& q) {
  const double r = .3;
  const Vector2 a = p - Vector2(.5, .5), b = q - Vector2(.5, .5);
  const double la = a.norm(), lb = b.norm();
  const double arc = std::acos(std::clamp(a.dot(b) / (la * lb), -1., 1.)) - std::acos(r / la) - std::acos(r / lb);
  return arc > 0 ? std::sqrt(la * la - r * r) + std::sqrt(lb * lb - r * r) + r * arc : (p - q).norm();
}

struct KnownShape {
  std::string name;
  bool (*inside)(const Vector2&);
  double (*flat)(const Vector2&, const Vector2&);  // the plane geodesic
  std::vector<Vector2> sources;

  VoxelDomain domain(int resolution) const { return extruded(resolution, inside); }

  /** A geodesic of an extruded set rises evenly, so its length is the hypotenuse of the flat one and the rise. */
  double distance(const Vector3& a, const Vector3& b) const { return std::hypot(flat({a[0], a[1]}, {b[0], b[1]}), b[2] - a[2]); }
};

inline std::vector<KnownShape> known_shapes() {
  return {{"box", inside_box, box_distance, {{.1, .1}, {.5, .5}, {0, 0}, {.31, .77}}},
          {"L", inside_l, l_distance, {{.1, .9}, {.3, .95}, {.2, .2}, {0, .7}}},
          {"ring", inside_ring, ring_distance, {{.5, .9}, {.97, .5}, {.73, .73}}}};
}

struct Accuracy {
  double mean = 0, largest = 0, bias = 0;
  double lowest = 0;       // error with its sign: how much too short the shortest is
  double nine_tenths = 0;  // what nine tenths of the voxels stay within
  double far = 0;          // largest from half a unit on
};

/** Relative errors of `measure(source, distances)` over all voxels at least five spacings from the source; sources are half way
 *  up. */
template <typename Measure>
Accuracy accuracy(const KnownShape& shape, const VoxelDomain& domain, const Measure& measure) {
  std::vector<double> d(domain.size());
  Accuracy result;
  std::vector<double> errors;
  for (const Vector2& s : shape.sources) {
    const Vector3 source(s[0], s[1], known_layers / 2. * domain.grid().spacing);
    measure(source, d.data());
    for (Index v = 0; v < domain.size(); ++v) {
      const Vector3 p = domain.center(v);
      if ((p - source).norm() < 5 * domain.grid().spacing) continue;
      const double error = d[v] / shape.distance(source, p) - 1;
      errors.push_back(std::abs(error));
      result.mean += std::abs(error), result.bias += error;
      result.lowest = std::min(result.lowest, error);
      if ((p - source).norm() > .5) result.far = std::max(result.far, std::abs(error));
    }
  }
  std::sort(errors.begin(), errors.end());
  const auto count = static_cast<double>(errors.size());
  result.mean /= count, result.bias /= count;
  result.nine_tenths = errors[errors.size() * 9 / 10], result.largest = errors.back();
  return result;
}

}  // namespace handlebody::test
