// Area-weighted vertex normals.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** Unit normals (n×3), each the normalized sum of the cross products of the triangles around a vertex; a vertex without area gets
 *  (0, 1, 0). `normals` must have the size of `positions`; nothing is allocated. */
void vertex_normals(const PointsF& positions, const Triangles& triangles, PointsF& normals);

}  // namespace handlebody
