// Radial kernels. The width enters as r/width; a kernel without a width ignores it.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** Numbers are part of the C interface. */
enum class KernelKind : unsigned {
  linear = 0,                // r
  cubic = 1,                 // r³
  thin_plate = 2,            // r² ln r
  gaussian = 3,              // exp(−(r/width)²)
  multiquadric = 4,          // √(1 + (r/width)²)
  inverse_multiquadric = 5,  // 1/√(1 + (r/width)²); with width h this is h·Φ of paper 001
  inverse_quadratic = 6,     // 1/(1 + (r/width)²)
};
constexpr unsigned kernel_count = 7;

struct Kernel {
  KernelKind kind = KernelKind::gaussian;
  double width = 1;

  /** The kernel at distance `r` ≥ 0; +infinity gives the limit (0 for the decreasing ones). */
  double operator()(double r) const;

  /** Lowest polynomial degree whose tail makes interpolation well posed (−1: none needed). */
  int minimum_degree() const;
};

}  // namespace handlebody
