// The part of the area or volume that belongs to each vertex: the diagonal mass matrix.
#pragma once

#include "core/mesh/simplex_mesh.hpp"

namespace handlebody {

/** `barycentric`: a third of each triangle, a fourth of each tetrahedron. `voronoi`: on triangles the area that is nearest to the
 * vertex, mixed with halves and quarters where an angle is obtuse (Meyer et al. 2003); tetrahedra, whose circumcenters may lie
 * anywhere, stay barycentric. */
enum class Mass { voronoi, barycentric };
constexpr unsigned mass_count = 2;

/** One mass per vertex, an area or volume; they sum to that of the mesh. 0 for vertices in no simplex. The mesh must have been
 * checked. */
Vector mass_matrix(const SimplexMesh& mesh, Mass kind);

}  // namespace handlebody
