// Boggio's formula (1905): the Green's function of (−Δ)^m in the unit ball of d dimensions, with all derivatives of order below m
// zero on the sphere,
//
//   G(x, y) = k ‖x−y‖^(2m−d) ∫₁^(A/‖x−y‖) (v² − 1)^(m−1) v^(1−d) dv,    A² = ‖x−y‖² + b,   b = (1 − ‖x‖²)(1 − ‖y‖²).
//
// It is positive definite and not radial. Substituting v² = 1 + t/‖x−y‖² leaves an integral without singular factors in front:
//
//   G = k/2 ∫₀^b t^(m−1) (‖x−y‖² + t)^(−d/2) dt,   here with k = 2m − d, so that G(0, 0) = 1.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

struct ClampedPlate {
  int order = 2;        // m, with 2m > d
  Index dimension = 2;  // d

  /** G from the squared distance and b ≥ 0; 0 on the sphere. */
  double value(double squared, double b) const;

  /** ∂G/∂(squared distance); 0 at distance 0, where it may be infinite while its product with x − y vanishes or jumps. */
  double slope(double squared, double b) const;

  /** ∂G/∂b. */
  double boundary_slope(double squared, double b) const;
};

}  // namespace handlebody
