// cosh and sinh beyond their library forms: as entire functions of x², so that a negative x² means cos and sin, and without the
// cancellation of their differences at small x.
#pragma once

namespace handlebody {

struct Hyperbolic {
  double cosh;   // cosh x
  double sinhc;  // sinh(x)/x
  double rest;   // (cosh x − sinh(x)/x)/x², 1/3 at x = 0
};

/** Each to a few units in the last place, or of what it oscillates between. Overflows at x² = 500000, as cosh does. */
Hyperbolic hyperbolic(double x_squared);

}  // namespace handlebody
