// Tetrahedra that fill a surface, for weights and energies of solids: the voxels that the surface touches or encloses, six
// tetrahedra each (Kuhn 1960), which fit together across voxels.
#pragma once

#include <array>
#include <vector>

#include "core/errors/result.hpp"
#include "core/mesh/simplex_mesh.hpp"

namespace handlebody {

struct VoxelTetrahedra {
  SimplexMesh mesh;  // corners of the voxels, in the surface's units; no position that a triangle with an area uses is outside
  /** Where each vertex of the surface is: the four corners of its tetrahedron, and its barycentric coordinates, which are not
   * negative. */
  std::vector<std::array<std::uint32_t, 4>> corners;
  std::vector<std::array<double, 4>> coordinates;
};

/** `surface` is a triangle mesh in space; an open one encloses nothing and gets only the voxels that it touches. Cubes,
 * `resolution` (4 to 256) along the longest side of its box: that of what sound_surface() leaves of it. Limbs that come closer than
 * a voxel merge: raise the resolution then. Fails as check_simplex_mesh() and make_grid() do, or with INVALID_OPTION. */
Result<VoxelTetrahedra> make_voxel_tetrahedra(const SimplexMesh& surface, int resolution);

}  // namespace handlebody
