// Robust fits of models with fewer centers than points (2014 course, §5.3): which points to trust.
#pragma once

#include "core/interpolation/radial_basis.hpp"

namespace handlebody {

/** Row weights (n, in [0, 1]) for a least-squares fit that is near the least sum of absolute misfits: iteratively reweighted least
 * squares, weight 1/max(misfit, δ) (Huber 1977), scaled to a largest weight of 1. `design` n×p, `values` n×m; a misfit is the norm
 * over the outputs. */
Vector least_absolute_weights(const MatrixXd& design, const Matrix& values);

/** Row weights (n, 0 or 1) by least median of squares (Rousseeuw 1984): of the exact fits through 3,000 random choices of p points
 * (always the same ones for the same data) the one with the least median misfit decides; points farther from it than 2.5 robust
 * standard deviations count 0. Withstands outliers up to half of the points; a choice without a bad point must be among those
 * tried, so p should be small. */
Vector least_median_weights(const MatrixXd& design, const Matrix& values);

}  // namespace handlebody
