// Lengths of vectors that avoid the overflow and underflow of squares of very large and very small numbers.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** ‖x‖; infinite or NaN where a number of x is. Eigen's stableNorm(), 1.5 kB for every kind of expression, instantiated once. */
double safe_norm(const Vector& x);

/** ‖x − y‖ likewise, of `dimension` coordinates. Infinite where a coordinate's difference is. It is computed for every pair of a
 * query and a point, nearly all of which need only the root of the sum of squares; stableNorm() would examine the size of each
 * number first. */
double safe_distance(const double* x, const double* y, Index dimension);

}  // namespace handlebody
