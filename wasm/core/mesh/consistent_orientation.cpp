#include "core/mesh/consistent_orientation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/mesh/triangle_sides.hpp"
#include "core/mesh/triangle_tree.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

/** Two triangles that run along an edge the same way are neighbors of which one is turned over, unless they lie on each other: then
 *  they are ends of two sheets that happen to meet there, such as the seams of a ball and of a capsule around it. */
constexpr double folded = 0.866;  // the cosine of 30°

/** Places from which it is looked whether a part lies in another: of one part, and of all together. */
constexpr Index samples_of_part = 32, samples_of_all = 65536;

Index count_open(const TriangleSides& sides) {
  Index open = 0;
  sides.for_each_edge([&](const std::uint32_t* first, const std::uint32_t* last) {
    int sum = 0;
    for (const std::uint32_t* side = first; side != last; ++side) sum += sides.direction(*side);
    open += sum != 0;
  });
  return open;
}

double volume_of(const Points& positions, const Triangles& triangles, Index t) {
  const Vector3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)), c = positions.row(triangles(t, 2));
  return a.dot(b.cross(c));
}

double area_of(const Points& positions, const Triangles& triangles, Index t) {
  const Vector3 a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)), c = positions.row(triangles(t, 2));
  return (b - a).cross(c - a).norm();
}

bool on_each_other(const Points& positions, const TriangleSides& sides, std::uint32_t one, std::uint32_t other) {
  const auto [low, high] = sides.ends(one);
  const Vector3 from = positions.row(low), along = (positions.row(high).transpose() - from).normalized();
  const auto away = [&](std::uint32_t side) {
    const Vector3 to = positions.row(sides.opposite(side)).transpose() - from;
    return Vector3((to - along.dot(to) * along).normalized());
  };
  return away(one).dot(away(other)) > folded;
}

/** Triangles that are connected by edges of two, and how each has to be turned to agree with the others of its part. */
class Parts {
 public:
  Parts(const Points& positions, const Triangles& triangles, const TriangleSides& sides);

  std::size_t count() const { return starts_.size() - 1; }
  const std::uint32_t* begin(std::size_t part) const { return queue_.data() + starts_[part]; }
  const std::uint32_t* end(std::size_t part) const { return queue_.data() + starts_[part + 1]; }

  bool turned(std::uint32_t triangle) const { return turned_[triangle]; }

  /** Whether on every edge as many of the part's sides run one way as the other, once they agree. */
  bool closed(std::size_t part) const { return !open_[part]; }

  /** Whether its triangles agree as they are. */
  bool agrees(std::size_t part) const {
    return std::none_of(begin(part), end(part), [&](std::uint32_t t) { return turned_[t] != 0; });
  }

 private:
  std::vector<std::uint8_t> turned_, open_;
  Indices queue_;                    // the triangles of one part after the other
  std::vector<std::size_t> starts_;  // where each begins
};

Parts::Parts(const Points& positions, const Triangles& triangles, const TriangleSides& sides) {
  Indices across(triangles.size(), no_index);
  sides.for_each_edge([&](const std::uint32_t* first, const std::uint32_t* last) {
    if (last - first != 2) return;
    if (sides.direction(first[0]) == sides.direction(first[1]) && on_each_other(positions, sides, first[0], first[1])) return;
    across[first[0]] = first[1], across[first[1]] = first[0];
  });
  const auto count = static_cast<std::size_t>(triangles.rows());
  turned_.resize(count);
  Indices part(count, no_index);
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    if (part[seed] != no_index) continue;
    std::size_t head = queue_.size();
    const auto number = static_cast<std::uint32_t>(starts_.size());
    starts_.push_back(head);
    part[seed] = number;
    queue_.push_back(seed);
    for (; head < queue_.size(); ++head) {
      for (std::uint32_t side = 3 * queue_[head]; side < 3 * queue_[head] + 3; ++side) {
        if (across[side] == no_index || part[across[side] / 3] != no_index) continue;
        const std::uint32_t t = across[side] / 3;
        turned_[t] = turned_[queue_[head]] ^ (sides.direction(side) == sides.direction(across[side]));
        part[t] = number;
        queue_.push_back(t);
      }
    }
  }
  starts_.push_back(queue_.size());

  open_.resize(starts_.size());
  for (std::size_t t = 0; t < count; ++t) {  // one without sides is a part that bounds nothing
    const auto corner = triangles.row(static_cast<Index>(t));
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) open_[part[t]] = 1;
  }
  std::vector<int> sum(starts_.size());
  sides.for_each_edge([&](const std::uint32_t* first, const std::uint32_t* last) {
    const auto sign = [&](std::uint32_t side) { return turned_[side / 3] ? -sides.direction(side) : sides.direction(side); };
    for (const std::uint32_t* side = first; side != last; ++side) sum[part[*side / 3]] += sign(*side);
    for (const std::uint32_t* side = first; side != last; ++side) open_[part[*side / 3]] |= sum[part[*side / 3]] != 0;
    for (const std::uint32_t* side = first; side != last; ++side) sum[part[*side / 3]] = 0;
  });
}

