// Spheres from an octree (paper 001, §4.2's alternative, after Bradshaw & O'Sullivan 2004).
#pragma once

#include "core/irbf/sphere_packing.hpp"

namespace handlebody {

/** Every occupied cell of an octree over the domain proposes the largest sphere inscribed at one of its voxels, at the deepest
 * level whose pruned spheres are no more than max_spheres; then they are pruned as in pack_spheres, larger first. While
 * pack_spheres follows bones, this spreads over the volume: broad parts get many spheres of similar size.
 *
 *  A `level` from 1 on, where one cell holds all, is taken as it is, or the finest where it is beyond that: its spheres are no more
 *  than max_spheres, the largest.
 *
 *  This is much simpler than Bradshaw and O'Sullivan's: they approximate the medial axis by a Voronoi diagram that is refined as it
 *  goes, and make a hierarchy of spheres that cover the object, for collisions; IRBF wants one level, inside and apart, and has
 *  distances on a grid. `medial_slope` is not used. */
std::vector<Sphere> sphere_tree(const VoxelDomain& domain, const std::vector<double>& surface_distance,
                                const SpherePackingOptions& options, int level = 0);

}  // namespace handlebody
