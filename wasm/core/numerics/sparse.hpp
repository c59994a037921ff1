// The core's sparse matrices are Eigen's, by rows: assembled from triplets (`setFromTriplets`, which adds up the entries of one
// place in the order in which they come), or row by row (`startVec`, `insertBack`) where entries come in order; multiplied by `*`.
// By rows, because the product with a dense matrix, also by rows, then runs along the rows of both.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

/** Compressed, column indices ascending in each row. Eigen copies where it is moved from: swap() does not. Less than 2³¹ entries:
 * who makes one sees to that. */
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;
using Triplet = Eigen::Triplet<double, std::int32_t>;

}  // namespace handlebody
