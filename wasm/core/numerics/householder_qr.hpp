// Householder's QR factorization of tall matrices: least squares without squaring the condition number, as normal equations do.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

class HouseholderQr {
 public:
  /** Factors `a` (rows ≥ columns) in place of a copy. O(rows · columns²). */
  explicit HouseholderQr(MatrixXd a);

  Index rows() const { return a_.rows(); }
  Index columns() const { return a_.cols(); }

  /** R's element, i ≤ j. */
  double r(Index i, Index j) const { return i == j ? diagonal_[i] : a_(i, j); }

  /** x ← Qᵀx, or Qx, for a vector of `rows()`. */
  void apply_transposed(double* x) const;
  void apply(double* x) const;

  /** x ← R⁻¹x, or R⁻ᵀx, in the first `columns()` numbers. A zero on R's diagonal gives numbers that are not finite. */
  void solve_r(double* x) const;
  void solve_r_transposed(double* x) const;

 private:
  void reflect(Index k, double* x) const;

  MatrixXd a_;       // above the diagonal R, on and below it the reflectors' vectors
  Vector diagonal_;  // R's
  Vector scale_;     // 2/vᵀv of each reflector
};

}  // namespace handlebody
