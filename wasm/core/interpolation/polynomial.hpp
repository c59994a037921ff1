// Polynomials of d variables up to a small degree: what polynomial_space.hpp is made of. They are
// sums of monomials, in this order: 1; x₁ … x_d; x₁x₁, x₁x₂ … x₁x_d, x₂x₂ … x_dx_d (xᵢxⱼ for i ≤ j).
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** Monomials up to `degree` in `dimension` variables: 0 for degree −1, then 1, 1 + d, 1 + d + d(d+1)/2. */
Index polynomial_count(int degree, Index dimension);

/** All monomials (count) up to `degree`, −1 to 2, at `x` (d). */
void polynomial_values(const double* x, Index dimension, int degree, double* out);

/** Their gradients (count×d) at `x` (d). */
void polynomial_gradients(const double* x, Index dimension, int degree, double* out);

}  // namespace handlebody
