#include "core/irbf/sphere_packing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

constexpr double tie = 1e-6;  // in spacings: distances that differ by rounding only are equal

/** Voxels by falling surface distance; ties in voxel order, whatever the rounding. */
Indices largest_first(const std::vector<double>& surface_distance, double spacing) {
  std::vector<std::int64_t> keys(surface_distance.size());
  for (std::size_t v = 0; v < keys.size(); ++v) keys[v] = std::llround(surface_distance[v] / (tie * spacing));
  return sorted_indices(keys.size(),
                        [&](std::uint32_t u, std::uint32_t v) { return keys[u] != keys[v] ? keys[u] > keys[v] : u < v; });
}

/** Marks the voxels whose centers lie in the sphere: no sphere that may only overlap in part can be centered there. */
void cover(const VoxelDomain& domain, const Sphere& sphere, std::vector<std::uint8_t>& covered) {
  const Grid& grid = domain.grid();
  std::array<int, 3> low{}, high{};
  for (int a = 0; a < 3; ++a) {
    const double middle = (sphere.center[a] - grid.origin[a]) / grid.spacing, radius = sphere.radius / grid.spacing;
    low[a] = static_cast<int>(std::clamp(std::ceil(middle - radius), 0.0, double(grid.dims[a])));
    high[a] = static_cast<int>(std::clamp(std::floor(middle + radius), -1.0, double(grid.dims[a] - 1)));
  }
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        const std::int32_t v = domain.number(i, j, k);
        if (v >= 0 && (domain.center(v) - sphere.center).squaredNorm() < sphere.radius * sphere.radius) covered[v] = true;
      }
    }
  }
}

/** Whether no neighbor is farther from the surface by more than `slope` of the way there: true on the medial axis, where the
 * distance has its ridge, and false on the slopes beside it, where it rises at rate 1. */
bool is_medial(const VoxelDomain& domain, const std::vector<double>& surface_distance, std::int32_t v, double slope) {
  const auto at = domain.grid().cell(domain.voxels()[v]);
  for (int k = -1; k <= 1; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const std::int32_t u = domain.number(at[0] + i, at[1] + j, at[2] + k);
        const double step = domain.grid().spacing * std::sqrt(i * i + j * j + k * k);
        if (u >= 0 && surface_distance[u] - surface_distance[v] > slope * step) return false;
      }
    }
  }
  return true;
}

}  // namespace

std::vector<Sphere> pack_spheres(const VoxelDomain& domain, const std::vector<double>& surface_distance,
                                 const SpherePackingOptions& options) {
  return pack_candidates(domain, surface_distance, options, medial_voxels(domain, surface_distance, options.medial_slope));
}

std::vector<std::uint8_t> medial_voxels(const VoxelDomain& domain, const std::vector<double>& surface_distance, double slope) {
  std::vector<std::uint8_t> medial(surface_distance.size());
  for (std::size_t v = 0; v < medial.size(); ++v) {
    medial[v] = is_medial(domain, surface_distance, static_cast<std::int32_t>(v), slope);
  }
  return medial;
}

std::vector<Sphere> pack_candidates(const VoxelDomain& domain, const std::vector<double>& surface_distance,
                                    const SpherePackingOptions& options, const std::vector<std::uint8_t>& candidates) {
  const std::vector<std::int32_t> component = face_components(domain);
  std::int64_t waiting =
      component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1;  // parts without a sphere
  std::vector<std::uint8_t> served(static_cast<std::size_t>(waiting)), covered(component.size());
  const double min_radius = options.min_radius * domain.grid().spacing;

  std::vector<Sphere> spheres;
  for (const std::uint32_t v : largest_first(surface_distance, domain.grid().spacing)) {
    const Sphere sphere{domain.center(v), options.shrink * surface_distance[v]};
    const bool first_of_part = !served[component[v]];
    const bool room = static_cast<std::int64_t>(spheres.size()) + waiting < options.max_spheres && sphere.radius >= min_radius;
    if (waiting == 0 && !room) break;  // the radii only fall from here on
    if (!first_of_part) {
      if (!room || covered[v] || !candidates[v]) continue;
      const auto too_close = [&](const Sphere& other) {
        const double gap = sphere.radius + other.radius - options.max_overlap * std::min(sphere.radius, other.radius);
        return (sphere.center - other.center).squaredNorm() < gap * gap;
      };
      if (options.max_overlap < 2 && std::any_of(spheres.begin(), spheres.end(), too_close)) continue;
    }
    spheres.push_back(sphere);
    if (first_of_part) served[component[v]] = true, --waiting;
    if (options.max_overlap <= 1) cover(domain, sphere, covered);
  }
  return spheres;
}

std::vector<Sphere> spread_spheres(const VoxelDomain& domain, int count) {
  std::vector<Sphere> spheres;
  const auto voxels = static_cast<std::size_t>(domain.size());
  std::vector<double> nearest(voxels, 1e300);
  std::size_t next = 0;
  for (std::size_t n = std::min(voxels, static_cast<std::size_t>(count)); n > 0; --n) {
    const Vector3 center = domain.center(static_cast<Index>(next));
    spheres.push_back({center, 0});
    for (std::size_t v = 0; v < voxels; ++v) {
      nearest[v] = std::min(nearest[v], (domain.center(static_cast<Index>(v)) - center).norm());
      if (nearest[v] > nearest[next]) next = v;
    }
  }
  double gap = 2 * domain.grid().spacing;
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    for (std::size_t t = 0; t < s; ++t) gap = std::min(gap, (spheres[s].center - spheres[t].center).norm());
  }
  for (Sphere& sphere : spheres) sphere.radius = 0.45 * gap;
  return spheres;
}

}  // namespace handlebody
