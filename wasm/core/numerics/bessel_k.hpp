// The modified Bessel functions K₀ and K₁ of a real argument, which C++'s library has and libc++ does not.
//
// Small arguments take the ascending series. Larger ones take Kᵥ(x) = ∫₀^∞ e^{−x cosh t} cosh νt dt with x(cosh t − 1) = u²,
//
//   K₀(x) = e⁻ˣ ∫₀^∞ 2e^{−u²} / √(2x + u²) du,      x K₁(x) = e⁻ˣ ∫₀^∞ 2e^{−u²} u² √(2x + u²) du,
//
// by the trapezoidal rule, which converges exponentially (Trefethen & Weideman, SIAM Review 56, 2014): its nodes do not depend on
// x.
#pragma once

namespace handlebody {

constexpr double euler_gamma = 0.57721566490153286061;

/** ∫₀^∞ 2e^{−u²} f(u²) du ≈ Σ weight·f(square): to 1e-16 where f's nearest branch point is that of √(2x + u²) with x ≥ 1, or with
 * complex x, |x| ≥ 2 and |arg x| ≤ π/4. */
struct GaussianRule {
  static constexpr int nodes = 30;
  double square[nodes];
  double weight[nodes];
};
extern const GaussianRule gaussian_rule;

/** To a relative error of 2e-15; infinite at x = 0, and 0 where e⁻ˣ underflows. x ≥ 0. */
double bessel_k0(double x);
double bessel_k1(double x);

}  // namespace handlebody
