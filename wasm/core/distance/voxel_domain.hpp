// The interior of a surface as a set of voxels: the grid on which interior distances are computed (paper 001, §4.1 "FMM").
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/errors/result.hpp"
#include "core/mesh/triangle_tree.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** A regular grid; the center of voxel (i, j, k) is origin + spacing·(i, j, k), its linear index i + nx·(j + ny·k). */
struct Grid {
  Vector3 origin = Vector3::Zero();
  double spacing = 0;
  std::array<std::int32_t, 3> dims{0, 0, 0};

  std::int64_t size() const { return std::int64_t{dims[0]} * dims[1] * dims[2]; }
  std::int64_t linear(int i, int j, int k) const { return i + std::int64_t{dims[0]} * (j + std::int64_t{dims[1]} * k); }
  Vector3 center(std::int64_t linear_index) const;

  /** (i, j, k) of a linear index. */
  std::array<std::int32_t, 3> cell(std::int64_t linear_index) const;
};

/** The grid over a box, `resolution` voxels along its longest side, with an empty margin of two voxels all round. The box is
 *  centered in the grid, so that a symmetric model gets a symmetric grid.
 *  @errors HB_ERROR_INVALID_OPTION (resolution below 1), HB_ERROR_MESH_NOT_FINITE, HB_ERROR_MESH_ZERO_EXTENT,
 *          HB_ERROR_MESH_TOO_LARGE (more than 64 million voxels) */
Result<Grid> make_grid(const Vector3& low, const Vector3& high, int resolution);

/** The voxels of `grid` that lie inside, ascending by linear index, and the compact number of each. */
class VoxelDomain {
 public:
  VoxelDomain() = default;
  VoxelDomain(const Grid& grid, std::vector<std::uint32_t> voxels);

  const Grid& grid() const { return grid_; }
  const std::vector<std::uint32_t>& voxels() const { return voxels_; }
  Index size() const { return std::ssize(voxels_); }
  Vector3 center(Index voxel) const { return grid_.center(voxels_[voxel]); }

  /** Compact number of the voxel at linear index, or -1 outside the domain (or outside the grid). */
  std::int32_t number(std::int64_t linear_index) const;
  std::int32_t number(int i, int j, int k) const;

  /** Compact number of the voxel whose center is nearest to `point` (the lowest of equals), or -1 if the domain is empty. The
   *  search goes outward from the point, so it is quick near the domain, and by blocks of 8³ voxels far away. */
  std::int32_t nearest(const Vector3& point) const;

  /** Compact numbers of the six face neighbors of each voxel, in the order -x +x -y +y -z +z; `size()` stands for none. One more
   *  row, for `size()` itself, closes the table: neighbors of none are none. */
  std::vector<std::int32_t> face_neighbors() const;

 private:
  Grid grid_;
  std::vector<std::uint32_t> voxels_;
  std::vector<std::int32_t> numbers_;                // grid.size() entries
  std::vector<std::array<std::int32_t, 3>> blocks_;  // that hold voxels, by their first cells
};

/** The face-connected part that each voxel belongs to, numbered from 0 in the order of their first voxels. */
std::vector<std::int32_t> face_components(const VoxelDomain& domain);

/** Joins separate face-connected parts of a voxel set by one-voxel-wide bridges along their shortest gaps, so that every interior
 *  distance is finite (eyes in a head, buttons on a coat). The bridges are a minimum spanning tree of the parts, where the length
 *  of a gap is the number of voxels to fill; the work is linear in the part of the grid that lies within the longest gap. `voxels`
 *  ascends before and after. Returns how many bridges it laid. */
int bridge_components(const Grid& grid, std::vector<std::uint32_t>& voxels);

}  // namespace handlebody