/** Whether just outside of a closed part, everywhere, is the inside of something else. `outside` is 1 for one that faces outward,
 * −1 for one that faces inward; places are at most `samples`. */
bool is_nested(const Points& positions, const Triangles& triangles, const TriangleTree& tree, const std::uint32_t* begin,
               const std::uint32_t* end, int outside, Index samples) {
  const Index step = std::max<Index>(1, (end - begin) / samples);
  bool looked = false;
  for (const std::uint32_t* t = begin; t < end; t += step) {
    const Vector3 a = positions.row(triangles(*t, 0)), b = positions.row(triangles(*t, 1)), c = positions.row(triangles(*t, 2));
    const Vector3 normal = (b - a).cross(c - a);
    const double size = std::sqrt(normal.norm());
    if (!(size > 0)) continue;
    looked = true;
    if (std::abs(tree.winding_number((a + b + c) / 3 + 1e-3 * outside * size * normal.normalized())) < 0.5) return false;
  }
  return looked;
}

}  // namespace

Orientation orient_consistently(const Points& positions, Triangles& triangles) {
  const TriangleSides as_given(triangles, positions.rows());
  Orientation result{false, false, 0, count_open(as_given)};
  result.closed = result.open_edges == 0;
  const Parts parts(positions, triangles, as_given);

  std::vector<std::size_t> inward, outward;  // closed parts that agree as they are
  std::vector<std::uint8_t> turn(static_cast<std::size_t>(triangles.rows()));
  double volume = 0;
  for (std::size_t p = 0; p < parts.count(); ++p) {
    double keep = 0;
    for (const std::uint32_t* t = parts.begin(p); t != parts.end(p); ++t) {
      const double own = volume_of(positions, triangles, *t);
      volume += own;
      const double share = parts.closed(p) ? own : area_of(positions, triangles, *t);
      keep += parts.turned(*t) ? -share : share;
    }
    if (!parts.agrees(p))
      for (const std::uint32_t* t = parts.begin(p); t != parts.end(p); ++t) turn[*t] = parts.turned(*t) != (keep < 0);
    else if (parts.closed(p))
      (keep < 0 ? inward : outward).push_back(p);
  }
  const auto turn_round = [&] {
    for (std::size_t t = 0; t < turn.size(); ++t) {
      if (!turn[t]) continue;
      std::swap(triangles(static_cast<Index>(t), 1), triangles(static_cast<Index>(t), 2));
      turn[t] = 0;
      ++result.turned;
    }
  };
  turn_round();
  result.inside_out = result.closed && volume < 0;
  if (!inward.empty()) {
    const TriangleTree tree(positions, triangles);
    const Index samples = std::clamp<Index>(samples_of_all / std::ssize(inward), 1, samples_of_part);
    const auto nested = [&](std::size_t p, int outside) {
      return is_nested(positions, triangles, tree, parts.begin(p), parts.end(p), outside, samples);
    };
    result.inside_out = result.closed && std::all_of(outward.begin(), outward.end(), [&](std::size_t p) { return nested(p, 1); });
    for (const std::size_t p : inward) {
      if (result.inside_out || nested(p, -1)) continue;
      for (const std::uint32_t* t = parts.begin(p); t != parts.end(p); ++t) turn[*t] = 1;
    }
    turn_round();
  }
  if (result.closed) return result;
  result.open_edges = count_open(TriangleSides(triangles, positions.rows()));
  result.closed = result.open_edges == 0;
  return result;
}

}  // namespace handlebody
