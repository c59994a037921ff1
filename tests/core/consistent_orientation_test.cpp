#include "core/mesh/consistent_orientation.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "core/mesh/weld.hpp"
#include "made_meshes.hpp"

using namespace handlebody;

namespace {

void turn_round(Triangles& triangles, Index t) {
  std::swap(triangles(t, 1), triangles(t, 2));
}

void turn_some(Triangles& triangles, std::mt19937& random) {
  for (Index t = 0; t < triangles.rows(); ++t)
    if (random() % 2) turn_round(triangles, t);
}

/** Both meshes in one list; the second moved. */
test::MadeMesh both_meshes(const test::MadeMesh& a, const test::MadeMesh& b, const Eigen::RowVector3d& by) {
  test::MadeMesh mesh;
  mesh.positions.resize(a.positions.rows() + b.positions.rows(), 3);
  mesh.positions << a.positions, b.positions.rowwise() + by;
  mesh.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
  mesh.triangles << a.triangles, (b.triangles.array() + static_cast<std::uint32_t>(a.positions.rows())).matrix();
  return mesh;
}

/** As a triangle is, whichever corner it begins with. */
Triangles from_lowest(Triangles triangles) {
  for (Index t = 0; t < triangles.rows(); ++t) {
    auto row = triangles.row(t);
    while (row[0] != row.minCoeff()) row = Eigen::Matrix<std::uint32_t, 1, 3>(row[1], row[2], row[0]);
  }
  return triangles;
}

/** A band of `count` quads round the z axis; twisted by half a turn where it is closed, it is Möbius's. */
test::MadeMesh triangle_band(std::uint32_t count, bool twisted) {
  test::MadeMesh mesh;
  mesh.positions.resize(2 * count, 3);
  mesh.triangles.resize(2 * count, 3);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * i / count, tilt = twisted ? angle / 2 : 0;
    const Vector3 outward(std::cos(angle), std::sin(angle), 0),
        across = std::cos(tilt) * Vector3::UnitZ() + std::sin(tilt) * outward;
    mesh.positions.row(2 * i) = 3 * outward - across;
    mesh.positions.row(2 * i + 1) = 3 * outward + across;
    std::uint32_t low = 2 * ((i + 1) % count), high = low + 1;
    if (twisted && i + 1 == count) std::swap(low, high);
    mesh.triangles.row(2 * i) << 2 * i, low, high;
    mesh.triangles.row(2 * i + 1) << 2 * i, high, 2 * i + 1;
  }
  return mesh;
}

}  // namespace

TEST_CASE("triangles are turned to agree, and closed parts face outward (seed 4)") {
  const test::MadeMesh box = test::made_box({2, 1, 1}, {6, 3, 3});
  Triangles triangles = box.triangles;
  CHECK(orient_consistently(box.positions, triangles).closed);
  CHECK(triangles == box.triangles);
  std::mt19937 random(4);
  turn_some(triangles, random);
  const Orientation repaired = orient_consistently(box.positions, triangles);
  CHECK(repaired.closed);
  CHECK(repaired.open_edges == 0);
  CHECK(repaired.turned > 30);
  CHECK(enclosed_volume(box.positions, triangles) == doctest::Approx(2));

  Triangles open = box.triangles.bottomRows(box.triangles.rows() - 1);
  CHECK(orient_consistently(box.positions, open).open_edges == 3);
  CHECK(open == box.triangles.bottomRows(box.triangles.rows() - 1));
}

