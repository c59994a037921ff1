#include "core/interpolation/convex_cell.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace handlebody;

namespace {

struct HalfPlane {
  double x, y, offset;
};

std::vector<HalfPlane> random_half_planes(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> angle(0, 6.283185307179586), offset(0.2, 1.5);
  std::vector<HalfPlane> planes;
  for (int k = 0; k < count; ++k) {
    const double turn = angle(random);
    planes.push_back({std::cos(turn), std::sin(turn), offset(random)});
  }
  return planes;
}

/** Area of the square of half width `half` within all half-planes: Sutherland and Hodgman's clipping, vertex after vertex. */
double clipped_area(double half, const std::vector<HalfPlane>& planes) {
  using Corner = Eigen::Vector2d;
  std::vector<Corner> polygon{{half, half}, {-half, half}, {-half, -half}, {half, -half}};
  for (const auto& [x, y, offset] : planes) {
    std::vector<Corner> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Corner &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      const double in = offset - x * a.x() - y * a.y(), next = offset - x * b.x() - y * b.y();
      if (in >= 0) kept.push_back(a);
      if ((in > 0) != (next > 0) && in != next) kept.push_back(a + in / (in - next) * (b - a));
    }
    polygon = kept;
  }
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

/** Every vertex on its side's line and the next one's and within all others; sides counter-clockwise. */
void check_cell(const ConvexCell& cell, double tolerance) {
  for (Index k = 0; k < cell.size(); ++k) {
    const auto& side = cell.side(k);
    const auto& next = cell.after(k);
    CHECK(&cell.before(k + 1 < cell.size() ? k + 1 : 0) == &side);
    CHECK(std::hypot(side.normal[0], side.normal[1]) == doctest::Approx(1).epsilon(1e-14));
    CHECK(side.normal[0] * next.normal[1] - side.normal[1] * next.normal[0] > -1e-14);
    for (Index l = 0; l < cell.size(); ++l) {
      const auto& line = cell.side(l);
      const double beyond = line.normal[0] * side.vertex[0] + line.normal[1] * side.vertex[1] - line.offset;
      CHECK(beyond <= tolerance);
      if (&line == &side || &line == &next) CHECK(beyond >= -tolerance);
    }
  }
}

}  // namespace

TEST_CASE("a cell begins as a square, and a cut off half of it has the owner of the cut") {
  ConvexCell cell(8);
  cell.start(3);
  CHECK(cell.size() == 4);
  CHECK(cell.area() == 36);
  CHECK(cell.reach() == 18);
  for (Index k = 0; k < 4; ++k) CHECK(cell.side(k).owner == ConvexCell::box);
  check_cell(cell, 0);

  cell.cut(1, 0, 1, 7);
  CHECK(cell.size() == 4);
  CHECK(cell.area() == 24);
  check_cell(cell, 1e-15);
  Index owned = 0;
  for (Index k = 0; k < 4; ++k) {
    if (cell.side(k).owner != 7) continue;
    ++owned;
    CHECK(cell.side(k).vertex[0] == 1);
    CHECK(cell.side(k).vertex[1] == 3);  // counter-clockwise: it ends above
    CHECK(cell.before(k).vertex[0] == 1);
    CHECK(cell.before(k).vertex[1] == -3);
  }
  CHECK(owned == 1);
}

TEST_CASE("a cut that misses or only touches leaves the cell, one beyond it all leaves nothing") {
  ConvexCell cell(8);
  cell.start(1);
  const double root = std::sqrt(0.5);
  cell.cut(1, 0, 2, 0);
  cell.cut(1, 0, 1, 1);
  cell.cut(root, root, 2 * root, 2);
  cell.cut(root, root, 2 * root * (1 - 1e-16), 3);
  CHECK(cell.size() == 4);
  for (Index k = 0; k < 4; ++k) CHECK(cell.side(k).owner == ConvexCell::box);
  cell.cut(root, root, 2 * root * (1 - 1e-12), 4);  // a corner of it
  CHECK(cell.size() == 5);
  cell.cut(0, -1, -1.5, 5);
  CHECK(cell.size() == 0);
  CHECK(cell.area() == 0);
  CHECK(cell.reach() == 0);
  cell.cut(1, 0, 0, 6);
  CHECK(cell.size() == 0);
}

