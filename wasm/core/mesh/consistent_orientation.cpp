#include "core/mesh/consistent_orientation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

/** The sides of all triangles, sorted so that those of one edge are adjacent. Side 3t + c runs from corner c to the next. */
class Edges {
 public:
  Edges(const Triangles& triangles, Index vertices) : triangles_(triangles) {
    // Sorted by the lower end in one pass, then by the higher among the few that share it.
    Indices starts(static_cast<std::size_t>(vertices) + 1);
    const auto count = static_cast<std::uint32_t>(triangles.size());
    const auto for_each_side = [&](const auto& visit) {
      for (std::uint32_t side = 0; side < count; ++side) {
        const std::uint32_t* t = triangles.data() + side / 3 * 3;
        // A triangle that uses a vertex twice has no side to face.
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) visit(side, ends(side).first);
      }
    };
    for_each_side([&](std::uint32_t, std::uint32_t low) { ++starts[low + 1]; });
    for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
    order_.resize(starts.back());
    Indices next = starts;
    for_each_side([&](std::uint32_t side, std::uint32_t low) { order_[next[low]++] = side; });
    Indices few;
    for (std::size_t v = 0; v + 1 < starts.size(); ++v) {
      few.assign(order_.begin() + starts[v], order_.begin() + starts[v + 1]);
      const auto before = [&](std::uint32_t s, std::uint32_t t) {
        const std::uint32_t high_s = ends(s).second, high_t = ends(t).second;
        return high_s != high_t ? high_s < high_t : s < t;
      };
      if (few.size() > 32) {
        sort(few, before);
      } else {
        for (std::size_t i = 1; i < few.size(); ++i) {
          for (std::size_t k = i; k > 0 && before(few[k], few[k - 1]); --k) std::swap(few[k], few[k - 1]);
        }
      }
      std::copy(few.begin(), few.end(), order_.begin() + starts[v]);
    }
  }

  std::pair<std::uint32_t, std::uint32_t> ends(std::uint32_t side) const {
    const std::uint32_t a = triangles_.data()[side], b = triangles_.data()[side % 3 == 2 ? side - 2 : side + 1];
    return a < b ? std::pair(a, b) : std::pair(b, a);
  }
  /** +1 for a side that runs from the lower number to the higher. */
  int direction(std::uint32_t side) const { return triangles_.data()[side] == ends(side).first ? 1 : -1; }

  /** Calls visit(first, last) for the sides of each edge. */
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t first = 0, last; first < order_.size(); first = last) {
      const auto edge = ends(order_[first]);
      for (last = first + 1; last < order_.size() && ends(order_[last]) == edge;) ++last;
      visit(order_.data() + first, order_.data() + last);
    }
  }

 private:
  const Triangles& triangles_;
  Indices order_;
};

Index count_open(const Edges& edges) {
  Index open = 0;
  edges.for_each([&](const std::uint32_t* first, const std::uint32_t* last) {
    int sum = 0;
    for (const std::uint32_t* side = first; side != last; ++side) sum += edges.direction(*side);
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

}  // namespace

Orientation orient_consistently(const Points& positions, Triangles& triangles) {
  const Edges edges(triangles, positions.rows());
  Orientation result{false, false, 0, count_open(edges)};
  if (result.open_edges == 0) {
    double volume = 0;
    for (Index t = 0; t < triangles.rows(); ++t) volume += volume_of(positions, triangles, t);
    result.closed = true, result.inside_out = volume < 0;
    return result;
  }

  // Neighbors across edges that exactly two triangles share.
  Indices across(triangles.size(), no_index);
  edges.for_each([&](const std::uint32_t* first, const std::uint32_t* last) {
    if (last - first == 2) across[first[0]] = first[1], across[first[1]] = first[0];
  });
  const auto count = static_cast<std::size_t>(triangles.rows());
  std::vector<std::uint8_t> turned(count);
  Indices part(count, no_index), queue;
  std::vector<std::size_t> starts;  // where each part starts in the queue
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    if (part[seed] != no_index) continue;
    std::size_t head = queue.size();
    const auto number = static_cast<std::uint32_t>(starts.size());
    starts.push_back(head);
    part[seed] = number;
    queue.push_back(seed);
    for (; head < queue.size(); ++head) {
      for (std::uint32_t side = 3 * queue[head]; side < 3 * queue[head] + 3; ++side) {
        if (across[side] == no_index || part[across[side] / 3] != no_index) continue;
        const std::uint32_t t = across[side] / 3;
        turned[t] = turned[queue[head]] ^ (edges.direction(side) == edges.direction(across[side]));
        part[t] = number;
        queue.push_back(t);
      }
    }
  }
  starts.push_back(queue.size());

  // A part is closed where on every edge as many of its sides run one way as the other.
  std::vector<std::uint8_t> open(starts.size());
  std::vector<int> sum(starts.size());
  edges.for_each([&](const std::uint32_t* first, const std::uint32_t* last) {
    const auto sign = [&](std::uint32_t side) { return turned[side / 3] ? -edges.direction(side) : edges.direction(side); };
    for (const std::uint32_t* side = first; side != last; ++side) sum[part[*side / 3]] += sign(*side);
    for (const std::uint32_t* side = first; side != last; ++side) open[part[*side / 3]] |= sum[part[*side / 3]] != 0;
    for (const std::uint32_t* side = first; side != last; ++side) sum[part[*side / 3]] = 0;
  });
  for (std::size_t p = 0; p + 1 < starts.size(); ++p) {
    double keep = 0;
    for (std::size_t k = starts[p]; k < starts[p + 1]; ++k) {
      const std::uint32_t t = queue[k];
      const double share = open[p] ? area_of(positions, triangles, t) : volume_of(positions, triangles, t);
      keep += turned[t] ? -share : share;
    }
    for (std::size_t k = starts[p]; k < starts[p + 1]; ++k) {
      const std::uint32_t t = queue[k];
      if (turned[t] != (keep < 0)) turned[t] = 2;
    }
  }
  for (std::size_t t = 0; t < count; ++t) {
    if (turned[t] != 2) continue;
    std::swap(triangles(static_cast<Index>(t), 1), triangles(static_cast<Index>(t), 2));
    ++result.turned;
  }
  result.open_edges = count_open(Edges(triangles, positions.rows()));
  result.closed = result.open_edges == 0;
  return result;
}

}  // namespace handlebody
