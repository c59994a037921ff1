// From values to the coefficients of a radial basis: linear in the values, factored once.
#pragma once

#include <memory>
#include <optional>

#include "core/interpolation/radial_basis.hpp"

namespace handlebody {

class LinearFit {
 public:
  virtual ~LinearFit() = default;

  /** Coefficients (m×size(), one row per output) for `values` (n×m). O(n² m). */
  virtual MatrixXd coefficients(const Matrix& values) const = 0;

  /** Values at the points (n×m) of the function with these coefficients (m×size()), from a fit that still holds its kernels:
   * computing them again takes a fifth of the time of fitting 400 points. */
  virtual std::optional<MatrixXd> fitted(const MatrixXd& /*coefficients*/) const { return std::nullopt; }

  /** 1-norm of the equations' matrix, and an estimate of its 1-norm condition number: never above it, and rarely below a third of
   * it. Infinite where the matrix is singular. */
  double norm() const { return norm_; }
  double condition() const { return condition_; }

 protected:
  double norm_ = 0, condition_ = 0;
};

/** Interpolation, or smoothing where `smoothing` λ > 0 (2014 course, §5.2; SciPy's `smoothing`):
 *
 *     [ R + λI  P ] [c]   [f]
 *     [   Pᵀ    0 ] [d] = [0]
 *
 *  with a center at each of the `points`. The polynomial part is not penalized, so that polynomials are kept whatever λ: a smoothed
 * thin plate becomes affine (Donato & Belongie 2002). λ takes the sign of the kernel, as if each were positive definite.
 *
 *  Where a theorem says that the kernel is definite on what the side conditions leave (kernel.hpp), they are eliminated by
 * Householder reflections and Cholesky does the rest, with half of the kernels and half of LU's work. Where it is not known to be,
 * as with unequal widths and normalized kernels, whose R is not symmetric, or where Cholesky finds it not to be in double
 * precision, the whole matrix is factored by LU. */
std::unique_ptr<LinearFit> fit_interpolant(RadialBasis& basis, const Matrix& points, double smoothing);

/** Least squares with as many centers as points, or fewer. Each point's misfit is weighted by `row_weights` (n, or empty for 1),
 * and there is weight decay λ (2014 course, eq. (3), (RᵀR + λI)⁻¹Rᵀd where there is no tail):
 *
 *     min ‖R c + P d − f‖² + λ‖c‖²,   P(centers)ᵀ c = 0
 *
 *  by QR of the stacked matrix, not by these normal equations, which square the condition number. The side conditions are met by
 *  writing c in a basis of their null space. */
std::unique_ptr<LinearFit> fit_least_squares(RadialBasis& basis, const Matrix& points, const Matrix& centers, double weight_decay,
                                             const Vector& row_weights);

/** The least-squares problem's matrix without weights: n × (number of free coefficients). For robust fits. */
MatrixXd design_matrix(RadialBasis& basis, const Matrix& points, const Matrix& centers);

}  // namespace handlebody
