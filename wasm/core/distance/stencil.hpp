// Reading a voxel field at any point: trilinear weights where all eight voxel centers around the point are inside, moving least
// squares of first degree over the connected inside voxels near it otherwise. One stencil serves every center's field.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** Weights that sum to 1 and reproduce linear functions wherever the voxels used span them. Their magnitudes sum to at most 3,
 *  which reduces the slope only in the outermost corners. */
struct Stencil {
  std::vector<std::int32_t> voxels;  // compact voxel numbers
  std::vector<double> weights;
};

/** The stencil of `point`. Near the boundary only voxels that are face-connected, within the local window, to the inside voxel
 *  nearest to the point are used: a leg never reads the field of the leg beside it. Never empty unless the domain
 *  is: a point outside reads the nearest voxels, extrapolating over 1.5 spacings at most. */
Stencil make_stencil(const VoxelDomain& domain, const Vector3& point);

}  // namespace handlebody
