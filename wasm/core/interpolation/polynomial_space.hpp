// The polynomials that points can tell apart: what a tail, or moving least squares, may ask of them.
//
// Points in general position determine every polynomial up to a degree, and the space is that of polynomial.hpp's monomials. Others
// do not: points on a line of the plane know nothing of a slope across it, points on a conic of one quadratic function. Of the
// polynomials with the same values at the points the space then has one, the simplest:
//
//   - it is constant across the points' span (in the metric of their coordinates), and a polynomial of coordinates z in that span,
//     in which the points have mean 0 and covariance 1;
//   - what of the quadratic ones vanishes at all points, up to linear ones, is left out: kept are those whose coefficients are
//     orthogonal to it (zᵢzⱼ counts √2, i < j, so that it does not matter how z is turned).
//
// So the least-norm solution of equations that are singular only for want of such points is the regular one here. It does not
// depend on the order of the points, nor on how they are moved, turned and scaled.
//
// Directions count as spanned when the points reach farther in them than 1e-10 of the longest, each axis relative to its own
// extent.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

class PolynomialSpace {
 public:
  PolynomialSpace() = default;

  /** `points` (n×d, near the origin, of an ordinary size), n ≥ 1; `degree` −1 to 2. O(n·size²). */
  PolynomialSpace(const Matrix& points, int degree);

  int degree() const { return degree_; }

  /** How many functions there are up to a degree; in all, of which there are never more than points. They come degree by degree. */
  Index count(int degree) const { return degree < 0 ? 0 : counts_[degree]; }
  Index size() const { return count(degree_); }

  /** Coordinates z of a place (d): r of them, at most d. As they are, where the points determine all polynomials. */
  Index rank() const { return rank_; }
  void coordinates(const double* x, double* z) const;

  /** z − z′ of places whose difference is `offset` (d): with all its digits, however far from the points' middle they are. */
  void turn(const double* offset, double* z) const;

  /** All functions (size()) at z. Those of z less a fixed origin span the same space. Allocates nothing, nor does any other call.
   */
  void values(const double* z, double* out);

  /** Their gradients (size()×d) by x. */
  void gradients(const double* z, double* out);

 private:
  /** Finds what the points determine: for degrees from 1 on. */
  void reduce(const Matrix& points);

  int degree_ = -1;
  Index dimension_ = 0, rank_ = 0;
  Index counts_[3] = {0, 0, 0};
  Matrix axes_;         // r×d, where the points do not determine all polynomials: z = axes x − shift
  Vector shift_;        // r
  MatrixXd quadratic_;  // r(r+1)/2 × kept: their coefficients; empty where all are kept
  bool reduced_ = false;
  Vector monomials_;  // scratch
  Matrix slopes_;     // scratch
};

}  // namespace handlebody