TEST_CASE("a regular polygon of n sides about the unit circle: area n tan(π/n), reach 1/cos²(π/n)") {
  for (const int n : {3, 4, 5, 12, 60}) {
    CAPTURE(n);
    ConvexCell cell(n + 6);
    cell.start(100);
    for (int k = 0; k < n; ++k) {
      const double turn = 6.283185307179586 * ((7 * k) % n) / n + 0.1;  // n is prime to 7, or the order is another one
      cell.cut(std::cos(turn), std::sin(turn), 1, k);
    }
    if (n % 7 != 0) CHECK(cell.size() == n);
    CHECK(cell.area() == doctest::Approx(n * std::tan(3.14159265358979 / n)).epsilon(1e-13));
    const double cosine = std::cos(3.14159265358979 / n);
    CHECK(cell.reach() == doctest::Approx(1 / (cosine * cosine)).epsilon(1e-13));
    check_cell(cell, 1e-14);
  }
}

TEST_CASE("random cuts agree with clipping, in any order (seeds 91 to 98)") {
  for (unsigned seed = 91; seed <= 98; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::vector<HalfPlane> planes = random_half_planes(random, 14);
    if (seed == 98) planes.push_back({-planes[0].x, -planes[0].y, -2});  // nothing is left
    const double expected = clipped_area(2, planes);
    for (int order = 0; order < 5; ++order) {
      ConvexCell cell(static_cast<Index>(planes.size()) + 4);
      cell.start(2);
      for (std::size_t k = 0; k < planes.size(); ++k) {
        cell.cut(planes[k].x, planes[k].y, planes[k].offset, static_cast<Index>(k));
        check_cell(cell, 1e-13);
      }
      CHECK(cell.area() == doctest::Approx(expected).scale(1).epsilon(1e-12));
      std::shuffle(planes.begin(), planes.end(), random);
    }
  }
}

TEST_CASE("a cell that began as a huge box ends with all its digits") {
  ConvexCell cell(8);
  cell.start(1e9);
  const double c = 0.8, s = 0.6;
  cell.cut(c, s, 1, 0);
  cell.cut(-s, c, 2, 1);
  cell.cut(-c, -s, 3, 2);
  cell.cut(s, -c, 4, 3);
  CHECK(cell.size() == 4);
  CHECK(cell.area() == doctest::Approx(24).epsilon(1e-15));
  check_cell(cell, 1e-15);
}

TEST_CASE("a cut that is known to go through a vertex does, whatever rounding says") {
  // The corner (½, ½) lies between the sides of 1 and 2; the line of the cut is wrong by 1e-9 there.
  const double c = std::cos(0.5), s = std::sin(0.5), offset = 0.5 * (c + s) - 1e-9;
  for (const bool known : {false, true}) {
    ConvexCell cell(8);
    cell.start(1);
    cell.cut(1, 0, 0.5, 1);
    cell.cut(0, 1, 0.5, 2);
    if (known) {
      cell.cut(c, s, offset, 1, 2);
    } else {
      cell.cut(c, s, offset, 3);
    }
    CHECK(cell.size() == (known ? 4 : 5));
    // And so from the other side: what meets is not an order.
    if (known) {
      cell.cut(c, s, offset, 2, 1);
      CHECK(cell.size() == 4);
    }
  }
}

TEST_CASE("a copy is a cell of its own") {
  ConvexCell cell(6), copy(8);
  cell.start(1);
  cell.cut(1, 0, 0.25, 3);
  copy.start(5);
  copy.copy(cell);
  CHECK(copy.size() == 4);
  CHECK(copy.area() == 2.5);
  copy.cut(0, 1, 0, 4);
  CHECK(copy.area() == 1.25);
  CHECK(cell.area() == 2.5);
}
