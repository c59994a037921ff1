#include "core/mesh/sound_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include "core/mesh/triangle_sides.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

/** A triangle lower than this part of its longest side has no area: coordinates that were meant to be in a line are so to a few
 *  roundings. */
constexpr double least_height = 1e-12;

bool repeats_corner(const std::uint32_t* t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

bool has_area(const Points& positions, const std::uint32_t* t) {
  const Vector3 a = positions.row(t[0]), b = positions.row(t[1]), c = positions.row(t[2]);
  const Vector3 ab = b - a, ac = c - a, bc = c - b;
  // Divided first, so that no product overflows or vanishes.
  const double longest = std::max({ab.lpNorm<Eigen::Infinity>(), ac.lpNorm<Eigen::Infinity>(), bc.lpNorm<Eigen::Infinity>()});
  return longest > 0 && (ab / longest).cross(ac / longest).norm() > least_height;
}

/** A face: the triangles that have the same three corners, as often as each way round occurs; `alike` face as the first does. */
struct Face {
  std::uint32_t first;
  std::int32_t alike = 1, opposite = 0;
  bool repeated() const { return alike + opposite > 1; }
  int net() const { return alike - opposite; }
};

std::array<std::uint32_t, 3> sorted_corners(const std::uint32_t* t) {
  std::array<std::uint32_t, 3> corners{t[0], t[1], t[2]};
  if (corners[0] > corners[1]) std::swap(corners[0], corners[1]);
  if (corners[1] > corners[2]) std::swap(corners[1], corners[2]);
  if (corners[0] > corners[1]) std::swap(corners[0], corners[1]);
  return corners;
}

bool is_even(const std::uint32_t* t) {
  return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
}

/** Sorts a few keys, and what belongs to them; equal ones keep their order. */
void sort_few(std::uint64_t* keys, std::uint32_t* values, std::size_t count) {
  if (count > 32) {
    const std::vector<std::uint64_t> old_keys(keys, keys + count);
    const Indices old_values(values, values + count);
    const Indices order = sorted_indices(count, [&](std::uint32_t a, std::uint32_t b) {
      return old_keys[a] < old_keys[b] || (old_keys[a] == old_keys[b] && a < b);
    });
    for (std::size_t i = 0; i < count; ++i) keys[i] = old_keys[order[i]], values[i] = old_values[order[i]];
    return;
  }
  for (std::size_t i = 1; i < count; ++i)
    for (std::size_t k = i; k > 0 && keys[k] < keys[k - 1]; --k)
      std::swap(keys[k], keys[k - 1]), std::swap(values[k], values[k - 1]);
}

/** The faces of the triangles in `of`, in the order of their first ones. */
std::vector<Face> find_faces(const Triangles& triangles, const Indices& of, Index vertices) {
  // Those with the same lowest corner are next to each other after one pass, and few share it: the other two are the key.
  Indices starts(static_cast<std::size_t>(vertices) + 1), order(of.size());
  std::vector<std::uint64_t> keys(of.size());
  const auto corners = [&](std::uint32_t t) { return triangles.data() + 3 * std::size_t{t}; };
  for (const std::uint32_t t : of) ++starts[sorted_corners(corners(t))[0] + 1];
  for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
  Indices next = starts;
  for (const std::uint32_t t : of) {
    const auto [low, middle, high] = sorted_corners(corners(t));
    const std::uint32_t place = next[low]++;
    order[place] = t;
    keys[place] = std::uint64_t{middle} << 32 | high;
  }
  std::vector<Face> face_of(static_cast<std::size_t>(triangles.rows()), Face{no_index});
  for (std::size_t v = 0; v + 1 < starts.size(); ++v) {
    sort_few(keys.data() + starts[v], order.data() + starts[v], starts[v + 1] - starts[v]);
    for (std::uint32_t i = starts[v], first = i; i < starts[v + 1]; ++i) {
      if (i == starts[v] || keys[i] != keys[first]) {
        first = i;
        face_of[order[i]] = Face{order[i]};
      } else {
        Face& face = face_of[order[first]];
        ++(is_even(corners(order[i])) == is_even(corners(order[first])) ? face.alike : face.opposite);
      }
    }
  }
  std::vector<Face> faces;
  for (const std::uint32_t t : of)
    if (face_of[t].first == t) faces.push_back(face_of[t]);
  return faces;
}

/** How often each face is to be there, in either direction: chosen so that the surface is as closed as it can be. */
class Multiplicities {
 public:
  Multiplicities(const Triangles& triangles, const std::vector<Face>& faces, Index vertices);

  /** Of faces that occur more than once: one of them, an opposite pair, or all, for each patch of such faces. */
  void choose();

  /** Of faces without area: none that has a corner off the others, and none where the surface is as closed without. */
  void leave_out(const std::vector<std::uint8_t>& flat);

  const std::vector<Face>& faces() const { return faces_; }

 private:
  std::size_t edge_of(std::size_t face, int side) const { return edges_[3 * face + side]; }
  void set(std::size_t face, int alike, int opposite);
  void choose_for(const Indices& patch, const std::vector<int>& turn);

  std::vector<Face> faces_;  // as they are to be
  std::vector<Face> given_;
  Triangles shown_;                // the first triangle of each
  Indices edges_;                  // of each side
  std::vector<int> balance_;       // of each edge: how much more often it is run one way than the other
  Indices across_;                 // of each side whose edge has two faces: the other one's side
  std::vector<std::uint8_t> rim_;  // edges of one face, however often that occurs
  std::vector<std::int8_t> directions_;
};

Multiplicities::Multiplicities(const Triangles& triangles, const std::vector<Face>& faces, Index vertices)
    : faces_(faces), given_(faces), shown_(static_cast<Index>(faces.size()), 3) {
  for (std::size_t f = 0; f < faces.size(); ++f) shown_.row(static_cast<Index>(f)) = triangles.row(faces[f].first);
  const TriangleSides sides(shown_, vertices);
  edges_.resize(3 * faces.size());
  across_.assign(3 * faces.size(), no_index);
  directions_.resize(3 * faces.size());
  for (std::uint32_t side = 0; side < directions_.size(); ++side)
    directions_[side] = static_cast<std::int8_t>(sides.direction(side));
  sides.for_each_edge([&](const std::uint32_t* first, const std::uint32_t* last) {
    int sum = 0;
    for (const std::uint32_t* side = first; side != last; ++side) {
      edges_[*side] = static_cast<std::uint32_t>(balance_.size());
      sum += directions_[*side] * faces_[*side / 3].net();
    }
    if (last - first == 2) across_[first[0]] = first[1], across_[first[1]] = first[0];
    balance_.push_back(sum);
    rim_.push_back(last - first == 1);
  });
}

void Multiplicities::set(std::size_t face, int alike, int opposite) {
  Face& now = faces_[face];
  const int change = alike - opposite - now.net();
  for (int side = 0; side < 3; ++side) balance_[edge_of(face, side)] += change * directions_[3 * face + side];
  now.alike = alike, now.opposite = opposite;
}

void Multiplicities::choose() {
  std::vector<std::uint8_t> seen(faces_.size());
  std::vector<int> turn(faces_.size(), 1);  // −1 for faces whose first triangle faces the other way than the patch
  for (std::uint32_t seed = 0; seed < faces_.size(); ++seed) {
    if (seen[seed] || !given_[seed].repeated()) continue;
    Indices patch{seed};
    seen[seed] = 1;
    for (std::size_t head = 0; head < patch.size(); ++head) {
      for (std::uint32_t side = 3 * patch[head]; side < 3 * patch[head] + 3; ++side) {
        if (across_[side] == no_index) continue;
        const std::uint32_t beside = across_[side] / 3;
        if (seen[beside] || !given_[beside].repeated()) continue;
        turn[beside] = directions_[side] == directions_[across_[side]] ? -turn[patch[head]] : turn[patch[head]];
        seen[beside] = 1;
        patch.push_back(beside);
      }
    }
    choose_for(patch, turn);
  }
}

void Multiplicities::choose_for(const Indices& patch, const std::vector<int>& turn) {
  enum Choice { once, once_turned, pair, given };
  Indices touched;
  for (const std::uint32_t face : patch)
    for (int side = 0; side < 3; ++side) touched.push_back(static_cast<std::uint32_t>(edge_of(face, side)));
  sort(touched, [](std::uint32_t a, std::uint32_t b) { return a < b; });
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  const auto take = [&](int choice) {
    for (const std::uint32_t face : patch) {
      const Face& was = given_[face];
      const bool same = turn[face] == (choice == once ? 1 : -1);
      if (choice == given || (choice == pair && (was.alike == 0 || was.opposite == 0)))
        set(face, was.alike, was.opposite);
      else if (choice == pair)
        set(face, 1, 1);
      else
        set(face, same ? 1 : 0, same ? 0 : 1);
    }
  };
  int best = given, fewest = -1;
  for (const int choice : {once, once_turned, pair, given}) {
    take(choice);
    int open = 0;
    for (const std::uint32_t edge : touched)
      if (!rim_[edge]) open += std::abs(balance_[edge]);
    if (fewest < 0 || open < fewest) best = choice, fewest = open;
  }
  take(best);
}

void Multiplicities::leave_out(const std::vector<std::uint8_t>& flat) {
  std::vector<std::uint8_t> used(static_cast<std::size_t>(shown_.maxCoeff()) + 1);
  for (Index face = 0; face < shown_.rows(); ++face)
    if (!flat[faces_[face].first])
      for (int c = 0; c < 3; ++c) used[shown_(face, c)] = 1;
  for (Index face = 0; face < shown_.rows(); ++face)
    if (!used[shown_(face, 0)] || !used[shown_(face, 1)] || !used[shown_(face, 2)]) set(static_cast<std::size_t>(face), 0, 0);
  for (std::size_t face = 0; face < faces_.size(); ++face) {
    if (!flat[faces_[face].first]) continue;
    int gain = 0;
    for (int side = 0; side < 3; ++side) {
      const int now = balance_[edge_of(face, side)];
      gain += std::abs(now) - std::abs(now - faces_[face].net() * directions_[3 * face + side]);
    }
    if (gain >= 0) set(face, 0, 0);
  }
}

}  // namespace

