// Choosing the width of a kernel from the data.
#pragma once

#include "core/interpolation/rbf.hpp"

namespace handlebody {

/** The mean distance of the points to their nearest neighbors in a metric (or empty); 0 where there is none. */
double metric_spacing(const Matrix& points, const MatrixXd& metric);

/** A multiple of the points' mean spacing: wide enough to be smooth between points, narrow enough to be well conditioned. 2 for the
 * Gaussian, the inverse multiquadric, the inverse quadratic and the compact inverse multiquadric, 1 for the multiquadric, 5 (the
 * radius of its support) for Wendland's and Buhmann's; for the clamped plate 1.5 times the radius of the points around their
 * middle; 1 for the caller's. */
double spacing_width(const Matrix& points, const RadialBasisOptions& options);

/** The width with the least sum of squared leave-one-out errors, among those with a condition number below 1e13: the best of a
 * geometric grid from ¼ to 32 spacings, then golden section. About 25 fits, O(n³) each; of more than 256 points, 256 spread over
 * them decide. */
double leave_one_out_width(const ScatteredData& data, const RbfOptions& options);

/** Whether a fit of at most 256 of the points, spread over them, has a condition number of at most `limit`. */
bool well_conditioned(const ScatteredData& data, const RbfOptions& options, double limit);

/** The largest width below the given one whose fit has a condition number of at most comfortable_condition; 0 where there is none
 * down to e⁻¹² of it. */
double comfortable_width(const ScatteredData& data, const RbfOptions& options);

}  // namespace handlebody
