// What all deformations of held meshes share, seen through the harmonic one.
#include "core/skinning/held_deformation.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <utility>
#include <vector>

#include "core/skinning/quadratic_deformation.hpp"
#include "skins.hpp"

using namespace handlebody;

namespace {

/** A strip of 2 × `columns` squares, row after row: vertex i + (columns + 1)·j is at (i, j). */
SimplexMesh strip_mesh(Index columns) {
  SimplexMesh mesh{Matrix(3 * (columns + 1), 2), Simplices(4 * columns, 3)};
  for (Index v = 0; v < mesh.positions.rows(); ++v)
    mesh.positions.row(v) << static_cast<double>(v % (columns + 1)), static_cast<double>(v / (columns + 1));
  Index t = 0;
  for (Index j = 0; j < 2; ++j)
    for (Index i = 0; i < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (columns + 1) + i), c = a + static_cast<std::uint32_t>(columns) + 1;
      mesh.simplices.row(t++) << a, a + 1, c + 1;
      mesh.simplices.row(t++) << a, c + 1, c;
    }
  return mesh;
}

Result<std::unique_ptr<HeldDeformation>> harmonic(const SimplexMesh& mesh, const HeldVertices& held) {
  return quadratic_deformation(mesh, held, QuadraticEnergy::dirichlet);
}

/** Opens what deformations are made with; never made itself. */
struct OpenedDeformation : HeldDeformation {
  using HeldDeformation::free_solver;
};

Matrix moved_by(double x, double y) {
  return test::affine(MatrixXd::Identity(2, 2), Eigen::Vector2d(x, y));
}

}  // namespace

TEST_CASE("twice the signed area of a triangle, at rest and displaced") {
  const double p[] = {0, 0, 9, 9, 3, 0, 0, 4}, u[] = {0, 0, 0, 0, -1, 0, 5, -6};
  const std::uint32_t corners[] = {0, 2, 3}, turned[] = {0, 3, 2};
  CHECK(doubled_area(corners, p) == 12);
  CHECK(doubled_area(turned, p) == -12);
  CHECK(doubled_area(corners, p, u) == 2 * -2);  // (2, 0) and (5, −2)
}

TEST_CASE("a point handle holds the vertices around its own too, a bone only its vertices") {
  // The left end by its middle vertex, the right end by all three.
  const SimplexMesh mesh = strip_mesh(6);
  auto skin = harmonic(mesh, {{7, 6, 13, 20}, {0, 1, 1, 1}, 2});
  REQUIRE(skin);
  const Matrix half_turn = test::affine(-MatrixXd::Identity(2, 2), Eigen::Vector2d(0, 2));  // about (0, 1)
  test::set_transform(**skin, 0, half_turn);
  test::set_transform(**skin, 1, moved_by(1, 3));
  const Matrix out = test::deformed(**skin);
  const Matrix turned = test::transformed(half_turn, mesh.positions), moved = test::transformed(moved_by(1, 3), mesh.positions);
  CHECK((out.row(7) - turned.row(7)).norm() < 1e-6);
  for (Index v = 0; v < 21; ++v) {
    bool neighbor = false;
    for (Index t = 0; t < mesh.simplices.rows(); ++t)
      neighbor |=
          (mesh.simplices.row(t).array() == 7u).any() && (mesh.simplices.row(t).array() == static_cast<std::uint32_t>(v)).any();
    CAPTURE(v);
    if (neighbor) {
      CHECK((out.row(v) - turned.row(v)).norm() < 1e-6);
    } else if (v == 6 || v == 13 || v == 20) {
      CHECK((out.row(v) - moved.row(v)).norm() < 1e-6);
    } else {  // free: neither handle's
      CHECK((out.row(v) - turned.row(v)).norm() > 0.1);
      CHECK((out.row(v) - moved.row(v)).norm() > 0.1);
    }
  }
}

TEST_CASE("a vertex around two point handles is neither's") {
  const SimplexMesh mesh = strip_mesh(6);
  auto skin = harmonic(mesh, {{8, 10}, {0, 1}, 2});  // at (1, 1) and (3, 1): (2, 1) is around both
  REQUIRE(skin);
  test::set_transform(**skin, 0, moved_by(0, -1));
  test::set_transform(**skin, 1, moved_by(0, 1));
  const Matrix out = test::deformed(**skin);
  CHECK(out(8, 1) == doctest::Approx(0));
  CHECK(out(10, 1) == doctest::Approx(2));
  CHECK(out(9, 1) > 0.2);
  CHECK(out(9, 1) < 1.8);
}

