#include "core/distance/voxel_tetrahedra.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "made_meshes.hpp"

using namespace handlebody;

namespace {

double signed_volume(const SimplexMesh& mesh, Index t) {
  const auto p = [&](Index k) { return Vector3(mesh.positions.row(mesh.simplices(t, k)).transpose()); };
  return (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) / 6;
}

}  // namespace

namespace {

/** A bent tube of squares: closed, with rows of vertices at odd angles to the grid. */
test::MadeMesh tube(std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  test::MadeMesh mesh = test::made_box({4, 1, 1}, {24, 6, 6});
  for (Index v = 0; v < mesh.positions.rows(); ++v) {
    const double angle = mesh.positions(v, 0) / 2, radius = 1.5 + mesh.positions(v, 1);
    mesh.positions.row(v) << radius * std::cos(angle) + shift(random), radius * std::sin(angle) + shift(random),
        mesh.positions(v, 2) + shift(random);
  }
  return mesh;
}

}  // namespace

TEST_CASE("tetrahedra fill what the surface touches or encloses, and fit together (seed 2110)") {
  std::mt19937 random(2110);
  const test::MadeMesh surface = tube(random);
  const double enclosed = std::abs(enclosed_volume(surface.positions, surface.triangles));
  double former = 1e9;
  for (const int resolution : {8, 20, 40}) {
    const auto made = make_voxel_tetrahedra({surface.positions, surface.triangles}, resolution);
    REQUIRE(made);
    const SimplexMesh& mesh = made->mesh;
    REQUIRE(check_simplex_mesh(mesh));
    REQUIRE(check_volumes(mesh));
    double volume = 0;
    std::map<std::array<std::uint32_t, 3>, int> faces;
    for (Index t = 0; t < mesh.simplices.rows(); ++t) {
      const double own = signed_volume(mesh, t);
      REQUIRE(own > 0);
      volume += own;
      for (Index k = 0; k < 4; ++k) {
        std::array<std::uint32_t, 3> face{mesh.simplices(t, (k + 1) % 4), mesh.simplices(t, (k + 2) % 4),
                                          mesh.simplices(t, (k + 3) % 4)};
        std::sort(face.begin(), face.end());
        ++faces[face];
      }
    }
    // No face belongs to three, and those that belong to one close the boundary: every edge of theirs is met an even number of
    // times.
    std::map<std::array<std::uint32_t, 2>, int> edges;
    for (const auto& [face, count] : faces) {
      REQUIRE(count <= 2);
      if (count == 2) continue;
      ++edges[{face[0], face[1]}];
      ++edges[{face[1], face[2]}];
      ++edges[{face[0], face[2]}];
    }
    for (const auto& [edge, count] : edges) REQUIRE(count % 2 == 0);
    CHECK(volume > enclosed);
    CHECK(volume - enclosed < former / 1.6);  // the layer that sticks out thins with the voxels
    former = volume - enclosed;
  }
  CHECK(former < 0.25 * enclosed);
}

TEST_CASE("every vertex of the surface lies in its tetrahedron (seed 2111)") {
  std::mt19937 random(2111);
  const test::MadeMesh surface = tube(random);
  const auto made = make_voxel_tetrahedra({surface.positions, surface.triangles}, 20);
  REQUIRE(made);
  REQUIRE(made->corners.size() == static_cast<std::size_t>(surface.positions.rows()));
  std::map<std::array<std::uint32_t, 4>, bool> known;
  for (Index t = 0; t < made->mesh.simplices.rows(); ++t) {
    std::array<std::uint32_t, 4> own{};
    for (std::size_t k = 0; k < 4; ++k) own[k] = made->mesh.simplices(t, static_cast<Index>(k));
    std::sort(own.begin(), own.end());
    known[own] = true;
  }
  for (std::size_t p = 0; p < made->corners.size(); ++p) {
    Vector3 place = Vector3::Zero();
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      REQUIRE(made->coordinates[p][k] >= 0);
      sum += made->coordinates[p][k];
      place += made->coordinates[p][k] * made->mesh.positions.row(made->corners[p][k]).transpose();
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-14));
    CHECK((place - surface.positions.row(static_cast<Index>(p)).transpose()).norm() < 1e-12);
    std::array<std::uint32_t, 4> own = made->corners[p];
    std::sort(own.begin(), own.end());
    CHECK(known.count(own) == 1);
  }
}

TEST_CASE("a box whose faces run between voxels is filled exactly") {
  const test::MadeMesh box = test::made_box({6, 2, 1}, {6, 2, 1});
  const auto made = make_voxel_tetrahedra({box.positions, box.triangles}, 12);
  REQUIRE(made);
  double volume = 0;
  for (Index t = 0; t < made->mesh.simplices.rows(); ++t) volume += signed_volume(made->mesh, t);
  CHECK(volume == doctest::Approx(12).epsilon(1e-12));
}

