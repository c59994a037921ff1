// The solver's promises on the paper's bar: acceleration, hard constraints, kernels, λ.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "baked_bar.hpp"
#include "core/irbf/irbf.hpp"

using namespace handlebody;
using test::paper_options;

namespace {

Points corners() {
  Points points(8, 3);
  for (Index i = 0; i < 8; ++i) points.row(i) << (i & 1 ? 10 : 0), (i & 2 ? 2 : 0), (i & 4 ? 2 : 0);
  return points;
}

/** The bar held at its corners and bent by a quarter turn along an arc. */
std::unique_ptr<Irbf> bent(const Body& body, const IrbfOptions& options) {
  auto irbf = Irbf::create(body, options);
  REQUIRE(irbf);
  const Points rest = corners();
  REQUIRE((*irbf)->set_handles(rest, std::vector<HandleKind>(8, HandleKind::position)));
  const double radius = 20 / M_PI;
  for (Index k = 0; k < 8; ++k) {
    double* target = (*irbf)->targets() + k * Irbf::target_size;
    if (k & 1) target[0] = radius - (rest(k, 1) - 1), target[1] = 1 + radius;
  }
  return std::move(*irbf);
}

/** Iterations until the energy is within `part` of the least. */
int iterations_to(const Body& body, bool accelerate, double part, double least) {
  auto irbf = bent(body, paper_options());
  for (int k = 1; k < 20000; ++k) {
    const auto report = irbf->solve({1, 0, accelerate});
    REQUIRE(report);
    if (report->energy < (1 + part) * least) return k;
  }
  return 20000;
}

Points positions(Irbf& irbf) {
  PointsF out(irbf.vertex_count(), 3);
  irbf.deform(out.data(), nullptr, nullptr);
  return out.cast<double>();
}

}  // namespace

TEST_CASE("accelerated iterations find the minimum that plain ones find, in a small part of their number") {
  const Body body = test::baked_bar(100, 100);
  REQUIRE(body.spheres.size() >= 30);
  auto fast = bent(body, paper_options()), slow = bent(body, paper_options());
  const auto least = fast->solve({5000, 1e-10, true});
  const auto plain = slow->solve({5000, 1e-8, false});
  REQUIRE(least);
  REQUIRE(plain);
  CHECK(least->converged);
  CHECK(plain->energy == doctest::Approx(least->energy).epsilon(1e-3));
  CHECK((positions(*fast) - positions(*slow)).cwiseAbs().maxCoeff() < 1e-3 * body.normalization.diagonal);
  const int within_tenth = iterations_to(body, true, 0.1, least->energy);
  const int within_hundredth = iterations_to(body, true, 0.01, least->energy);
  const int plain_hundredth = iterations_to(body, false, 0.01, least->energy);
  MESSAGE("from rest, to 10% in " << within_tenth << ", to 1% in " << within_hundredth << " iterations; plain ones need "
                                  << plain_hundredth);
  CHECK(within_tenth <= 12);
  CHECK(5 * within_hundredth <= plain_hundredth);
}

TEST_CASE("the energy never rises, however the iterations are cut up, and cutting them up changes nothing") {
  const Body body = test::baked_bar(100, 40);
  auto whole = bent(body, paper_options()), cut = bent(body, paper_options());
  const auto at_once = whole->solve({24, 0, true});
  REQUIRE(at_once);
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 24; ++k) {
    const auto report = cut->solve({1, 0, true});
    REQUIRE(report);
    CHECK(report->energy <= last * (1 + 1e-9));
    last = report->energy;
  }
  CHECK(last == at_once->energy);
  CHECK(positions(*whole) == positions(*cut));
}

