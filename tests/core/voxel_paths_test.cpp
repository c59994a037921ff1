#include "core/irbf/voxel_paths.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace handlebody;

TEST_CASE("limbs that touch by edges or corners of voxels alone are not joined") {
  const Grid grid = *make_grid({0, 0, 0}, {1, 1, 1}, 16);
  std::vector<std::uint32_t> voxels;
  for (int i = 0; i < 6; ++i) voxels.push_back(static_cast<std::uint32_t>(grid.linear(3 + i, 5, 5)));
  for (int i = 0; i < 6; ++i) voxels.push_back(static_cast<std::uint32_t>(grid.linear(9 + i, 6, 5)));
  std::sort(voxels.begin(), voxels.end());
  const VoxelDomain domain(grid, voxels);
  const VoxelPaths paths = voxel_paths(domain, std::vector<double>(voxels.size(), 0.3 * grid.spacing));
  CHECK(std::count(paths.toward.begin(), paths.toward.end(), -1) == 2);
}
