// The Delaunay cell that contains a place x, in any dimension and without a triangulation. Of the linear program
//
//   minimize Σ wᵢ‖pᵢ − x‖²   where   Σ wᵢ (pᵢ − x) = 0,   Σ wᵢ = 1,   w ≥ 0
//
// the optimal basis is a simplex with an empty circumsphere around x. (Its dual finds, below all points lifted to the paraboloid,
// the plane that is highest at x; what the plane touches is a facet of the lower hull. The reduced cost of a point is its power
// with respect to the sphere.) All points on that sphere are the cell: d + 1 of them as a rule, more where points are cospherical.
//
// From one place to another only the right-hand side changes, so that any empty simplex is a start for the dual simplex method.
// Each pivot crosses the facet beyond which x lies, to the simplex on its other side: a walk. It starts from a simplex at the point
// nearest to x, which a walk from one fixed simplex finds when it is first needed; so an answer depends on x alone and not on
// earlier queries. A walk takes a few pivots of O(nd + d²). The inverse of the basis is kept and updated by each pivot, as the
// simplex method does and Eigen's factorizations do not.
#pragma once

#include <cstdint>

#include "core/numerics/indices.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class DelaunayCell {
 public:
  /** Points are on the sphere if their power is below this part of the squared radius, or of the squared unit, if that is less. */
  static constexpr double cospherical = 1e-9;

  /** `points` n×d, d ≥ 0, that span the space, of a size about 1 and around the origin, no two in one place. */
  explicit DelaunayCell(const Matrix& points);

  /** Looks for the cell of `place` (d), which must be no farther from the points than they are from each other. False where there
   * is none, outside the hull by more than rounding, where the points hardly span the space, so that no simplex was found, or where
   * a bound on the number of pivots is reached: by Bland's rule ties cannot cycle, but rounding might make them. Allocates nothing.
   */
  bool find(const double* place);

  /** The points of the cell found last, ascending. At a point, that point alone. */
  const Indices& members() const { return members_; }

 private:
  Index measure(const double* place);
  double affine(const double* coefficients, Index point) const;
  double steepness(Index row) const;
  void pivot(Index row, std::uint32_t point);
  void factor();
  void raise_plane();
  bool enter(Index row, double direction);
  bool bland() const;
  bool walk();

  Matrix points_;
  Vector place_;          // x
  Vector costs_;          // n: ‖pᵢ − x‖²
  Indices basis_;         // d+1
  Indices root_;          // d+1: the simplex from which walks to the points start
  bool spanned_ = false;  // whether there is one
  Indices former_;        // scratch of factor()
  Indices starts_;        // n×(d+1): bases at the points, where their first is not `no_index`
  Indices members_;       // room for n
  Matrix inverse_;  // (d+1)×(d+1): row k is barycentric coordinate k, (1, p − x) ↦ λₖ(p); its first number is λₖ(x)
  Vector column_;   // d+1: barycentric coordinates of the point that enters
  Vector plane_;    // d+1: the lifted plane through the basis, ‖p − x‖² ≥ plane · (1, p − x)
  double tie_ = 0;  // powers up to this count as zero
  Vector powers_;   // n: reduced costs
  Vector rates_;    // n: how fast they fall while the plane turns
  Index age_ = 0;   // of the inverse, pivots
  Index idle_ = 0;  // pivots since the plane last rose
};

}  // namespace handlebody
