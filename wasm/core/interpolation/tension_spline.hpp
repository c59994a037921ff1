// Splines with tension in 1, 2 and 3 dimensions (2014 course, §4.2 and eq. (2)): the function that minimizes, over all of space,
//
//   Σ (f(xᵢ) − yᵢ)²/σ + α ∫(∇²f)² + β ∫|∇f|² + γ ∫f²,
//
// or, for σ = 0, α ∫(∇²f)² + β ∫|∇f|² + γ ∫f² among those through the points; σ = 1 is eq. (2). α makes it smooth, β reduces
// overshoot, γ makes it decay to 0 between and beyond the points, over lengths of (α/β)^½ and (α/γ)^¼. It is a radial basis
// interpolant with the kernel of tension_kernel.hpp and, for γ = 0, a polynomial tail. On a line it differs from the spline of
// tension_spline_1d.hpp, which ends at the last point: it goes on beyond, and only for β = γ = 0 straight, as the natural cubic
// spline.
#pragma once

#include "core/interpolation/rbf.hpp"

namespace handlebody {

struct TensionSplineOptions {
  double alpha = 1, beta = 0, gamma = 0;  // ≥ 0, α > 0 except on a line
  double smoothing = 0;                   // σ ≥ 0
};

/** O(n³). Fails with the codes of Rbf::create() and TensionKernel::create(). */
Result<Rbf> tension_spline(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                           const TensionSplineOptions& options = {});

}  // namespace handlebody
