// Triangles in the plane or in space, or tetrahedra: the meshes of finite elements.
#pragma once

#include <vector>

#include "core/errors/result.hpp"
#include "core/numerics/indices.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** m×3 or m×4 vertex numbers. */
using Simplices = Eigen::Matrix<std::uint32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct SimplexMesh {
  Matrix positions;     // n × 2 or n × 3
  Simplices simplices;  // m × 3: triangles; m × 4: tetrahedra, in space only
};

/** Area of a triangle or volume of a tetrahedron (without sign). */
double simplex_volume(const SimplexMesh& mesh, Index simplex);

/** Length of the longest edge. */
double longest_edge(const SimplexMesh& mesh, Index simplex);

/** Whether an area or volume is below 1e-14 of the longest edge's square or cube, where cotangents cannot be computed. */
bool is_flat(const SimplexMesh& mesh, Index simplex);

/** For each vertex whether a simplex uses it. Indices must be in range. */
std::vector<char> used_vertices(const SimplexMesh& mesh);

/** The longest side of the box of all that simplices use. */
double longest_side(const SimplexMesh& mesh);

/** Checks that sizes fit, indices are in range, and that the vertices which simplices use are finite and span something; the others
 * may be anywhere. MESH_TOO_LARGE, MESH_TOO_FEW_VERTICES, MESH_NO_TRIANGLES, MESH_INDEX_OUT_OF_RANGE, MESH_NOT_FINITE or
 * MESH_ZERO_EXTENT. */
Result<Done> check_simplex_mesh(const SimplexMesh& mesh);

/** Checks that no simplex is flat. MESH_DEGENERATE. The mesh must have been checked. */
Result<Done> check_volumes(const SimplexMesh& mesh);

/** The number of each vertex's connected part, counted from 0 in the order of their first vertices; a vertex in no simplex is a
 * part of its own. */
Indices connected_parts(const SimplexMesh& mesh);

}  // namespace handlebody
