// Spheres that fill the volume (paper 001, §4.2): large first, 90% of the distance to the surface, pruned by overlap and size.
#pragma once

#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

struct Sphere {
  Vector3 center;
  double radius;
};

struct SpherePackingOptions {
  int max_spheres = 100;
  double shrink = 0.9;       // radius as a part of the distance to the surface
  double min_radius = 0.5;   // in voxel spacings
  double max_overlap = 0.1;  // two spheres may overlap by this part of the smaller radius; negative keeps them apart
};

/** Greedy packing over the domain's voxel centers; `surface_distance[v]` is the distance of voxel v to the surface. Every
 *  face-connected part of the domain gets at least one sphere, the largest that fits at one of its voxels, even if that exceeds
 *  max_spheres, undercuts min_radius or overlaps. Spheres come largest first. Deterministic: distances within a millionth of a
 *  spacing are ties, and ties are broken by voxel index. Voxels of a bridge lie outside the surface: give them the distance 0. */
std::vector<Sphere> pack_spheres(const VoxelDomain& domain, const std::vector<double>& surface_distance,
                                 const SpherePackingOptions& options);

}  // namespace handlebody
