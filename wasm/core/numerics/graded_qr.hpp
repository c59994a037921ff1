// QR factorization of a tall matrix whose rows differ by many orders of magnitude, as those of weighted least squares do near a
// singular weight: Householder's method with row and column pivoting, which leaves every row an error in proportion to its own size
// (Powell and Reid 1969; Cox and Higham 1998). Columns are factored in blocks, so that a block that turns out to depend on the
// former ones can be left out. One object factors many matrices without allocating. Eigen's QR with column pivoting exchanges no
// rows, so that a large row that comes late spoils the small ones above it; and it factors all columns or none.
#pragma once

#include "core/numerics/indices.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class GradedQr {
 public:
  GradedQr(Index most_rows, Index columns);

  /** Begins another matrix A of `rows` rows. All of them must then be set, each to scale · numbers (one per column); `scale` is the
   * overall size of the row and above 1e-250. */
  void reset(Index rows);
  void set_row(Index row, double scale, const double* numbers);

  /** Factors the columns up to `end`, in any order among themselves. False, and none is factored, where one depends on the others
   *  to 1e-10: where nothing left of it, divided by the rows' scales, exceeds that part of its largest element. */
  bool extend(Index end);

  Index rows() const { return rows_; }
  Index rank() const { return rank_; }  // columns factored

  /** x (rows): the shortest of all solutions of Aᵀx = b, for the first rank() columns of A. */
  void solve_transposed(const double* b, double* x);

 private:
  void reflect(Index k, double* x) const;
  void swap_rows(Index i, Index k);
  void swap_columns(Index j, Index k);
  bool independent(Index column) const;

  MatrixXd a_;  // on and above the diagonal R, below it the reflectors 1, v₁, v₂ …
  Vector one_over_scale_, tau_, size_, y_;
  Indices row_of_, column_of_;  // the caller's row and column numbers
  Index rows_ = 0, rank_ = 0;
};

}  // namespace handlebody
