// The volume that a closed, consistently oriented surface encloses, by the divergence theorem: Σ det(a, b, c) / 6 over its
// triangles.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** Negative where the triangles face inward. Corners are taken from the first vertex, so that a surface far from the origin keeps
 * its digits. Indices must be in range. */
double enclosed_volume(const ConstPoints& positions, const ConstTriangles& triangles);

}  // namespace handlebody
