// A baked body: a mesh with the interior distances and spheres that IRBF needs (paper 001, §1.2 "precomputation steps" 1–3).
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/errors/result.hpp"
#include "core/irbf/curve_skeleton.hpp"
#include "core/irbf/sphere_packing.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** Solver space is the model scaled to a unit bounding-box diagonal and centered on its box, so that λ, h and tolerances mean the
 *  same for every model. */
struct Normalization {
  Vector3 center = Vector3::Zero();
  double diagonal = 1;

  Vector3 to_solver(const Vector3& model) const { return (model - center) / diagonal; }
  Vector3 to_model(const Vector3& solver) const { return center + diagonal * solver; }
};

struct Body {
  Points positions;     // as stored, model units
  Triangles triangles;  // as stored
  Normalization normalization;
  VoxelDomain domain;                    // solver space, like all below
  std::vector<std::uint32_t> centers;    // stored vertex numbers
  std::vector<std::uint16_t> distances;  // centers × voxels: interior distance = distance_scale · code
  double distance_scale = 0;
  std::vector<Sphere> spheres;
  double smooth_length = 0;  // see curve_skeleton.hpp; 0 where it is not known

  // What the deformation does not need, kept to be looked at.
  CurveSkeleton skeleton;                     // without nodes for a sheet
  std::vector<std::int32_t> sphere_branches;  // of the skeleton, one per sphere, −1 beside it; empty for a sheet

  Points solver_positions() const;
  Vector3 center_position(Index center) const;
};

/** Checks that a mesh is not too large to bake or deform, by its counts alone: before anything is allocated for it. */
Result<Done> check_mesh_size(std::int64_t vertices, std::int64_t triangles);

/** Checks that a mesh, or a cloud of points without triangles, can be baked or deformed at all: sizes, finiteness, index ranges,
 *  extent. */
Result<Done> check_mesh(const ConstPoints& positions, const ConstTriangles& triangles, bool cloud = false);

/** The normalization of a checked mesh. */
Normalization normalize(const ConstPoints& positions);

/** Fails with MESH_ZERO_EXTENT where all vertices coincide, or MESH_NOT_FINITE where squares of coordinates would overflow. */
Result<Done> check_extent(const Normalization& normalization);

/** Checks that the arrays of a body from outside agree with each other before they are used. */
Result<Done> check_body(const Body& body);

}  // namespace handlebody