TEST_CASE("a closed mesh stays as it is: its cavities too, and one that is inside out, which is said") {
  const test::MadeMesh outer = test::made_box({4, 4, 4}, {2, 2, 2});
  test::MadeMesh inner = test::made_box({1, 1, 1}, {1, 1, 1});
  for (Index t = 0; t < inner.triangles.rows(); ++t) turn_round(inner.triangles, t);
  const test::MadeMesh hollow = both_meshes(outer, inner, {1, 1, 1});
  Triangles triangles = hollow.triangles;
  Orientation found = orient_consistently(hollow.positions, triangles);
  CHECK(found.closed);
  CHECK_FALSE(found.inside_out);
  CHECK(found.turned == 0);
  CHECK(triangles == hollow.triangles);

  for (Index t = 0; t < triangles.rows(); ++t) turn_round(triangles, t);
  const Triangles inside_out = triangles;
  found = orient_consistently(hollow.positions, triangles);
  CHECK(found.closed);
  CHECK(found.inside_out);
  CHECK(found.turned == 0);
  CHECK(triangles == inside_out);
}

TEST_CASE("of a mesh that is not closed as it is, every closed part is made to face outward, cavities too (seeds 71 to 75)") {
  for (unsigned seed = 71; seed <= 75; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const test::MadeMesh mesh = both_meshes(test::made_box({4, 4, 4}, {2, 3, 2}), test::made_box({1, 1, 1}, {1, 2, 1}), {1, 1, 1});
    Triangles triangles = mesh.triangles;
    turn_some(triangles, random);
    Index wrong = 0;
    for (Index t = 0; t < triangles.rows(); ++t) wrong += triangles.row(t) != mesh.triangles.row(t);
    const Orientation found = orient_consistently(mesh.positions, triangles);
    CHECK(found.closed);
    CHECK_FALSE(found.inside_out);
    CHECK(found.turned == wrong);
    CHECK(found.open_edges == 0);
    CHECK(from_lowest(triangles) == from_lowest(mesh.triangles));
  }
}

TEST_CASE("an open part comes to face as the larger share of its area did") {
  const test::MadeMesh sheet = triangle_band(8, false);
  for (const bool most : {false, true}) {
    Triangles triangles = sheet.triangles, expected = sheet.triangles;
    for (Index t = 0; t < triangles.rows(); ++t) {
      if (most ? t >= 5 : t < 5) turn_round(triangles, t);
      if (most) turn_round(expected, t);
    }
    const Orientation found = orient_consistently(sheet.positions, triangles);
    CHECK_FALSE(found.closed);
    CHECK(found.turned == 5);
    CHECK(found.open_edges == 16);  // its two rims
    CHECK(from_lowest(triangles) == from_lowest(expected));
  }
  // By area, not by number: one large triangle against two small ones.
  Points positions(5, 3);
  positions << 0, 0, 0, 10, 0, 0, 0, 10, 0, 10, 1, 0, 11, 1, 0;
  Triangles triangles(3, 3);
  triangles << 0, 1, 2, 1, 2, 3, 1, 3, 4;  // the first faces up, the others down
  const Orientation found = orient_consistently(positions, triangles);
  CHECK(found.turned == 2);
  CHECK(found.open_edges == 5);
  CHECK(triangles.row(0) == Eigen::Matrix<std::uint32_t, 1, 3>(0, 1, 2));
}

TEST_CASE("a Möbius band cannot agree: one edge of two is left, and it says so") {
  const test::MadeMesh twisted = triangle_band(12, true);
  Triangles triangles = twisted.triangles;
  const Orientation found = orient_consistently(twisted.positions, triangles);
  CHECK_FALSE(found.closed);
  CHECK_FALSE(found.inside_out);
  CHECK(found.open_edges == 24 + 1);  // its one rim, and where the walks meet
}

TEST_CASE("an edge of three triangles joins no parts, but the others agree (seeds 76 to 85)") {
  // A fin on a box: the box is closed without it. The fin is the first triangle, or the last.
  const test::MadeMesh box = test::made_box({1, 1, 1}, {1, 1, 1});
  const Index sides = box.triangles.rows();
  Points positions(9, 3);
  positions << box.positions, 2, 2, 2;
  const Eigen::Matrix<std::uint32_t, 1, 3> fin(box.triangles(0, 0), box.triangles(0, 1), 8);
  for (unsigned seed = 76; seed <= 85; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    Triangles shell = box.triangles, triangles(sides + 1, 3);
    turn_some(shell, random);
    const bool first = seed % 2;
    triangles.middleRows(first ? 1 : 0, sides) = shell;
    triangles.row(first ? 0 : sides) = fin;
    const Orientation found = orient_consistently(positions, triangles);
    CHECK_FALSE(found.closed);
    CHECK(found.open_edges == 3);  // the fin's
    shell = triangles.middleRows(first ? 1 : 0, sides);
    CHECK(enclosed_volume(positions, shell) == doctest::Approx(1));
  }
}

