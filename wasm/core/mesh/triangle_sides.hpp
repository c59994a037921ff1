// The sides of triangles, in the order of the edges that they lie on: what tells which triangles are neighbors.
#pragma once

#include <cstdint>
#include <utility>

#include "core/numerics/indices.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** The sides of all triangles, sorted so that those of one edge are adjacent. Side 3t + c runs from corner c of triangle t to the
 *  next. Triangles that use a vertex twice have no sides. Keeps a reference to the triangles (indices below `vertices`). */
class TriangleSides {
 public:
  TriangleSides(const Triangles& triangles, Index vertices);

  /** The vertices of a side, the lower number first. */
  std::pair<std::uint32_t, std::uint32_t> ends(std::uint32_t side) const {
    const std::uint32_t a = triangles_.data()[side], b = triangles_.data()[side % 3 == 2 ? side - 2 : side + 1];
    return a < b ? std::pair(a, b) : std::pair(b, a);
  }
  /** +1 for a side that runs from the lower number to the higher. */
  int direction(std::uint32_t side) const { return triangles_.data()[side] == ends(side).first ? 1 : -1; }

  /** The corner that is not on the side. */
  std::uint32_t opposite(std::uint32_t side) const { return triangles_.data()[side % 3 == 0 ? side + 2 : side - 1]; }

  /** Calls visit(first, last) for the sides of each edge. */
  template <typename Visit>
  void for_each_edge(const Visit& visit) const {
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

}  // namespace handlebody
