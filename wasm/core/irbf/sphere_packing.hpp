// Spheres that fill the volume (paper 001, §4.2): large first, 90% of the distance to the surface, pruned by overlap and size.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

struct Sphere {
  Vector3 center;
  double radius;
  Vector3 axis = Vector3::Zero();  // half the long axis of an ellipsoid that is `radius` thick about it; 0 for a sphere
};

inline bool is_long(const Sphere& sphere) {
  return !sphere.axis.isZero(0);
}

struct SpherePackingOptions {
  int max_spheres = 120;
  double shrink = 0.9;      // radius as a part of the distance to the surface
  double min_radius = 0.9;  // in voxel spacings
  double max_overlap = 0;   // two spheres may overlap by this part of the smaller radius; negative keeps them apart
  // Spheres are centered near the medial axis only: where the distance to the surface rises toward some neighbor by more than this
  // part of the step, a larger sphere lies that way. 1 admits every voxel, and then small spheres between a torso's large ones are
  // taken before those along a leg's bones: on the dog, 100 spheres left the lower legs bare, and a pulled paw drew out a ribbon.
  // This and the three above were picked by a sweep on the dog alone.
  double medial_slope = 0.9;
};

/** Greedy packing over the domain's medial voxel centers; `surface_distance[v]` is the distance of voxel v to the surface. Every
 *  face-connected part of the domain gets at least one sphere, the largest that fits at one of its voxels, even if that exceeds
 *  max_spheres, undercuts min_radius or overlaps. Spheres come largest first. Deterministic: distances within a millionth of a
 *  spacing are ties, and ties are broken by voxel index. Voxels of a bridge lie outside the surface: give them the distance 0. */
std::vector<Sphere> pack_spheres(const VoxelDomain& domain, const std::vector<double>& surface_distance,
                                 const SpherePackingOptions& options);

/** 1 for the voxels near the medial axis: those from which the distance to the surface rises by no more than `slope` of the way. */
std::vector<std::uint8_t> medial_voxels(const VoxelDomain& domain, const std::vector<double>& surface_distance, double slope);

/** As pack_spheres, where a voxel may be a center if it is a candidate (or its part's first), whatever `medial_slope` says. */
std::vector<Sphere> pack_candidates(const VoxelDomain& domain, const std::vector<double>& surface_distance,
                                    const SpherePackingOptions& options, const std::vector<std::uint8_t>& candidates);

/** Spheres for a domain without depth, as of an open sheet's voxels: equal ones at voxels spread farthest-first, so small that no
 * two touch. */
std::vector<Sphere> spread_spheres(const VoxelDomain& domain, int count);

}  // namespace handlebody