TEST_CASE("a part without a handle goes as a whole with the nearest one") {
  SimplexMesh mesh = strip_mesh(3);
  const Index n = mesh.positions.rows(), m = mesh.simplices.rows();
  mesh.positions.conservativeResize(n + 3, 2);
  mesh.positions.bottomRows(3) << 5, 0, 6, 0, 5, 1;
  mesh.simplices.conservativeResize(m + 1, 3);
  for (Index k = 0; k < 3; ++k) mesh.simplices(m, k) = static_cast<std::uint32_t>(n + k);
  auto skin = harmonic(mesh, {{0, 3}, {0, 1}, 2});  // left and right, of which the right is nearest
  REQUIRE(skin);
  const Matrix quarter = test::affine(Eigen::Rotation2Dd(1.5).toRotationMatrix(), Eigen::Vector2d(1, 2));
  test::set_transform(**skin, 1, quarter);
  CHECK(test::apart(test::deformed(**skin).bottomRows(3), test::transformed(quarter, mesh.positions).bottomRows(3)) < 1e-5);
}

TEST_CASE("flips are triangles that face the other way or lost their area") {
  const SimplexMesh mesh = strip_mesh(4);
  Indices all;
  for (std::uint32_t v = 0; v < 15; ++v) all.push_back(v);
  auto skin = harmonic(mesh, {all, Indices(15, 0), 1});
  REQUIRE(skin);
  test::deformed(**skin);
  CHECK((*skin)->report().flips == 0);
  CHECK((*skin)->report().energy == 0);
  test::set_transform(**skin, 0, test::affine(Eigen::Vector2d(1, -1).asDiagonal(), Eigen::Vector2d(0, 0)));
  test::deformed(**skin);
  CHECK((*skin)->report().flips == 16);
  test::set_transform(**skin, 0, test::affine(Eigen::Vector2d(1, 0).asDiagonal(), Eigen::Vector2d(0, 0)));
  test::deformed(**skin);
  CHECK((*skin)->report().flips == 16);
}

TEST_CASE("meshes that are not of triangles in the plane are refused, and others as everywhere") {
  const auto code_of_mesh = [](const SimplexMesh& mesh, const HeldVertices& held) {
    const auto made = harmonic(mesh, held);
    REQUIRE_FALSE(made);
    return made.error().code;
  };
  const HeldVertices corner{{0}, {0}, 1};
  SimplexMesh space = strip_mesh(2);
  space.positions.conservativeResize(space.positions.rows(), 3);
  space.positions.col(2).setZero();
  CHECK(code_of_mesh(space, corner) == HB_ERROR_INVALID_SHAPE);
  SimplexMesh thin = strip_mesh(2);
  thin.positions.row(4) = thin.positions.row(5);
  CHECK(code_of_mesh(thin, corner) == HB_ERROR_MESH_DEGENERATE);
  SimplexMesh beyond = strip_mesh(2);
  beyond.simplices(3, 1) = 100;
  CHECK(code_of_mesh(beyond, corner) == HB_ERROR_MESH_INDEX_OUT_OF_RANGE);
  CHECK(code_of_mesh(strip_mesh(2), {{}, {}, 0}) == HB_ERROR_HANDLES_MISSING);
  CHECK(code_of_mesh(strip_mesh(2), {{0, 0}, {0, 1}, 2}) == HB_ERROR_HANDLE_CONFLICT);
}

TEST_CASE("equations that do not determine the free vertices are refused") {
  const Indices owners{0, no_index, no_index};
  SparseMatrix q(3, 3);
  q.setIdentity();
  CHECK(OpenedDeformation::free_solver(q, owners));
  q.coeffRef(0, 0) = 0;  // the held one's
  CHECK(OpenedDeformation::free_solver(q, owners));
  q.coeffRef(2, 2) = 0;
  const auto made = OpenedDeformation::free_solver(q, owners);
  REQUIRE_FALSE(made);
  CHECK(made.error().code == HB_ERROR_SYSTEM_SINGULAR);
}
