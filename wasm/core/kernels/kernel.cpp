#include "core/kernels/kernel.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/elementary.hpp"

namespace handlebody {
namespace {

constexpr int all_dimensions = 1000;

template <typename Function>
void each(double* squared, Index count, Function function) {
  for (Index i = 0; i < count; ++i) squared[i] = function(squared[i]);
}

/** function(q, ln q), a chunk at a time; ln 0 is some finite number. */
template <typename Function>
void each_with_logarithm(double* squared, Index count, Function function) {
  constexpr Index chunk = 64;
  double logs[chunk];
  for (Index first = 0; first < count; first += chunk, squared += chunk) {
    const Index width = std::min(chunk, count - first);
    std::copy(squared, squared + width, logs);
    logarithms(logs, width);
    for (Index i = 0; i < width; ++i) squared[i] = function(squared[i], logs[i]);
  }
}

/** x^n for small n ≥ 0: std::pow is large, and slower. */
double power(double x, int n) {
  double result = 1;
  for (; n > 0; n >>= 1, x *= x)
    if (n & 1) result *= x;
  return result;
}

/** r^e of the squared distance. */
double power_of_root(double squared, int e) {
  const double even = power(squared, e / 2);
  return e % 2 ? even * std::sqrt(squared) : even;
}

/** f(s) within the unit support of a compact kernel. */
template <typename Function>
void within(double* squared, Index count, Function function) {
  each(squared, count, [&](double q) { return q < 1 ? function(std::sqrt(q)) : 0; });
}

}  // namespace

Kernel Kernel::of(KernelKind kind, double width, Index dimension, int order) {
  Kernel kernel{kind, width};
  const int half = static_cast<int>(dimension / 2);
  switch (kind) {
    case KernelKind::polyharmonic:
      // Whoever takes the order checks it; here it is only not to overflow.
      kernel.exponent = 2 * std::clamp(order, 0, 1000) - static_cast<int>(dimension);
      break;
    case KernelKind::wendland_c0:
      kernel.exponent = half + 1;
      break;
    case KernelKind::wendland_c2:
      kernel.exponent = half + 2;
      break;
    case KernelKind::wendland_c4:
      kernel.exponent = half + 3;
      break;
    default:
      break;
  }
  return kernel;
}

double Kernel::operator()(double r) const {
  const double s = has_width() ? r / width : r;
  double value = s * s;
  values(&value, 1);
  return value;
}

void Kernel::values(double* squared, Index count) const {
  switch (kind) {
    case KernelKind::linear:
      return each(squared, count, [](double q) { return std::sqrt(q); });
    case KernelKind::cubic:
      return each(squared, count, [](double q) { return q * std::sqrt(q); });
    case KernelKind::quintic:
      return each(squared, count, [](double q) { return q * q * std::sqrt(q); });
    case KernelKind::thin_plate:
      return each_with_logarithm(squared, count, [](double q, double log) { return 0.5 * q * log; });
    case KernelKind::polyharmonic:
      return each(squared, count, [e = exponent](double q) {
        if (e % 2) return power_of_root(q, e);
        return q > 0 ? 0.5 * std::log(q) * power(q, e / 2) : 0;
      });
    case KernelKind::gaussian:
      return decaying_exponentials(squared, count);
    case KernelKind::multiquadric:
      return each(squared, count, [](double q) { return std::sqrt(1 + q); });
    case KernelKind::inverse_multiquadric:
      return each(squared, count, [](double q) { return 1 / std::sqrt(1 + q); });
    case KernelKind::inverse_quadratic:
      return each(squared, count, [](double q) { return 1 / (1 + q); });
    case KernelKind::wendland_c0:
      return within(squared, count, [l = exponent](double s) { return power(1 - s, l); });
    case KernelKind::wendland_c2:
      return within(squared, count, [l = exponent](double s) { return power(1 - s, l + 1) * ((l + 1) * s + 1); });
    case KernelKind::wendland_c4:
      return within(squared, count, [l = exponent](double s) {
        return power(1 - s, l + 2) * (((l * l + 4 * l + 3) * s + (3 * l + 6)) * s + 3) / 3;
      });
    case KernelKind::buhmann:
      return within(squared, count, [](double s) {
        const double q = s * s;
        return s > 0 ? ((12 * std::log(s) - 21) * q + 32 * s - 12) * q + 1 : 1;
      });
    case KernelKind::compact_inverse_multiquadric: {
      const double end = 1 / std::sqrt(1 + support * support);
      return each(squared, count, [&](double q) { return q < support * support ? 1 / std::sqrt(1 + q) - end : 0; });
    }
    case KernelKind::custom:
      return each(squared, count, [this](double q) { return custom.function(custom.context, std::sqrt(q), false); });
    case KernelKind::tension:
      return each(squared, count, [this](double q) { return tension.value(std::sqrt(q)); });
    case KernelKind::clamped_plate:  // needs more than a distance
      return;
  }
}

void Kernel::slopes(double* squared, Index count) const {
  switch (kind) {
    case KernelKind::linear:
      return each(squared, count, [](double q) { return q > 0 ? 1 / std::sqrt(q) : 0; });
    case KernelKind::cubic:
      return each(squared, count, [](double q) { return 3 * std::sqrt(q); });
    case KernelKind::quintic:
      return each(squared, count, [](double q) { return 5 * q * std::sqrt(q); });
    case KernelKind::thin_plate:
      return each(squared, count, [](double q) { return q > 0 ? std::log(q) + 1 : 0; });
    case KernelKind::polyharmonic:
      return each(squared, count, [e = exponent](double q) {
        if (!(q > 0)) return 0.0;
        const double power_less_two = power_of_root(q, e) / q;
        return e % 2 ? e * power_less_two : power_less_two * (0.5 * e * std::log(q) + 1);
      });
    case KernelKind::gaussian:
      return each(squared, count, [](double q) { return -2 * std::exp(-q); });
    case KernelKind::multiquadric:
      return each(squared, count, [](double q) { return 1 / std::sqrt(1 + q); });
    case KernelKind::inverse_multiquadric:
      return each(squared, count, [](double q) { return -1 / ((1 + q) * std::sqrt(1 + q)); });
    case KernelKind::inverse_quadratic:
      return each(squared, count, [](double q) { return -2 / ((1 + q) * (1 + q)); });
    case KernelKind::wendland_c0:
      return within(squared, count, [l = exponent](double s) { return s > 0 ? -l * power(1 - s, l - 1) / s : 0; });
    case KernelKind::wendland_c2:
      return within(squared, count, [l = exponent](double s) { return -(l + 1) * (l + 2) * power(1 - s, l); });
    case KernelKind::wendland_c4:
      return within(squared, count,
                    [l = exponent](double s) { return -(l + 3) * (l + 4) * power(1 - s, l + 1) * ((l + 1) * s + 1) / 3; });
    case KernelKind::buhmann:
      return within(squared, count, [](double s) { return s > 0 ? ((48 * std::log(s) - 72) * s + 96) * s - 24 : -24; });
    case KernelKind::compact_inverse_multiquadric:
      return each(squared, count, [end = support * support](double q) { return q < end ? -1 / ((1 + q) * std::sqrt(1 + q)) : 0; });
    case KernelKind::custom:
      return each(squared, count, [this](double q) {
        const double s = std::sqrt(q);
        return s > 0 ? custom.function(custom.context, s, true) / s : 0;
      });
    case KernelKind::tension:
      return each(squared, count, [this](double q) {
        const double r = std::sqrt(q);
        return r > 0 ? tension.slope(r) / r : 0;
      });
    case KernelKind::clamped_plate:
      return;
  }
}

bool Kernel::has_width() const {
  return homogeneity() == 0 && kind != KernelKind::tension;
}

int Kernel::homogeneity() const {
  switch (kind) {
    case KernelKind::linear:
      return 1;
    case KernelKind::cubic:
      return 3;
    case KernelKind::thin_plate:
      return 2;
    case KernelKind::quintic:
      return 5;
    case KernelKind::polyharmonic:
      return exponent;
    default:
      return 0;
  }
}

int Kernel::order() const {
  switch (kind) {
    case KernelKind::multiquadric:
      return 1;
    case KernelKind::custom:
      return custom.minimum_degree + 1;
    case KernelKind::tension:
      return tension.minimum_degree() + 1;
    default: {
      const int e = homogeneity();
      return e == 0 ? 0 : e / 2 + 1;  // ⌈e/2⌉ for odd e too
    }
  }
}

double Kernel::sign() const {
  if (kind == KernelKind::multiquadric) return -1;
  return homogeneity() == 0 || order() % 2 == 0 ? 1 : -1;
}

int Kernel::definite_to_dimension() const {
  switch (kind) {
    case KernelKind::buhmann:
    case KernelKind::tension:
      return 3;
    case KernelKind::compact_inverse_multiquadric:
    case KernelKind::custom:
      return 0;
    default:
      return all_dimensions;  // Wendland's ℓ is chosen for the dimension at hand
  }
}

bool Kernel::vanishes_at_center() const {
  return homogeneity() != 0 || (kind == KernelKind::tension && tension.minimum_degree() >= 0);
}

}  // namespace handlebody
