#include "core/irbf/prepared_body.hpp"

#include <doctest/doctest.h>

#include "core/irbf/bake.hpp"
#include "core/irbf/irbf.hpp"
#include "made_meshes.hpp"

using namespace handlebody;

namespace {

Body bar() {
  const test::MadeMesh mesh = test::made_box({10, 2, 2}, {30, 6, 6});
  BakeOptions options;
  options.centers = 60;
  options.resolution = 40;
  options.max_spheres = 9;
  auto bake = Bake::begin(mesh.positions, mesh.triangles, options);
  REQUIRE(bake);
  for (double progress = 0; progress < 1;) {
    auto step = (*bake)->step();
    REQUIRE(step);
    progress = *step;
  }
  return (*bake)->body();
}

/** Its two ends. */
Points ends() {
  Points points(2, 3);
  points << 0, 0, 0, 10, 2, 2;
  return points;
}

const std::vector<HandleKind> two(2, HandleKind::position);

/** Lifts one end, and gives what comes of it. */
Points lifted(Irbf& irbf) {
  REQUIRE(irbf.set_handles(ends(), two));
  irbf.targets()[Irbf::target_size + 1] += 3;
  REQUIRE(irbf.solve({}));
  PointsF out(irbf.vertex_count(), 3);
  irbf.deform(out.data(), nullptr, nullptr);
  return out.cast<double>();
}

Points present(Irbf& irbf) {
  PointsF out(irbf.vertex_count(), 3);
  irbf.deform(out.data(), nullptr, nullptr);
  return out.cast<double>();
}

}  // namespace

TEST_CASE("deformations that share a body deform as one of its own does, and outlive each other") {
  const Body body = bar();
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
  const Body body = bar();
  IrbfOptions options;
  options.anchor_weight = -1;
  CHECK(refusal(body, options) == HB_ERROR_INVALID_OPTION);
  Body broken = body;
  broken.distances.pop_back();
  CHECK(refusal(broken, {}) == HB_ERROR_BODY_INVALID);
}
