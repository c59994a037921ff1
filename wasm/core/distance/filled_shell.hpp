// The inside of a shell of voxels with gaps, as a dense point cloud or a soup of triangles makes it: close it, flood from outside.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"

namespace handlebody {

/** The voxels that those given (in any order) enclose, themselves included, ascending. The shell of voxels within r of a given one,
 *  faces, edges and corners, has no gaps for a large enough r; what a flood from outside does not reach, and does not when it has
 * been taken back by r, is inside: a morphological closing with its holes filled. The least r from 0 to 3 is taken at which r + 1
 * adds less than half as much again, as it does not where the shell has leaked. Empty where no r does, or where less than a
 * twentieth lies a voxel deep: nothing is enclosed, or the points are too sparse for this grid. */
std::vector<std::uint32_t> filled_shell(const Grid& grid, const std::vector<std::uint32_t>& voxels);

}  // namespace handlebody