SoundSurface sound_surface(const Points& positions, const Triangles& triangles) {
  SoundSurface sound;
  const auto count = static_cast<std::size_t>(triangles.rows());
  std::vector<std::uint8_t> flat(count);
  Indices whole;  // with three corners
  bool any_area = false, any_line = false;
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::uint32_t* corners = triangles.data() + 3 * std::size_t{t};
    const bool area = has_area(positions, corners);
    flat[t] = !area;
    sound.flat += !area;
    any_area |= area;
    if (repeats_corner(corners)) continue;
    any_line |= !area;
    whole.push_back(t);
  }
  if (!any_area) return {triangles, triangles.rows(), 0, 0};
  std::vector<Face> faces = find_faces(triangles, whole, positions.rows());
  if (faces.size() < whole.size() || any_line) {
    Multiplicities chosen(triangles, faces, positions.rows());
    chosen.choose();
    if (any_line) chosen.leave_out(flat);
    const std::vector<Face>& as_chosen = chosen.faces();
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (!flat[faces[f].first]) sound.doubled += faces[f].alike + faces[f].opposite - as_chosen[f].alike - as_chosen[f].opposite;
    faces = as_chosen;
  }

  sound.triangles.resize(static_cast<Index>(whole.size()), 3);
  Index row = 0;
  const auto add = [&](bool without_area) {
    for (const Face& face : faces) {
      if ((flat[face.first] != 0) != without_area) continue;
      for (int copy = 0; copy < face.alike + face.opposite; ++copy, ++row) {
        sound.triangles.row(row) = triangles.row(face.first);
        if (copy >= face.alike) sound.triangles.row(row).tail<2>().reverseInPlace();
      }
    }
  };
  add(false);
  sound.with_area = row;
  add(true);
  sound.triangles.conservativeResize(row, 3);
  return sound;
}

}  // namespace handlebody
