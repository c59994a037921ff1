#include "core/numerics/sparse_matrix.hpp"

#include <algorithm>

namespace handlebody {

namespace {

/** Turns counts at i + 1 into starts. */
void accumulate(Indices& starts) {
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
}

/** Aᵀ, with its rows in order whatever A's were. */
SparseMatrix transposed(const SparseMatrix& a) {
  const auto n = static_cast<std::size_t>(a.rows());
  SparseMatrix result;
  result.starts.assign(n + 1, 0);
  result.columns.resize(a.columns.size());
  result.values.resize(a.values.size());
  for (const std::uint32_t column : a.columns) ++result.starts[column + 1];
  accumulate(result.starts);
  Indices next(result.starts.begin(), result.starts.end() - 1);
  for (std::size_t row = 0; row < n; ++row) {
    for (std::uint32_t k = a.starts[row]; k < a.starts[row + 1]; ++k) {
      const std::uint32_t to = next[a.columns[k]]++;
      result.columns[to] = static_cast<std::uint32_t>(row);
      result.values[to] = a.values[k];
    }
  }
  return result;
}

}  // namespace

void SparseMatrix::multiply(const double* x, Index width, double* out) const {
  const Index n = rows();
  std::fill(out, out + n * width, 0.0);
  for (Index row = 0; row < n; ++row, out += width) {
    for (std::uint32_t k = starts[row]; k < starts[static_cast<std::size_t>(row) + 1]; ++k) {
      const double value = values[k];
      const double* from = x + columns[k] * width;
      for (Index j = 0; j < width; ++j) out[j] += value * from[j];
    }
  }
}

double SparseMatrix::row_times(Index row, const double* x) const {
  double sum = 0;
  for (std::uint32_t k = starts[row]; k < starts[static_cast<std::size_t>(row) + 1]; ++k) sum += values[k] * x[columns[k]];
  return sum;
}

double SparseMatrix::diagonal(Index row) const {
  for (std::uint32_t k = starts[row]; k < starts[static_cast<std::size_t>(row) + 1]; ++k)
    if (columns[k] == static_cast<std::uint32_t>(row)) return values[k];
  return 0;
}

void SparseEntries::reserve(std::size_t count) {
  row_of_.reserve(count);
  column_of_.reserve(count);
  values_.reserve(count);
}

void SparseEntries::put(std::uint32_t row, std::uint32_t column, double value) {
  row_of_.push_back(row);
  column_of_.push_back(column);
  values_.push_back(value);
}

SparseMatrix SparseEntries::matrix() const {
  const auto n = static_cast<std::size_t>(rows_);
  SparseMatrix rows;
  rows.starts.assign(n + 1, 0);
  rows.columns.resize(values_.size());
  rows.values.resize(values_.size());
  for (const std::uint32_t row : row_of_) ++rows.starts[row + 1];
  accumulate(rows.starts);
  Indices next(rows.starts.begin(), rows.starts.end() - 1);
  for (std::size_t k = 0; k < values_.size(); ++k) {
    const std::uint32_t to = next[row_of_[k]]++;
    rows.columns[to] = column_of_[k];
    rows.values[to] = values_[k];
  }
  rows = transposed(transposed(rows));  // sorts each row, and keeps the order of equal places

  SparseMatrix result;
  result.starts.assign(1, 0);
  result.starts.reserve(n + 1);
  for (std::size_t row = 0; row < n; ++row) {
    for (std::uint32_t k = rows.starts[row]; k < rows.starts[row + 1]; ++k) {
      if (result.columns.size() > result.starts.back() && result.columns.back() == rows.columns[k]) {
        result.values.back() += rows.values[k];
      } else {
        result.columns.push_back(rows.columns[k]);
        result.values.push_back(rows.values[k]);
      }
    }
    result.starts.push_back(static_cast<std::uint32_t>(result.columns.size()));
  }
  return result;
}

SparseMatrix symmetric_product(const SparseMatrix& a, const Vector& d, const SparseMatrix& b) {
  const auto n = static_cast<std::size_t>(a.rows());
  SparseMatrix product;
  product.starts.reserve(n + 1);
  Indices place(n, no_index);  // of a column in the row that is being made
  for (std::size_t row = 0; row < n; ++row) {
    const auto first = static_cast<std::uint32_t>(product.columns.size());
    for (std::uint32_t k = a.starts[row]; k < a.starts[row + 1]; ++k) {
      const std::uint32_t middle = a.columns[k];
      const double factor = a.values[k] * d[middle];
      for (std::uint32_t m = b.starts[middle]; m < b.starts[middle + 1]; ++m) {
        const std::uint32_t column = b.columns[m];
        if (place[column] == no_index || place[column] < first) {
          place[column] = static_cast<std::uint32_t>(product.columns.size());
          product.columns.push_back(column);
          product.values.push_back(factor * b.values[m]);
        } else {
          product.values[place[column]] += factor * b.values[m];
        }
      }
    }
    product.starts.push_back(static_cast<std::uint32_t>(product.columns.size()));
  }
  return transposed(product);  // its own transpose, but in order
}

SparseMatrix submatrix(const SparseMatrix& a, const Indices& number_of, Index count) {
  const auto size = static_cast<std::uint32_t>(count);
  Indices row_of(size);
  bool in_order = true;
  for (std::uint32_t row = 0, last = 0; row < number_of.size(); ++row) {
    if (number_of[row] >= size) continue;
    row_of[number_of[row]] = row;
    in_order = in_order && number_of[row] >= last;
    last = number_of[row];
  }
  SparseMatrix result;
  result.starts.reserve(row_of.size() + 1);
  for (const std::uint32_t row : row_of) {
    for (std::uint32_t k = a.starts[row]; k < a.starts[row + 1]; ++k) {
      const std::uint32_t column = number_of[a.columns[k]];
      if (column >= size) continue;
      result.columns.push_back(column);
      result.values.push_back(a.values[k]);
    }
    result.starts.push_back(static_cast<std::uint32_t>(result.columns.size()));
  }
  return in_order ? result : transposed(result);
}

}  // namespace handlebody
