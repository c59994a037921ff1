// The exact spline in tension through points on a line, with zero slope at both ends (2014 course, §4.2, Fig. 11: the paper calls
// these ends Dirichlet's; they are Neumann's). It minimizes
//
//   α ∫f″² + β ∫f′²      between the first and the last point,      f(xᵢ) = yᵢ,   f′ = 0 at both,
//
// and stays constant beyond. Between points α f⁗ = β f″, so that it is made of 1, x, e^{bx} and e^{−bx}, b² = β/α; at points it has
// two continuous derivatives (D. Schweikert, J. Math. Phys. 45, 1966). β = 0 is the clamped cubic spline, and large β the polyline.
//
// The unknowns are the slopes mᵢ at the points: f″ at the ends of an interval of length H with chord slope s is
//
//   H f″ = −p (m₀ − s) − q (m₁ − s)   and   q (m₀ − s) + p (m₁ − s),     p, q = 4, 2 for cubics,
//
// whose continuity makes a tridiagonal, symmetric and diagonally dominant system: two sweeps over the points solve it, where a
// dense factorization would take O(n³).
#pragma once

#include <vector>

#include "core/interpolation/interpolant.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {

struct TensionSpline1dOptions {
  double alpha = 1;  // α > 0
  double beta = 0;   // β ≥ 0, in units of α over a squared length of the points
};

class TensionSpline1d final : public Interpolant {
 public:
  /** `points` n×1, in any order. O(nm) and a sort. Fails with the codes of check_data(), INVALID_SHAPE (another dimension) or
   * INVALID_OPTION. */
  static Result<TensionSpline1d> create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                        const TensionSpline1dOptions& options = {});

  void evaluate(const double* queries, Index count, double* out) override { combine(queries, count, out, false); }
  void gradient(const double* queries, Index count, double* out) override { combine(queries, count, out, true); }

 private:
  /** f or f′ = y₀ + rise (y₁ − y₀) + left m₀ + right m₁ on an interval; f′ without y₀. */
  struct Blend {
    double rise, left, right;
  };

  TensionSpline1d(ScatteredData data, double stiffness);

  void weigh(const double* query, double* w, double* slopes) override;
  void combine(const double* queries, Index count, double* out, bool derivative) const;
  Index interval_of(double x) const;
  Blend blend(Index interval, double x, bool derivative) const;
  void solve(double* rhs, Index first) const;

  double stiffness_;          // b
  Indices order_;             // the kept points from left to right
  std::vector<double> x_;     // n: their places
  std::vector<double> pull_;  // n − 1: (p + q)/H², the factor of the interval's rise in the right-hand sides of both its ends
  std::vector<double> over_;  // n: the matrix as L D Lᵀ: 1/D, and 0 at both ends, whose slope is known
  std::vector<double> link_;  // n: L's entry below the diagonal
  Matrix slopes_;             // n×m: mᵢ, from left to right
  std::vector<double> z_;     // n: scratch
};

}  // namespace handlebody
