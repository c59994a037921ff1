// Voxel domains that the tests make.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/distance/voxel_domain.hpp"

namespace handlebody::test {

/** The voxels of a grid whose centers satisfy `inside`. */
template <typename Inside>
VoxelDomain domain_where(const Grid& grid, Inside inside) {
  std::vector<std::uint32_t> voxels;
  for (std::int64_t c = 0; c < grid.size(); ++c) {
    if (inside(grid.center(c))) voxels.push_back(static_cast<std::uint32_t>(c));
  }
  return {grid, voxels};
}

/** The grid over [−1, 1]³. */
inline Grid cube_grid(int resolution) {
  return *make_grid({-1, -1, -1}, {1, 1, 1}, resolution);
}

inline Vector3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random);
  return Vector3(x, y, normal(random)).normalized();
}

}  // namespace handlebody::test
