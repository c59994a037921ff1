#include "core/numerics/min_quad_with_fixed.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace handlebody {

FreeRows free_rows(const SparseMatrix& q, const Indices& free) {
  Indices position(q.cols(), no_index);
  Index entries = 0;
  for (std::size_t k = 0; k < free.size(); ++k) {
    position[free[k]] = static_cast<std::uint32_t>(k);
    entries += q.outerIndexPtr()[free[k] + 1] - q.outerIndexPtr()[free[k]];
  }
  const Index m = std::ssize(free);
  FreeRows rows{SparseMatrix(m, m), SparseMatrix(m, q.cols())};
  rows.among_free.reserve(entries);
  for (Index k = 0; k < m; ++k) {
    rows.among_free.startVec(k);
    rows.to_fixed.startVec(k);
    for (SparseMatrix::InnerIterator entry(q, free[k]); entry; ++entry) {
      const std::uint32_t to = position[entry.col()];
      if (to == no_index)
        rows.to_fixed.insertBack(k, entry.col()) = entry.value();
      else
        rows.among_free.insertBack(k, to) = entry.value();
    }
  }
  rows.among_free.finalize();
  rows.to_fixed.finalize();
  return rows;
}

Result<std::unique_ptr<MinQuadWithFixed>> MinQuadWithFixed::create(const SparseMatrix& q, Indices free, Options options) {
  std::unique_ptr<MinQuadWithFixed> made(new MinQuadWithFixed);
  FreeRows rows = free_rows(q, free);
  auto analyzed = options.order.empty() ? SparseCholesky::analyze(rows.among_free)
                                        : SparseCholesky::analyze(rows.among_free, std::move(options.order));
  if (!analyzed) return analyzed.error();
  made->cholesky_ = std::move(*analyzed);
  made->succeeded_ = made->cholesky_->factor(rows.among_free);
  made->free_ = std::move(free);
  made->to_fixed_.swap(rows.to_fixed);
  made->right_.resize(made->to_fixed_.rows(), options.columns);
  return made;
}

double MinQuadWithFixed::solve(Eigen::Ref<Matrix> u) {
  right_.resize(right_.rows(), u.cols());
  right_.setZero();
  return finish(u);
}

double MinQuadWithFixed::solve(const Eigen::Ref<const Matrix>& f, Eigen::Ref<Matrix> u) {
  right_.resize(right_.rows(), u.cols());
  for (Index k = 0; k < right_.rows(); ++k) right_.row(k) = f.row(free_[k]);
  return finish(u);
}

double MinQuadWithFixed::finish(Eigen::Ref<Matrix>& u) {
  right_.noalias() -= to_fixed_ * u;
  cholesky_->solve(right_.data(), right_.cols());
  double largest = 0;
  for (Index k = 0; k < right_.rows(); ++k) {
    for (Index j = 0; j < right_.cols(); ++j) {
      double& to = u(free_[k], j);
      largest = std::max(largest, std::abs(right_(k, j) - to));
      to = right_(k, j);
    }
  }
  return largest;
}

}  // namespace handlebody
