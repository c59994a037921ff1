#include "core/mesh/enclosed_volume.hpp"

#include <doctest/doctest.h>

#include "made_meshes.hpp"

using namespace handlebody;

TEST_CASE("a box encloses its volume, wherever it is") {
  test::MadeMesh box = test::made_box({2, 3, 4}, {3, 2, 5});
  box.positions.rowwise() += Eigen::RowVector3d(100, -50, 20);
  CHECK(enclosed_volume(box.positions, box.triangles) == doctest::Approx(24).epsilon(1e-12));
}

TEST_CASE("a surface turned inside out encloses less than nothing, a flat one and none at all nothing") {
  test::MadeMesh box = test::made_box({2, 3, 4}, {1, 1, 1});
  box.triangles.col(1).swap(box.triangles.col(2));
  CHECK(enclosed_volume(box.positions, box.triangles) == doctest::Approx(-24).epsilon(1e-12));
  box.positions.col(2).setConstant(7);
  CHECK(enclosed_volume(box.positions, box.triangles) == 0);
  CHECK(enclosed_volume(Points(0, 3), Triangles(0, 3)) == 0);
}

TEST_CASE("a small box far away keeps nine digits of its volume") {
  test::MadeMesh box = test::made_box({0.5, 0.25, 0.125}, {2, 2, 2});
  box.positions.rowwise() += Eigen::RowVector3d(1e5, 2e5, -3e5);
  CHECK(enclosed_volume(box.positions, box.triangles) == doctest::Approx(1. / 64).epsilon(1e-9));
}
