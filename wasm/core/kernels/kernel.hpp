// Radial kernels φ(s) of s = r/width, and what is known of their definiteness. A kernel without a width ignores it.
//
// A kernel is conditionally positive definite of order m where Σ cᵢcⱼ φ(‖xᵢ − xⱼ‖) > 0 for all distinct points and all c ≠ 0 with
// Σ cᵢ p(xᵢ) = 0 for every polynomial p of degree below m. Some kernels are so only after multiplication by −1, their sign. With a
// tail of degree m − 1 or more the interpolation equations are then regular, and Cholesky solves them once the side conditions are
// eliminated. In how many dimensions this is proved: Wendland, Scattered Data Approximation (2005), chapters 6–9; Fasshauer,
// Meshfree Approximation Methods with MATLAB (2007), appendix D; Buhmann, Math. Comp. 70 (2001).
//
//                                                        order m    sign            dimensions
//   Gaussian, inverse multiquadric, inverse quadratic    0          1               all
//   Wendland's (ℓ for the dimension), clamped plate      0          1               all
//   Buhmann's                                            0          1               3
//   linear, multiquadric                                 1          −1              all
//   thin plate, cubic                                    2          1               all
//   quintic                                              3          −1              all
//   polyharmonic r^e, e odd                              ⌈e/2⌉      (−1)^⌈e/2⌉      all
//   polyharmonic r^e ln r, e even                        e/2 + 1    (−1)^(e/2+1)    all
//   tension                                              0 to 2     1               3
//   compact inverse multiquadric, the caller's           unknown
#pragma once

#include "core/kernels/tension_kernel.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** Indices are part of the C interface. */
enum class KernelKind : unsigned {
  linear = 0,                // r: the biharmonic kernel in 3D
  cubic = 1,                 // r³: biharmonic in 1D (the natural cubic spline), triharmonic in 3D
  thin_plate = 2,            // r² ln r: biharmonic in 2D
  gaussian = 3,              // exp(−s²)
  multiquadric = 4,          // √(1 + s²)
  inverse_multiquadric = 5,  // 1/√(1 + s²); with width h this is h·Φ of paper 001
  inverse_quadratic = 6,     // 1/(1 + s²)
  quintic = 7,               // r⁵: triharmonic in 1D
  polyharmonic = 8,          // r^e, or r^e ln r for even e; e = 2·order − dimension
  wendland_c0 = 9,           // (1−s)^ℓ, all three zero beyond s = 1; ℓ = ⌊dimension/2⌋ + 1, + 2, + 3
  wendland_c2 = 10,          // (1−s)^(ℓ+1) ((ℓ+1)s + 1)
  wendland_c4 = 11,          // (1−s)^(ℓ+2) ((ℓ²+4ℓ+3)s² + (3ℓ+6)s + 3)/3
  buhmann = 12,              // 12s⁴ ln s − 21s⁴ + 32s³ − 12s² + 1, zero beyond s = 1: six times that of paper 001, §3.1
  compact_inverse_multiquadric = 13,  // 1/√(1+s²) − 1/√(1+S²), zero beyond s = S = `support`: Φ_CIMQ of paper 001, §3.1
  clamped_plate = 14,                 // not radial: clamped_plate.hpp
  custom = 15,                        // the caller's
  tension = 16,                       // tension_kernel.hpp
};
constexpr unsigned kernel_count = 17;
/** Kernels below this number are functions of r and the width alone, in any dimension. */
constexpr unsigned plain_kernel_count = 8;

/** A kernel of the caller's, as a function of s = r/width: φ(s), and φ′(s) where `derivative` is true. */
struct CustomKernel {
  double (*function)(const void* context, double s, bool derivative) = nullptr;
  const void* context = nullptr;
  int minimum_degree = -1;  // as the caller declares it
};

struct Kernel {
  KernelKind kind = KernelKind::gaussian;
  double width = 1;
  int exponent = 3;    // e of polyharmonic, ℓ of Wendland
  double support = 4;  // S of the compact inverse multiquadric
  CustomKernel custom = {};
  TensionKernel tension = {};

  /** The kernel of that kind in `dimension` dimensions: sets the exponent. `order` is that of polyharmonic's Laplacian (2
   * biharmonic, 3 triharmonic …), with 2·order > dimension. */
  static Kernel of(KernelKind kind, double width, Index dimension, int order = 2);

  /** The kernel at distance `r` ≥ 0; +infinity gives the limit (0 for the decreasing ones). */
  double operator()(double r) const;

  /** In place, for `count` squared s (squared r for a kernel without a width): φ(s). */
  void values(double* squared, Index count) const;

  /** In place likewise: φ′(s)/s, so that the gradient with respect to x is this times (x − center)/width². 0 where that is
   * infinite, at the center itself: there the gradient's limit is 0, or none exists. */
  void slopes(double* squared, Index count) const;

  /** Whether the kernel depends on the width. */
  bool has_width() const;

  /** e of φ(cr) = c^e φ(r), up to polynomials that the tail absorbs; 0 for a kernel with a width. */
  int homogeneity() const;

  /** m of the table above; where it is unknown, the one that the caller declares, or the customary one. */
  int order() const;

  /** The table's sign; 1 where it is unknown. */
  double sign() const;

  /** Largest dimension in which order and sign are proved: 0 for none, 1000 for all. */
  int definite_to_dimension() const;

  /** Lowest polynomial degree whose tail makes interpolation well posed (−1: none needed). */
  int minimum_degree() const { return order() - 1; }

  /** Whether φ(0) = 0, so that a single kernel is 0 at its own center. */
  bool vanishes_at_center() const;
};

}  // namespace handlebody
