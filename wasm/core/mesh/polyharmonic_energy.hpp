// The energies whose minimizers are skinning weights and smooth deformations (Botsch & Kobbelt 2004, Jacobson et al. 2010).
#pragma once

#include "core/errors/result.hpp"
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

}  // namespace handlebody
