// Polynomials of d variables up to a small degree: what moving least squares fits, and the tail of radial basis functions. They are
// sums of monomials, in this order: 1; x₁ … x_d; x₁x₁, x₁x₂ … x₁x_d, x₂x₂ … x_dx_d (xᵢxⱼ for i ≤ j).
#pragma once

#include "core/errors/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** Monomials up to `degree` in `dimension` variables: 0 for degree −1, then 1, 1 + d, 1 + d + d(d+1)/2. */
Index polynomial_count(int degree, Index dimension);

/** All monomials (count) up to `degree`, −1 to 2, at `x` (d). */
void polynomial_values(const double* x, Index dimension, int degree, double* out);

/** Their gradients (count×d) at `x` (d). */
void polynomial_gradients(const double* x, Index dimension, int degree, double* out);

/** Whether `points` (n×d, moved near the origin and scaled to an ordinary size) determine a polynomial of `degree`, −1 to 2: only
 * the zero polynomial vanishes at all of them. Fails with POINTS_TOO_FEW, or POINTS_DEGENERATE where they lie on a line, a plane …
 * or, for degree 2, on a conic. Whether they do is decided to 1e-10, of the extent for degree 1; for degree 2 it does not depend on
 * how long and thin the set is. O(n·count²). */
Result<Done> check_unisolvent(const Matrix& points, int degree);

}  // namespace handlebody
