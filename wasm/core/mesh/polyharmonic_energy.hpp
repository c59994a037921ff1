// The energies whose minimizers are skinning weights and smooth deformations (Botsch & Kobbelt 2004, Jacobson et al. 2010).
#pragma once

#include "core/errors/result.hpp"
#include "core/mesh/simplex_mesh.hpp"
#include "core/numerics/sparse.hpp"

namespace handlebody {

/** Q with fᵀ Q f = ∫|∇f|², ∫(Δf)² or ∫|∇Δf|² for the order 1, 2 or 3:
 *
 *    Q = (L M⁻¹)^(order − 1) L
 *
 * n×n and symmetric but for rounding, from the cotangent Laplacian L and the vertices' masses M. A vertex without mass, which is in
 * no simplex, has a row of zeros. OUT_OF_MEMORY, before anything is allocated, where Q might have 2³¹ entries or more, as with a
 * vertex of some 50,000 neighbors. */
Result<SparseMatrix> polyharmonic_energy(const SparseMatrix& laplacian, const Vector& mass, int order);

/** That of a mesh with these masses, where no simplex is thinner than `thinnest`: its area or volume counts as that part of its
 * longest edge's square or cube at least. Products of the cotangents of thinner ones drown all others in rounding. The mesh must
 * have been checked. */
Result<SparseMatrix> polyharmonic_energy(const SimplexMesh& mesh, const Vector& mass, int order, double thinnest);

/** The next `thinnest` to try where that one loses too much to rounding; 0 where thin simplices cannot be the reason. `of_mesh` is
 * the area or volume of the mesh's thinnest simplex, as a part of its longest edge's square or cube. */
double thicker(double thinnest, int order, double of_mesh);
double thinnest_simplex(const SimplexMesh& mesh);

}  // namespace handlebody
