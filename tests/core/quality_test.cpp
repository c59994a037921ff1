#include "core/irbf/quality.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <random>

#include "core/mesh/kuhn_tetrahedra.hpp"

using namespace handlebody;

namespace {

/** The unit cube in six tetrahedra. */
struct Cube {
  Points rest{8, 3};
  Tetrahedra tetrahedra{6, 4};
  Cube() {
    for (Index c = 0; c < 8; ++c) rest.row(c) << (c & 1), (c >> 1 & 1), (c >> 2);
    for (Index t = 0; t < 6; ++t)
      for (Index k = 0; k < 4; ++k) tetrahedra(t, k) = static_cast<std::uint32_t>(kuhn_tetrahedra[t][k]);
  }
};

Matrix3 random_matrix(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Matrix3::NullaryExpr([&] { return normal(random); });
}

}  // namespace

TEST_CASE("affine maps have Σ (σ − 1)² of their singular values, by Eigen's SVD (seed 11)") {
  const Cube cube;
  std::mt19937 random(11);
  for (int round = 0; round < 30; ++round) {
    const Matrix3 map = Matrix3::Identity() + 0.5 * random_matrix(random);
    const Points moved = (cube.rest * map.transpose()).rowwise() + Eigen::RowVector3d(3, 4, 5);
    const Quality quality = measure_tetrahedra(cube.tetrahedra, cube.rest, moved);
    Vector3 sigma = Eigen::JacobiSVD<Matrix3>(map).singularValues();
    if (map.determinant() < 0) sigma[2] = -sigma[2];
    CHECK(quality.total_distortion == doctest::Approx((sigma - Vector3::Ones()).squaredNorm()).epsilon(1e-9));
    CHECK(quality.max_distortion == doctest::Approx(quality.total_distortion / 6).epsilon(1e-9));
    CHECK(quality.volume_ratio == doctest::Approx(map.determinant()).epsilon(1e-9));
    CHECK(quality.flips == (map.determinant() < 0 ? 6 : 0));
    CHECK(quality.tetrahedra == 6);
  }
}

TEST_CASE("rest and rigid motions have no distortion") {
  const Cube cube;
  const Matrix3 turn = Eigen::AngleAxisd(2, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Points& moved : {cube.rest, Points(cube.rest * turn.transpose())}) {
    const Quality quality = measure_tetrahedra(cube.tetrahedra, cube.rest, moved);
    CHECK(quality.total_distortion < 1e-28);
    CHECK(quality.volume_ratio == doctest::Approx(1).epsilon(1e-14));
    CHECK(quality.flips == 0);
  }
}

TEST_CASE("one corner pushed through turns over the tetrahedra that have it alone, and flat ones are left out") {
  Cube cube;
  Points moved = cube.rest;
  moved.row(1) << -0.5, 0.8, 0.8;  // corner 1 is in two tetrahedra
  const Quality quality = measure_tetrahedra(cube.tetrahedra, cube.rest, moved);
  CHECK(quality.flips > 0);
  CHECK(quality.flips <= 2);
  cube.rest.row(1) = cube.rest.row(0);
  CHECK(measure_tetrahedra(cube.tetrahedra, cube.rest, cube.rest).tetrahedra == 4);
}
