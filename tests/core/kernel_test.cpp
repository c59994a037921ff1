#include "core/kernels/kernel.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace handlebody;

TEST_CASE("kernels have their textbook values at r = 1, width 2") {
  const auto at = [](KernelKind kind) { return Kernel{kind, 2}(1); };
  CHECK(at(KernelKind::linear) == 1);
  CHECK(at(KernelKind::cubic) == 1);
  CHECK(at(KernelKind::thin_plate) == 0);
  CHECK(at(KernelKind::gaussian) == doctest::Approx(std::exp(-0.25)).epsilon(1e-15));
  CHECK(at(KernelKind::multiquadric) == doctest::Approx(std::sqrt(1.25)).epsilon(1e-15));
  CHECK(at(KernelKind::inverse_multiquadric) == doctest::Approx(1 / std::sqrt(1.25)).epsilon(1e-15));
  CHECK(at(KernelKind::inverse_quadratic) == doctest::Approx(0.8).epsilon(1e-15));
  CHECK(Kernel{KernelKind::cubic}(3) == 27);
  CHECK(Kernel{KernelKind::thin_plate}(std::exp(1.0)) == doctest::Approx(std::exp(2.0)));
}

TEST_CASE("kernels have their limits at 0 and at infinity") {
  const double infinity = std::numeric_limits<double>::infinity();
  for (unsigned k = 0; k < kernel_count; ++k) {
    CAPTURE(k);
    const Kernel kernel{static_cast<KernelKind>(k), 0.5};
    const bool vanishes = k <= 2, decreases = k == 3 || k >= 5;
    CHECK(kernel(0) == (vanishes ? 0 : 1));
    CHECK(kernel(infinity) == (decreases ? 0 : infinity));
    CHECK(std::isfinite(kernel(std::numeric_limits<double>::min())));
  }
}

TEST_CASE("lowest degrees of the tail are those of conditional positive definiteness") {
  const int expected[kernel_count] = {0, 1, 1, -1, 0, -1, -1};
  for (unsigned k = 0; k < kernel_count; ++k) CHECK(Kernel{static_cast<KernelKind>(k), 1}.minimum_degree() == expected[k]);
}
