#include "core/mesh/kuhn_tetrahedra.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <random>
#include <set>
#include <utility>

#include "core/numerics/types.hpp"

using namespace handlebody;

namespace {

Vector3 corner(int c) {
  return {static_cast<double>(c & 1), static_cast<double>(c >> 1 & 1), static_cast<double>(c >> 2)};
}

/** Columns from the first corner to the others. */
Matrix3 edges(const std::array<int, 4>& tetrahedron) {
  Matrix3 e;
  for (Index k = 0; k < 3; ++k) e.col(k) = corner(tetrahedron[k + 1]) - corner(tetrahedron[0]);
  return e;
}

/** The edges of tetrahedra in the face where the cube's coordinate on `axis` is `side`, as corners with that coordinate taken out.
 */
std::set<std::pair<int, int>> edges_in_face(int axis, int side) {
  std::set<std::pair<int, int>> found;
  const int bit = 1 << axis;
  for (const auto& tetrahedron : kuhn_tetrahedra)
    for (const int a : tetrahedron)
      for (const int b : tetrahedron)
        if (a < b && (a & bit) == side * bit && (b & bit) == side * bit) found.insert({a & ~bit, b & ~bit});
  return found;
}

}  // namespace

TEST_CASE("each has a sixth of the cube, positively oriented") {
  for (const auto& tetrahedron : kuhn_tetrahedra) CHECK(edges(tetrahedron).determinant() == doctest::Approx(1));
}

TEST_CASE("every place in the cube is in exactly one (seed 6)") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 1000; ++round) {
    const Vector3 place(uniform(random), uniform(random), uniform(random));
    int holders = 0;
    for (const auto& tetrahedron : kuhn_tetrahedra) {
      const Vector3 part = edges(tetrahedron).inverse() * place;  // corner 0 is the origin
      holders += part.minCoeff() >= 0 && part.sum() <= 1;
    }
    REQUIRE(holders == 1);
  }
}

TEST_CASE("cubes side by side agree on the face between them: four sides and one diagonal") {
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(edges_in_face(axis, 0).size() == 5);
    CHECK(edges_in_face(axis, 0) == edges_in_face(axis, 1));
  }
}
