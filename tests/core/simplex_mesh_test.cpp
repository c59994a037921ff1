#include "core/mesh/simplex_mesh.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

using namespace handlebody;

namespace {

/** Volume from lengths alone: Cayley and Menger's determinant. */
double volume_from_lengths(const SimplexMesh& mesh, Index simplex) {
  const Index corners = mesh.simplices.cols();
  MatrixXd bordered = MatrixXd::Ones(corners + 1, corners + 1);
  bordered(corners, corners) = 0;
  for (Index i = 0; i < corners; ++i)
    for (Index j = 0; j < corners; ++j)
      bordered(i, j) =
          (mesh.positions.row(mesh.simplices(simplex, i)) - mesh.positions.row(mesh.simplices(simplex, j))).squaredNorm();
  return std::sqrt(corners == 3 ? -bordered.determinant() / 16 : bordered.determinant() / 288);
}

SimplexMesh random_simplices(std::mt19937& random, Index vertices, Index dimension, Index simplices, Index corners) {
  std::normal_distribution<double> normal;
  SimplexMesh mesh{Matrix::NullaryExpr(vertices, dimension, [&] { return normal(random); }), Simplices(simplices, corners)};
  for (Index s = 0; s < simplices; ++s)
    for (Index k = 0; k < corners; ++k) {
      bool fresh = false;
      while (!fresh) {
        mesh.simplices(s, k) = static_cast<std::uint32_t>(random() % static_cast<unsigned>(vertices));
        fresh = true;
        for (Index l = 0; l < k; ++l) fresh = fresh && mesh.simplices(s, l) != mesh.simplices(s, k);
      }
    }
  return mesh;
}

/** A right triangle and, in the plane, nothing else. */
SimplexMesh one_triangle() {
  SimplexMesh mesh{Matrix(3, 2), Simplices(1, 3)};
  mesh.positions << 0, 0, 3, 0, 0, 4;
  mesh.simplices << 0, 1, 2;
  return mesh;
}

SimplexMesh one_tetrahedron() {
  SimplexMesh mesh{Matrix(4, 3), Simplices(1, 4)};
  mesh.positions << 1, 1, 1, 3, 1, 1, 1, 4, 1, 1, 1, 6;
  mesh.simplices << 0, 1, 2, 3;
  return mesh;
}

void check_mesh_refused(const SimplexMesh& mesh, hb_status code, hb_culprit culprit = HB_CULPRIT_NONE, std::int64_t index = -1) {
  const auto checked = check_simplex_mesh(mesh);
  REQUIRE_FALSE(checked);
  CAPTURE(checked.error().message);
  CHECK(checked.error().code == code);
  CHECK(checked.error().culprit == culprit);
  CHECK(checked.error().index == index);
}

}  // namespace

TEST_CASE("areas and volumes in closed form, whichever way the corners run") {
  SimplexMesh triangle = one_triangle(), tetrahedron = one_tetrahedron();
  CHECK(simplex_volume(triangle, 0) == doctest::Approx(6));
  CHECK(simplex_volume(tetrahedron, 0) == doctest::Approx(5));
  triangle.simplices << 0, 2, 1;
  tetrahedron.simplices << 1, 0, 2, 3;
  CHECK(simplex_volume(triangle, 0) == doctest::Approx(6));
  CHECK(simplex_volume(tetrahedron, 0) == doctest::Approx(5));
}

TEST_CASE("areas and volumes from the lengths of edges alone: triangles in the plane and in space, tetrahedra (seed 41)") {
  std::mt19937 random(41);
  for (const auto& [dimension, corners] : {std::pair<Index, Index>{2, 3}, {3, 3}, {3, 4}}) {
    const SimplexMesh mesh = random_simplices(random, 40, dimension, 60, corners);
    for (Index s = 0; s < 60; ++s) CHECK(simplex_volume(mesh, s) == doctest::Approx(volume_from_lengths(mesh, s)).epsilon(1e-9));
  }
}

