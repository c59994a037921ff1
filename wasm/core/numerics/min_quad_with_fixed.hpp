// Minimizes ½ uᵀ Q u − fᵀ u where some unknowns are fixed: factored once, solved for many f and fixed values (libigl's
// min_quad_with_fixed). With u_f the free unknowns and u_p the fixed ones,
//
//   Q_ff u_f = f_f − Q_fp u_p.
#pragma once

#include <memory>

#include "core/errors/result.hpp"
#include "core/numerics/sparse_cholesky.hpp"

namespace handlebody {

/** The rows of Q that belong to free unknowns. */
struct FreeRows {
  SparseMatrix among_free;  // Q_ff, m×m
  SparseMatrix to_fixed;    // Q_fp, m×n: columns keep their indices, those of free unknowns are empty
};

/** `free` lists m of Q's n unknowns in ascending order. Forming Q_ff as Sᵀ Q S, S made of columns of the identity, takes 5 times as
 * long: a fifth of the time to factor it (the bi-Laplacian of 2,300 vertices), which counts where active sets change. */
FreeRows free_rows(const SparseMatrix& q, const Indices& free);

class MinQuadWithFixed {
 public:
  struct Options {
    Index columns = 1;  // of u, for which memory is allocated in advance
    Indices order;      // of elimination: positions in `free`, all of them; minimum degree where it is empty
  };

  /** Factors Q_ff. `q` is symmetric, n×n, with all its entries stored; `free` lists the unknowns that are not fixed in ascending
   * order. OUT_OF_MEMORY. */
  static Result<std::unique_ptr<MinQuadWithFixed>> create(const SparseMatrix& q, Indices free, Options options);

  /** False where Q_ff is not positive definite to working precision. Nothing but free() may be called then. */
  bool succeeded() const { return succeeded_; }

  const Indices& free() const { return free_; }

  /** Computes the free rows of u (n×k) from its fixed ones, for f (n×k), whose fixed rows do not matter, or for f = 0. Returns the
   * largest change of a number of u. Allocates nothing where k is what it was before. */
  double solve(Eigen::Ref<Matrix> u);
  double solve(const Eigen::Ref<const Matrix>& f, Eigen::Ref<Matrix> u);

  /** Multiplications for factoring, and for solving one column. */
  double factor_cost() const { return cholesky_->factor_cost(); }
  double solve_cost() const { return cholesky_->solve_cost(); }

 private:
  MinQuadWithFixed() = default;

  /** The rest of solve(), once `right_` holds f_f. */
  double finish(Eigen::Ref<Matrix>& u);

  Indices free_;
  SparseMatrix to_fixed_;  // Q_fp
  std::unique_ptr<SparseCholesky> cholesky_;
  Matrix right_;  // m×k: right-hand sides, then solutions
  bool succeeded_ = false;
};

}  // namespace handlebody
