// Eigenvalues and eigenvectors of a small symmetric matrix, by Jacobi's rotations.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** a = V diag(λ) Vᵀ with V orthogonal: afterwards λ is on a's diagonal, in no order, and column k of `vectors` belongs to λₖ. Reads
 * all of a. About 10 n³ multiplications; for up to a few hundred rows. */
void symmetric_eigen(MatrixXd& a, MatrixXd& vectors);

}  // namespace handlebody
