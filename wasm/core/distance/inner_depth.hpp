// Reading the distance to the surface between voxel centers, on the safe side.
#pragma once

#include <vector>

#include "core/distance/voxel_domain.hpp"

namespace handlebody {

/** How far the surface is at least from a point inside, in the unit of the spacing; 0 outside the domain. Exact at voxel centers,
 *  and otherwise from the voxels around: their trilinear mean less what the curvature of level sets can make of it, or what a
 *  distance that changes at rate 1 must be, whichever is more. */
double inner_depth(const VoxelDomain& domain, const std::vector<double>& depth, const Vector3& point);

}  // namespace handlebody