TEST_CASE("triangles that use a vertex twice have no sides: they open nothing and join nothing") {
  test::MadeMesh mesh = test::made_box({1, 1, 1}, {1, 1, 1});
  const Index box = mesh.triangles.rows();
  mesh.triangles.conservativeResize(box + 2, 3);
  mesh.triangles.row(box) << 0u, 0u, 1u;
  mesh.triangles.row(box + 1) << 3u, 3u, 3u;
  Triangles triangles = mesh.triangles;
  const Orientation found = orient_consistently(mesh.positions, triangles);
  CHECK(found.closed);
  CHECK_FALSE(found.inside_out);
  CHECK(triangles == mesh.triangles);
}

TEST_CASE("the order of the triangles does not matter, nor that many meet at one vertex (seed 77)") {
  // A fan of 100 triangles over a rim, and one below it: a double cone, whose tips have more edges than are sorted by insertion.
  constexpr std::uint32_t rim = 100;
  Points positions(rim + 2, 3);
  Triangles triangles(2 * rim, 3);
  for (std::uint32_t i = 0; i < rim; ++i) {
    const double angle = 6.283185307179586 * i / rim;
    positions.row(i + 2) << std::cos(angle), std::sin(angle), 0;
    triangles.row(2 * i) << 0, i + 2, (i + 1) % rim + 2;
    triangles.row(2 * i + 1) << 1, (i + 1) % rim + 2, i + 2;
  }
  positions.topRows(2) << 0, 0, 1, 0, 0, -1;
  const Triangles right = triangles;
  std::mt19937 random(77);
  std::vector<Index> order(2 * rim);
  std::iota(order.begin(), order.end(), Index{0});
  std::shuffle(order.begin(), order.end(), random);
  for (Index t = 0; t < triangles.rows(); ++t) triangles.row(t) = right.row(order[t]);
  turn_some(triangles, random);
  CHECK(orient_consistently(positions, triangles).closed);
  Triangles back(2 * rim, 3);
  for (Index t = 0; t < triangles.rows(); ++t) back.row(order[t]) = triangles.row(t);
  CHECK(from_lowest(back) == from_lowest(right));
}

TEST_CASE("a closed part that faces inward is turned where it lies in no other, and stays a cavity where it does") {
  const test::MadeMesh outer = test::made_box({4, 4, 4}, {2, 2, 2});
  test::MadeMesh inverted = test::made_box({1, 1, 1}, {1, 1, 1});
  for (Index t = 0; t < inverted.triangles.rows(); ++t) turn_round(inverted.triangles, t);
  const test::MadeMesh sheet = triangle_band(8, false);
  struct Place {
    Eigen::RowVector3d by;
    bool cavity;
  };
  for (const Place& place : {Place{{1.3, 1.2, 1.1}, true}, Place{{6, 0, 0}, false}, Place{{3.5, 1.1, 1.2}, false}}) {
    const Eigen::RowVector3d by = place.by;  // not a structured binding, which Clang 14 captures in no lambda
    const bool cavity = place.cavity;
    for (const bool open : {false, true}) {  // with an open part elsewhere, the same
      CAPTURE(by);
      CAPTURE(open);
      test::MadeMesh mesh = both_meshes(outer, inverted, by);
      if (open) mesh = both_meshes(mesh, sheet, {20, 0, 0});
      Triangles triangles = mesh.triangles;
      const Orientation found = orient_consistently(mesh.positions, triangles);
      CHECK(found.closed == !open);
      CHECK_FALSE(found.inside_out);
      CHECK(found.turned == (cavity ? 0 : 12));
      const Triangles closed = triangles.topRows(outer.triangles.rows() + 12);
      CHECK(enclosed_volume(mesh.positions, closed) == doctest::Approx(cavity ? 63 : 65));
    }
  }
}

