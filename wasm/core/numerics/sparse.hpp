// The core's sparse matrices are Eigen's, row-major: assembled from triplets (`setFromTriplets`, which adds up the entries of one
// place in the order in which they come), or row by row (`startVec`, `insertBack`) where entries come in order; multiplied by `*`.
// Row-major, because the product with a dense matrix, which is row-major too, then runs along the rows of both.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

/** Compressed, column indices ascending in each row. Eigen's move copies; swap() does not. Fewer than 2³¹ entries: whoever makes a
 * matrix must ensure that. */
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;
using Triplet = Eigen::Triplet<double, std::int32_t>;

}  // namespace handlebody
