#include "core/numerics/householder_qr.hpp"

#include <cmath>
#include <utility>

namespace handlebody {
namespace {

double dot(const double* __restrict x, const double* __restrict y, Index count) {
  double sums[4] = {0, 0, 0, 0};
  Index i = 0;
  for (; i + 4 <= count; i += 4)
    for (Index lane = 0; lane < 4; ++lane) sums[lane] += x[i + lane] * y[i + lane];
  for (; i < count; ++i) sums[0] += x[i] * y[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

void subtract(double factor, const double* __restrict x, double* __restrict y, Index count) {
  for (Index i = 0; i < count; ++i) y[i] -= factor * x[i];
}

}  // namespace

HouseholderQr::HouseholderQr(MatrixXd a) : a_(std::move(a)), diagonal_(a_.cols()), scale_(a_.cols()) {
  for (Index k = 0; k < columns(); ++k) {
    double* v = &a_(k, k);
    const Index count = rows() - k;
    const double norm = std::sqrt(dot(v, v, count));
    diagonal_[k] = v[0] > 0 ? -norm : norm;  // away from v₀: no cancellation
    v[0] -= diagonal_[k];
    const double squared = dot(v, v, count);
    scale_[k] = squared > 0 ? 2 / squared : 0;
    for (Index j = k + 1; j < columns(); ++j) reflect(k, &a_(0, j));
  }
}

void HouseholderQr::reflect(Index k, double* x) const {
  const double* v = &a_(k, k);
  const Index count = rows() - k;
  subtract(scale_[k] * dot(v, x + k, count), v, x + k, count);
}

void HouseholderQr::apply_transposed(double* x) const {
  for (Index k = 0; k < columns(); ++k) reflect(k, x);
}

void HouseholderQr::apply(double* x) const {
  for (Index k = columns(); k-- > 0;) reflect(k, x);
}

void HouseholderQr::solve_r(double* x) const {
  for (Index j = columns(); j-- > 0;) {
    x[j] /= diagonal_[j];
    subtract(x[j], a_.data() + j * rows(), x, j);
  }
}

void HouseholderQr::solve_r_transposed(double* x) const {
  for (Index j = 0; j < columns(); ++j) x[j] = (x[j] - dot(a_.data() + j * rows(), x, j)) / diagonal_[j];
}

}  // namespace handlebody