TEST_CASE("hard constraints meet their targets exactly, and soft ones agree with them") {
  const Body body = test::baked_bar(100, 9);
  IrbfOptions options = paper_options();
  options.constraints = ConstraintKind::hard;
  auto hard = bent(body, options), soft = bent(body, paper_options());
  const auto exact = hard->solve({500, 1e-9, true});
  const auto near = soft->solve({500, 1e-9, true});
  REQUIRE(exact);
  REQUIRE(near);
  CHECK(exact->anchor_error < 1e-9);
  CHECK(near->anchor_error > exact->anchor_error);
  CHECK(near->energy == doctest::Approx(exact->energy).epsilon(1e-3));
  CHECK(near->energy < exact->energy);  // it may miss a little
  CHECK((positions(*hard) - positions(*soft)).cwiseAbs().maxCoeff() < 1e-3 * body.normalization.diagonal);

  Points twice = corners();
  twice.row(3) = twice.row(5);
  const auto repeated = hard->set_handles(twice, std::vector<HandleKind>(8, HandleKind::position));
  REQUIRE_FALSE(repeated);
  CHECK(repeated.error().code == HB_ERROR_HANDLE_CONFLICT);
  CHECK(repeated.error().index == 5);
  CHECK(hard->handle_count() == 8);
}

TEST_CASE("every radial kernel deforms the bar, or says why not; decreasing ones come nearest to a maximum principle") {
  const Body body = test::baked_bar(60, 9);
  double inverse_multiquadric = 0;
  for (unsigned kind = 0; kind <= static_cast<unsigned>(KernelKind::compact_inverse_multiquadric); ++kind) {
    CAPTURE(kind);
    IrbfOptions options = paper_options();
    options.kernel = Kernel::of(static_cast<KernelKind>(kind), 4, 3);
    auto made = Irbf::create(body, options);
    if (!made) {
      CHECK(made.error().code == HB_ERROR_INVALID_OPTION);  // changes sign, and cancels
      CHECK(kind == static_cast<unsigned>(KernelKind::thin_plate));
      continue;
    }
    auto irbf = bent(body, options);
    const auto report = irbf->solve({200, 1e-7, true});
    REQUIRE(report);
    CHECK(report->anchor_error < 0.02 * body.normalization.diagonal);
    CHECK(irbf->condition() > 1);
    const auto quality = irbf->quality(Tetrahedra(0, 4));
    REQUIRE(quality);
    MESSAGE("kernel " << kind << ": volume " << quality->volume_ratio << ", distortion " << quality->total_distortion
                      << ", beyond the maximum principle by " << quality->maximum_principle << ", condition " << irbf->condition());
    CHECK(std::isfinite(quality->total_distortion));
    CHECK(quality->maximum_principle >= 0);
    if (kind == static_cast<unsigned>(KernelKind::inverse_multiquadric)) inverse_multiquadric = quality->maximum_principle;
    if (kind == static_cast<unsigned>(KernelKind::cubic)) CHECK(quality->maximum_principle >= inverse_multiquadric);
  }
  CHECK(inverse_multiquadric < 0.02);
}

TEST_CASE("a kernel of the caller's that fails is named") {
  const Body body = test::baked_bar(30, 5);
  IrbfOptions options = paper_options();
  options.kernel = Kernel::of(KernelKind::custom, 2, 3);
  options.kernel.custom.function = [](const void*, double s, bool) { return s > 1 ? std::nan("") : 1 - s / 2; };
  const auto refused = Irbf::create(body, options);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().code == HB_ERROR_KERNEL_FAILED);
  options.kernel.custom.function = [](const void*, double s, bool) { return 1 / std::sqrt(1 + s * s); };
  auto own = bent(body, options), built_in = bent(body, paper_options());
  REQUIRE(own->solve({50, 1e-8, true}));
  REQUIRE(built_in->solve({50, 1e-8, true}));
  CHECK((positions(*own) - positions(*built_in)).cwiseAbs().maxCoeff() < 1e-5 * body.normalization.diagonal);
}

TEST_CASE("Fig. 9: with seven spheres, too small a λ is jerky, too large a one gives up rigidity; the chosen one is between") {
  const Body body = test::baked_bar(100, 7);
  const auto distortion = [&](double smoothness, double width) {
    IrbfOptions options = paper_options();
    options.smoothness = smoothness;
    options.kernel.width = width;
    auto irbf = bent(body, options);
    REQUIRE(irbf->solve({3000, 1e-7, true}));
    const auto quality = irbf->quality(Tetrahedra(0, 4));
    REQUIRE(quality);
    return std::pair(quality->total_distortion, irbf->smoothness());
  };
  for (const double width : {2.0, 3.0, 4.0}) {
    CAPTURE(width);
    double least = std::numeric_limits<double>::infinity(), first = 0, last = 0;
    for (const double smoothness : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
      last = distortion(smoothness, width).first;
      if (first == 0) first = last;
      least = std::min(least, last);
    }
    const auto [chosen, smoothness] = distortion(0, width);
    MESSAGE("width " << width << ": distortion from " << first << " over " << least << " to " << last << "; with the chosen λ "
                     << smoothness << " " << chosen);
    CHECK(first > 1.02 * least);
    CHECK(last > 1.5 * least);
    CHECK(chosen < 1.35 * least);
    CHECK(chosen < last);
  }
}

