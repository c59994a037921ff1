#include "core/mesh/surface_geodesics.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "cell_surface.hpp"
#include "oracle_lines.hpp"

using namespace handlebody;
using namespace handlebody::test;

TEST_CASE("geodesics of a sphere are its great circles") {
  const MadeMesh sphere = octahedral_sphere(24);
  SurfaceGeodesics geodesics(sphere.positions, sphere.triangles);
  const Index n = sphere.positions.rows();
  std::vector<double> d(n);
  double mean = 0, largest = 0, count = 0;
  for (const Index s : {Index{0}, n / 3, n - 5}) {
    geodesics.measure(static_cast<std::uint32_t>(s), d.data());
    CHECK(d[s] == 0);
    for (Index v = 0; v < n; ++v) {
      const double exact = std::acos(std::clamp(sphere.positions.row(s).dot(sphere.positions.row(v)), -1., 1.));
      if (exact < .2) continue;
      const double error = std::abs(d[v] / exact - 1);
      mean += error, ++count;
      largest = std::max(largest, error);
    }
  }
  mean /= count;
  MESSAGE("mean " << 100 * mean << "%, largest " << 100 * largest << "%");
  CHECK(mean < .005);  // the mesh itself is 0.1% smaller
  CHECK(largest < .02);
}

TEST_CASE("on a flat face distances are straight, also with triangles of every shape (seed 4)") {
  // A square of scattered points, joined to the corners of cells that the scatter never turns over: obtuse ones and slivers.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-.35, .35);
  constexpr int n = 24;
  Points positions(n * n, 3);
  std::vector<std::uint32_t> corners;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      positions.row(i * n + j) = Vector3(i + uniform(random), 3 * (j + uniform(random)), 0);
      if (i == 0 || j == 0) continue;
      const auto a = static_cast<std::uint32_t>((i - 1) * n + j - 1), b = a + n, c = b + 1, d = a + 1;
      corners.insert(corners.end(), {a, b, c, a, c, d});
    }
  }
  const Triangles triangles = Eigen::Map<const Triangles>(corners.data(), static_cast<Index>(corners.size() / 3), 3);
  SurfaceGeodesics geodesics(positions, triangles);
  std::vector<double> d(n * n);
  const std::uint32_t source = n * (n / 2) + n / 2;
  geodesics.measure(source, d.data());
  double largest = 0;
  for (Index v = 0; v < n * n; ++v) {
    // The outline is ragged: what is straight in the plane may pass outside it near the rim.
    const Vector3 p = positions.row(v);
    if (std::min(p[0], n - 1 - p[0]) < 1 || std::min(p[1] / 3, n - 1 - p[1] / 3) < 1) continue;
    const double straight = (positions.row(v) - positions.row(source)).norm();
    CHECK(d[v] >= straight * (1 - 1e-6));
    if (straight > 0) largest = std::max(largest, d[v] / straight - 1);
  }
  MESSAGE("largest " << 100 * largest << "%");
  CHECK(largest < .02);
}

TEST_CASE("geodesics agree with libigl's exact ones") {
  for (const std::string& line : oracle_lines("surface_geodesics.json")) {
    const std::vector<double> p = oracle_numbers(line, "positions"), t = oracle_numbers(line, "triangles"),
                              sources = oracle_numbers(line, "sources"), expected = oracle_numbers(line, "distances");
    const Points positions = Eigen::Map<const Points>(p.data(), static_cast<Index>(p.size() / 3), 3);
    Triangles triangles(static_cast<Index>(t.size() / 3), 3);
    for (std::size_t k = 0; k < t.size(); ++k) triangles.data()[k] = static_cast<std::uint32_t>(t[k]);
    SurfaceGeodesics geodesics(positions, triangles);
    const std::size_t n = p.size() / 3;
    REQUIRE(expected.size() == sources.size() * n);
    std::vector<double> d(n);
    double mean = 0, largest = 0, count = 0;
    for (std::size_t s = 0; s < sources.size(); ++s) {
      geodesics.measure(static_cast<std::uint32_t>(sources[s]), d.data());
      const double reach = *std::max_element(&expected[s * n], &expected[s * n] + n);
      for (std::size_t v = 0; v < n; ++v) {
        const double exact = expected[s * n + v];
        if (exact < .1 * reach) continue;
        mean += std::abs(d[v] / exact - 1), ++count;
        largest = std::max(largest, std::abs(d[v] / exact - 1));
      }
    }
    mean /= count;
    MESSAGE(n << " vertices: mean " << 100 * mean << "%, largest " << 100 * largest << "%");
    CHECK(mean < .01);
    CHECK(largest < .1);  // at single vertices, where waves meet around big triangles
  }
}

TEST_CASE("what is not connected is infinitely far, and a triangle without area does no harm") {
  Points positions(7, 3);
  positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, .5, 0, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0;
  Triangles triangles(3, 3);
  triangles << 0, 1, 2, 0, 3, 1, 4, 5, 6;
  SurfaceGeodesics geodesics(positions, triangles);
  std::vector<double> d(7);
  for (int round = 0; round < 2; ++round) {
    geodesics.measure(0, d.data());
    CHECK(d[1] == doctest::Approx(1));
    CHECK(d[3] == doctest::Approx(.5));
    CHECK(std::isinf(d[5]));
  }
}
