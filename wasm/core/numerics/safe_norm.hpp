// Lengths that neither overflow nor vanish before they have to, as squares of very large and very small numbers do.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** ‖x‖; infinite or NaN where a number of x is. Eigen's stableNorm(), 1.5 kB of code for every kind of expression, once. */
double safe_norm(const Vector& x);

/** ‖x − y‖ likewise, of `dimension` coordinates. Infinite where a coordinate's difference is. Asked for every pair of a query and a
 * point, nearly all of which need no more than the root of the sum of squares; stableNorm() would look at each for its size first.
 */
double safe_distance(const double* x, const double* y, Index dimension);

}  // namespace handlebody
