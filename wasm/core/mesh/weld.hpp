// Welding by exact position: renderers split vertices at texture seams, a volume does not.
#pragma once

#include <cstdint>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

struct Weld {
  std::vector<std::uint32_t> unique;     // for each welded vertex, the first stored vertex there
  std::vector<std::uint32_t> to_unique;  // for each stored vertex, its welded vertex
};

/** Finds the stored vertices that share a position exactly (−0 equals 0). Welded vertices are numbered in stored order. */
Weld weld_vertices(const ConstPoints& positions);

/** `triangles` with welded indices. */
Triangles weld_triangles(const Weld& weld, const ConstTriangles& triangles);

}  // namespace handlebody
