#include "core/numerics/anderson.hpp"

#include <algorithm>

namespace handlebody {

namespace {

/** Normal equations square the condition number. Without this small term on the diagonal, differences that are nearly parallel, as
 *  they are close to convergence, give weights that are nothing but rounding errors. */
constexpr double ridge = 1e-12;

}  // namespace

Anderson::Anderson(Index size, Index window)
    : window_(window),
      residuals_(MatrixXd::Zero(size, window)),
      images_(MatrixXd::Zero(size, window)),
      last_residual_(size),
      last_image_(size),
      residual_(size),
      gram_(MatrixXd::Zero(window, window)),
      system_(MatrixXd::Identity(window, window)),
      factor_(system_),
      weights_(window) {}

void Anderson::accelerate(const double* x, const double* g, double* next) {
  const Index size = last_image_.size();
  const Eigen::Map<const Vector> image(g, size);
  residual_ = image - Eigen::Map<const Vector>(x, size);
  const Index count = std::min(steps_, window_);
  if (count > 0) {
    const Index newest = (steps_ - 1) % window_;
    residuals_.col(newest) = residual_ - last_residual_;
    images_.col(newest) = image - last_image_;
    const auto kept = residuals_.leftCols(count);
    weights_.setZero();
    weights_.head(count).noalias() = kept.transpose() * residuals_.col(newest);
    gram_.row(newest) = weights_.transpose();
    gram_.col(newest) = weights_;
    weights_.head(count).noalias() = kept.transpose() * residual_;
  }
  last_residual_.swap(residual_);
  last_image_ = image;
  ++steps_;
  Eigen::Map<Vector> result(next, size);
  result = last_image_;
  if (count == 0) return;
  system_.setIdentity();
  system_.topLeftCorner(count, count) = gram_.topLeftCorner(count, count);
  system_.diagonal().head(count).array() += ridge * gram_.diagonal().head(count).sum();
  factor_.compute(system_);
  if (!factor_.succeeded()) return;
  factor_.solve_in_place(weights_);
  result.noalias() -= images_.leftCols(count) * weights_.head(count);
}

}  // namespace handlebody
