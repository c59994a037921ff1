#include "core/numerics/bessel_k.hpp"

#include <cmath>
#include <limits>

namespace handlebody {
namespace {

constexpr double largest_for_series = 2;
constexpr double underflow = 746;  // e⁻ˣ is 0 from here on

/** e^{−u²} at u = jδ by recurrence, in long double: evaluated by the compiler only, never at run time. */
constexpr GaussianRule make_rule() {
  constexpr double step = 0.23;
  constexpr long double ratio = 0.899604550995231498554037L;       // e^{−2δ²}
  long double gaussian = 1, factor = 0.948474855225604543571764L;  // e^{−δ²}
  GaussianRule rule{};
  for (int j = 0; j < GaussianRule::nodes; ++j, gaussian *= factor, factor *= ratio) {
    rule.square[j] = step * step * j * j;
    rule.weight[j] = static_cast<double>((j == 0 ? 1 : 2) * static_cast<long double>(step) * gaussian);
  }
  return rule;
}

struct SmallK {
  double k0, x_k1;
};

/** K₀ = Σ tₖ (ψₖ − ln(x/2)), tₖ = (x²/4)ᵏ/k!², ψₖ = Hₖ − γ; K₁ = −K₀′. */
SmallK series(double x) {
  const double y = x * x / 4, log_half = std::log(x / 2);
  double t = 1, psi = -euler_gamma;
  SmallK sum{psi - log_half, 1};
  for (int k = 1; k <= 13; ++k) {
    t *= y / (k * k);
    psi += 1.0 / k;
    sum.k0 += t * (psi - log_half);
    sum.x_k1 += t * (1 - 2 * k * (psi - log_half));
  }
  return sum;
}

}  // namespace

constinit const GaussianRule gaussian_rule = make_rule();

double bessel_k0(double x) {
  if (!(x > 0)) return std::numeric_limits<double>::infinity();
  if (x <= largest_for_series) return series(x).k0;
  if (x > underflow) return 0;
  double sum = 0;
  for (int j = 0; j < GaussianRule::nodes; ++j) sum += gaussian_rule.weight[j] / std::sqrt(2 * x + gaussian_rule.square[j]);
  return std::exp(-x) * sum;
}

double bessel_k1(double x) {
  if (!(x > 0)) return std::numeric_limits<double>::infinity();
  if (x <= largest_for_series) return series(x).x_k1 / x;
  if (x > underflow) return 0;
  double sum = 0;
  for (int j = 0; j < GaussianRule::nodes; ++j)
    sum += gaussian_rule.weight[j] * gaussian_rule.square[j] * std::sqrt(2 * x + gaussian_rule.square[j]);
  return std::exp(-x) * sum / x;
}

}  // namespace handlebody
