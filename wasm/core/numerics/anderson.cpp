#include "core/numerics/anderson.hpp"

#include <algorithm>
#include <cmath>

namespace handlebody {

namespace {

/** Normal equations square the condition number: without this trace, differences that are nearly parallel, as they are close to
 *  the end, give weights of pure rounding. */
constexpr double ridge = 1e-12;

double dot(const double* a, const double* b, Index size) {
  double sum0 = 0, sum1 = 0, sum2 = 0, sum3 = 0;
  Index i = 0;
  for (; i + 4 <= size; i += 4)
    sum0 += a[i] * b[i], sum1 += a[i + 1] * b[i + 1], sum2 += a[i + 2] * b[i + 2], sum3 += a[i + 3] * b[i + 3];
  for (; i < size; ++i) sum0 += a[i] * b[i];
  return (sum0 + sum1) + (sum2 + sum3);
}

}  // namespace

Anderson::Anderson(Index size, Index window)
    : size_(size),
      window_(window),
      residuals_(size, window),
      images_(size, window),
      last_residual_(size),
      last_image_(size),
      residual_(size),
      gram_(window, window),
      system_(window, window),
      weights_(window) {}

void Anderson::accelerate(const double* x, const double* g, double* next) {
  for (Index i = 0; i < size_; ++i) residual_[i] = g[i] - x[i];
  const Index count = std::min(steps_, window_);
  if (count > 0) {
    const Index newest = (steps_ - 1) % window_;
    double* residuals = residuals_.data() + newest * size_;
    double* images = images_.data() + newest * size_;
    for (Index i = 0; i < size_; ++i) residuals[i] = residual_[i] - last_residual_[i], images[i] = g[i] - last_image_[i];
    for (Index j = 0; j < count; ++j) gram_(newest, j) = gram_(j, newest) = dot(residuals, residuals_.data() + j * size_, size_);
    for (Index j = 0; j < count; ++j) weights_[j] = dot(residuals_.data() + j * size_, residual_.data(), size_);
  }
  last_residual_.swap(residual_);
  for (Index i = 0; i < size_; ++i) last_image_[i] = g[i];
  ++steps_;
  for (Index i = 0; i < size_; ++i) next[i] = last_image_[i];
  if (count == 0 || !solve(count)) return;
  for (Index j = 0; j < count; ++j) {
    const double weight = weights_[j];
    const double* images = images_.data() + j * size_;
    for (Index i = 0; i < size_; ++i) next[i] -= weight * images[i];
  }
}

/** weights ← gram⁻¹ weights by Cholesky; false where that fails. */
bool Anderson::solve(Index count) {
  double trace = 0;
  for (Index j = 0; j < count; ++j) trace += gram_(j, j);
  for (Index j = 0; j < count; ++j) {
    for (Index i = j; i < count; ++i) {
      double sum = gram_(i, j) + (i == j ? ridge * trace : 0);
      for (Index k = 0; k < j; ++k) sum -= system_(i, k) * system_(j, k);
      if (i == j) {
        if (!(sum > 0)) return false;
        system_(j, j) = std::sqrt(sum);
      } else {
        system_(i, j) = sum / system_(j, j);
      }
    }
  }
  for (Index i = 0; i < count; ++i) {
    for (Index k = 0; k < i; ++k) weights_[i] -= system_(i, k) * weights_[k];
    weights_[i] /= system_(i, i);
  }
  for (Index i = count; i-- > 0;) {
    for (Index k = i + 1; k < count; ++k) weights_[i] -= system_(k, i) * weights_[k];
    weights_[i] /= system_(i, i);
  }
  return true;
}

}  // namespace handlebody
