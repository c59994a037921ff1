// cosh and sinh beyond the library's functions: as entire functions of x², so that a negative x² means cos and sin, and without
// cancellation in their differences at small x. They use only exp and log, which adds no code: the C library's cos and sin are 3 kB
// of wasm, most of it for arguments that do not occur.
#pragma once

namespace handlebody {

struct Hyperbolic {
  double cosh;   // cosh x
  double sinhc;  // sinh(x)/x
  double rest;   // (cosh x − sinh(x)/x)/x², 1/3 at x = 0
};

/** Each to a few units in the last place, of the amplitude if it oscillates. Overflows at x² = 500000, as cosh does; x² ≥ −1e12. */
Hyperbolic hyperbolic(double x_squared);

/** eˣ − 1 and ln(1 + x)/x without cancellation at small x (W. Kahan): the errors of u = eˣ and u = 1 + x cancel. */
double exp_less_one(double x);
double log_one_plus_over(double x);

}  // namespace handlebody
