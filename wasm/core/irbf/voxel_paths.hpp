// Centered paths of voxels into every limb of a domain: what a curve skeleton is made of (paper 001, §4.2).
//
// After TEASAR (Sato, Bitter, Bender, Kaufman & Nakajima, "TEASAR: tree-structure extraction algorithm for accurate and robust
// skeletons", Pacific Graphics 2000): from the voxel that is farthest from the paths so far, the path to them that keeps from the
// surface, until every voxel lies in a ball around a path. Different from there:
//  - A step costs 1/depth³, which centers a path in a thin limb as it does in a torso: (1 − depth/deepest)¹⁶ hardly tells the axis
//    of a finger from its skin.
//  - Paths lead to the nearest path, not to the root, so that limbs meet where they are joined.
//  - A path is kept if it leads along a limb, by how far it reaches out of the balls compared with its own depth and theirs. A ball
//    enlarged by a factor and a constant, as there, loses the ears of a thick head, or takes the corners of a box for limbs.
//  - Where two ways lead around a hole, both are taken.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"

namespace handlebody {

struct VoxelPaths {
  std::vector<std::int32_t> voxels;                // compact voxel numbers, each once; a voxel comes after the one that it leads to
  std::vector<std::int32_t> toward;                // the place in `voxels` of the next one toward the root; −1 for a root
  std::vector<std::array<std::int32_t, 2>> loops;  // places in `voxels` of two neighbors that close a way around a hole
};

/** One tree of paths for each face-connected part, its root the deepest voxel. `depth` holds every voxel's distance to the surface,
 *  at least 0 (0 on bridges), in the unit of the grid's spacing. Near-linear in the voxels. Depths that agree to a millionth of a
 *  spacing are equal, costs are whole numbers, and ties are broken by voxel number: the same on every machine. */
VoxelPaths voxel_paths(const VoxelDomain& domain, const std::vector<double>& depth);

}  // namespace handlebody
