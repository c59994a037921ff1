// Dense linear algebra of the solver, on column-major matrices. Everything is made of one operation, a linear combination of
// columns, so that the whole file is one hot loop: a tenth of the code of Eigen's blocked products and factorizations, at their
// speed for the few hundred rows at hand.
#pragma once

#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

/** Three columns x, y, z, each contiguous. */
using Columns3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/** out = a·x. `out` must have its size; allocates nothing. */
void multiply(const MatrixXd& a, const Columns3& x, Columns3& out);
void multiply(const MatrixXd& a, const Vector& x, Eigen::Ref<Vector> out);

/** The same for a symmetric matrix, of which only the lower triangle is read: half the memory, which is what takes the time. */
void multiply_symmetric(const MatrixXd& lower, const Columns3& x, Columns3& out);

MatrixXd product(const MatrixXd& a, const MatrixXd& b);

/** a += bᵀ b, of which only the lower triangle is written. */
void add_gram(const MatrixXd& b, MatrixXd& a);

/** The Cholesky factor L of a = L Lᵀ over a's lower triangle, which is all that is read. False where a is not positive definite. */
bool factor_cholesky(MatrixXd& a);

/** b ← b (L Lᵀ)⁻¹: solves from the right. */
void solve_cholesky(const MatrixXd& factor, MatrixXd& b);

/** x ← (L Lᵀ)⁻¹ x for one vector. */
void solve_cholesky(const MatrixXd& factor, Vector& x);

/** P a = L U over a, with partial pivoting: row i was swapped with row `pivots[i]`, in that order. Singular matrices pass, and give
 *  numbers that are not finite later on. */
void factor_lu(MatrixXd& a, std::vector<Index>& pivots);

/** b ← b a⁻¹ from a's factor: solves from the right. */
void solve_lu(const MatrixXd& factor, const std::vector<Index>& pivots, MatrixXd& b);

/** x ← a⁻¹ x from a's factor, for one vector: solves from the left. */
void solve_lu(const MatrixXd& factor, const std::vector<Index>& pivots, double* x);

}  // namespace handlebody
