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
  } else {
    out = {std::cos(x), std::sin(x) / x, 0};
  }
  out.rest = (out.cosh - out.sinhc) / x_squared;
  return out;
}

}  // namespace handlebody