TEST_CASE("meshes that no operator can be made on are named") {
  CHECK(check_simplex_mesh(one_triangle()));
  CHECK(check_simplex_mesh(one_tetrahedron()));
  const double nan = std::numeric_limits<double>::quiet_NaN();

  SimplexMesh mesh = one_triangle();
  mesh.positions.conservativeResize(2, 2);
  check_mesh_refused(mesh, HB_ERROR_MESH_TOO_FEW_VERTICES);
  mesh = one_tetrahedron();
  mesh.positions.conservativeResize(3, 3);
  check_mesh_refused(mesh, HB_ERROR_MESH_TOO_FEW_VERTICES);
  mesh = one_triangle();
  mesh.simplices.resize(0, 3);
  check_mesh_refused(mesh, HB_ERROR_MESH_NO_TRIANGLES);
  for (const double bad : {nan, HUGE_VAL, -HUGE_VAL}) {
    mesh = one_triangle();
    mesh.positions(1, 1) = bad;
    check_mesh_refused(mesh, HB_ERROR_MESH_NOT_FINITE, HB_CULPRIT_VERTEX, 1);
  }
  mesh = one_triangle();
  mesh.positions *= 1e61;
  check_mesh_refused(mesh, HB_ERROR_MESH_NOT_FINITE);
  mesh.positions.setConstant(2);
  check_mesh_refused(mesh, HB_ERROR_MESH_ZERO_EXTENT);
  mesh = one_triangle();
  mesh.simplices(0, 1) = 3;
  check_mesh_refused(mesh, HB_ERROR_MESH_INDEX_OUT_OF_RANGE, HB_CULPRIT_TRIANGLE, 0);
  mesh.simplices(0, 1) = 0xffffffff;
  check_mesh_refused(mesh, HB_ERROR_MESH_INDEX_OUT_OF_RANGE, HB_CULPRIT_TRIANGLE, 0);
  mesh = one_tetrahedron();
  mesh.simplices.conservativeResize(3, 4);
  mesh.simplices.row(1) << 0, 1, 2, 3;
  mesh.simplices.row(2) << 0, 1, 2, 4;
  check_mesh_refused(mesh, HB_ERROR_MESH_INDEX_OUT_OF_RANGE, HB_CULPRIT_TETRAHEDRON, 2);
  // Sizes are refused before anything is read.
  mesh = one_triangle();
  mesh.positions.resize(4'000'001, 2);
  check_mesh_refused(mesh, HB_ERROR_MESH_TOO_LARGE);
}

TEST_CASE("vertices that no simplex uses may be anywhere, and give no extent") {
  for (const double anywhere : {std::nan(""), HUGE_VAL, 1e300, 5.0}) {
    SimplexMesh mesh = one_triangle();
    mesh.positions.conservativeResize(4, 2);
    mesh.positions.row(3).setConstant(anywhere);
    CHECK(used_vertices(mesh) == std::vector<char>{1, 1, 1, 0});
    CHECK(check_simplex_mesh(mesh));
    mesh.positions.topRows(3).setConstant(2);
    check_mesh_refused(mesh, HB_ERROR_MESH_ZERO_EXTENT);
  }
}

TEST_CASE("simplices without volume are named, thin ones are let through, at any size") {
  for (const double size : {1e-40, 1.0, 1e40}) {
    CAPTURE(size);
    SimplexMesh mesh = one_triangle();
    mesh.positions << 0, 0, 2, 0, 1, 1e-12;
    mesh.positions *= size;
    CHECK(check_volumes(mesh));
    mesh.positions(2, 1) = 1e-14 * size;  // an area of 1e-14, the longest edge's square is 4
    const auto flat = check_volumes(mesh);
    REQUIRE_FALSE(flat);
    CHECK(flat.error().code == HB_ERROR_MESH_DEGENERATE);
    CHECK(flat.error().culprit == HB_CULPRIT_TRIANGLE);
    CHECK(flat.error().index == 0);

    SimplexMesh solid = one_tetrahedron();
    solid.positions *= size;
    solid.simplices.conservativeResize(2, 4);
    solid.simplices.row(1) << 0, 1, 2, 2;
    const auto squashed = check_volumes(solid);
    REQUIRE_FALSE(squashed);
    CHECK(squashed.error().culprit == HB_CULPRIT_TETRAHEDRON);
    CHECK(squashed.error().index == 1);
    solid.simplices.row(1) << 3, 2, 1, 0;
    CHECK(check_volumes(solid));
  }
}

TEST_CASE("connected parts: those that a walk reaches, counted by their first vertices (seeds 42 to 51)") {
  for (unsigned seed = 42; seed <= 51; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Index vertices = 30, corners = 3 + seed % 2;
    const SimplexMesh mesh = random_simplices(random, vertices, 3, 8, corners);
    // Which vertices hang together, by spreading the least number until nothing changes.
    std::vector<std::uint32_t> least(vertices);
    for (Index v = 0; v < vertices; ++v) least[v] = static_cast<std::uint32_t>(v);
    for (bool changed = true; changed;) {
      changed = false;
      for (Index s = 0; s < mesh.simplices.rows(); ++s)
        for (Index k = 0; k < corners; ++k)
          for (Index l = 0; l < corners; ++l) {
            std::uint32_t &a = least[mesh.simplices(s, k)], b = least[mesh.simplices(s, l)];
            if (b < a) a = b, changed = true;
          }
    }
    const Indices parts = connected_parts(mesh);
    REQUIRE(std::ssize(parts) == vertices);
    std::uint32_t count = 0;
    for (Index v = 0; v < vertices; ++v) CHECK(parts[v] == (least[v] == v ? count++ : parts[least[v]]));
    CHECK(count > 1);
  }
}
