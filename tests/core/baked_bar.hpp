// The bar of paper 001, Fig. 2, at a tenth of its vertices, baked.
#pragma once

#include <doctest/doctest.h>

#include "core/irbf/bake.hpp"
#include "made_meshes.hpp"

namespace handlebody::test {

inline Body baked_bar(Index centers, int spheres) {
  const MadeMesh mesh = made_box({10, 2, 2}, {30, 6, 6});
  BakeOptions options;
  options.centers = centers;
  options.resolution = 40;
  options.max_spheres = spheres;
  auto bake = Bake::begin(mesh.positions, mesh.triangles, options);
  REQUIRE(bake);
  for (double progress = 0; progress < 1;) {
    auto step = (*bake)->step();
    REQUIRE(step);
    progress = *step;
  }
  return (*bake)->body();
}

}  // namespace handlebody::test
