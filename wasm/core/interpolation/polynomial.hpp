// Monomials up to degree 2 in any dimension, in the order 1; x₁ … x_d; x₁x₁, x₁x₂ … x₁x_d, x₂x₂ … x_dx_d.
#pragma once

#include "core/numerics/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** How many there are: 0 for degree −1, then 1, 1 + d, (d + 1)(d + 2)/2. */
Index polynomial_count(int degree, Index dimension);

/** All of them at x (d): out polynomial_count(). */
void polynomial_values(const double* x, Index dimension, int degree, double* out);

/** Their gradients at x: out polynomial_count() × d, row-major. */
void polynomial_gradients(const double* x, Index dimension, int degree, double* out);

/** Whether a polynomial of the degree is determined by its values at `points` (n×d, centered and scaled to about unit size). Fails
 * with POINTS_TOO_FEW or POINTS_DEGENERATE, which say what the points span. O(n · count²). */
Result<Done> check_unisolvent(const Matrix& points, int degree);

}  // namespace handlebody
