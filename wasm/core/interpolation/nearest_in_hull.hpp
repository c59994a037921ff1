// The nearest point of a convex hull, in any dimension and without the hull's faces: Wolfe's minimum-norm-point algorithm
// (P. Wolfe, Finding the nearest point in a polytope, Mathematical Programming 11, 1976).
//
// It keeps a *corral*: a few affinely independent points pₛ, with positive weights, whose affine span is nearest to the query x at
// their own convex combination z. While some point lies in front of the plane through z across x − z, that is (x − z)·(pᵢ − z) > 0,
// it joins; points whose weights would turn negative leave. Every corral is nearer than the one before, so none comes twice and the
// search ends, usually after a few times d steps. A step takes O(nd + d³).
//
// The corral's edges are factored by Gram–Schmidt, an edge at a time as it joins, in the object's own scratch space: Eigen's
// factorizations would start anew with every change.
#pragma once

#include <cstdint>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

/** What an interpolant that is defined in the hull returns outside of it. */
enum class OutsideHull {
  nearest,  // the value at the nearest point of the hull
  nan,
};

class NearestInHull {
 public:
  /** Queries closer to the hull than this part of the diagonal of the points' bounding box (plus 4 ε of the largest coordinate, for
   *  points far from the origin) are inside, at distance 0. */
  static constexpr double tolerance = 1e-12;

  /** `points` n×d, n ≥ 1, finite; they may coincide, or span fewer than d dimensions. All scratch space is made here. */
  explicit NearestInHull(const Matrix& points);

  /** Writes the hull's `nearest` point to `query` (d each; the query itself where that is inside) and, unless it is null, `weights`
   *  (n): at most d + 1 of them positive, the others 0, of sum 1 and mean `nearest`. Returns the distance. Allocates nothing.
   *  Finite for every finite query; one that is t > 1 diagonals away is answered to about 1e-15 t diagonals, which is its own
   *  rounding, and coordinates beyond 1e150 diagonals are clamped. If rounding keeps the search from ending, a bound on the number
   *  of steps stops it, and the nearest point so far is the answer. */
  double operator()(const double* query, double* nearest, double* weights);

 private:
  double* corner(Index k) { return points_.data() + corral_[k] * points_.cols(); }
  void combine();
  void leave(Index k);
  bool orthonormalize(Index from);
  void minimize_in_span();

  Matrix points_;  // n×d: centered, diagonal 1
  Vector center_;
  double diagonal_;
  double spread_;  // rounding errors of the points, diagonals

  // The corral and what it knows, all scratch: only the first `count_` entries mean anything.
  Index count_ = 0;
  std::vector<std::uint32_t> corral_;  // d+1
  Vector weights_, wanted_;            // d+1; of the convex combination, of the point of the span nearest to the query
  Matrix edges_;                       // (d+1)×d: row k is what corner k − corner 0 adds to the span, orthonormal
  Matrix factor_;                      // corner k − corner 0 = Σⱼ factor_(j, k) edges_(j), j ≤ k
  Vector query_, point_, across_;      // d: x, z, x − z
};

}  // namespace handlebody