TEST_CASE("Fig. 20: fewer centers follow the spheres less") {
  double last_energy = 0;
  for (const Index centers : {50, 35, 20, 10}) {
    const Body body = test::baked_bar(centers, 20);
    IrbfOptions options = paper_options();
    options.smoothness = 1e-6;
    auto irbf = bent(body, options);
    const auto report = irbf->solve({1000, 1e-8, true});
    REQUIRE(report);
    const auto quality = irbf->quality(Tetrahedra(0, 4));
    REQUIRE(quality);
    MESSAGE(centers << " centers: energy " << report->energy << ", distortion " << quality->total_distortion << ", volume "
                    << quality->volume_ratio);
    CHECK(report->energy > last_energy);
    last_energy = report->energy;
  }
}

TEST_CASE("the chosen λ does not depend on the model's size, and follows the energy's weights") {
  const Body body = test::baked_bar(60, 9);
  const auto chosen = [](const Body& from, double exponent) {
    IrbfOptions options = paper_options();
    options.edge_exponent = exponent;
    auto irbf = Irbf::create(from, options);
    REQUIRE(irbf);
    return (*irbf)->smoothness();
  };
  Body large = body;
  large.positions *= 8;
  large.normalization.center *= 8;
  large.normalization.diagonal *= 8;
  CHECK(chosen(large, -1) == doctest::Approx(chosen(body, -1)).epsilon(1e-12));
  CHECK(chosen(body, 0) < chosen(body, -1));  // edges are shorter than 1
}

TEST_CASE(
    "the smaller of the two products gives what the other one does, and a new set of handles keeps the shape until it is solved") {
  // 27 + 8 columns by spheres and handles, 100 by centers; and 40 spheres, where centers are fewer.
  for (const int spheres : {9, 40}) {
    const Body body = test::baked_bar(100, spheres);
    CAPTURE(spheres);
    for (const FramePrecision precision : {FramePrecision::floating, FramePrecision::fixed}) {
      IrbfOptions options = paper_options();
      options.precision = precision;
      auto irbf = bent(body, options);
      REQUIRE(irbf->solve({50, 1e-7, true}));
      const auto reference = irbf->evaluate(body.positions);
      REQUIRE(reference);
      const Points moved = positions(*irbf);
      const double error = (moved - *reference).rowwise().norm().maxCoeff() / body.normalization.diagonal;
      MESSAGE("largest error " << error);
      CHECK(error < (precision == FramePrecision::fixed ? 1e-4 : 4e-6));
      REQUIRE(irbf->set_handles(corners().topRows(4), std::vector<HandleKind>(4, HandleKind::position)));
      CHECK((positions(*irbf) - moved).rowwise().norm().maxCoeff() < 2e-4 * body.normalization.diagonal);
    }
  }
}

TEST_CASE("one handle carries the shape along, and two turn it") {
  const Body body = test::baked_bar(60, 9);
  for (const ConstraintKind kind : {ConstraintKind::soft, ConstraintKind::hard}) {
    IrbfOptions options = paper_options();
    options.constraints = kind;
    auto irbf = Irbf::create(body, options);
    REQUIRE(irbf);
    REQUIRE((*irbf)->set_handles(corners().topRows(1), {HandleKind::position}));
    (*irbf)->targets()[1] += 3;
    const auto report = (*irbf)->solve({50, 1e-7, true});
    REQUIRE(report);
    CHECK(report->energy < 1e-15);
    const Points moved = positions(**irbf);
    CHECK((moved - body.positions).col(1).cwiseAbs().minCoeff() > 3 - 1e-4);
    CHECK((moved - body.positions).col(0).cwiseAbs().maxCoeff() < 1e-4);
  }
}
