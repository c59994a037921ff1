#include "core/mesh/weld.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "made_meshes.hpp"

using namespace handlebody;

namespace {

/** Every pair compared. */
void check_weld(const Points& positions, const Weld& weld) {
  const Index count = positions.rows();
  REQUIRE(std::ssize(weld.to_unique) == count);
  std::uint32_t found = 0;
  for (Index v = 0; v < count; ++v) {
    Index first = 0;
    while (positions.row(first) != positions.row(v)) ++first;
    if (first == v) {  // a new place: the next number is its
      CHECK(weld.to_unique[v] == found);
      CHECK(weld.unique.at(found++) == v);
    } else {
      CHECK(weld.to_unique[v] == weld.to_unique[first]);
    }
  }
  CHECK(weld.unique.size() == found);
}

}  // namespace

TEST_CASE("vertices at one place are welded, numbered as stored (seeds 21 to 25)") {
  for (unsigned seed = 21; seed <= 25; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    // So few places that most are taken more than once, and many share one or two coordinates.
    const Points positions = Points::NullaryExpr(200, 3, [&] { return static_cast<double>(random() % 4) / 3 - .5; });
    const Weld weld = weld_vertices(positions);
    check_weld(positions, weld);
    CHECK(weld.unique.size() < 65);
  }
}

TEST_CASE("only equal positions are welded: −0 is 0, the next double is another place") {
  Points positions(5, 3);
  positions << 0, 1, 2,                //
      -0.0, 1, 2,                      //
      std::nextafter(0.0, 1.0), 1, 2,  //
      0, 1, std::nextafter(2.0, 3.0),  //
      0, 1, 2;
  const Weld weld = weld_vertices(positions);
  CHECK(weld.to_unique == std::vector<std::uint32_t>{0, 0, 1, 2, 0});
  CHECK(weld.unique == std::vector<std::uint32_t>{0, 2, 3});
}

TEST_CASE("nearly equal positions within reach of both are welded, chains of them too: every pair compared (seeds 31 to 54)") {
  for (unsigned seed = 31; seed < 55; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    // On a plane, a line or anywhere; so dense that a reach of 0.02 joins many, and some by others in between.
    const Index count = 300, axes = 1 + seed % 3;
    Points positions = Points::Zero(count, 3);
    for (Index v = 0; v < count; ++v)
      for (Index axis = 0; axis < axes; ++axis) positions(v, axis) = axes == 1 ? 8 * unit(random) : unit(random);
    for (Index v = 0; v < 40; ++v) positions.row(random() % count) = positions.row(v);
    const Vector reach = Vector::NullaryExpr(count, [&] { return random() % 4 ? 0.03 * unit(random) : 0.0; });
    // The reach of a place is the largest there.
    Vector of_place = reach;
    for (Index v = 0; v < count; ++v)
      for (Index w = 0; w < count; ++w)
        if (positions.row(v) == positions.row(w)) of_place[v] = std::max(of_place[v], reach[w]);
    std::vector<Index> least(count);
    for (Index v = 0; v < count; ++v) least[v] = v;
    for (bool changed = true; changed;) {
      changed = false;
      for (Index v = 0; v < count; ++v)
        for (Index w = 0; w < count; ++w) {
          const double apart = (positions.row(v) - positions.row(w)).norm();
          if (!(apart == 0 || apart < std::min(of_place[v], of_place[w])) || least[w] >= least[v]) continue;
          least[v] = least[w];
          changed = true;
        }
    }
    const Weld weld = weld_vertices(positions, reach);
    std::uint32_t found = 0;
    for (Index v = 0; v < count; ++v) {
      if (least[v] == v) CHECK(weld.unique.at(found++) == v);
      CHECK(weld.unique[weld.to_unique[v]] == least[v]);
    }
    CHECK(weld.unique.size() == found);
    CHECK(found < 280);
    CHECK(weld_vertices(positions, Vector::Zero(count)).to_unique == weld_vertices(positions).to_unique);
  }
}

TEST_CASE("a mesh whose corners rounding has parted is welded as the whole one is, and no gap that is one (seeds 31 to 50)") {
  for (unsigned seed = 31; seed <= 50; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> sign(-1, 1);
    const double size = std::pow(10, 4 * sign(random));
    test::MadeMesh box = test::made_box({1, 1, 1}, {3, 3, 3});
    box.positions *= size;
    // Each corner of a triangle has a vertex of its own, moved by up to a part of the diagonal along each axis.
    const auto parted = [&](double part) {
      Points positions(box.triangles.size() + 1, 3);
      for (Index k = 0; k < box.triangles.size(); ++k)
        for (Index axis = 0; axis < 3; ++axis)
          positions(k, axis) = box.positions(box.triangles.data()[k], axis) + part * size * sign(random);
      positions.bottomRows(1).setConstant(1e30);  // what nothing uses is none of the diagonal
      Triangles triangles(box.triangles.rows(), 3);
      for (Index k = 0; k < triangles.size(); ++k) triangles.data()[k] = static_cast<std::uint32_t>(k);
      return weld_mesh(positions, triangles);
    };
    const Weld near = parted(4e-7);
    CHECK(near.unique.size() == static_cast<std::size_t>(box.positions.rows()) + 1);
    for (Index k = 0; k < box.triangles.size(); ++k)
      for (Index l = 0; l < k; ++l)
        CHECK((near.to_unique[k] == near.to_unique[l]) == (box.triangles.data()[k] == box.triangles.data()[l]));
    CHECK(parted(1e-4).unique.size() == static_cast<std::size_t>(box.triangles.size()) + 1);
  }
}

TEST_CASE("short edges bring no vertices together that are as far apart as they are long") {
  // A needle of a long triangle's side, whose short edge is within a millionth of the diagonal.
  Points positions(6, 3);
  positions << 0, 0, 0, 1, 0, 0, 0, 1, 0,  //
      0.3, 0.3, 0, 0.3 + 5e-7, 0.3, 0, 0.3, 0.3 + 5e-7, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  CHECK(weld_mesh(positions, triangles).unique.size() == 6);
}

TEST_CASE("triangles are welded corner by corner") {
  // Two triangles of a square, each with corners of its own.
  Points positions(6, 3);
  positions << 0, 0, 0, 1, 0, 0, 1, 1, 0,  //
      0, 0, 0, 1, 1, 0, 0, 1, 0;
  Triangles triangles(2, 3), expected(2, 3);
  triangles << 0, 1, 2, 3, 4, 5;
  expected << 0, 1, 2, 0, 2, 3;
  const Weld weld = weld_vertices(positions);
  CHECK(weld_triangles(weld, triangles) == expected);
}

TEST_CASE("nothing is welded to nothing") {
  const Weld weld = weld_vertices(Points(0, 3));
  CHECK(weld.unique.empty());
  CHECK(weld.to_unique.empty());
  CHECK(weld_triangles(weld, Triangles(0, 3)).rows() == 0);
}
