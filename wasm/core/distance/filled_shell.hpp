// The inside of a shell of voxels with gaps, as from a dense point cloud or a triangle soup: close the gaps, flood from outside.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"

namespace handlebody {

/** The voxels that those given (in any order) enclose, themselves included, ascending: a morphological closing with its holes
 *  filled. The shell is all voxels within r of a given one, across faces, edges and corners; a large enough r leaves it no gaps.
 *  Inside is what a flood from outside does not reach even after it is dilated by r. The smallest r from 0 to 3 is taken at which
 *  r + 1 adds less than half as much again; where the shell leaks, it adds more. Empty where no r does, or where less than a
 *  twentieth lies a voxel deep: nothing is enclosed, or the points are too sparse for this grid. */
std::vector<std::uint32_t> filled_shell(const Grid& grid, const std::vector<std::uint32_t>& voxels);

}  // namespace handlebody