TEST_CASE("an open sheet gets the voxels that it touches; loose vertices get the nearest") {
  SimplexMesh sheet;
  sheet.positions.resize(5, 3);
  sheet.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0.1, 0, 1, 0.1, 0.5, 0.5, 0.9;
  sheet.simplices.resize(2, 3);
  sheet.simplices << 0, 1, 2, 0, 2, 3;
  const auto made = make_voxel_tetrahedra(sheet, 10);
  REQUIRE(made);
  CHECK(made->mesh.simplices.rows() >= 6 * 100);
  CHECK(made->mesh.simplices.rows() < 6 * 400);
  for (const double coordinate : made->coordinates[4]) CHECK(coordinate >= 0);
  sheet.positions.col(2) *= 0;  // between two layers of voxels: both are taken
  sheet.positions(4, 2) = 0.9;
  const auto flat = make_voxel_tetrahedra(sheet, 10);
  REQUIRE(flat);
  CHECK(flat->mesh.simplices.rows() >= 6 * 100);
}

TEST_CASE("surfaces and resolutions that cannot be are refused") {
  SimplexMesh sheet;
  sheet.positions.resize(3, 3);
  sheet.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0;
  sheet.simplices.resize(1, 3);
  sheet.simplices << 0, 1, 2;
  CHECK(make_voxel_tetrahedra(sheet, 3).error().code == HB_ERROR_INVALID_OPTION);
  CHECK(make_voxel_tetrahedra(sheet, 257).error().code == HB_ERROR_INVALID_OPTION);
  SimplexMesh bad = sheet;
  bad.positions(1, 1) = std::nan("");
  CHECK(make_voxel_tetrahedra(bad, 10).error().code == HB_ERROR_MESH_NOT_FINITE);
  bad = sheet;
  bad.simplices(0, 1) = 3;
  CHECK(make_voxel_tetrahedra(bad, 10).error().code == HB_ERROR_MESH_INDEX_OUT_OF_RANGE);
}

TEST_CASE("vertices that no triangle uses, copies of faces and faces without area change no tetrahedron (seeds 1 to 20)") {
  const test::MadeMesh box = test::made_box({2, 1, 1}, {4, 2, 2});
  const auto plain = make_voxel_tetrahedra({box.positions, box.triangles}, 12);
  REQUIRE(plain);
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Index vertices = box.positions.rows(), strays = 1 + random() % 3, copies = 1 + random() % 6;
    Points positions(vertices + strays, 3);
    positions.topRows(vertices) = box.positions;
    for (Index v = vertices; v < positions.rows(); ++v)
      positions.row(v) << std::pow(10., static_cast<double>(random() % 18)), -3, static_cast<double>(random() % 9);
    Triangles triangles(box.triangles.rows() + copies, 3);
    triangles.topRows(box.triangles.rows()) = box.triangles;
    for (Index t = box.triangles.rows(); t < triangles.rows(); ++t) {
      triangles.row(t) = box.triangles.row(random() % box.triangles.rows());
      if (random() % 2) std::swap(triangles(t, 0), triangles(t, 1));
    }
    const auto made = make_voxel_tetrahedra({positions, triangles}, 12);
    REQUIRE(made);
    CHECK(made->mesh.positions == plain->mesh.positions);
    CHECK(made->mesh.simplices == plain->mesh.simplices);
    for (std::size_t v = 0; v < made->corners.size(); ++v) {
      for (const double part : made->coordinates[v]) CHECK((part >= 0 && part <= 1));
      if (v < plain->corners.size()) CHECK(made->corners[v] == plain->corners[v]);
    }
  }
}

TEST_CASE("a vertex of no triangle gets corners that are there, wherever it is") {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double x : {std::nan(""), infinite, -infinite, 1e300, -1e300, 1e10, 5.0}) {
    test::MadeMesh box = test::made_box({1, 1, 1}, {2, 2, 2});
    SimplexMesh surface{Matrix(box.positions.rows() + 1, 3), box.triangles};
    surface.positions << box.positions, x, 0.5, x;
    const auto made = make_voxel_tetrahedra(surface, 6);
    REQUIRE(made);
    CAPTURE(x);
    for (const std::uint32_t corner : made->corners.back()) CHECK(corner < static_cast<std::uint32_t>(made->mesh.positions.rows()));
    double sum = 0;
    for (const double part : made->coordinates.back()) {
      CHECK(part >= 0);
      sum += part;
    }
    CHECK(sum == doctest::Approx(1));
  }
}
