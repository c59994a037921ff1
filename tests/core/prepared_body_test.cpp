#include "core/irbf/prepared_body.hpp"

#include <doctest/doctest.h>

#include "baked_bar.hpp"
#include "core/irbf/irbf.hpp"

using namespace handlebody;

namespace {

/** The bar's two ends. */
Points ends() {
  Points points(2, 3);
  points << 0, 0, 0, 10, 2, 2;
  return points;
}

const std::vector<HandleKind> two(2, HandleKind::position);

Points present(Irbf& irbf) {
  PointsF out(irbf.vertex_count(), 3);
  irbf.deform(out.data(), nullptr, nullptr);
  return out.cast<double>();
}

/** Lifts one end, and gives what comes of it. */
Points lifted(Irbf& irbf) {
  REQUIRE(irbf.set_handles(ends(), two));
  irbf.targets()[Irbf::target_size + 1] += 3;
  REQUIRE(irbf.solve({}));
  return present(irbf);
}

}  // namespace

TEST_CASE("deformations that share a body deform as one of its own does, and outlive each other") {
  const Body body = test::baked_bar(60, 9);
  for (const FramePrecision precision : {FramePrecision::fixed, FramePrecision::floating}) {
    IrbfOptions options;
    options.precision = precision;
    auto alone = Irbf::create(body, options);
    REQUIRE(alone);
    const Points bent = lifted(**alone);

    auto prepared = PreparedBody::create(body, options);
    REQUIRE(prepared);
    auto first = std::make_unique<Irbf>(*prepared);
    Irbf second(first->prepared());
    prepared->reset();
    CHECK(second.handle_count() == 0);
    CHECK(lifted(*first) == bent);
    CHECK((present(second) - body.positions).cwiseAbs().maxCoeff() < 1e-6);
    first.reset();
    CHECK(lifted(second) == bent);
    const auto quality = second.quality(Tetrahedra(0, 4)), expected = (*alone)->quality(Tetrahedra(0, 4));
    REQUIRE(quality);
    REQUIRE(expected);
    CHECK(quality->volume_ratio == doctest::Approx(expected->volume_ratio));
    CHECK(quality->maximum_principle == expected->maximum_principle);
  }
}

TEST_CASE("what cannot be prepared is refused by name") {
  const auto refusal = [](const Body& body, const IrbfOptions& options) {
    const auto prepared = PreparedBody::create(body, options);
    REQUIRE_FALSE(prepared);
    return prepared.error().code;
  };
  const Body body = test::baked_bar(60, 9);
  IrbfOptions options;
  options.anchor_weight = -1;
  CHECK(refusal(body, options) == HB_ERROR_INVALID_OPTION);
  Body broken = body;
  broken.distances.pop_back();
  CHECK(refusal(broken, {}) == HB_ERROR_BODY_INVALID);
}
