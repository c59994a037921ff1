// Welding by position: renderers split vertices at texture seams and creases, a volume or a surface does not.
#pragma once

#include <cstdint>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

struct Weld {
  std::vector<std::uint32_t> unique;     // for each welded vertex, the first stored vertex there
  std::vector<std::uint32_t> to_unique;  // for each stored vertex, its welded vertex
};

/** Finds the stored vertices that share a position exactly (−0 equals 0). Welded vertices are numbered in stored order. */
Weld weld_vertices(const ConstPoints& positions);

/** Finds the vertices that are at one place for all that matters to a surface: at the same position exactly, or nearer than the
 * smaller of their `reach`es (one per vertex, 0 for exact only), which bridges what rounding has parted. Places of which each is
 * near the next are one. The result does not depend on the order of vertices, but for their numbers. */
Weld weld_vertices(const ConstPoints& positions, const Vector& reach);

/** How far apart rounding may put two corners in one place of a mesh with this diagonal, where a simplex with this longest edge is:
 * a millionth of the one, and a thousandth of the other. */
double rounding(double longest_edge, double diagonal);

/** m×3 or m×4 vertex numbers: triangles or tetrahedra. */
using ConstSimplices = Eigen::Ref<const Eigen::Matrix<std::uint32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/** The diagonal of the box of all that simplices use; 0 where there are none. */
double used_diagonal(const ConstPoints& positions, const ConstSimplices& simplices);

/** Finds the vertices that are one for all that goes along simplices: at the same position exactly, or so near that only rounding()
 * can have parted them, as the two ends of a lathe's seam. Positions must be finite, and indices in range. */
Weld weld_mesh(const ConstPoints& positions, const ConstSimplices& simplices);

/** `triangles` with welded indices. */
Triangles weld_triangles(const Weld& weld, const ConstTriangles& triangles);

}  // namespace handlebody
