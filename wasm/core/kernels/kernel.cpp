#include "core/kernels/kernel.hpp"

#include <cmath>

namespace handlebody {

double Kernel::operator()(double r) const {
  const double s = r / width;
  switch (kind) {
    case KernelKind::linear:
      return r;
    case KernelKind::cubic:
      return r * r * r;
    case KernelKind::thin_plate:
      return r > 0 ? r * r * std::log(r) : 0;  // 0·ln 0 would be NaN; the limit is 0
    case KernelKind::gaussian:
      return std::exp(-s * s);
    case KernelKind::multiquadric:
      return std::sqrt(1 + s * s);
    case KernelKind::inverse_multiquadric:
      return 1 / std::sqrt(1 + s * s);
    case KernelKind::inverse_quadratic:
      return 1 / (1 + s * s);
  }
  return 0;
}

int Kernel::minimum_degree() const {
  // One less than the order of conditional positive definiteness (Wendland, Scattered Data Approximation, 2005, chapter 8).
  switch (kind) {
    case KernelKind::linear:
    case KernelKind::multiquadric:
      return 0;
    case KernelKind::cubic:
    case KernelKind::thin_plate:
      return 1;
    case KernelKind::gaussian:
    case KernelKind::inverse_multiquadric:
    case KernelKind::inverse_quadratic:
      return -1;
  }
  return -1;
}

}  // namespace handlebody
