// Natural neighbor interpolation in the plane (R. Sibson, A brief description of natural neighbour interpolation, in: Interpreting
// Multivariate Data, 1981). A query x added to the points would get a Voronoi cell, taken from the cells of its neighbors:
//
//   f(x) = Σ wᵢ fᵢ,   wᵢ = Aᵢ / Σ Aⱼ,   Aᵢ = area of what x's cell takes from the cell of pᵢ.
//
// Inside the convex hull w ≥ 0, Σ wᵢ = 1 and Σ wᵢ pᵢ = x (Sibson, A vector identity for the Dirichlet tessellation, 1980): so it
// interpolates, reproduces linear functions and never leaves the range of the values. It has one value and one gradient everywhere
// but at the points, where the surface has cusps. Nothing is triangulated, so neither depends on a triangulation. The sets in
//
//   cell = {y : |y − x| ≤ |y − pᵢ| for all i},   Aᵢ = area of {y in cell : |y − pᵢ| ≤ |y − pⱼ| for all neighbors j},
//
// are intersections of half-planes; the cell needs the nearest points only, those up to twice as far as its farthest vertex.
// A query takes O(n + k log n + k²) for k neighbors, of which there are about six.
//
// **Gradient.** As x moves, only the cell's own sides move to first order: with ℓᵢ and mᵢ the length and the midpoint of the side
// between x and pᵢ, ∇Aᵢ = ℓᵢ (mᵢ − x) / |pᵢ − x|, and the quotient rule does the rest. There is none at a point: NaN, closer than
// 1e-12 of the diagonal of the points' bounding box.
//
// **At the hull's boundary** the cell grows without bound and the weights become linear between the two points on both sides of x.
// **Outside** there are no cells: either the value at the nearest point of the hull, which is the continuous extension (constant
// along the hull's normals; the gradient is the part along the boundary), or NaN. Inside means up to 1e-12 of the diagonal, as in
// NearestInHull. What is inside by less than 1e-11 diagonals, or 2e-13 of the largest coordinate, counts as on the boundary.
// **Points on a line**, to the same accuracy, are all boundary: linear between neighbors, constant across and beyond. One point
// makes a constant.
//
// **Accuracy.** Weights are those of points moved by 1e-15 diagonals: right to 1e-14, close to points and to the boundary too, but
// to 1e-15/t only where points crowd within t diagonals or form a needle t thick. Gradients are right to 1e-15 over the distance to
// the nearest point or to the boundary, in diagonals.
#pragma once

#include "core/interpolation/convex_cell.hpp"
#include "core/interpolation/interpolant.hpp"
#include "core/interpolation/nearest_in_hull.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {

class NaturalNeighbor final : public Interpolant {
 public:
  /** Fails with INVALID_SHAPE where the points are not in the plane, or the codes of check_data(). */
  static Result<NaturalNeighbor> create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                        OutsideHull outside = OutsideHull::nearest);

 private:
  enum class Place { at_point, enclosed, open };

  NaturalNeighbor(ScatteredData data, OutsideHull outside);

  void weigh(const double* query, double* w, double* slopes) override;
  void measure(const double* x);
  Place surround(const double* x);
  void take_areas(double* w, double* slopes);
  void share_edge(Index i, Index j, double* w, double* slopes);
  void sift_down(Index at, Index size);
  Index pop(Index size);

  const double* point(Index i) const { return &data_.points(i, 0); }

  OutsideHull outside_;
  double low_[2], high_[2];  // the points' bounding box
  double per_diagonal_;      // 1 / its diagonal; 1 where that is 0
  NearestInHull hull_;
  double blur_;  // how far off the hull's boundary a point on it may seem, diagonals
  double far_;   // half the box that cells start from, diagonals: anything farther counts as at infinity

  // Scratch, around x and in diagonals.
  Matrix offsets_;          // n×2: pᵢ − x
  Vector squares_;          // n: |pᵢ − x|²
  Indices heap_;            // points, the nearest first
  Index own_ = 0;           // the point that x is at
  ConvexCell cell_, part_;  // of x; its part that is nearest to one neighbor
};

}  // namespace handlebody