TEST_CASE("the seams of two sheets that lie on each other are no neighbors; those of two halves that face apart are") {
  // Two strips begin at one edge and run the same way along it: to one side, nearly in one place, or to both.
  for (const double angle : {0., 10., 20., 60., 120., 180.}) {
    CAPTURE(angle);
    const double radians = angle * 3.141592653589793 / 180;
    Points positions(6, 3);
    positions << 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, std::cos(radians), 0, std::sin(radians), std::cos(radians), 1,
        std::sin(radians);
    Triangles triangles(4, 3);
    triangles << 0, 1, 3, 0, 3, 2, 0, 1, 5, 0, 5, 4;
    CHECK(orient_consistently(positions, triangles).turned == (angle < 30 ? 0 : 2));
  }
}

TEST_CASE("a part whose seam is apart by a rounding to floats is closed once it is welded: it is turned, or stays a cavity") {
  for (const bool apart : {false, true}) {
    for (const bool in : {false, true}) {
      CAPTURE(apart);
      CAPTURE(in);
      test::MadeMesh box = test::made_box({1, 1, 1}, {2, 2, 2});
      for (Index t = 0; t < box.triangles.rows(); ++t) turn_round(box.triangles, t);
      if (apart) {  // the triangles on one half of a side get corners of their own
        const Index vertices = box.positions.rows();
        box.positions.conservativeResize(2 * vertices, 3);
        box.positions.bottomRows(vertices) = box.positions.topRows(vertices).array() + 1e-8;
        box.triangles.topRows(5).array() += static_cast<std::uint32_t>(vertices);
      }
      const test::MadeMesh outer = test::made_box({4, 4, 4}, {1, 1, 1});
      const test::MadeMesh mesh = both_meshes(outer, box, {in ? 1. : 9., 1, 1});
      const Weld weld = weld_mesh(mesh.positions, mesh.triangles);
      Triangles triangles = mesh.triangles.unaryExpr([&](std::uint32_t v) { return weld.unique[weld.to_unique[v]]; });
      const Orientation found = orient_consistently(mesh.positions, triangles);
      CHECK(found.closed);
      CHECK(found.turned == (in ? 0 : box.triangles.rows()));
    }
  }
}

TEST_CASE("a mesh is inside out where all that lies in nothing else faces inward, however large the rest is") {
  test::MadeMesh large = test::made_box({4, 4, 4}, {1, 1, 1});
  const test::MadeMesh small = test::made_box({1, 1, 1}, {1, 1, 1});
  for (Index t = 0; t < large.triangles.rows(); ++t) turn_round(large.triangles, t);
  const test::MadeMesh hollow = both_meshes(large, small, {1, 1, 1}), mixed = both_meshes(large, small, {9, 1, 1});
  Triangles triangles = hollow.triangles;
  CHECK(orient_consistently(hollow.positions, triangles).inside_out);
  CHECK(triangles == hollow.triangles);
  triangles = mixed.triangles;
  const Orientation found = orient_consistently(mixed.positions, triangles);
  CHECK_FALSE(found.inside_out);
  CHECK(found.turned == 12);
  CHECK(enclosed_volume(mixed.positions, triangles) == doctest::Approx(65));
}

TEST_CASE("nothing is closed and encloses nothing") {
  Triangles none(0, 3);
  const Orientation found = orient_consistently(Points(0, 3), none);
  CHECK(found.closed);
  CHECK_FALSE(found.inside_out);
  CHECK(found.turned == 0);
}
