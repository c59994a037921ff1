#include "core/irbf/sphere_tree.hpp"

#include <algorithm>

#include "core/numerics/indices.hpp"

namespace handlebody {

std::vector<Sphere> sphere_tree(const VoxelDomain& domain, const std::vector<double>& surface_distance,
                                const SpherePackingOptions& options, int level) {
  const Grid& grid = domain.grid();
  const auto count = static_cast<std::size_t>(domain.size());
  SpherePackingOptions all = options;
  all.max_spheres = options.max_spheres + (level > 0 ? 0 : 1);  // one more tells that a level has too many
  std::vector<Sphere> spheres;
  int edge = 2;
  while (edge < std::max({grid.dims[0], grid.dims[1], grid.dims[2]})) edge *= 2;
  for (int at_level = 1; edge >= 2; edge /= 2, ++at_level) {
    if (level > at_level && edge > 2) continue;
    std::array<std::int64_t, 3> cells{};
    for (int a = 0; a < 3; ++a) cells[a] = (grid.dims[a] + edge - 1) / edge;
    // The deepest voxel of each cell; of equals, to a millionth of a spacing, the first.
    std::vector<std::int32_t> deepest(static_cast<std::size_t>(cells[0] * cells[1] * cells[2]), -1);
    for (std::size_t v = 0; v < count; ++v) {
      const auto at = grid.cell(domain.voxels()[v]);
      std::int32_t& best = deepest[static_cast<std::size_t>(at[0] / edge + cells[0] * (at[1] / edge + cells[1] * (at[2] / edge)))];
      if (best < 0 || surface_distance[v] > surface_distance[best] + 1e-6 * grid.spacing) best = static_cast<std::int32_t>(v);
    }
    std::vector<std::uint8_t> candidates(count);
    for (const std::int32_t v : deepest) {
      if (v >= 0) candidates[v] = 1;
    }
    auto packed = pack_candidates(domain, surface_distance, all, candidates);
    if (!spheres.empty() && packed.size() > static_cast<std::size_t>(options.max_spheres)) break;
    spheres.swap(packed);
    if (level > 0) break;
  }
  return spheres;
}

}  // namespace handlebody
