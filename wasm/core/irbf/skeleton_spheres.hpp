// Controlling spheres along a curve skeleton (paper 001, §4.2): 90% of the distance to the surface, pruned by overlap and size,
// larger first, but so that every limb keeps some.
#pragma once

#include <cstdint>
#include <vector>

#include "core/irbf/curve_skeleton.hpp"
#include "core/irbf/sphere_packing.hpp"

namespace handlebody {

struct SkeletonSphere : Sphere {
  std::int32_t branch;  // of the skeleton, or −1: on the root's hub, or beside the skeleton
};

struct SkeletonSphereOptions {
  SpherePackingOptions packing;  // `medial_slope` is for those beside the skeleton
  int least_per_branch = 3;      // fewer let a limb turn or bend as one piece with what it grows from
  bool fill = true;              // places beside the skeleton, in what is wide, while max_spheres allows more
  double fill_radius = 2;        // of the smallest of those, in spacings
};

/** Spheres at nodes of the skeleton of this domain, and beside it if wanted, each inside: its radius is less than its center's
 *  distance to the surface. Largest first.
 *
 *  - Two overlap by max_overlap of the smaller radius at most. A negative part keeps them apart.
 *  - A branch that is more than two voxels thick somewhere outside the spheres of others gets least_per_branch: where those of 90%
 *    are too few, all of the branch are made smaller until as many fit. Any other gets one at least, whatever min_radius says; only
 *    that one may overlap more than allowed, where a branch has no room at all. A part that is one node gets one.
 *  - Beyond max_spheres, branches lose all but those minima, and the places kept are spread over each: its largest sphere, then
 *    those farthest from what it has. Among branches the largest stay. The minima stand even if they exceed max_spheres.
 *  - A place where branches meet counts for the branch that leads there from the root.
 *
 *  Deterministic: radii within about a fourteenth are ties, which are taken in order along a branch, so that spheres touch. */
std::vector<SkeletonSphere> skeleton_spheres(const VoxelDomain& domain, const std::vector<double>& surface_distance,
                                             const CurveSkeleton& skeleton, const SkeletonSphereOptions& options);

}  // namespace handlebody
