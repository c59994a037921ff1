#include "core/distance/inner_depth.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "capsule_trees.hpp"

using namespace handlebody;
using namespace handlebody::test;

TEST_CASE("the inner depth is exact at voxel centers, and elsewhere at most the depth and within a voxel of it (seed 1)") {
  const Capsules capsules{{{0, 0, 0}, {1, 0.2, 0.1}, 0.2}};
  const Solid body = solid_of(capsules, 40);
  for (Index v = 0; v < body.domain.size(); ++v) {
    CHECK(inner_depth(body.domain, body.depth, body.domain.center(v)) == doctest::Approx(body.depth[v]));
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-0.2, 1.2);
  for (int i = 0; i < 3000; ++i) {
    const Vector3 p(part(random), part(random) / 2, part(random) / 2);
    const double depth = depth_in(capsules, p), inner = inner_depth(body.domain, body.depth, p);
    CHECK(inner <= std::max(depth, 0.) + 1e-12);
    if (depth > 0) CHECK(inner > depth - body.spacing());
  }
}
