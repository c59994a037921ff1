// How fine a grid a body gets: by how much is inside, whatever its shape.
#include "core/irbf/interior_search.hpp"

#include <doctest/doctest.h>

#include "made_meshes.hpp"

using namespace handlebody;
using test::made_box;
using test::MadeMesh;

namespace {

struct Searched {
  MadeMesh mesh;
  std::unique_ptr<InteriorSearch> search;
  bool failed = false;

  Searched(MadeMesh made, int resolution, BakeQuality quality, InteriorOptions options = {}) : mesh(std::move(made)) {
    options.centers = 100;
    search = std::make_unique<InteriorSearch>(mesh.positions, mesh.triangles, resolution, quality, std::move(options));
    for (double progress = 0; progress < 1;) {
      const auto step = search->step();
      if (!step) {
        failed = true;
        return;
      }
      CHECK(*step >= progress);
      progress = *step;
    }
  }
  Index voxels() { return search->found().domain().size(); }
};

}  // namespace

TEST_CASE("a cube, a plate and a rod get the same number of voxels, by the quality, and so different resolutions") {
  for (const auto& [quality, aim] : {std::pair(BakeQuality::draft, 5000.), std::pair(BakeQuality::normal, 16000.)}) {
    Searched cube(made_box({1, 1, 1}, {2, 2, 2}), 0, quality), plate(made_box({1, 1, 0.1}, {2, 2, 2}), 0, quality),
        rod(made_box({1, 0.1, 0.1}, {8, 2, 2}), 0, quality);
    for (Searched* one : {&cube, &plate, &rod}) CHECK(std::abs(double(one->voxels()) / aim - 1) < 0.2);
    CHECK(cube.search->resolution() < plate.search->resolution());
    CHECK(plate.search->resolution() < rod.search->resolution());
  }
}

TEST_CASE("a resolution that is given is taken, and a wire is as fine as the quality allows at most") {
  Searched given(made_box({1, 1, 1}, {2, 2, 2}), 20, BakeQuality::normal);
  CHECK(given.search->resolution() == 20);
  CHECK(given.voxels() == 8000);
  Searched wire(made_box({1, 0.012, 0.012}, {20, 1, 1}), 0, BakeQuality::normal);
  CHECK(wire.search->resolution() == 192);
}

TEST_CASE("what encloses nothing on the first grid is tried on finer ones, and fails where it is an open sheet") {
  Searched thin(made_box({1, 0.4, 0.004}, {4, 2, 1}), 0, BakeQuality::normal);
  if (!thin.failed) CHECK(thin.voxels() > 0);
  MadeMesh open = made_box({1, 1, 1}, {2, 2, 2});
  open.triangles.conservativeResize(2, 3);
  CHECK(Searched(open, 0, BakeQuality::draft).failed);
}
