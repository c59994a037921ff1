// A = L D Lᵀ of a sparse, symmetric, positive definite matrix: factored once, solved many times.
//
// Rows are put in approximate minimum degree order (Amestoy, Davis & Duff 1996), by Eigen. The elimination tree gives the size of a
// factor before any of it is allocated (Liu 1990); factoring goes row by row (Davis 2005).
//
// Why not Eigen's SimplicialLDLT, against which this is tested: it takes 2.5 to 3 times as long to factor, solves columns one by
// one, reading the factor once for each, cannot be interrupted and resumed, and allocates before its size is known.
#pragma once

#include <memory>
#include <vector>

#include "core/errors/result.hpp"
#include "core/numerics/indices.hpp"
#include "core/numerics/sparse.hpp"

namespace handlebody {

/** The order in which a symmetric matrix is eliminated with little fill. Restricted to a submatrix, it is still a good order. */
Indices minimum_degree_order(const SparseMatrix& a);

class SparseCholesky {
 public:
  /** Orders the rows of a symmetric matrix, all of whose entries are stored, and finds the pattern of its factor. Fails with
   * OUT_OF_MEMORY where the factor would take more than 1.5 GiB, and says how much. */
  static Result<std::unique_ptr<SparseCholesky>> analyze(const SparseMatrix& a);

  /** The same in a given order (row order[0] is eliminated first) and with a given limit, for a caller that holds several factors.
   */
  static Result<std::unique_ptr<SparseCholesky>> analyze(const SparseMatrix& a, Indices order, double most_bytes = 1.5 * (1 << 30));

  /** Factors a matrix with the pattern that was analyzed. False, and no factor, where it is not positive definite to working
   * precision. */
  bool factor(const SparseMatrix& a);

  /** The same in parts of about `multiplications` each: returns the fraction done, 1 when the factor is ready, or a negative number
   * where `a` is not positive definite. Do not call solve() before it is ready. The call after the last part starts anew. */
  double factor_part(const SparseMatrix& a, double multiplications);

  /** x ← A⁻¹ x, rows() × `width`, row-major: columns are solved together. Not after factor() returned false. */
  void solve(double* x, Index width = 1);

  Index rows() const { return std::ssize(order_); }

  /** Multiplications for a factorization, and for solving one column. */
  double factor_cost() const { return factor_cost_; }
  double solve_cost() const { return 2.0 * static_cast<double>(starts_.back()); }

 private:
  SparseCholesky() = default;

  /** Solves for columns 0 to `count` − 1, count ≤ width, of rows that are `stride` numbers apart. */
  template <int width>
  void solve_columns(double* x, Index stride, int count);

  Indices order_, place_;   // order_[k]: the row that is eliminated as number k; place_ is its inverse
  Indices parent_;          // elimination tree, of places
  Indices starts_, below_;  // L by columns: the places below the diagonal
  std::vector<double> factor_, pivots_;
  std::vector<unsigned char> merges_;  // column k has the pattern of column k − 1, without k itself
  std::vector<double> work_;
  double factor_cost_ = 0;

  // The state of an unfinished factorization: next row, entries of each column so far, marks and a stack, multiplications done.
  std::uint32_t row_ = 0;
  Indices filled_, seen_, path_;
  double done_ = 0;
};

}  // namespace handlebody
