// Least ½ uᵀ Q u − uᵀ f over the vertices that nothing holds, given u at those that are held: factored once, solved every frame.
#pragma once

#include <memory>
#include <vector>

#include "core/numerics/sparse_cholesky.hpp"

namespace handlebody {

class FreeRows {
 public:
  /** `q` symmetric, of n vertices: with 1 row a vertex its two coordinates are unknowns of the same equations, with 2 rows x and y
   * have their own. A vertex is free where `owner_of` is `no_index`. Fails with OUT_OF_MEMORY, or with SYSTEM_SINGULAR where q does
   * not determine the free ones. */
  static Result<std::unique_ptr<FreeRows>> create(SparseMatrix q, const Indices& owner_of, Index rows_per_vertex);

  /** Gives the free rows of u (n×2) their values, whatever they were, under forces f (n×2) or none. Returns the largest change of a
   * number. Allocates nothing. */
  double solve(const double* f, double* u);

  /** ½ uᵀ Q u. Allocates nothing. */
  double energy(const double* u);

 private:
  FreeRows() = default;

  SparseMatrix q_;
  Index width_ = 2;  // numbers of u a row of q
  Indices rows_;     // that are free
  std::unique_ptr<SparseCholesky> cholesky_;
  std::vector<double> product_, right_;
};

}  // namespace handlebody
