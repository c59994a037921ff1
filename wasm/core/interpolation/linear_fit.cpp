#include "core/interpolation/linear_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/interpolation/polynomial.hpp"
#include "core/numerics/condition_estimate.hpp"
#include "core/numerics/dense.hpp"
#include "core/numerics/householder_qr.hpp"

namespace handlebody {
namespace {

double largest_column_sum(const MatrixXd& matrix) {
  double largest = 0;
  const double* entry = matrix.data();
  for (Index j = 0; j < matrix.cols(); ++j) {
    double sum = 0;
    for (Index i = 0; i < matrix.rows(); ++i) sum += std::abs(*entry++);
    if (!(largest >= sum) && !std::isnan(largest)) largest = sum;  // a NaN stays
  }
  return largest;
}

class SaddleFit final : public LinearFit {
 public:
  SaddleFit(RadialBasis& basis, const Matrix& points, double smoothing) : points_(points.rows()) {
    const Index n = points_, size = basis.size();
    MatrixXd system(size, size);  // transposed: one column a point
    for (Index i = 0; i < n; ++i) basis.values(&points(i, 0), &system(0, i));
    for (Index j = n; j < size; ++j) {
      for (Index i = 0; i < n; ++i) system(i, j) = system(j, i);
      for (Index i = n; i < size; ++i) system(i, j) = 0;
    }
    for (Index i = 0; i < n; ++i) system(i, i) += basis.kernel().sign() * basis.amplitude_of_scale() * smoothing;
    norm_ = largest_column_sum(system);
    factor_lu(system, pivots_);
    factor_ = std::move(system);
    condition_ = norm_ * estimate_inverse_norm(
                             size, [&](double* x) { solve_lu(factor_, pivots_, x); },
                             [&](double* x) {
                               MatrixXd row = Eigen::Map<MatrixXd>(x, 1, size);
                               solve_lu(factor_, pivots_, row);
                               std::copy(row.data(), row.data() + size, x);
                             });
  }

  MatrixXd coefficients(const Matrix& values) const override {
    MatrixXd result = MatrixXd::Zero(values.cols(), factor_.rows());
    for (Index i = 0; i < points_; ++i)
      for (Index j = 0; j < values.cols(); ++j) result(j, i) = values(i, j);
    solve_lu(factor_, pivots_, result);
    return result;
  }

 private:
  Index points_;
  MatrixXd factor_;
  std::vector<Index> pivots_;
};

/** The null space of the side conditions P(centers)ᵀ c = 0, as Householder reflections: c = Q [0; z]. */
class SideConditions {
 public:
  SideConditions(const RadialBasis& basis, const Matrix& inner_centers) : k_(basis.centers()), fixed_(std::min(basis.tail(), k_)) {
    if (fixed_ == 0 || fixed_ == k_) return;
    MatrixXd p(k_, fixed_);
    Vector row(basis.tail());
    for (Index i = 0; i < k_; ++i) {
      polynomial_values(&inner_centers(i, 0), basis.dimension(), basis.degree(), row.data());
      p.row(i) = row.transpose();
    }
    qr_ = std::make_unique<HouseholderQr>(std::move(p));
  }

  Index free() const { return k_ - fixed_; }

  /** r (k) becomes r·N in its first free() numbers. */
  void project(double* r) const {
    if (qr_) qr_->apply_transposed(r);
    std::rotate(r, r + fixed_, r + k_);
  }

  /** z in the first free() numbers becomes c (k). */
  void expand(double* z) const {
    std::rotate(z, z + free(), z + k_);
    std::fill(z, z + fixed_, 0.0);
    if (qr_) qr_->apply(z);
  }

 private:
  Index k_, fixed_;
  std::unique_ptr<HouseholderQr> qr_;
};

MatrixXd design(RadialBasis& basis, const Matrix& points, const SideConditions& side) {
  const Index k = basis.centers(), free = side.free(), tail = basis.tail();
  MatrixXd matrix(points.rows(), free + tail);
  Vector row(basis.size());
  for (Index i = 0; i < points.rows(); ++i) {
    basis.values(&points(i, 0), row.data());
    side.project(row.data());
    for (Index j = 0; j < free; ++j) matrix(i, j) = row[j];
    for (Index j = 0; j < tail; ++j) matrix(i, free + j) = row[k + j];
  }
  return matrix;
}

class LeastSquaresFit final : public LinearFit {
 public:
  LeastSquaresFit(RadialBasis& basis, const Matrix& points, const Matrix& centers, double weight_decay, const Vector& row_weights)
      : points_(points.rows()), centers_(basis.centers()), tail_(basis.tail()), side_(basis, basis.to_inner(centers)) {
    const Index free = side_.free();
    const bool decays = weight_decay > 0;
    root_weights_ = row_weights.size() ? Vector(row_weights.cwiseSqrt()) : Vector::Ones(points_);
    MatrixXd stacked = MatrixXd::Zero(points_ + (decays ? free : 0), free + tail_);
    stacked.topRows(points_) = design(basis, points, side_);
    for (Index j = 0; j < stacked.cols(); ++j)
      for (Index i = 0; i < points_; ++i) stacked(i, j) *= root_weights_[i];
    if (decays)
      for (Index j = 0; j < free; ++j) stacked(points_ + j, j) = basis.amplitude_of_scale() * std::sqrt(weight_decay);
    qr_ = std::make_unique<HouseholderQr>(std::move(stacked));
    const Index columns = qr_->columns();
    for (Index j = 0; j < columns; ++j) {
      double sum = 0;
      for (Index i = 0; i <= j; ++i) sum += std::abs(qr_->r(i, j));
      norm_ = std::max(norm_, sum);
    }
    condition_ = norm_ * estimate_inverse_norm(
                             columns, [&](double* x) { qr_->solve_r(x); }, [&](double* x) { qr_->solve_r_transposed(x); });
  }

  MatrixXd coefficients(const Matrix& values) const override {
    const Index free = side_.free();
    MatrixXd result(values.cols(), centers_ + tail_);
    Vector x(qr_->rows()), c(centers_);
    for (Index j = 0; j < values.cols(); ++j) {
      x.setZero();
      for (Index i = 0; i < points_; ++i) x[i] = root_weights_[i] * values(i, j);
      qr_->apply_transposed(x.data());
      qr_->solve_r(x.data());
      c.setZero();
      c.head(free) = x.head(free);
      side_.expand(c.data());
      for (Index i = 0; i < centers_; ++i) result(j, i) = c[i];
      for (Index i = 0; i < tail_; ++i) result(j, centers_ + i) = x[free + i];
    }
    return result;
  }

 private:
  Index points_, centers_, tail_;
  SideConditions side_;
  Vector root_weights_;
  std::unique_ptr<HouseholderQr> qr_;
};

}  // namespace

std::unique_ptr<LinearFit> fit_interpolant(RadialBasis& basis, const Matrix& points, double smoothing) {
  return std::make_unique<SaddleFit>(basis, points, smoothing);
}

std::unique_ptr<LinearFit> fit_least_squares(RadialBasis& basis, const Matrix& points, const Matrix& centers, double weight_decay,
                                             const Vector& row_weights) {
  return std::make_unique<LeastSquaresFit>(basis, points, centers, weight_decay, row_weights);
}

MatrixXd design_matrix(RadialBasis& basis, const Matrix& points, const Matrix& centers) {
  return design(basis, points, SideConditions(basis, basis.to_inner(centers)));
}

}  // namespace handlebody
