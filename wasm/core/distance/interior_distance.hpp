// The four ways to measure interior distances (paper 001, §4.1) behind one interface.
#pragma once

#include <memory>

#include "core/distance/voxel_domain.hpp"
#include "core/errors/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

enum class DistanceMethod : unsigned {
  fast_marching = 0,
  euclidean = 1,  // for convex shapes, and to compare with interior distances
  heat = 2,
  mean_value = 3,
};
constexpr unsigned distance_method_count = 4;

/** Distances from one source after another on one domain, which must outlive it: step until ready, then measure. */
class InteriorDistance {
 public:
  virtual ~InteriorDistance() = default;

  /** A bounded part of what all sources share. Returns the part done, 1 when ready. */
  virtual Result<double> step() { return 1.0; }

  /** Interior distances from `source` (anywhere in or near the domain) to every voxel center, into `distances` (domain.size());
   *  +infinity where there is no path. */
  virtual void measure(const Vector3& source, double* distances) = 0;
};

/** Mean value distances also need the surface, in the domain's units: they fail with MESH_OPEN, MESH_NOT_CONNECTED or OUT_OF_MEMORY
 *  (see mean_value_distance.hpp). */
Result<std::unique_ptr<InteriorDistance>> make_interior_distance(DistanceMethod method, const VoxelDomain& domain,
                                                                 const Points& positions, const Triangles& triangles);

}  // namespace handlebody
