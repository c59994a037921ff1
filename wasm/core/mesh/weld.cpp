#include "core/mesh/weld.hpp"

#include <algorithm>

#include "core/numerics/indices.hpp"

namespace handlebody {

namespace {

/** Numbers the welds of `first`, the first stored vertex at the place of each, in stored order. */
Weld number_places(const Indices& first) {
  Weld weld;
  weld.to_unique.resize(first.size());
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (first[v] == v) {
      weld.to_unique[v] = static_cast<std::uint32_t>(weld.unique.size());
      weld.unique.push_back(v);
    } else {
      weld.to_unique[v] = weld.to_unique[first[v]];
    }
  }
  return weld;
}

/** A direction in which the vertices of made shapes rarely share a height: sweeping along it compares few pairs. */
const Vector3 sweep(0.5377, 0.6173, 0.5743);  // shorter than 1, so that heights differ less than places

}  // namespace

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
  return number_places(first);
}

Weld weld_vertices(const ConstPoints& positions, const Vector& reach) {
  const Weld exact = weld_vertices(positions);
  const auto count = static_cast<std::uint32_t>(exact.unique.size());
  Vector reach_of = Vector::Zero(count), height(count);
  for (std::size_t v = 0; v < exact.to_unique.size(); ++v) {
    double& own = reach_of[exact.to_unique[v]];
    own = std::max(own, reach[static_cast<Index>(v)]);
  }
  const auto place = [&](std::uint32_t u) { return positions.row(exact.unique[u]); };
  for (std::uint32_t u = 0; u < count; ++u) height[u] = (place(u) - place(0)).dot(sweep.transpose());
  const Indices order = sorted_indices(
      count, [&](std::uint32_t a, std::uint32_t b) { return height[a] < height[b] || (height[a] == height[b] && a < b); });

  Indices root(count);
  for (std::uint32_t u = 0; u < count; ++u) root[u] = u;
  const auto find = [&root](std::uint32_t u) {
    while (root[u] != u) u = root[u] = root[root[u]];
    return u;
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t u = order[i];
    for (std::uint32_t j = i + 1; j < count && height[order[j]] - height[u] <= reach_of[u]; ++j) {
      const std::uint32_t w = order[j];
      if (!((place(u) - place(w)).norm() < std::min(reach_of[u], reach_of[w]))) continue;
      const std::uint32_t a = find(u), b = find(w);
      root[std::max(a, b)] = std::min(a, b);  // so that the root is the first
    }
  }
  Indices first(exact.to_unique.size());
  for (std::size_t v = 0; v < first.size(); ++v) first[v] = exact.unique[find(exact.to_unique[v])];
  return number_places(first);
}

double rounding(double longest_edge, double diagonal) {
  return std::min(1e-3 * longest_edge, 1e-6 * diagonal);
}

double used_diagonal(const ConstPoints& positions, const ConstSimplices& simplices) {
  if (simplices.size() == 0) return 0;
  Vector3 low = positions.row(simplices(0, 0)), high = low;
  for (Index s = 0; s < simplices.rows(); ++s)
    for (Index k = 0; k < simplices.cols(); ++k) {
      low = low.cwiseMin(positions.row(simplices(s, k)).transpose());
      high = high.cwiseMax(positions.row(simplices(s, k)).transpose());
    }
  return (high - low).norm();
}

Weld weld_mesh(const ConstPoints& positions, const ConstSimplices& simplices) {
  const double diagonal = used_diagonal(positions, simplices);
  Vector reach = Vector::Zero(positions.rows());
  for (Index s = 0; s < simplices.rows(); ++s) {
    double longest = 0;
    for (Index k = 0; k < simplices.cols(); ++k)
      for (Index l = 0; l < k; ++l)
        longest = std::max(longest, (positions.row(simplices(s, k)) - positions.row(simplices(s, l))).norm());
    for (Index k = 0; k < simplices.cols(); ++k) {
      double& own = reach[simplices(s, k)];
      own = std::max(own, rounding(longest, diagonal));
    }
  }
  return weld_vertices(positions, reach);
}

Triangles weld_triangles(const Weld& weld, const ConstTriangles& triangles) {
  return triangles.unaryExpr([&](std::uint32_t v) { return weld.to_unique[v]; });
}

}  // namespace handlebody
