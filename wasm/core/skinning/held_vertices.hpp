// Which vertices the handles hold, and what becomes of parts of a mesh that no handle touches.
#pragma once

#include <vector>

#include "core/mesh/simplex_mesh.hpp"

namespace handlebody {

/** Handle owners[k] holds vertices[k]: one for a point handle, several for a bone. */
struct HeldVertices {
  Indices vertices, owners;
  Index handle_count = 0;
};

/** A connected part of the mesh without a handle of its own: it goes with the nearest one. */
struct Island {
  std::uint32_t first, count, handle;  // its first vertex, its number of vertices, the handle
};

/** Checks that every handle holds a vertex and that no two hold the same one, drops repetitions, and then adds the first vertex of
 * each island to the handle that has a vertex nearest to any of the island's. Returns the islands. HANDLES_MISSING,
 * HANDLE_OUT_OF_RANGE (also for a handle without vertices) or HANDLE_CONFLICT. */
Result<std::vector<Island>> complete(HeldVertices& held, const SimplexMesh& mesh, const Indices& parts);

}  // namespace handlebody
