// Meshes and held vertices as handlebody.h has them, for the files that implement its sections on skinning.
#pragma once

#include "abi/support.hpp"
#include "core/skinning/held_vertices.hpp"

namespace handlebody {

/** HB_OK, or INVALID_SHAPE where the counts are none that arrays have: before read_mesh() and read_held(). */
int32_t check_mesh(const hb_simplex_mesh& mesh);
int32_t check_held(const hb_held_vertices& held);

/** A copy of the mesh. INVALID_SHAPE for simplices other than those in handlebody.h. */
Result<SimplexMesh> read_mesh(const hb_simplex_mesh& mesh);

HeldVertices read_held(const hb_held_vertices& held);

}  // namespace handlebody
