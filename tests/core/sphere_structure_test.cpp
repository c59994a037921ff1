#include "core/irbf/sphere_structure.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

using namespace handlebody;

namespace {

const Sphere ball{Vector3(1, 2, 3), 0.5};
const Sphere bone{Vector3(1, 2, 3), 0.5, Vector3(1, 2, 2)};

/** In the space where it is a unit ball about 0. */
Vector3 in_ball(const Sphere& sphere, const Vector3& point) {
  return half_axes(sphere).inverse() * (point - sphere.center);
}

}  // namespace

TEST_CASE("half the axes are perpendicular, the long one first, and all of one length for a sphere") {
  CHECK(half_axes(ball) == 0.5 * Matrix3::Identity());
  const Matrix3 axes = half_axes(bone);
  CHECK(axes.col(0) == bone.axis);
  CHECK((axes.transpose() * axes - Vector3(9, .25, .25).asDiagonal().toDenseMatrix()).norm() < 1e-14);
}

TEST_CASE("six points are the ends of three perpendicular diameters") {
  const StructureEdges made = structure_edges(ball, SphereStructure::octahedron);
  REQUIRE(made.points.size() == 6);
  REQUIRE(made.edges.size() == 3);
  CHECK(made.share == 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [from, to, scale] = made.edges[i];
    CHECK(scale * (made.points[to] - made.points[from]) == Vector3::Unit(static_cast<Index>(i)));
    CHECK((made.points[to] + made.points[from]) / 2 == ball.center);
  }
}

TEST_CASE(
    "twelve points lie on a sphere and 32 on an ellipsoid, evenly spread, and their edges weigh what three diameters of its row of "
    "spheres do") {
  for (const Sphere& sphere : {ball, bone}) {
    const StructureEdges made = structure_edges(sphere, SphereStructure::icosahedron);
    const std::size_t count = sphere.axis.isZero(0) ? 12 : 32;
    REQUIRE(made.points.size() == count + 1);
    REQUIRE(made.edges.size() == count);
    Matrix3 spread = Matrix3::Zero(), diameters = Matrix3::Zero();
    double nearest = 2;
    for (const auto& [from, to, scale] : made.edges) {
      CHECK(made.points[from] == sphere.center);
      const Vector3 place = in_ball(sphere, made.points[to]);
      CHECK(place.norm() == doctest::Approx(1).epsilon(1e-14));
      spread += place * place.transpose();
      const Vector3 edge = scale * (made.points[to] - made.points[from]);
      diameters += made.share * edge * edge.transpose();
      for (const auto& other : made.edges) {
        if (other.to != to) nearest = std::min(nearest, (place - in_ball(sphere, made.points[other.to])).norm());
      }
    }
    CHECK((spread - double(count) / 3 * Matrix3::Identity()).norm() < 1e-12);
    // The edge of an icosahedron in the unit ball; of 32 points, from the middle of its face to a vertex.
    CHECK(nearest == doctest::Approx(count == 12 ? 1.0514622242382672 : 0.6408518201709834).epsilon(1e-12));
    const Matrix3 axes = 2 * half_axes(sphere);
    const double row = sphere.axis.isZero(0) ? 1 : sphere.axis.norm() / sphere.radius;
    CHECK((diameters - row * axes * axes.transpose()).norm() < 1e-11);
  }
  // Six points cannot feel a bend of an ellipsoid, whatever was asked for.
  CHECK(structure_edges(bone, SphereStructure::octahedron).edges.size() == 32);
}
