#include "core/irbf/basis.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "made_body.hpp"

using namespace handlebody;

namespace {

/** Points of the bar, more than are looked at together. */
InteriorSamples random_samples(const Body& body, std::mt19937& random, Index count) {
  std::uniform_real_distribution<double> uniform(-.95, .95);
  InteriorSamples samples;
  const Vector3 half = Vector3(2, .5, .5) / body.normalization.diagonal;
  for (Index i = 0; i < count; ++i)
    samples.add(body.domain, half.cwiseProduct(Vector3(uniform(random), uniform(random), uniform(random))));
  return samples;
}

Matrix basis_at(const Basis& basis, const InteriorSamples& samples) {
  Matrix phi = Matrix::Constant(samples.size(), basis.size(), 77);
  REQUIRE(basis.evaluate<double>(samples, phi));
  return phi;
}

double mean_spacing_of_centers(const Body& body) {
  double sum = 0;
  const auto count = std::ssize(body.centers);
  for (Index c = 0; c < count; ++c) {
    double least = HUGE_VAL;
    for (Index d = 0; d < count; ++d)
      if (d != c) least = std::min(least, (body.center_position(c) - body.center_position(d)).norm());
    sum += least;
  }
  return sum / static_cast<double>(count);
}

/** A kernel of the caller's that is what `context` says beyond s = 1, and 1 before. */
double step_kernel(const void* context, double s, bool derivative) {
  return derivative ? 0 : s < 1 ? 1 : *static_cast<const double*>(context);
}

}  // namespace

TEST_CASE("the basis is eqs. (2) and (3): kernels of the interior distances over their sum (seed 141)") {
  std::mt19937 random(141);
  for (const Index centers : {2, 8, 9, 20}) {  // they are taken by eights
    CAPTURE(centers);
    const Body body = test::made_bar_body(centers);
    const InteriorSamples samples = random_samples(body, random, 40);
    for (const KernelKind kind : {KernelKind::inverse_multiquadric, KernelKind::gaussian, KernelKind::linear}) {
      const Basis basis(body, Kernel::of(kind, 1.5, 3));
      REQUIRE(basis.size() == centers);
      const double width = 1.5 * mean_spacing_of_centers(body);
      if (kind != KernelKind::linear) CHECK(basis.kernel().width == doctest::Approx(width).epsilon(1e-3));
      const Matrix phi = basis_at(basis, samples);
      for (Index i = 0; i < samples.size(); ++i) {
        Vector expected(centers);
        for (Index c = 0; c < centers; ++c) {
          const double r = (samples.point(i) - body.center_position(c)).norm(), s = r / width;
          expected[c] = kind == KernelKind::linear ? r : kind == KernelKind::gaussian ? std::exp(-s * s) : 1 / std::sqrt(1 + s * s);
        }
        expected /= expected.sum();
        CHECK((phi.row(i).transpose() - expected).cwiseAbs().maxCoeff() < 2e-3);  // distances come in 65535 steps
        CHECK(phi.row(i).sum() == doctest::Approx(1).epsilon(1e-14));
      }
    }
  }
}

TEST_CASE("single precision agrees with double (seed 142)") {
  std::mt19937 random(142);
  const Body body = test::made_bar_body(11);
  const InteriorSamples samples = random_samples(body, random, 70);
  const Basis basis(body, Kernel::of(KernelKind::inverse_multiquadric, 2, 3));
  MatrixF single(70, 11);
  REQUIRE(basis.evaluate<float>(samples, single));
  CHECK((single.cast<double>() - basis_at(basis, samples)).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("distances are those inside: a center that is far by the way round counts less") {
  Body body = test::made_bar_body(2);
  const InteriorSamples samples = [&] {
    InteriorSamples made;
    made.add(body.domain, Vector3::Zero());
    return made;
  }();
  const Basis before(body, Kernel::of(KernelKind::inverse_multiquadric, 1, 3));
  const Matrix straight = basis_at(before, samples);
  // The second center's distances are doubled, which changes the spacing too.
  for (Index v = 0; v < body.domain.size(); ++v) {
    std::uint16_t& code = body.distances[static_cast<std::size_t>(body.domain.size() + v)];
    code = static_cast<std::uint16_t>(std::min(2 * int{code}, 65535));
  }
  const Basis after(body, Kernel::of(KernelKind::inverse_multiquadric, 1, 3));
  const Matrix round = basis_at(after, samples);
  const double width = after.kernel().width, near = body.center_position(0).norm() / width,
               far = 2 * body.center_position(1).norm() / width;
  const double a = 1 / std::sqrt(1 + near * near), b = 1 / std::sqrt(1 + far * far);
  CHECK(width > 1.2 * before.kernel().width);
  CHECK(round(0, 1) == doctest::Approx(b / (a + b)).epsilon(1e-3));
  CHECK(round(0, 1) < straight(0, 1));
}

TEST_CASE("a single center is everything everywhere, its width is in diagonals (seed 143)") {
  std::mt19937 random(143);
  const Body body = test::made_bar_body(1);
  const Basis basis(body, Kernel::of(KernelKind::inverse_multiquadric, 0.7, 3));
  CHECK(basis.kernel().width == 0.7);
  CHECK((basis_at(basis, random_samples(body, random, 5)) - Matrix::Ones(5, 1)).norm() < 1e-14);
}

TEST_CASE("where no kernel of compact support reaches, the row is 0, elsewhere it sums to 1 (seed 144)") {
  std::mt19937 random(144);
  const Body body = test::made_bar_body(4);
  const Basis basis(body, Kernel::of(KernelKind::wendland_c2, 0.5, 3));
  const InteriorSamples samples = random_samples(body, random, 200);
  const Matrix phi = basis_at(basis, samples);
  Index empty = 0;
  for (Index i = 0; i < samples.size(); ++i) {
    double nearest = HUGE_VAL;
    for (Index c = 0; c < 4; ++c) nearest = std::min(nearest, (samples.point(i) - body.center_position(c)).norm());
    if (std::abs(nearest - basis.kernel().width) < 1e-3) continue;
    const bool reached = nearest < basis.kernel().width;
    empty += !reached;
    CHECK(phi.row(i).sum() == doctest::Approx(reached ? 1 : 0));
  }
  CHECK(empty > 10);
  CHECK(empty < 190);
}

TEST_CASE("kernels of the caller's that fail or cancel are named") {
  const Body body = test::made_bar_body(2);
  InteriorSamples samples;
  samples.add(body.domain, body.center_position(0));
  Matrix phi(1, 2);
  const auto code_of = [&](double beyond) {
    Kernel kernel;
    kernel.kind = KernelKind::custom;
    kernel.width = 0.5;
    kernel.custom.function = step_kernel;
    kernel.custom.context = &beyond;
    phi.setZero();
    const auto done = Basis(body, kernel).evaluate<double>(samples, phi);
    if (!done) CHECK(!done.error().remedy.empty());
    return done ? HB_OK : done.error().code;
  };
  CHECK(code_of(0.25) == HB_OK);
  CHECK((phi - Eigen::RowVector2d(0.8, 0.2)).norm() < 1e-14);
  CHECK(code_of(-0.25) == HB_OK);  // of both signs, but they do not cancel
  CHECK((phi - Eigen::RowVector2d(4, -1) / 3).norm() < 1e-14);
  CHECK(code_of(-1) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(-0.999) == HB_ERROR_INVALID_OPTION);
  CHECK(code_of(std::numeric_limits<double>::quiet_NaN()) == HB_ERROR_KERNEL_FAILED);
  CHECK(code_of(HUGE_VAL) == HB_ERROR_KERNEL_FAILED);
}
