// Logarithms and exponentials of many numbers at a time, which the C library's functions, one number a call, take most of a
// kernel's time for. Without branches and tables, so that compilers vectorize them.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** x ← ln x in place, to 3 units in the last place (of 1 where the result is below 1), for positive normal numbers. 0 gives some
 * finite negative number, so that 0 · ln 0 is 0. */
void logarithms(double* x, Index count);

/** x ← exp(−x) in place, relative error below 1e-15, for x ≥ 0; 0 from 708 on and for NaN. */
void decaying_exponentials(double* x, Index count);

/** x ← (least/x)ᵖ in place, for x ≥ least > 0 and p > 0, relative error below 1e-15 (1 + p + p ln(x/least)); 0 where that is below
 * 1e-300. By products for whole p up to 16. */
void inverse_powers(double* x, Index count, double least, double p);

}  // namespace handlebody
