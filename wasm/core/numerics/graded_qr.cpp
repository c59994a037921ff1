#include "core/numerics/graded_qr.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace handlebody {
namespace {

constexpr double rank_tolerance = 1e-10;
constexpr double least = 1e-300;  // its inverse is finite

}  // namespace

GradedQr::GradedQr(Index most_rows, Index columns)
    : a_(most_rows, columns),
      one_over_scale_(most_rows),
      tau_(columns),
      size_(columns),
      y_(most_rows),
      row_of_(most_rows),
      column_of_(columns) {}

void GradedQr::reset(Index rows) {
  rows_ = rows;
  rank_ = 0;
  std::iota(row_of_.begin(), row_of_.end(), 0u);
  std::iota(column_of_.begin(), column_of_.end(), 0u);
}

void GradedQr::set_row(Index row, double scale, const double* numbers) {
  one_over_scale_[row] = 1 / scale;
  for (Index j = 0; j < a_.cols(); ++j) a_(row, j) = scale * numbers[j];
}

bool GradedQr::extend(Index end) {
  for (Index j = rank_; j < end; ++j) {
    size_[j] = 0;
    for (Index i = 0; i < rows_; ++i) size_[j] = std::max(size_[j], std::abs(a_(i, j)) * one_over_scale_[i]);
    for (Index k = 0; k < rank_; ++k) reflect(k, &a_(0, j));
  }
  for (Index k = rank_; k < end; ++k) {
    Index row = k, column = k;
    double largest = 0;
    for (Index j = k; j < end; ++j)
      for (Index i = k; i < rows_; ++i)
        if (std::abs(a_(i, j)) > largest) largest = std::abs(a_(row = i, column = j));
    if (!(largest > least)) return false;
    swap_rows(row, k);
    swap_columns(column, k);
    if (!independent(k)) return false;

    // The norm from squares of quotients, which neither overflow nor vanish; the reflector has a leading 1.
    double* x = &a_(0, k);
    const double one_over_largest = 1 / largest;
    double squared = 0;
    for (Index i = k; i < rows_; ++i) squared += x[i] * one_over_largest * (x[i] * one_over_largest);
    const double norm = largest * std::sqrt(squared), image = x[k] > 0 ? -norm : norm;  // of the opposite sign: no cancellation
    const double one_over_first = 1 / (x[k] - image);
    for (Index i = k + 1; i < rows_; ++i) x[i] *= one_over_first;
    tau_[k] = 1 - x[k] / image;
    x[k] = image;
    for (Index j = k + 1; j < end; ++j) reflect(k, &a_(0, j));
  }
  rank_ = end;
  return true;
}

void GradedQr::solve_transposed(const double* b, double* x) {
  for (Index k = 0; k < rank_; ++k) {  // Rᵀ z = b
    double rest = b[column_of_[k]];
    for (Index j = 0; j < k; ++j) rest -= a_(j, k) * y_[j];
    y_[k] = rest / a_(k, k);
  }
  std::fill(y_.data() + rank_, y_.data() + rows_, 0.0);
  for (Index k = rank_; k-- > 0;) reflect(k, y_.data());
  for (Index i = 0; i < rows_; ++i) x[row_of_[i]] = y_[i];
}

/** x ← (I − τ v vᵀ) x */
void GradedQr::reflect(Index k, double* x) const {
  const double* v = a_.data() + k * a_.rows();
  double along = x[k];
  for (Index i = k + 1; i < rows_; ++i) along += v[i] * x[i];
  along *= tau_[k];
  x[k] -= along;
  for (Index i = k + 1; i < rows_; ++i) x[i] -= along * v[i];
}

/** Swaps the rows of reflectors too, as if they had been in this order from the start. */
void GradedQr::swap_rows(Index i, Index k) {
  if (i == k) return;
  for (Index j = 0; j < a_.cols(); ++j) std::swap(a_(i, j), a_(k, j));
  std::swap(one_over_scale_[i], one_over_scale_[k]);
  std::swap(row_of_[i], row_of_[k]);
}

void GradedQr::swap_columns(Index j, Index k) {
  if (j == k) return;
  for (Index i = 0; i < rows_; ++i) std::swap(a_(i, j), a_(i, k));
  std::swap(size_[j], size_[k]);
  std::swap(column_of_[j], column_of_[k]);
}

bool GradedQr::independent(Index column) const {
  for (Index i = column; i < rows_; ++i)
    if (std::abs(a_(i, column)) * one_over_scale_[i] > rank_tolerance * size_[column]) return true;
  return false;
}

}  // namespace handlebody
