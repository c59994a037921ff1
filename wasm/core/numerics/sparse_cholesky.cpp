#include "core/numerics/sparse_cholesky.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <limits>
#include <utility>

namespace handlebody {

namespace {

constexpr double entry_bytes = sizeof(double) + sizeof(std::uint32_t);
constexpr int together = 8;     // columns solved at once
constexpr int most_merged = 4;  // columns of L taken at once

template <int width>
void subtract(double* y, const std::uint32_t* below, std::uint32_t count, const double* const* columns, const double* values) {
  for (std::uint32_t e = 0; e < count; ++e) {
    double sum = 0;
    for (int c = 0; c < width; ++c) sum += columns[c][e] * values[c];
    y[below[e]] -= sum;
  }
}

}  // namespace

Indices minimum_degree_order(const SparseMatrix& a) {
  const Index n = a.rows();
  Eigen::SparseMatrix<char, Eigen::ColMajor, std::int32_t> pattern(n, n);  // without A's numbers, which do not matter
  pattern.resizeNonZeros(a.nonZeros());
  std::copy_n(a.outerIndexPtr(), n + 1, pattern.outerIndexPtr());
  std::copy_n(a.innerIndexPtr(), a.nonZeros(), pattern.innerIndexPtr());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, std::int32_t> order;
  Eigen::internal::minimum_degree_ordering(pattern, order);
  return {order.indices().data(), order.indices().data() + n};
}

Result<std::unique_ptr<SparseCholesky>> SparseCholesky::analyze(const SparseMatrix& a) {
  return analyze(a, minimum_degree_order(a));
}

Result<std::unique_ptr<SparseCholesky>> SparseCholesky::analyze(const SparseMatrix& a, Indices order, double most_bytes) {
  std::unique_ptr<SparseCholesky> made(new SparseCholesky);
  SparseCholesky& result = *made;
  const auto n = static_cast<std::size_t>(a.rows());
  result.order_ = std::move(order);
  result.place_.resize(n);
  for (std::size_t k = 0; k < n; ++k) result.place_[result.order_[k]] = static_cast<std::uint32_t>(k);

  // Row k of L has an entry wherever the tree leads from an entry of A's row k up to k.
  Indices &parent = result.parent_, counts(n, 0), seen(n, no_index);
  parent.assign(n, no_index);
  for (std::uint32_t k = 0; k < n; ++k) {
    seen[k] = k;
    for (SparseMatrix::InnerIterator entry(a, result.order_[k]); entry; ++entry) {
      std::uint32_t i = result.place_[entry.col()];
      if (i > k) continue;
      for (; seen[i] != k; i = parent[i]) {
        if (parent[i] == no_index) parent[i] = k;
        ++counts[i];
        seen[i] = k;
      }
    }
  }

  double entries = 0;
  for (const std::uint32_t count : counts) {
    entries += count;
    result.factor_cost_ += (count + 1.0) * (count + 1.0);
  }
  if (entries * entry_bytes > most_bytes) {
    return Error(HB_ERROR_OUT_OF_MEMORY, {"The factor of ", n, " equations would take ", entries * entry_bytes / 1048576, " MiB."},
                 {"Use a coarser mesh."});
  }
  result.starts_.assign(n + 1, 0);
  for (std::size_t k = 0; k < n; ++k) result.starts_[k + 1] = result.starts_[k] + counts[k];
  result.below_.resize(result.starts_.back());
  result.factor_.resize(result.starts_.back());
  result.pivots_.resize(n);
  result.merges_.resize(n);
  for (std::size_t k = 1; k < n; ++k) result.merges_[k] = parent[k - 1] == k && counts[k - 1] == counts[k] + 1;
  result.work_.resize(n * together);
  return made;
}

bool SparseCholesky::factor(const SparseMatrix& a) {
  row_ = 0;
  return factor_part(a, std::numeric_limits<double>::infinity()) > 0;
}

double SparseCholesky::factor_part(const SparseMatrix& a, double multiplications) {
  const auto n = static_cast<std::uint32_t>(order_.size());
  if (row_ == 0) {
    filled_.assign(starts_.begin(), starts_.end() - 1);
    seen_.assign(n, no_index);
    path_.resize(n);
    done_ = 0;
    std::fill(work_.begin(), work_.begin() + n, 0.0);
  }
  Indices &filled = filled_, &seen = seen_, &path = path_;
  double *const y = work_.data(), *const inverse = y + n;
  const double enough = done_ + multiplications;
  for (std::uint32_t k = row_; k < n; ++k) {
    if (done_ >= enough) {
      row_ = k;
      return std::min(2 * done_ / factor_cost_, 0.999);
    }
    // The entries of row k, each before those that it changes: paths of the elimination tree, the path found last comes first.
    std::uint32_t top = n;
    double diagonal = 0;
    seen[k] = k;
    for (SparseMatrix::InnerIterator entry(a, order_[k]); entry; ++entry) {
      std::uint32_t i = place_[entry.col()];
      if (i > k) continue;
      if (i == k) {
        diagonal = entry.value();
        continue;
      }
      y[i] = entry.value();
      std::uint32_t length = 0;
      for (; seen[i] != k; i = parent_[i]) {
        path[length++] = i;
        seen[i] = k;
      }
      while (length > 0) path[--top] = path[--length];
    }
    double pivot = diagonal;
    while (top < n) {
      // Successive columns with the same pattern are processed together: a fourth of the indices to read, and of y to write.
      const std::uint32_t first = path[top];
      int width = 1;
      while (width < most_merged && top + width < n && path[top + width] == first + width && merges_[first + width]) ++width;
      double values[most_merged];
      const double* columns[most_merged];
      for (int c = 0; c < width; ++c) {
        const std::uint32_t i = first + static_cast<std::uint32_t>(c);
        const double value = values[c] = y[i], entry = value * inverse[i];
        y[i] = 0;
        columns[c] = &factor_[starts_[i]];
        for (int later = c + 1; later < width; ++later) y[first + later] -= *columns[c]++ * value;
        pivot -= entry * value;
        below_[filled[i]] = k;
        factor_[filled[i]++] = entry;
      }
      const std::uint32_t last = first + static_cast<std::uint32_t>(width) - 1;
      const std::uint32_t* const below = &below_[starts_[last]];
      const std::uint32_t count = filled[last] - 1 - starts_[last];
      if (width == 4)
        subtract<4>(y, below, count, columns, values);
      else if (width == 3)
        subtract<3>(y, below, count, columns, values);
      else if (width == 2)
        subtract<2>(y, below, count, columns, values);
      else
        subtract<1>(y, below, count, columns, values);
      top += static_cast<std::uint32_t>(width);
      done_ += static_cast<double>(width) * (count + 1.0);
    }
    if (!(pivot > 1e-15 * diagonal)) {
      row_ = 0;
      return -1;
    }
    pivots_[k] = pivot;
    inverse[k] = 1 / pivot;
  }
  row_ = 0;
  return 1;
}

template <int width>
void SparseCholesky::solve_columns(double* x, Index stride, int count) {
  const std::size_t n = order_.size();
  double* const y = work_.data();
  std::fill(work_.begin(), work_.begin() + static_cast<std::ptrdiff_t>(n * width), 0.0);
  for (std::size_t k = 0; k < n; ++k)
    for (int j = 0; j < count; ++j) y[k * width + static_cast<std::size_t>(j)] = x[order_[k] * stride + j];
  const std::uint32_t* const below = below_.data();
  const double* const factor = factor_.data();
  for (std::size_t k = 0; k < n; ++k) {
    double own[width];
    for (int j = 0; j < width; ++j) own[j] = y[k * width + static_cast<std::size_t>(j)];
    for (std::uint32_t e = starts_[k]; e < starts_[k + 1]; ++e) {
      double* const other = y + below[e] * width;
      for (int j = 0; j < width; ++j) other[j] -= factor[e] * own[j];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    double own[width];
    for (int j = 0; j < width; ++j) own[j] = y[k * width + static_cast<std::size_t>(j)] / pivots_[k];
    for (std::uint32_t e = starts_[k]; e < starts_[k + 1]; ++e) {
      const double* const other = y + below[e] * width;
      for (int j = 0; j < width; ++j) own[j] -= factor[e] * other[j];
    }
    for (int j = 0; j < width; ++j) y[k * width + static_cast<std::size_t>(j)] = own[j];
  }
  for (std::size_t k = 0; k < n; ++k)
    for (int j = 0; j < count; ++j) x[order_[k] * stride + j] = y[k * width + static_cast<std::size_t>(j)];
}

void SparseCholesky::solve(double* x, Index width) {
  if (width == 1) return solve_columns<1>(x, 1, 1);
  if (width == 2) return solve_columns<2>(x, 2, 2);  // a deformation's frame in the plane
  for (Index done = 0; done < width; done += together)
    solve_columns<together>(x + done, width, static_cast<int>(std::min<Index>(together, width - done)));
}

}  // namespace handlebody
