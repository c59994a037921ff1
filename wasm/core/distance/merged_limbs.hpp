// Where a grid is too coarse: there is outside between neighboring inside voxels, so that distances leap from limb to limb.
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

/** Appends the crossed links of one axis. Outside a closed surface is where its winding number is 0; of an open one, anything
 *  between two crossings. */
void find_crossed_links(const VoxelDomain& domain, const SurfaceCrossings& crossings, bool closed, std::vector<CrossedLink>& links);

struct MergedLimbs {
  Index links = 0;                  // number of links that join distant parts
  Vector3 place = Vector3::Zero();  // the middle of the largest cluster of them, solver space
  double gap = 0;                   // tenth percentile of the gaps there, in spacings
};

/** The crossed links that matter: those where the path from one end to the other without crossed links is longer than eight voxels.
 * In a narrowing crease, which no grid resolves to its end, it is shorter. Of more than 4,000 links a sample is examined. */
MergedLimbs find_merged_limbs(const VoxelDomain& domain, const std::vector<CrossedLink>& links);

}  // namespace handlebody
