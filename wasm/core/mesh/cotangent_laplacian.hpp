// The Laplacian of linear finite elements (Pinkall & Polthier 1993), in its positive semidefinite form.
#pragma once

#include "core/mesh/simplex_mesh.hpp"
#include "core/numerics/sparse.hpp"

namespace handlebody {

/** C, n×n and symmetric, with fᵀ C f = ∫ |∇f|² for functions that are linear on each simplex: on triangles Cᵢⱼ = −(cot αᵢⱼ + cot
 * βᵢⱼ)/2 of the angles opposite the edge, and rows sum to 0. The negative of the lecture's C and of libigl's `cotmatrix`. No units
 * in 2D; a length on tetrahedra. The mesh must have been checked. A simplex is taken for as thick as `thinnest` times the square or
 * cube of its longest edge at least, which bounds its cotangents. */
SparseMatrix cotangent_laplacian(const SimplexMesh& mesh, double thinnest = 0);

}  // namespace handlebody
