#include "core/numerics/hyperbolic.hpp"

#include <cmath>

namespace handlebody {

Hyperbolic hyperbolic(double x_squared) {
  if (std::abs(x_squared) < 1) {
    // Σ qᵏ/(2k)!, Σ qᵏ/(2k+1)!, Σ 2(k+1) qᵏ/(2k+3)! by Horner's rule
    Hyperbolic sum{1, 1, 1};
    for (int k = 9; k > 0; --k) {
      sum.cosh = 1 + sum.cosh * x_squared / ((2 * k - 1) * (2 * k));
      sum.sinhc = 1 + sum.sinhc * x_squared / ((2 * k) * (2 * k + 1));
      sum.rest = 1 + sum.rest * x_squared / ((2 * k) * (2 * k + 3));
    }
    sum.rest /= 3;
    return sum;
  }
  const double x = std::sqrt(std::abs(x_squared));
  Hyperbolic out{};
  if (x_squared > 0) {
    const double grown = std::exp(x), decayed = 1 / grown;
    out = {(grown + decayed) / 2, (grown - decayed) / (2 * x), 0};
  } else {  // x = n π/2 + r; π/2 in two parts, the first of which times n is exact
    const double n = std::floor(x / 1.5707963267948966 + 0.5);
    const double r = (x - n * 1.57079632673412561417) - n * 6.07710050650619224932e-11;
    const Hyperbolic rest = hyperbolic(-r * r);
    const double cosine = rest.cosh, sine = r * rest.sinhc;
    const auto quadrant = static_cast<long long>(n) & 3;
    const double turned_cosine = quadrant & 1 ? sine : cosine, turned_sine = quadrant & 1 ? cosine : sine;
    out = {quadrant == 1 || quadrant == 2 ? -turned_cosine : turned_cosine, (quadrant & 2 ? -turned_sine : turned_sine) / x, 0};
  }
  out.rest = (out.cosh - out.sinhc) / x_squared;
  return out;
}

double exp_less_one(double x) {
  const double u = std::exp(x), difference = u - 1;
  return u == 1 ? x : difference == -1 ? -1 : difference * x / std::log(u);
}

double log_one_plus_over(double x) {
  const double u = 1 + x;
  return u == 1 ? 1 : std::log(u) / (u - 1);
}

}  // namespace handlebody
