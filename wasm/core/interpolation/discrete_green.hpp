// Where radial kernels come from (2014 course, §5.4–5.6), on a line of N samples at unit spacing. A curve f through given samples,
// S f = d, that is as smooth as possible in terms of a difference operator D,
//
//   min ‖D f‖²  with  S f = d,    so that    DᵀD f + Sᵀλ = 0                             (eq. (4) and its derivative)
//
// is found in two ways that agree:
//
//   on the grid,  [ DᵀD  Sᵀ ] [f]   [0]          by radial functions,  [ S G Sᵀ    S N ] [λ]   [d]
//                 [  S   0  ] [λ] = [d]                                [ (S N)ᵀ     0  ] [c] = [0],    f = G Sᵀλ + N c   (eq. (5))
//
// (up to λ's sign) with Green's matrix G, DᵀD G = I. Where DᵀD is singular, with null space N (N columns, orthonormal), G is the
// upper left block of the inverse of the bordered matrix
//
//   [ DᵀD  N ]⁻¹   [ G  N ]
//   [ Nᵀ   0 ]   = [ Nᵀ 0 ],    DᵀD G = I − N Nᵀ,
//
// and N c is the polynomial of §5.2, (S N)ᵀλ = 0 its side condition. With m = |i − j| and up to polynomials in i and j the kernels
// are −m/2 (first differences; linear interpolation), (m³ − m)/12 (second; the cubic spline's r³/12 but for a grid's m) and −m(m² −
// 1)(m² − 4)/240 (third; the quintic's).
//
// Boundaries, for a D of order k made of first differences D₁; what lies beyond the ends is
//   free        nothing: only differences that fit, N − k rows; N: polynomials of degree below k
//   dirichlet   0: D₁ has N + 1 rows, D₂ = −D₁ᵀD₁ is the course's matrix, N rows, D₃ = D₁D₂; regular
//   neumann     the end's own value, no slope: D₁ has N − 1 rows, D₂ = −D₁ᵀD₁, D₃ = D₁D₂; N: constants
//   periodic    the other end: N rows; N: constants
// DᵀD is then the k-th power of D₁ᵀD₁ except where the ends are free.
//
// Accuracy. G is integrated or in closed form, to about 1e-13 of its largest element. The grid is solved by elimination: the
// samples are known, and the rest minimizes ‖D f‖ by Givens rotations, whose errors grow with the longest gap as gapᵏ and not
// gap²ᵏ. Radial functions lose digits to cancellation in G Sᵀλ: 1e-16 of the largest of G times that of λ.
#pragma once

#include <cstdint>
#include <vector>

#include "core/errors/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

enum class GridBoundary : std::uint32_t { free = 0, dirichlet = 1, neumann = 2, periodic = 3 };
constexpr unsigned grid_boundary_count = 4;

class DiscreteGreen {
 public:
  /** `samples` (count, from 0 to size − 1) with their `values`; `order` of the differences 1 to 3; `size` above that and at most
   * 1024. Fails with INVALID_OPTION (order, size, or a sample outside the grid), POINT_DUPLICATE, VALUE_NOT_FINITE (culprit: which
   * of the samples), or POINTS_TOO_FEW (none, or fewer than the null space's dimension). O(size²). */
  static Result<DiscreteGreen> create(Index size, int order, GridBoundary boundary, const std::uint32_t* samples,
                                      const double* values, Index count);

  Index size() const { return green_.rows(); }
  Index samples() const { return values_.size(); }
  const Matrix& difference() const { return difference_; }  // D, rows as above × N
  const Matrix& null_space() const { return null_space_; }  // N × 0 to 3
  const Matrix& green() const { return green_; }            // G, N×N

  /** DᵀD (N×N). */
  Matrix squared() const;

  /** f (N) by the grid, O(Nk²), or O(N²) where periodic. */
  void solve_grid(double* f) const;

  /** f (N) by radial functions, O(n³ + nN) for n samples, and, unless null, their weights λ and c (n + columns of N). */
  void solve_radial(double* f, double* weights = nullptr) const;

 private:
  DiscreteGreen() = default;

  Matrix difference_, null_space_, green_;
  std::vector<Index> samples_;
  Vector values_;
};

}  // namespace handlebody
