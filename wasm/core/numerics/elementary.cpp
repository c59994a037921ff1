// Compiled with -O3: see CMakeLists.txt.
#include "core/numerics/elementary.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace handlebody {
namespace {

// Four numbers at a time in the vector types of GCC and Clang, which become the machine's own vectors. From a plain loop clang 14
// makes scalar code of the integer parts for wasm, no faster than the C library; with these types two million thin plate kernels
// take three fifths of the time.
using Reals = double __attribute__((vector_size(32)));
using Words = std::uint64_t __attribute__((vector_size(32)));
using Integers = std::int64_t __attribute__((vector_size(32)));
constexpr Index lanes = 4;

constexpr double ln2_high = 0x1.62e42feep-1,
                 ln2_low = 0x1.a39ef35793c76p-33;     // together ln 2; the product of the first and any exponent is exact
constexpr double integer_shift = 6755399441055744.0;  // 1.5 · 2⁵²: adding it puts an integer into the lowest bits
constexpr std::uint64_t integer_shift_bits = 0x4338000000000000u, root_half_bits = 0x3fe6a09e667f3bcdu;

constexpr double artanh_terms[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11, 2.0 / 13,
                                   2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21, 2.0 / 23};  // of (2 artanh s − 2s)/s³, in s²
constexpr double exponential_terms[] = {1.0 / 2,       1.0 / 6,        1.0 / 24,        1.0 / 120,
                                        1.0 / 720,     1.0 / 5040,     1.0 / 40320,     1.0 / 362880,
                                        1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};  // 1/k! from k = 2 on

/** Σ cₖ xᵏ. Even and odd powers in separate sums, so that neither waits for the other. Both begin with their highest term:
 * from zero on, the compiler keeps the products with zero, and evaluating thin plates takes 1.07 × the time. */
template <std::size_t n>
Reals power_series(const double (&c)[n], const Reals& x) {
  const Reals z = x * x;
  Reals sums[2];
  sums[n % 2] = Reals{} + c[n - 2];
  sums[(n - 1) % 2] = Reals{} + c[n - 1];
  for (std::size_t k = n - 2; k-- > 0;) sums[k % 2] = sums[k % 2] * z + c[k];
  return sums[0] + x * sums[1];
}

void logarithm(Reals& x) {
  // x = 2ᵏ m with m in [√½, √2); ln m = 2 artanh s, s = (m − 1)/(m + 1), |s| < 0.172: eleven terms of its series.
  const Words bits = (Words)x;
  const Words k = (Words)((Integers)(bits - root_half_bits) >> 52);
  const Reals m = (Reals)(bits - (k << 52));
  const Reals exponent = (Reals)(k + integer_shift_bits) - integer_shift;
  const Reals s = (m - 1) / (m + 1), z = s * s;
  x = exponent * ln2_high + (exponent * ln2_low + s * z * power_series(artanh_terms, z) + 2 * s);
}

void decaying_exponential(Reals& x) {
  // exp(−x) = 2ᵏ exp(r) with |r| ≤ ½ ln 2: fourteen terms of its series.
  const Words in_range = (Words)(x < 708.0);
  const Reals t = -(Reals)((Words)x & in_range);
  const Reals shifted = t * 1.4426950408889634 + integer_shift, k = shifted - integer_shift;
  const Reals r = (t - k * ln2_high) - k * ln2_low;
  const Reals sum = 1 + (r + r * r * power_series(exponential_terms, r));
  const Reals scale = (Reals)(((Words)shifted + 1023) << 52);
  x = (Reals)((Words)(sum * scale) & in_range);
}

template <typename Function>
void in_place(double* x, Index count, Function function) {
  Reals some;
  for (; count >= lanes; x += lanes, count -= lanes) {
    std::memcpy(&some, x, sizeof some);
    function(some);
    std::memcpy(x, &some, sizeof some);
  }
  some = Reals{1, 1, 1, 1};
  std::memcpy(&some, x, sizeof(double) * static_cast<std::size_t>(count));
  function(some);
  std::memcpy(x, &some, sizeof(double) * static_cast<std::size_t>(count));
}

}  // namespace

void logarithms(double* x, Index count) {
  in_place(x, count, logarithm);
}

void decaying_exponentials(double* x, Index count) {
  in_place(x, count, decaying_exponential);
}

void inverse_powers(double* x, Index count, double least, double p) {
  const int whole = p <= 16 ? static_cast<int>(p) : 0;
  if (whole == p) {
    for (Index i = 0; i < count; ++i) {
      double square = least / x[i], product = 1;
      for (int bits = whole; bits > 0; bits >>= 1, square *= square)
        if (bits & 1) product *= square;
      x[i] = product;
    }
    return;
  }
  for (Index i = 0; i < count; ++i) x[i] = std::min(x[i] / least, 1e308);
  logarithms(x, count);
  for (Index i = 0; i < count; ++i) x[i] *= p;
  decaying_exponentials(x, count);
}

}  // namespace handlebody
