// Products of dense matrices of any size, by Eigen, compiled once and for speed: files that are compiled for size call these.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

using ConstMatrixRef = Eigen::Ref<const MatrixXd>;
using ConstVectorRef = Eigen::Ref<const Vector>;

/** A B (m×n) for A m×k and B k×n; Aᵀ B (k×n) for A m×k and B m×n. */
MatrixXd product(const ConstMatrixRef& a, const ConstMatrixRef& b);
MatrixXd transposed_product(const ConstMatrixRef& a, const ConstMatrixRef& b);

/** out = A x. Allocates nothing. */
void multiply(const ConstMatrixRef& a, const ConstVectorRef& x, Eigen::Ref<Vector> out);

}  // namespace handlebody
