// Square sparse matrices by rows, as the operators of a mesh are made, multiplied and factored.
#pragma once

#include <cstdint>
#include <vector>

#include "core/numerics/indices.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** Row i's entries are columns[starts[i]] … columns[starts[i + 1] − 1], ascending, each with its value. */
struct SparseMatrix {
  Indices starts{0}, columns;
  std::vector<double> values;

  Index rows() const { return std::ssize(starts) - 1; }

  /** out = A x of row-major x, rows() × `width`. Allocates nothing. */
  void multiply(const double* x, Index width, double* out) const;

  /** (A x)ᵢ of a vector. */
  double row_times(Index row, const double* x) const;

  double diagonal(Index row) const;
};

/** Entries of a matrix in any order; those at one place are added up, in the order in which they were put. */
class SparseEntries {
 public:
  explicit SparseEntries(Index rows) : rows_(rows) {}

  void reserve(std::size_t count);
  void put(std::uint32_t row, std::uint32_t column, double value);
  SparseMatrix matrix() const;

 private:
  Index rows_;
  Indices row_of_, column_of_;
  std::vector<double> values_;
};

/** A diag(d) B for symmetric A and B whose product is symmetric too, as powers of one operator are. */
SparseMatrix symmetric_product(const SparseMatrix& a, const Vector& d, const SparseMatrix& b);

/** The rows and columns i of a symmetric A that have a number below `count`, at that number: a permutation where all have one. */
SparseMatrix submatrix(const SparseMatrix& a, const Indices& number_of, Index count);

}  // namespace handlebody
