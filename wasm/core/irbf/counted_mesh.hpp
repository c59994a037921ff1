// What of a mesh counts when it is baked: the vertices that something uses, each place once, and the triangles that are a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "core/errors/result.hpp"
#include "core/irbf/bake_warning.hpp"
#include "core/mesh/weld.hpp"
#include "core/numerics/indices.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

struct CountedMesh {
  Indices stored;       // the stored number of each vertex that counts, ascending
  Weld weld;            // of those
  Points positions;     // the places, model units
  Triangles triangles;  // of places; those from `with_area` on have none and close gaps
  Index with_area = 0;
  std::vector<BakeWarning> warnings;  // what was passed over

  /** The stored number of a place. */
  std::uint32_t stored_number(std::uint32_t place) const { return stored[weld.unique[place]]; }
};

/** `used` tells which vertices something uses; empty for those of the triangles, or all where there are none. Vertices that only
 *  triangles without area use do not count either. Fails with MESH_NOT_FINITE where a vertex that does not count cannot be held in
 *  single precision (it is deformed along with the rest), MESH_TOO_FEW_VERTICES where less than a volume's corners are left, or
 *  as check_extent() does. The mesh has passed check_mesh(). */
Result<CountedMesh> count_mesh(const ConstPoints& positions, const ConstTriangles& triangles, std::vector<std::uint8_t> used);

}  // namespace handlebody
