// Logarithms and exponentials of many numbers at a time: one per call, as in the C library, they take most of a kernel's time.
// Without branches and tables, so that compilers vectorize them.
//
// Rejected: Eigen's packets, as exact (2.2e-16) but slower: array().log() takes 2.4 × the time in wasm and 1.4 × natively,
// array().exp() 2.5 × and 1.1 × (4,096 numbers). elementary_test.cpp compares with them.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** x ← ln x in place, to 3 units in the last place (of 1 where the result is below 1), for positive normal numbers. 0 gives some
 * finite negative number, so that 0 · ln 0 is 0. */
void logarithms(double* x, Index count);

/** x ← exp(−x) in place, relative error below 1e-15, for x ≥ 0; 0 from 708 on and for NaN. */
void decaying_exponentials(double* x, Index count);

/** x ← (least/x)ᵖ in place, for x ≥ least > 0 and p > 0, relative error below 1e-15 (1 + p + p ln(x/least)); 0 where the result is
 * below 1e-300. By repeated multiplication for integers p up to 16. */
void inverse_powers(double* x, Index count, double least, double p);

}  // namespace handlebody
