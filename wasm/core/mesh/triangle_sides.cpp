#include "core/mesh/triangle_sides.hpp"

#include <algorithm>

namespace handlebody {

/** Sorted by the lower end in one pass, then by the higher among the few that share it. */
TriangleSides::TriangleSides(const Triangles& triangles, Index vertices) : triangles_(triangles) {
  Indices starts(static_cast<std::size_t>(vertices) + 1);
  const auto count = static_cast<std::uint32_t>(triangles.size());
  const auto for_each_side = [&](const auto& visit) {
    for (std::uint32_t side = 0; side < count; ++side) {
      const std::uint32_t* t = triangles.data() + side / 3 * 3;
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

}  // namespace handlebody
