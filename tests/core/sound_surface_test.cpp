#include "core/mesh/sound_surface.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/numerics/indices.hpp"
#include "made_meshes.hpp"

using namespace handlebody;
using test::made_box;
using test::MadeMesh;

namespace {

using Row = Eigen::Matrix<std::uint32_t, 1, 3>;

Row reversed(const Row& t) {
  return {t[0], t[2], t[1]};
}

/** As a set, each triangle from its lowest corner on. */
std::vector<std::array<std::uint32_t, 3>> as_set(const Triangles& triangles) {
  std::vector<std::array<std::uint32_t, 3>> all;
  for (Index t = 0; t < triangles.rows(); ++t) {
    std::array<std::uint32_t, 3> row{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
    all.push_back(row);
  }
  std::sort(all.begin(), all.end());
  return all;
}

Triangles with(const Triangles& triangles, const std::vector<Row>& more, std::mt19937* shuffled = nullptr) {
  std::vector<Row> all(more);
  for (Index t = 0; t < triangles.rows(); ++t) all.emplace_back(triangles.row(t));
  if (shuffled) std::shuffle(all.begin(), all.end(), *shuffled);
  Triangles joined(std::ssize(all), 3);
  for (std::size_t t = 0; t < all.size(); ++t) joined.row(static_cast<Index>(t)) = all[t];
  return joined;
}

/** Two unit boxes that share the side x = 1, welded there; the wall between them is there once from either side. */
MadeMesh two_boxes() {
  const MadeMesh one = made_box({1, 1, 1}, {2, 2, 2});
  MadeMesh both{Points(2 * one.positions.rows(), 3), Triangles(2 * one.triangles.rows(), 3)};
  std::vector<std::uint32_t> number(static_cast<std::size_t>(one.positions.rows()));
  both.positions.topRows(one.positions.rows()) = one.positions;
  Index next = one.positions.rows();
  for (Index v = 0; v < one.positions.rows(); ++v) {
    const Eigen::RowVector3d place = one.positions.row(v) + Eigen::RowVector3d(1, 0, 0);
    Index found = -1;
    for (Index u = 0; u < one.positions.rows(); ++u)
      if (one.positions.row(u) == place) found = u;
    if (found < 0) both.positions.row(found = next++) = place;
    number[v] = static_cast<std::uint32_t>(found);
  }
  both.positions.conservativeResize(next, 3);
  both.triangles.topRows(one.triangles.rows()) = one.triangles;
  both.triangles.bottomRows(one.triangles.rows()) = one.triangles.unaryExpr([&](std::uint32_t v) { return number[v]; });
  return both;
}

}  // namespace

TEST_CASE("a sound surface is left as it is, in its order") {
  const MadeMesh box = made_box({2, 1, 3}, {3, 2, 4});
  const SoundSurface sound = sound_surface(box.positions, box.triangles);
  CHECK(sound.triangles == box.triangles);
  CHECK(sound.with_area == box.triangles.rows());
  CHECK(sound.flat == 0);
  CHECK(sound.doubled == 0);
}

TEST_CASE("copies of some faces, as they are and turned round, and faces with a corner twice leave no trace (seeds 1 to 30)") {
  const MadeMesh box = made_box({2, 1, 3}, {3, 2, 4});
  for (unsigned seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::vector<Row> more;
    const std::uint32_t copies = 1 + random() % 40, flat = random() % 5;
    for (std::uint32_t k = 0; k < copies; ++k) {
      const Row face = box.triangles.row(random() % box.triangles.rows());
      more.push_back(random() % 2 ? face : reversed(face));
    }
    for (std::uint32_t k = 0; k < flat; ++k) {
      const auto v = static_cast<std::uint32_t>(random() % box.positions.rows());
      more.emplace_back(v, static_cast<std::uint32_t>(random() % box.positions.rows()), v);
    }
    const SoundSurface sound = sound_surface(box.positions, with(box.triangles, more, &random));
    CHECK(as_set(sound.triangles) == as_set(box.triangles));
    CHECK(sound.doubled == copies);
    CHECK(sound.flat == flat);
    CHECK(sound.with_area == box.triangles.rows());
  }
}

TEST_CASE("a surface that is there twice, from both sides or alike, is taken once, whichever copy comes first (seeds 31 to 40)") {
  const MadeMesh box = made_box({2, 1, 3}, {3, 2, 4});
  for (unsigned seed = 31; seed <= 40; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::vector<Row> more;
    for (Index t = 0; t < box.triangles.rows(); ++t)
      more.push_back(seed % 2 ? reversed(box.triangles.row(t)) : Row(box.triangles.row(t)));
    const SoundSurface sound = sound_surface(box.positions, with(box.triangles, more, &random));
    CHECK(sound.doubled == box.triangles.rows());
    // All one way or all the other: the order of both sides says no more.
    Triangles round = box.triangles;
    round.col(1).swap(round.col(2));
    const auto found = as_set(sound.triangles);
    CHECK((found == as_set(box.triangles) || found == as_set(round)));
  }
  // An open one too: its rim is open with one copy as with two.
  const Triangles open = box.triangles.topRows(box.triangles.rows() - 4);
  Triangles backs = open;
  backs.col(1).swap(backs.col(2));
  Triangles both(2 * open.rows(), 3);
  both << open, backs;
  const SoundSurface sound = sound_surface(box.positions, both);
  CHECK(sound.triangles == open);
  CHECK(sound.doubled == open.rows());
}

TEST_CASE("a wall between two boxes, and the shared sides of boxes that overlap, are no copies") {
  const MadeMesh boxes = two_boxes();
  const SoundSurface walled = sound_surface(boxes.positions, boxes.triangles);
  CHECK(as_set(walled.triangles) == as_set(boxes.triangles));
  CHECK(walled.doubled == 0);

  // The first box once more, as a part of a box over both: it has five sides in common with that.
  Triangles large(0, 3), small = boxes.triangles.topRows(boxes.triangles.rows() / 2);
  for (Index t = 0; t < boxes.triangles.rows(); ++t) {
    bool wall = true;
    for (int c = 0; c < 3; ++c) wall &= boxes.positions(boxes.triangles(t, c), 0) == 1;
    if (wall) continue;
    large.conservativeResize(large.rows() + 1, 3);
    large.bottomRows(1) = boxes.triangles.row(t);
  }
  Triangles both(large.rows() + small.rows(), 3);
  both << large, small;
  const SoundSurface overlapping = sound_surface(boxes.positions, both);
  CHECK(as_set(overlapping.triangles) == as_set(both));
  CHECK(overlapping.doubled == 0);
}

TEST_CASE("a triangle on a line is left out, but for one that closes a gap; it comes last then") {
  const MadeMesh box = made_box({2, 2, 2}, {2, 2, 2});
  const auto at = [&](double x, double y, double z) {
    for (Index v = 0; v < box.positions.rows(); ++v)
      if (box.positions.row(v) == Eigen::RowVector3d(x, y, z)) return static_cast<std::uint32_t>(v);
    return no_index;
  };
  const SoundSurface without = sound_surface(
      box.positions, with(box.triangles, {Row(at(0, 0, 0), at(1, 0, 0), at(2, 0, 0)), Row(at(0, 0, 2), at(1, 0, 1), at(2, 0, 0))}));
  CHECK(without.triangles == box.triangles);
  CHECK(without.flat == 2);

  // A side of two large triangles, whose edges the four around it have in halves.
  Triangles gap(0, 3);
  for (Index t = 0; t < box.triangles.rows(); ++t) {
    bool low = true;
    for (int c = 0; c < 3; ++c) low &= box.positions(box.triangles(t, c), 2) == 0;
    if (low) continue;
    gap.conservativeResize(gap.rows() + 1, 3);
    gap.bottomRows(1) = box.triangles.row(t);
  }
  const std::uint32_t corner[4] = {at(0, 0, 0), at(0, 2, 0), at(2, 2, 0), at(2, 0, 0)},
                      middle[4] = {at(0, 1, 0), at(1, 2, 0), at(2, 1, 0), at(1, 0, 0)};
  std::vector<Row> side{Row(corner[0], corner[1], corner[2]), Row(corner[0], corner[2], corner[3])};
  for (int k = 0; k < 4; ++k) side.emplace_back(corner[k], middle[k], corner[(k + 1) % 4]);
  const SoundSurface closed = sound_surface(box.positions, with(gap, side));
  CHECK(closed.flat == 4);
  CHECK(closed.with_area == gap.rows() + 2);
  CHECK(closed.triangles.rows() == gap.rows() + 6);
}

TEST_CASE("a spike without area is left out with its tip, and where nothing has an area all is left") {
  const MadeMesh box = made_box({1, 1, 1}, {1, 1, 1});
  Points positions(9, 3);
  positions << box.positions, 50, 0, 0;
  const auto at = [&](double x) {
    for (Index v = 0; v < 8; ++v)
      if (positions.row(v) == Eigen::RowVector3d(x, 0, 0)) return static_cast<std::uint32_t>(v);
    return no_index;
  };
  const SoundSurface sound = sound_surface(positions, with(box.triangles, {Row(at(0), at(1), 8), Row(at(1), at(0), 8)}));
  CHECK(as_set(sound.triangles) == as_set(box.triangles));
  CHECK(sound.flat == 2);

  // Closed by itself, a tetrahedron on the line: nothing of it is left, so that no side of the box is open.
  const Triangles needle = with(box.triangles, {Row(at(0), at(1), 8), Row(at(1), at(0), 9), Row(at(0), 8, 9), Row(8, at(1), 9)});
  Points longer(10, 3);
  longer << positions, 70, 0, 0;
  CHECK(as_set(sound_surface(longer, needle).triangles) == as_set(box.triangles));

  Triangles line(2, 3);
  line << at(0), at(1), 8, at(0), at(0), 8;
  const SoundSurface nothing = sound_surface(positions, line);
  CHECK(nothing.triangles == line);
  CHECK(nothing.with_area == 2);
  CHECK(nothing.flat == 0);
}

TEST_CASE("what has an area does not depend on the model's size") {
  for (const double scale : {1e-140, 1e-20, 1., 1e20, 1e140}) {
    CAPTURE(scale);
    MadeMesh box = made_box({1, 1, 1}, {2, 2, 2});
    box.positions *= scale;
    CHECK(sound_surface(box.positions, box.triangles).flat == 0);
    box.positions.col(2).setZero();  // its sides stand on edge
    const SoundSurface flattened = sound_surface(box.positions, box.triangles);
    CHECK(flattened.flat == 4 * 8);
  }
}
