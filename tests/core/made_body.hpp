// A baked body that the tests make without baking: a bar whose interior distances are Euclidean.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/irbf/body.hpp"
#include "made_domains.hpp"
#include "made_meshes.hpp"

namespace handlebody::test {

/** The bar [1, 5] × [2, 3] × [3, 4] of 24 × 6 × 6 voxels and more, with centers at `count` of its vertices and three spheres along
 *  it of radii 0.1, 0.08 and 0.06 (solver space). */
inline Body made_bar_body(Index count) {
  MadeMesh mesh = made_box({4, 1, 1}, {8, 2, 2});
  mesh.positions.rowwise() += Eigen::RowVector3d(1, 2, 3);
  Body body;
  body.normalization = normalize(mesh.positions);
  const Vector3 half = Vector3(2, .5, .5) / body.normalization.diagonal;
  body.domain =
      domain_where(*make_grid(-half, half, 24), [&](const Vector3& p) { return (p.cwiseAbs().array() <= half.array()).all(); });
  body.positions = mesh.positions;
  body.triangles = mesh.triangles;
  for (Index c = 0; c < count; ++c) body.centers.push_back(static_cast<std::uint32_t>(c * mesh.positions.rows() / count));
  body.distance_scale = 1.2 / 65535;  // the bar's diagonal is 1
  for (Index c = 0; c < count; ++c)
    for (Index v = 0; v < body.domain.size(); ++v)
      body.distances.push_back(
          static_cast<std::uint16_t>(std::lround((body.domain.center(v) - body.center_position(c)).norm() / body.distance_scale)));
  for (int s = 0; s < 3; ++s) body.spheres.push_back({Vector3(.25 * (s - 1), 0, 0), .1 - .02 * s});
  return body;
}

}  // namespace handlebody::test
