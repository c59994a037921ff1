// Products of dense matrices of any size, by Eigen, compiled once and for speed: files that are compiled for size call these.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

using ConstMatrixRef = Eigen::Ref<const MatrixXd>;
using ConstVectorRef = Eigen::Ref<const Vector>;

/** A B (m×n) and Aᵀ B (k×n), for A m×k (or m×k transposed: m×k with B m×n) and B. */
MatrixXd product(const ConstMatrixRef& a, const ConstMatrixRef& b);
MatrixXd transposed_product(const ConstMatrixRef& a, const ConstMatrixRef& b);

/** out = A x. Allocates nothing. */
void multiply(const ConstMatrixRef& a, const ConstVectorRef& x, Eigen::Ref<Vector> out);

}  // namespace handlebody
