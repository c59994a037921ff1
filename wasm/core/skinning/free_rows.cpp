#include "core/skinning/free_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace handlebody {

Result<std::unique_ptr<FreeRows>> FreeRows::create(SparseMatrix q, const Indices& owner_of, Index rows_per_vertex) {
  std::unique_ptr<FreeRows> made(new FreeRows);
  FreeRows& result = *made;
  result.width_ = 2 / rows_per_vertex;
  Indices number_of(q.rows(), no_index);
  for (std::size_t row = 0; row < number_of.size(); ++row) {
    if (owner_of[row / static_cast<std::size_t>(rows_per_vertex)] != no_index) continue;
    number_of[row] = static_cast<std::uint32_t>(result.rows_.size());
    result.rows_.push_back(static_cast<std::uint32_t>(row));
  }
  const SparseMatrix among_free = submatrix(q, number_of, std::ssize(result.rows_));
  auto analyzed = SparseCholesky::analyze(among_free);
  if (!analyzed) return analyzed.error();
  result.cholesky_ = std::move(*analyzed);
  if (!result.cholesky_->factor(among_free)) {
    return Error(HB_ERROR_SYSTEM_SINGULAR,
                 {"The handles do not determine the shape: some triangles are too thin, or hang on one vertex only."},
                 {"Improve the mesh, or hold more of it."});
  }
  result.product_.resize(owner_of.size() * 2);
  result.right_.resize(result.rows_.size() * static_cast<std::size_t>(result.width_));
  result.q_ = std::move(q);
  return made;
}

double FreeRows::solve(const double* f, double* u) {
  q_.multiply(u, width_, product_.data());
  double* right = right_.data();
  for (const std::uint32_t row : rows_)
    for (Index k = row * width_; k < (row + 1) * width_; ++k) *right++ = (f ? f[k] : 0) - product_[k];
  cholesky_->solve(right_.data(), width_);
  right = right_.data();
  double largest = 0;
  for (const std::uint32_t row : rows_)
    for (Index k = row * width_; k < (row + 1) * width_; ++k) {
      largest = std::max(largest, std::abs(*right));
      u[k] += *right++;
    }
  return largest;
}

double FreeRows::energy(const double* u) {
  q_.multiply(u, width_, product_.data());
  double sum = 0;
  for (std::size_t k = 0; k < product_.size(); ++k) sum += u[k] * product_[k];
  return sum / 2;
}

}  // namespace handlebody
