#include "core/kernels/clamped_plate.hpp"

#include <cmath>

namespace handlebody {
namespace {

// Gauss–Legendre on [−1, 1], eight of its sixteen nodes: the others mirror them (Abramowitz & Stegun, table 25.4).
constexpr double nodes[8] = {0.0950125098376374402, 0.2816035507792589133, 0.4580167776572273863, 0.6178762444026437484,
                             0.7554044083550030339, 0.8656312023878317439, 0.9445750230732325761, 0.9894009349916499326};
constexpr double node_weights[8] = {0.1894506104550684963, 0.1826034150449235888, 0.1691565193950025382, 0.1495959888165767321,
                                    0.1246289712555338720, 0.0951585116824927848, 0.0622535239386478929, 0.0271524594117540949};

double power(double x, Index n) {
  double result = 1;
  for (; n > 0; --n) result *= x;
  return result;
}

/** x^(−d/2). */
double inverse_half_power(double x, Index d) {
  return 1 / (power(x, d / 2) * (d % 2 ? std::sqrt(x) : 1));
}

/** ½ ∫₀^b t^(m−1) (q + t)^(−d/2) dt, q > 0. */
double integral(double q, double b, int m, Index d) {
  if (b <= 4 * q) {  // smooth over the interval: sixteen nodes give full precision
    double sum = 0;
    for (int i = 0; i < 16; ++i) {
      const double t = b / 2 * (1 + (i < 8 ? -nodes[i] : nodes[i - 8]));
      sum += node_weights[i % 8] * power(t, m - 1) * inverse_half_power(q + t, d);
    }
    return sum * b / 4;
  }
  // With w² = q + t: ∫ (w² − q)^(m−1) w^(1−d) dw from √q to √(q + b), expanded. The last term dominates, so little cancels.
  const double low = std::sqrt(q), high = std::sqrt(q + b);
  double sum = 0, factor = 1;  // (m−1 choose j) (−q)^(m−1−j), from j = m − 1 down
  for (int j = m - 1; j >= 0; --j) {
    const Index e = 2 * j + 2 - d;  // ∫ w^(e−1) dw
    const double part = e == 0  ? std::log(high / low)
                        : e > 0 ? (power(high, e) - power(low, e)) / static_cast<double>(e)
                                : (1 / power(high, -e) - 1 / power(low, -e)) / static_cast<double>(e);
    sum += factor * part;
    factor *= -q * j / (m - j);
  }
  return sum;
}

}  // namespace

double ClampedPlate::value(double squared, double b) const {
  if (!(b > 0)) return 0;
  const Index e = 2 * order - dimension;
  // At distance 0 the integral is that of t^(m−1−d/2).
  if (!(squared > 1e-30)) return power(b, e / 2) * (e % 2 ? std::sqrt(b) : 1);
  return static_cast<double>(e) * integral(squared, b, order, dimension);
}

double ClampedPlate::slope(double squared, double b) const {
  if (!(b > 0) || !(squared > 1e-30)) return 0;
  const double k = static_cast<double>(2 * order - dimension), half = static_cast<double>(dimension) / 2;
  return -k * half * integral(squared, b, order, dimension + 2);
}

double ClampedPlate::boundary_slope(double squared, double b) const {
  if (!(b > 0)) return 0;
  const double k = static_cast<double>(2 * order - dimension);
  return k / 2 * power(b, order - 1) * inverse_half_power(squared + b, dimension);
}

}  // namespace handlebody
