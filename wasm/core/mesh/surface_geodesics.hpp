// Lengths of shortest paths along a triangle mesh, approximately: Dijkstra's method with a front that also crosses triangles
// (Novotni & Klein 2002). Any triangles will do, even obtuse ones and ones without area. Lengths are 0.5% too long on average;
// rejected: the heat method along the surface, 1 to 3.5%.
#pragma once

#include <cstdint>
#include <vector>

#include "core/numerics/indices.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** Reusable state for many sources on one mesh, of which it keeps a copy. Indices must be in range. */
class SurfaceGeodesics {
 public:
  SurfaceGeodesics(const ConstPoints& positions, const ConstTriangles& triangles);

  /** Distances along the surface from vertex `source` to every vertex, into `distances` (one per vertex); +infinity to other parts
   *  of the mesh. On smooth surfaces about 0.5% off in the mean. Allocates nothing after the first call. */
  void measure(std::uint32_t source, double* distances);

 private:
  struct Trial {
    double distance;
    std::uint32_t vertex;
  };

  void offer(std::uint32_t vertex, double distance, double* distances);
  void cross(std::uint32_t a, std::uint32_t b, std::uint32_t to, double* distances);

  Points positions_;
  Triangles triangles_;
  Indices starts_, around_;  // the triangles around each vertex
  std::vector<Trial> heap_;
};

}  // namespace handlebody
