// Bounded weights by sweeps of the alternating direction method (Boyd et al. 2011): soon near the least energy, but never at it.
// With z the projection of s to the rows with z ≥ 0 and Σ z = 1, a sweep is
//
//   x = argmin E(x) + ½ ‖x − (2z − s)‖²   in the metric ρD,     s ← s + α (x − z).
//
// This is Douglas–Rachford's form, over-relaxed by α = 1.6. One factorization of B + ρD serves all handles and all sweeps.
#pragma once

#include <memory>

#include "core/errors/result.hpp"
#include "core/numerics/sparse_cholesky.hpp"
#include "core/skinning/bounded_problem.hpp"

namespace handlebody {

class BoundedSweeps {
 public:
  /** `problem` must outlive them; `mass`: of all n vertices; `order`: of elimination, for B. OUT_OF_MEMORY, or SYSTEM_SINGULAR
   * where the matrix is not positive definite. */
  static Result<std::unique_ptr<BoundedSweeps>> create(BoundedProblem& problem, const Vector& mass, Indices order);

  void sweep();

  /** x of the last sweep, whose rows sum to 1 but which may be below 0. */
  const Matrix& x() const { return x_; }

  /** z of the next sweep: feasible, and 0 about where bounds hold. */
  Matrix projected() const;

  /** Multiplications that solving takes for one handle. */
  double solve_cost() const { return cholesky_->solve_cost(); }

 private:
  explicit BoundedSweeps(const BoundedProblem& problem) : problem_(&problem) {}

  const BoundedProblem* problem_;
  std::unique_ptr<SparseCholesky> cholesky_;  // of B + ρD
  Vector penalty_;                            // ρD
  Matrix s_, z_, x_;
};

}  // namespace handlebody
