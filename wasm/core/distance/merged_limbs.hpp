// Where a grid is too coarse: neighboring inside voxels with outside between them, so that distances leap from limb to limb.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/surface_crossings.hpp"
#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** Two face-neighboring inside voxels whose connecting segment leaves the surface and enters it again. */
struct CrossedLink {
  std::int32_t from, to;  // compact voxel numbers
  double gap;             // how far apart the surface's two sides are there, in spacings
};

/** Appends the crossed links of one axis. For a closed surface outside is where it does not wind; for another one, between two
 *  crossings. */
void find_crossed_links(const VoxelDomain& domain, const SurfaceCrossings& crossings, bool closed, std::vector<CrossedLink>& links);

struct MergedLimbs {
  Index links = 0;                  // that join what is far apart
  Vector3 place = Vector3::Zero();  // the middle of the largest cluster of them, solver space
  double gap = 0;                   // the narrowest there but for a tenth, in spacings
};

/** Of the crossed links those that matter: without crossed links the way from one end to the other is longer than eight voxels. In
 * a narrowing crease, which no grid resolves to its end, it is shorter. Of more than 4,000 links a sample is looked at. */
MergedLimbs find_merged_limbs(const VoxelDomain& domain, const std::vector<CrossedLink>& links);

}  // namespace handlebody
