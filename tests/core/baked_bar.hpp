// The bar of paper 001, Fig. 2, at a tenth of its vertices, baked.
#pragma once

#include <doctest/doctest.h>

#include "core/irbf/bake.hpp"
#include "core/irbf/prepared_body.hpp"
#include "made_meshes.hpp"

namespace handlebody::test {

/** The energy of paper 001 itself, with the width that its bar has in most figures. */
inline IrbfOptions paper_options() {
  IrbfOptions options;
  options.kernel.width = 2;
  options.edge_exponent = -1;
  options.poisson_ratio = 0;
  return options;
}

inline Body baked_bar(Index centers, int spheres) {
  const MadeMesh mesh = made_box({10, 2, 2}, {30, 6, 6});
  BakeOptions options;
  options.centers = centers;
  options.resolution = 40;
  options.max_spheres = spheres;
  options.packing = SpherePacking::medial;  // as many as are asked for
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
