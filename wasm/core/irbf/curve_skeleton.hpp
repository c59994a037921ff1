// A curve skeleton: a graph of curves through the middle of a body, one into every limb (paper 001, §4.2 "curve skeleton").
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {

struct SkeletonNode {
  Vector3 place;  // in the domain's space
  double radius;  // how far the surface is at least; within a voxel of the distance itself
};

/** A curve between two places where curves meet or end. */
struct SkeletonBranch {
  Indices nodes;  // in order from the end that is nearer to the root, half a voxel apart; ends where curves meet are shared
  std::int32_t parent = -1;  // the branch that this one goes on from, or −1 at the root
  bool starts_free = false;  // nothing goes on from its first node: the branch is a whole part, such as a bar
  bool ends_free = false;    // nor from its last: a tip
};

struct CurveSkeleton {
  std::vector<SkeletonNode> nodes;
  std::vector<SkeletonBranch> branches;  // a parent comes before its children
  Indices hubs;                          // nodes where branches meet
};

/** The skeleton of a domain whose voxels lie `depth` (≥ 0, in the unit of the spacing, and 0 on bridges) from the surface.
 *
 *  - Every face-connected part has one, in one piece. A part that is about a ball is one node, which starts and ends its branch.
 *  - A limb gets a branch if it reaches out of what it grows from by twice its own radius, or by three quarters of that one's and
 *    more than its own. Branches end about where the largest ball at the end of a limb has its center, and run down a spike.
 *  - Where curves meet so close together that spheres of 90% would overlap, they meet at one node, the deepest: a star of eight
 *    arms has one hub.
 *  - A ring is a branch that ends at the node where it starts, or hangs on a hub by both ends; neither end is free.
 *
 *  Near-linear in the voxels: 125,000 take 0.25 s, native. The same on every machine but for the last digits of places. */
CurveSkeleton curve_skeleton(const VoxelDomain& domain, const std::vector<double>& depth);

/** The length over which one smooth function may deform a body: where branches meet, half of a limb, so that a function about one
 *  limb hardly reaches the next (the mean of the branches' lengths, each weighted by itself, so that spikes count little); of a
 * body where none meet its whole length, with the balls at the ends. 0 for a skeleton without branches. */
double smooth_length(const CurveSkeleton& skeleton);

/** Nodes where a branch ends freely, each once, ascending. */
Indices tips(const CurveSkeleton& skeleton);

}  // namespace handlebody
