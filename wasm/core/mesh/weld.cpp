#include "core/mesh/weld.hpp"

#include "core/numerics/indices.hpp"

namespace handlebody {

Weld weld_vertices(const ConstPoints& positions) {
  const auto count = static_cast<std::uint32_t>(positions.rows());
  const Indices order = sorted_indices(count, [&](std::uint32_t a, std::uint32_t b) {
    for (int axis = 0; axis < 3; ++axis) {
      if (positions(a, axis) != positions(b, axis)) return positions(a, axis) < positions(b, axis);
    }
    return a < b;
  });

  // Within a run of equal positions the first is the lowest stored number.
  std::vector<std::uint32_t> first(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool same = i > 0 && positions.row(order[i]) == positions.row(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  Weld weld;
  weld.to_unique.resize(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    if (first[v] == v) {
      weld.to_unique[v] = static_cast<std::uint32_t>(weld.unique.size());
      weld.unique.push_back(v);
    } else {
      weld.to_unique[v] = weld.to_unique[first[v]];
    }
  }
  return weld;
}

Triangles weld_triangles(const Weld& weld, const ConstTriangles& triangles) {
  return triangles.unaryExpr([&](std::uint32_t v) { return weld.to_unique[v]; });
}

}  // namespace handlebody
