#include "core/numerics/hyperbolic.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

using namespace handlebody;

namespace {

constexpr double hyperbolic_pi = 3.14159265358979323846;
constexpr double rounding_unit = std::numeric_limits<double>::epsilon();

void check_hyperbolic(double x_squared, double cosh, double sinhc, double rest) {
  CAPTURE(x_squared);
  const Hyperbolic found = hyperbolic(x_squared);
  // Where they oscillate, rounding is measured against what they oscillate between: 1, 1/x, 1/x².
  const double x = std::sqrt(std::abs(x_squared)), waves = x_squared < -1 ? 1 : 0;
  CHECK(std::abs(found.cosh - cosh) <= 8 * rounding_unit * std::fmax(std::abs(cosh), waves));
  CHECK(std::abs(found.sinhc - sinhc) <= 8 * rounding_unit * std::fmax(std::abs(sinhc), waves / x));
  CHECK(std::abs(found.rest - rest) <= 16 * rounding_unit * std::fmax(std::abs(rest), waves / (x * x)));
}

}  // namespace

TEST_CASE("cosh, sinh x/x and the rest where they are known in closed form") {
  check_hyperbolic(0, 1, 1, 1.0 / 3);
  // At x = 1 the rest is cosh 1 − sinh 1 = 1/e.
  check_hyperbolic(1, 1.54308063481524377848, 1.17520119364380145688, 0.36787944117144232160);
  // x = ln 2: cosh x = 5/4, sinh x = 3/4.
  const double ln2 = 0.69314718055994530942;
  check_hyperbolic(ln2 * ln2, 1.25, 0.75 / ln2, 0.34962569588933066471);
  // Imaginary x: cosh is cos, sinh(x)/x is sin(x)/x.
  const double pi = hyperbolic_pi;
  check_hyperbolic(-pi * pi / 4, 0, 2 / pi, 8 / (pi * pi * pi));
  check_hyperbolic(-pi * pi, -1, 0, 1 / (pi * pi));
  check_hyperbolic(-pi * pi / 9, 0.5, 3 * std::sqrt(3.0) / (2 * pi), 9 * (3 * std::sqrt(3.0) / (2 * pi) - 0.5) / (pi * pi));
}

TEST_CASE("near 0 the three are their series, where differences of cosh and sinh have no digits left") {
  for (const double q : {1e-3, 1e-5, 1e-8, 1e-12, 1e-30, -1e-3, -1e-5, -1e-8, -1e-12, -1e-30}) {
    check_hyperbolic(q, 1 + q / 2 * (1 + q / 12 * (1 + q / 30 * (1 + q / 56))), 1 + q / 6 * (1 + q / 20 * (1 + q / 42)),
                     (1 + q / 10 * (1 + q / 28 * (1 + q / 54))) / 3);
  }
}

TEST_CASE("far from 0 they are the C library's") {
  for (double x = 1; x < 700; x *= 1.07) {
    const double q = x * x, root = std::sqrt(q), exact = std::cosh(root), sinhc = std::sinh(root) / root;
    check_hyperbolic(q, exact, sinhc, (exact - sinhc) / q);
  }
  for (double x = 1; x < 1e6; x *= 1.07) {
    const double q = -x * x, root = std::sqrt(-q), exact = std::cos(root), sinc = std::sin(root) / root;
    check_hyperbolic(q, exact, sinc, (exact - sinc) / q);
  }
}

TEST_CASE("doubling x: cosh 2x = 2 cosh² x − 1, sinh 2x = 2 sinh x cosh x, on both sides of the change of method") {
  for (double q = -3; q <= 3; q += 1.0 / 64) {
    CAPTURE(q);
    const Hyperbolic once = hyperbolic(q), twice = hyperbolic(4 * q);
    CHECK(std::abs(twice.cosh - (2 * once.cosh * once.cosh - 1)) <= 1e-14 * std::fmax(1, twice.cosh));
    CHECK(std::abs(twice.sinhc - once.sinhc * once.cosh) <= 1e-14 * std::fmax(1, twice.sinhc));
    CHECK(std::abs(q * once.rest - (once.cosh - once.sinhc)) <= 1e-15 * std::fmax(1, once.cosh));
  }
}

TEST_CASE("eˣ − 1 and ln(1 + x)/x keep their digits at any x") {
  for (const double sign : {1.0, -1.0}) {
    for (double size = 1e-20; size < 30; size *= 1.7) {
      const double x = sign * size;
      CAPTURE(x);
      CHECK(std::abs(exp_less_one(x) - std::expm1(x)) <= 8 * rounding_unit * std::abs(std::expm1(x)));
      if (x > -1) CHECK(std::abs(log_one_plus_over(x) - std::log1p(x) / x) <= 8 * rounding_unit * std::abs(std::log1p(x) / x));
    }
  }
  CHECK(exp_less_one(0) == 0);
  CHECK(exp_less_one(-1000) == -1);
  CHECK(log_one_plus_over(0) == 1);
}
