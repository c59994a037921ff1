// Radial basis interpolation of scattered data: factor once, evaluate many times.
//
//   f(x) = Σᵢ cᵢ Rᵢ(‖x − xᵢ‖) + Σⱼ dⱼ pⱼ(x),    [ R  P ] [c]   [f]
//                                                [ Pᵀ 0 ] [d] = [0]       (2014 course, eqs. (1) of §4.4 and §5.2)
//
// with P the polynomials up to `degree`. Instead of coefficients for one set of values the class keeps those of all n cardinal
// functions, so that the value at x is Σ wₖ(x) fₖ for any values f:
//
//   w(x) = first n entries of [R(x) P(x)] · inverse of the block matrix,   wₖ(xᵢ) = 1 if i = k, else 0.
//
// `normalized` divides every basis function by their sum, φᵢ = Rᵢ / Σⱼ Rⱼ (eq. (1) of the IRBF paper; course §4.4.1). Constants are
// then in the span of the basis: the weights sum to 1 without a tail, and stay bounded far away.
//
// Inside, places are moved and scaled to a bounding box with a unit diagonal. This changes the conditioning and not the result:
// widths are scaled along, r and r³ are homogeneous, and r² ln r changes by a multiple of r², which the side conditions of its
// linear tail turn into a constant.
#pragma once

#include "core/kernels/kernel.hpp"
#include "core/numerics/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

struct RadialBasisOptions {
  Kernel kernel;            // width in units of the places
  int degree = -1;          // of the polynomial tail: −1 (none), 0 or 1; at least kernel.minimum_degree() unless normalized
  bool normalized = false;  // needs a kernel without zeros: gaussian, multiquadric or one of the inverse ones

  // One width a place instead of kernel.width (n, units of the places), or empty. Multiquadrics are then scaled by their widths,
  // √(hᵢ² + r²), so that all grow alike and the side condition Σcᵢ = 0 still cancels the growth. No theorem guarantees that
  // unequal widths give a regular matrix: create() checks the result.
  Vector widths = {};
};

class RadialBasisInterpolant {
 public:
  /** Factors the system for `places` (n×d, any d ≥ 1). O((n+p)³), p = 0, 1 or d + 1 polynomials.
   *
   * Fails with EXAMPLES_TOO_FEW (n = 0, or n < p), EXAMPLE_NOT_FINITE (culprit: the place), EXAMPLES_DEGENERATE (the places do not
   * determine the polynomials, e.g. on one line for degree 1; or the matrix is singular to double precision, as for coincident
   * places and for widths far beyond the spacing), or INVALID_OPTION. */
  static Result<RadialBasisInterpolant> create(const Eigen::Ref<const Matrix>& places, const RadialBasisOptions& options);

  Index size() const { return places_.rows(); }
  Index dimension() const { return places_.cols(); }

  /** The n cardinal weights at `query` (d). Allocates nothing; O(n(n+p)). Not const: it uses the object's own scratch space.
   * Finite for every query within 1e100 diagonals of the data. */
  void weights(const Eigen::Ref<const Vector>& query, Eigen::Ref<Vector> out);

  /** max |wₖ(xᵢ) − δᵢₖ| over the data, as checked by create(): at most 1e-6, and mostly below 1e-12. */
  double cardinal_error() const { return cardinal_error_; }

  /** 1-norm condition number of the scaled block matrix, from the n columns of its inverse that are kept: exact without a tail. */
  double condition() const { return condition_; }

 private:
  RadialBasisInterpolant() = default;

  void evaluate_basis(const Eigen::Ref<const Vector>& scaled_query, Eigen::Ref<Vector> out) const;

  Kernel kernel_;
  int degree_ = -1;
  bool normalized_ = false;
  Vector center_;      // d: data units
  double scale_ = 1;   // scaled = (x − center) · scale
  Matrix places_;      // n×d, scaled
  Vector widths_;      // n, scaled
  Vector amplitudes_;  // n: factor of each kernel
  MatrixXd cardinal_;  // n×(n+p): row k holds the coefficients of the k-th cardinal function
  Vector query_;       // d: scratch
  Vector basis_;       // n+p: scratch
  double cardinal_error_ = 0;
  double condition_ = 1;
};

}  // namespace handlebody
