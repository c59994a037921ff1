// Linear interpolation on the Delaunay simplices of the points (2014 course, §4.1), in any dimension and without a triangulation:
// for every query the simplex that contains it is found, and its barycentric coordinates are the weights.
//
//   f(x) = Σ wᵢ fᵢ,   with w ≥ 0, Σ wᵢ = 1 and Σ wᵢ pᵢ = x inside the convex hull.
//
// So it interpolates, reproduces linear functions, never leaves the range of the values, is continuous, and has kinks.
//
// **Cospherical points** (grids, circles) leave open which simplex. The rule here: of all weights of points on the empty sphere,
// those of least Σ wᵢ². They depend neither on the order of the points nor on rotation, translation or scale, and the center of a
// square gets ¼ of each corner. On a face that two cells share only the face's points can have weight, so that the function is
// continuous. Points are cospherical to 1e-9 (DelaunayCell::cospherical); nearly cospherical points beyond that have a Delaunay
// simplex like all others.
//
// **Outside the hull** the value is that of the nearest point of the hull (constant along its normals), or NaN. Inside means up to
// 1e-12 of the diagonal of the points' bounding box, plus the coordinates' own rounding (4 ε of the largest), as for NearestInHull.
//
// **Points that span less than the space** (to 1e-9 of the diagonal), such as points on a line, or one or two, are interpolated in
// their span, onto which queries are projected; a query farther than 2e-9 diagonals from it is outside.
#pragma once

#include "core/interpolation/delaunay_cell.hpp"
#include "core/interpolation/interpolant.hpp"
#include "core/interpolation/least_norm_weights.hpp"
#include "core/interpolation/nearest_in_hull.hpp"

namespace handlebody {

class SimplexLinear final : public Interpolant {
 public:
  /** Fails with the codes of check_data(). Linear in the number of points, but for the search for duplicates. */
  static Result<SimplexLinear> create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                      OutsideHull outside = OutsideHull::nearest);

  bool differentiable() const override { return false; }

 private:
  struct Frame;

  SimplexLinear(ScatteredData data, OutsideHull outside, Frame frame);

  void weigh(const double* query, double* w, double* slopes) override;
  bool weigh_cell(double* w);

  OutsideHull outside_;
  Vector center_;    // d: the point nearest to their mean
  double scale_;     // their diagonal; 1 where that is 0
  Matrix axes_;      // r×d, orthonormal: of the span; 0×d where that is the whole space
  Matrix points_;    // n×r: in the frame of center, scale and axes
  double radius_;    // no point is farther from the center
  double rounding_;  // of the coordinates as given, diagonals
  DelaunayCell cell_;
  LeastNormWeights least_norm_;
  NearestInHull hull_;
  Vector offset_;  // d: the query from the center
  Vector place_;   // r: the query in the frame
};

}  // namespace handlebody
