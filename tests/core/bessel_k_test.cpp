#include "core/numerics/bessel_k.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "oracle_lines.hpp"

using namespace handlebody;

// Tolerance: thirty terms of rounding, and e⁻ˣ, whose relative error is that of x times x.
TEST_CASE("K0 and K1 agree with mpmath to a relative 2e-15 (1 + x/10)") {
  int checked = 0;
  for (const std::string& line : oracle_lines("tension_kernel.json")) {
    const auto x = oracle_numbers(line, "x"), k0 = oracle_numbers(line, "k0"), k1 = oracle_numbers(line, "k1");
    for (std::size_t i = 0; i < x.size(); ++i, ++checked) {
      CAPTURE(x[i]);
      const double tolerance = 2e-15 * (1 + x[i] / 10);
      CHECK(std::abs(bessel_k0(x[i]) - k0.at(i)) <= tolerance * k0[i]);
      CHECK(std::abs(bessel_k1(x[i]) - k1.at(i)) <= tolerance * k1[i]);
    }
  }
  CHECK(checked > 20);
}

TEST_CASE("K0 and K1 at the ends: infinite at 0, and 0 far out") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto bessel : {bessel_k0, bessel_k1}) {
    CHECK(bessel(0) == infinity);
    CHECK(bessel(1e4) == 0);
    CHECK(bessel(1e300) == 0);
    CHECK(bessel(infinity) == 0);
  }
  CHECK(std::isfinite(bessel_k1(1e-307)));
}

TEST_CASE("K0 and K1 solve their equation: the Wronskian I0 K1 + I1 K0 is 1/x on both sides of the change of method") {
  for (double x = 0.05; x < 30; x *= 1.3) {
    double i0 = 1, i1 = 1, t0 = 1, t1 = 1;  // I₀ = Σ (x²/4)ᵏ/k!², I₁ = x/2 Σ (x²/4)ᵏ/(k!(k+1)!)
    for (int k = 1; k < 80; ++k) {
      i0 += t0 *= x * x / 4 / (k * k);
      i1 += t1 *= x * x / 4 / (k * (k + 1));
    }
    CHECK(x * (i0 * bessel_k1(x) + x / 2 * i1 * bessel_k0(x)) == doctest::Approx(1).epsilon(2e-14));
  }
}
