#include "core/mesh/vertex_normals.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "made_meshes.hpp"

using namespace handlebody;

namespace {

PointsF normals_of(const PointsF& positions, const Triangles& triangles) {
  PointsF normals = PointsF::Constant(positions.rows(), 3, 7);  // must not matter
  const float* const memory = normals.data();
  vertex_normals(positions, triangles, normals);
  CHECK(normals.data() == memory);
  return normals;
}

}  // namespace

TEST_CASE("a regular octahedron's normals point away from its middle") {
  PointsF positions(6, 3);
  positions << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  Triangles triangles(8, 3);
  triangles << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
  CHECK((normals_of(positions, triangles) - positions).norm() < 1e-6f);
  triangles.col(1).swap(triangles.col(2));
  CHECK((normals_of(positions, triangles) + positions).norm() < 1e-6f);
}

TEST_CASE("triangles count by their areas") {
  // About the edge on the x axis, a triangle of area 1 in the plane z = 0 and one of area 3 in the plane y = 0.
  PointsF positions(4, 3);
  positions << 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 6;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 3, 1;  // facing +z and +y
  const PointsF normals = normals_of(positions, triangles);
  for (const Index shared : {0, 1}) {
    const Eigen::RowVector3f expected(0, 3 / std::sqrt(10.f), 1 / std::sqrt(10.f));
    CHECK((normals.row(shared) - expected).norm() < 1e-6f);
  }
  CHECK((normals.row(2) - Eigen::RowVector3f(0, 0, 1)).norm() < 1e-6f);
  CHECK((normals.row(3) - Eigen::RowVector3f(0, 1, 0)).norm() < 1e-6f);
}

TEST_CASE("normals turn with the mesh, whatever its place, its size and the order of its triangles (seed 31)") {
  std::mt19937 random(31);
  std::normal_distribution<float> normal;
  const test::MadeMesh mesh = test::made_box({1, 2, 3}, {2, 3, 4});
  PointsF positions = mesh.positions.cast<float>();
  for (float& x : positions.reshaped()) x += .1f * normal(random);
  const PointsF normals = normals_of(positions, mesh.triangles);
  for (Index v = 0; v < normals.rows(); ++v) CHECK(normals.row(v).norm() == doctest::Approx(1).epsilon(1e-6));

  const Eigen::Matrix3f turn =
      Eigen::Quaternionf(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
  const PointsF moved = ((5 * positions * turn.transpose()).rowwise() + Eigen::RowVector3f(3, -2, 1)).eval();
  const Triangles reversed = mesh.triangles.colwise().reverse();
  CHECK((normals_of(moved, reversed) - normals * turn.transpose()).cwiseAbs().maxCoeff() < 1e-5f);
}

TEST_CASE("a vertex without area points up") {
  PointsF positions(5, 3);
  positions << 0, 0, 0, 1, 0, 0, 2, 0, 0, 5, 5, 5, 0, 0, 3;
  Triangles flat(1, 3);
  flat << 0, 1, 2;
  const PointsF normals = normals_of(positions, flat);
  for (Index v = 0; v < 5; ++v) CHECK(normals.row(v) == Eigen::RowVector3f(0, 1, 0));

  // So do vertices of two triangles back to back.
  Triangles both(2, 3);
  both << 0, 1, 4, 0, 4, 1;
  CHECK(normals_of(positions, both).row(0) == Eigen::RowVector3f(0, 1, 0));
}
