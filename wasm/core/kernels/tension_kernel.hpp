// The kernel of eq. (2) of the 2014 course: the Green's function G(‖x‖) of
//
//   α Δ²G − β ΔG + γ G = δ      in 1, 2 or 3 dimensions,
//
// with which f = Σ wᵢ G(‖x − xᵢ‖) + tail, (G + σI)w + tail = y, minimizes
//
//   Σ (f(xᵢ) − yᵢ)²/σ + α ∫(∇²f)² + β ∫|∇f|² + γ ∫f²        (σ = 1 is eq. (2) as printed, σ = 0 interpolates).
//
// With a², b² the roots of αx² − βx + γ = 0 and g_k the Green's function of −Δ + k², which is e^{−kr}/(2k), K₀(kr)/(2π) or
// e^{−kr}/(4πr), G is a divided difference of g_k over k² (H. Mitášová & L. Mitáš, Mathematical Geology 25, 1993; P. Wessel &
// D. Bercovici, Mathematical Geology 30, 1998, for γ = 0),
//
//   G = (g_a − g_b) / (α (b² − a²)).
//
// Written in m = (a + b)/2 and h² = (b − a)²/4, both real, it has no special cases where the roots are equal (β² = 4αγ) or a
// complex pair (β² < 4αγ, G oscillates), and no cancellation where r is small or the roots are close. For example, in one dimension
//
//   G = e^{−mr} (cosh hr + m sinh(hr)/h) / (4α m (m² − h²)).
//
// Where γ = 0, constants have no energy, and where β = 0 as well, linear functions have none: the tail consists of these, and the
// kernel is determined only up to them. G(0) = 0 is chosen (C is Euler's constant):
//
//              1D                          2D                                3D
//   γ = 0      −(br + e^{−br} − 1)/(2αb³)  −(ln(br/2) + C + K₀(br))/(2παb²)  −(br + e^{−br} − 1)/(4παb²r)  b² = β/α
//   β = γ = 0  r³/(12α)                    r² ln r/(8πα)                     −r/(8πα)
//   α = 0      e^{−kr}/(2kβ) or −r/(2β)    –                                 –                             k² = γ/β
#pragma once

#include "core/errors/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class TensionKernel {
 public:
  /** r³/12. */
  TensionKernel() = default;

  /** Fails with INVALID_SHAPE (a dimension other than 1, 2 and 3) or INVALID_OPTION: a weight that is negative or not finite; all
   *  three zero; α = 0 in 2D and 3D, where G(0) is infinite, or with β = 0; or lengths (α/β)^½, (α/γ)^¼ beyond double precision. */
  static Result<TensionKernel> create(double alpha, double beta, double gamma, Index dimension);

  /** G(r), r ≥ 0, to about 1e-14 of its value, or where it oscillates, of its envelope. */
  double value(double r) const;

  /** G′(r); at r = 0 the limit from the right, which is not 0 where G has a kink: in 3D, and for α = 0. */
  double slope(double r) const;

  /** The degree of the tail, which consists of the functions without energy: −1 (γ > 0), 0 (γ = 0) or 1 (β = γ = 0). */
  int minimum_degree() const { return gamma_ > 0 ? -1 : beta_ > 0 ? 0 : 1; }

  /** The kernel for points whose coordinates are all multiplied by `scale`, times `factor`: scaled(s, c).value(s·r) = c·value(r),
   * up to the tail. */
  Result<TensionKernel> scaled(double scale, double factor = 1) const;

 private:
  /** Value and slope, in two dimensions where the roots are close or a complex pair. */
  struct Jet {
    double value, slope;
  };
  Jet series(double r) const;
  Jet quadrature(double r) const;

  int dimension_ = 1;
  double alpha_ = 1, beta_ = 0, gamma_ = 0;
  double a_ = 0, b_ = 0;  // the roots, a ≤ b; both √(ab) for a complex pair
  double ab_ = 0;         // √(γ/α)
  double m_ = 0;
  double h_ = 0, h2_ = 0;  // h2 < 0 and h = 0 for a complex pair
  double factor_ = 0;      // 1/(4αm)
  double log_ratio_ = 0;   // (ln b² − ln a²)/(b² − a²), the value in 2D at r = 0 up to a factor
};

}  // namespace handlebody
