// One-sided Jacobi rotations (Hestenes 1958) of a 3×3 matrix: its singular value decomposition, accurate for small singular values,
// and the eigenvectors of a positive semidefinite one.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** a·v = columns, with v orthogonal and the columns perpendicular to each other, the longest first. Their lengths are the singular
 *  values of a, and the columns of v the right singular vectors. */
struct OrthogonalColumns {
  Matrix3 columns, v;
};

OrthogonalColumns orthogonal_columns(const Matrix3& a);

}  // namespace handlebody
