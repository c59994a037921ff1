#include "core/mesh/weld.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

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
