#include "core/kernels/kernel.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace handlebody;

namespace {

double kernel_value_near(const Kernel& kernel, double r) {
  return std::max(std::abs(kernel(r)), std::abs(kernel(r * (1 - 1e-10))));
}

}  // namespace

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
  for (unsigned k = 0; k < 14; ++k) {
    CAPTURE(k);
    const Kernel kernel = Kernel::of(static_cast<KernelKind>(k), 0.5, 3, 2);
    const bool decreases = !kernel.vanishes_at_center() && kernel.kind != KernelKind::multiquadric;
    if (kernel.kind != KernelKind::compact_inverse_multiquadric) CHECK(kernel(0) == (kernel.vanishes_at_center() ? 0 : 1));
    CHECK(kernel(infinity) == (decreases ? 0 : infinity));
    CHECK(std::isfinite(kernel(std::numeric_limits<double>::min())));
  }
}

TEST_CASE("slopes are φ′(s)/s by central differences") {
  for (unsigned k = 0; k < 14; ++k) {
    const Kernel kernel = Kernel::of(static_cast<KernelKind>(k), 1, 3, 3);
    CAPTURE(k);
    for (const double s : {0.1, 0.45, 0.9, 1.7}) {
      double slope = s * s;
      kernel.slopes(&slope, 1);
      const double h = 1e-6, difference = (kernel(s + h) - kernel(s - h)) / (2 * h);
      CHECK(slope * s == doctest::Approx(difference).epsilon(1e-7).scale(1));
    }
  }
}

TEST_CASE("compact kernels end at their support, smoothly where they promise to") {
  for (const auto kind : {KernelKind::wendland_c0, KernelKind::wendland_c2, KernelKind::wendland_c4, KernelKind::buhmann}) {
    for (const Index dimension : {1, 2, 3, 5, 8}) {
      const Kernel kernel = Kernel::of(kind, 2, dimension);
      CHECK(kernel(2) == 0);
      CHECK(std::abs(kernel(2 - 1e-4)) < (kind == KernelKind::wendland_c0 ? 1e-4 : 1e-8));
      CHECK(kernel(1.9) > 0);
    }
  }
  Kernel compact{KernelKind::compact_inverse_multiquadric, 2};
  compact.support = 3;
  CHECK(kernel_value_near(compact, 6) < 1e-9);
  CHECK(compact(5.9) > 0);
}

TEST_CASE("polyharmonic kernels of order 2 and 3 are the biharmonic and triharmonic ones") {
  const auto same = [](const Kernel& a, const Kernel& b) {
    for (const double r : {0.0, 0.3, 1.0, 4.0}) CHECK(a(r) == doctest::Approx(b(r)).epsilon(1e-14));
    CHECK(a.minimum_degree() == b.minimum_degree());
    CHECK(a.sign() == b.sign());
  };
  same(Kernel::of(KernelKind::polyharmonic, 1, 3, 2), {KernelKind::linear});
  same(Kernel::of(KernelKind::polyharmonic, 1, 2, 2), {KernelKind::thin_plate});
  same(Kernel::of(KernelKind::polyharmonic, 1, 1, 2), {KernelKind::cubic});
  same(Kernel::of(KernelKind::polyharmonic, 1, 3, 3), {KernelKind::cubic});
  same(Kernel::of(KernelKind::polyharmonic, 1, 1, 3), {KernelKind::quintic});
}

TEST_CASE("kernels are definite as stated: no negative eigenvalue beside the tail, random points in dimension 1 to 5 (seed 1)") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (unsigned k = 0; k < 13; ++k) {
    for (Index dimension = 1; dimension <= 5; ++dimension) {
      const Kernel kernel = Kernel::of(static_cast<KernelKind>(k), 0.7, dimension, static_cast<int>(dimension) / 2 + 1);
      if (kernel.definite_to_dimension() < dimension) continue;
      CAPTURE(k);
      CAPTURE(dimension);
      constexpr Index n = 30;
      const MatrixXd points = MatrixXd::NullaryExpr(n, dimension, [&] { return uniform(random); });
      MatrixXd r(n, n), p(n, 1 + dimension + dimension * (dimension + 1) / 2);
      for (Index i = 0; i < n; ++i) {
        for (Index j = 0; j < n; ++j) r(i, j) = kernel.sign() * kernel((points.row(i) - points.row(j)).norm());
        Index column = 0;
        p(i, column++) = 1;
        for (Index a = 0; a < dimension; ++a) p(i, column++) = points(i, a);
        for (Index a = 0; a < dimension; ++a)
          for (Index b = a; b < dimension; ++b) p(i, column++) = points(i, a) * points(i, b);
      }
      const int degree = kernel.minimum_degree();
      const Index count = degree < 0 ? 0 : degree == 0 ? 1 : degree == 1 ? 1 + dimension : p.cols();
      MatrixXd beside = MatrixXd::Identity(n, n);
      if (count) beside = MatrixXd(MatrixXd(p.leftCols(count)).householderQr().householderQ()).rightCols(n - count);
      const MatrixXd reduced = beside.transpose() * r * beside;
      const double least = Eigen::SelfAdjointEigenSolver<MatrixXd>(reduced).eigenvalues().minCoeff();
      CHECK(least > -1e-10 * r.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("lowest degrees of the tail are those of conditional positive definiteness") {
  const int expected[14] = {0, 1, 1, -1, 0, -1, -1, 2, 0, -1, -1, -1, -1, -1};
  for (unsigned k = 0; k < 14; ++k) CHECK(Kernel::of(static_cast<KernelKind>(k), 1, 3, 2).minimum_degree() == expected[k]);
}
