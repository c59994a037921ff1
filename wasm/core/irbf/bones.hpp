// Ellipsoids as bones (paper 001, §2.4): one long ellipsoid instead of the small spheres that fill a straight part of a limb.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/irbf/curve_skeleton.hpp"
#include "core/irbf/sphere_packing.hpp"

namespace handlebody {

/** From end to end of a bone, in the domain's space. */
struct Bone {
  Vector3 from, to;
};

/** Straight runs of a skeleton's branches, outside of what they grow from: a branch is cut where it leaves the line between the
 * ends of a run by more than half of its own radius there (Douglas & Peucker). Runs that are less than four radii long are none. */
std::vector<Bone> straight_bones(const CurveSkeleton& skeleton);

/** The ellipsoid that ends where the bone ends, as thick as a part `shrink` of the depth of the voxels along it allows, and as a
 * ball at most. None where the way from end to end leaves the domain, or has no length. */
std::optional<Sphere> bone_ellipsoid(const VoxelDomain& domain, const std::vector<double>& depth, const Bone& bone, double shrink);

/** Puts ellipsoids before the spheres, each on the branch that is nearest to its middle (−1 without a skeleton), and leaves out
 * what they overlap, of one another the later. `branches` has one number a sphere. */
void add_bones(const std::vector<Sphere>& ellipsoids, const CurveSkeleton& skeleton, std::vector<Sphere>& spheres,
               std::vector<std::int32_t>& branches);

}  // namespace handlebody
