#include "core/interpolation/linear_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/numerics/decompositions.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {
namespace {

double or_infinite(double condition) {
  return std::isfinite(condition) ? condition : std::numeric_limits<double>::infinity();
}

/** The polynomials of the tail at inner coordinates (n×tail, of which the first `columns` are wanted). */
MatrixXd tail_at(RadialBasis& basis, const Matrix& inner, Index columns) {
  MatrixXd p(inner.rows(), columns);
  Vector row(basis.tail());
  for (Index i = 0; i < inner.rows(); ++i) {
    basis.polynomials(&inner(i, 0), row.data());
    p.row(i) = row.head(columns).transpose();
  }
  return p;
}

/** Copies the lower triangle to the upper one. */
void mirror(Eigen::Ref<MatrixXd> square) {
  square.triangularView<Eigen::StrictlyUpper>() = square.transpose();
}

/** The whole block matrix by LU, for any kernel. */
class SaddleFit final : public LinearFit {
 public:
  SaddleFit(RadialBasis& basis, const Matrix& points, double smoothing) : points_(points.rows()) {
    const Index n = points_, size = basis.size(), tail = basis.tail();
    MatrixXd system(size, size);
    for (Index i = 0; i < n; ++i) basis.values(&points(i, 0), &system(0, i));  // row i
    system.leftCols(n).topRows(n).diagonal().array() += basis.kernel().sign() * basis.amplitude_of_scale() * smoothing;
    system.topRightCorner(n, tail) = system.bottomLeftCorner(tail, n).transpose();
    system.bottomRightCorner(tail, tail).setZero();
    system.transposeInPlace();
    lu_.emplace(std::move(system));
    norm_ = lu_->norm();
    condition_ = or_infinite(1 / lu_->rcond());
  }

  MatrixXd coefficients(const Matrix& values) const override {
    MatrixXd known = MatrixXd::Zero(lu_->rows(), values.cols());
    known.topRows(points_) = values;
    return lu_->solve(known).transpose();
  }

 private:
  Index points_;
  std::optional<Lu> lu_;
};

/** For a kernel that, times its sign, is positive definite on what the side conditions leave: half of LU's work. With P = Q [T; 0],
 * c = Q [y; z] and B = Qᵀ(R + λI)Q, the equations become
 *
 *   [ B₁₁  B₂₁ᵀ  T ] [y]
 *   [ B₂₁  B₂₂   0 ] [z] = [Qᵀf; h],     h = 0,
 *   [ Tᵀ    0    0 ] [d]
 *
 *  of which only B₂₂ takes a factorization: Cholesky's. */
class DefiniteFit final : public LinearFit, private Inverse {
 public:
  DefiniteFit(RadialBasis& basis, const Matrix& points, double smoothing)
      : tail_(basis.tail()),
        sign_(basis.kernel().sign()),
        polynomials_(tail_at(basis, basis.to_inner(points), tail_)),
        side_(polynomials_) {
    const Index n = points.rows();
    MatrixXd b(n, n);  // its lower triangle; the kernels themselves stay in the upper one
    for (Index j = 0; j < n; ++j) {
      basis.kernels_from(j, &points(j, 0), &b(j, j));
      if (sign_ < 0) b.col(j).tail(n - j) *= -1;
    }
    mirror(b);
    diagonal_ = b.diagonal();
    b.diagonal().array() += basis.amplitude_of_scale() * smoothing;
    set_norm(b);
    side_.conjugate(b);
    // The first columns are kept apart; with those of the identity in their place the rest need not be copied.
    strip_ = b.leftCols(tail_);
    mirror(strip_.topRows(tail_));
    b.leftCols(tail_).triangularView<Eigen::Lower>().setZero();
    b.diagonal().head(tail_).setOnes();
    cholesky_.emplace(std::move(b));
    if (definite()) condition_ = or_infinite(norm_ * inverse_norm_estimate(*this));
  }

  /** Where it is not, nothing else may be called. */
  bool definite() const { return cholesky_->succeeded(); }

  MatrixXd coefficients(const Matrix& values) const override {
    const Index n = cholesky_->rows();
    MatrixXd x = MatrixXd::Zero(n + tail_, values.cols());
    x.topRows(n) = values;
    if (x.cols() == 1) {
      Vector one = x.col(0);
      solve(one);
      x.col(0) = one;
    } else {
      solve(x);
    }
    x.topRows(n) *= sign_;
    return x.transpose();
  }

  std::optional<MatrixXd> fitted(const MatrixXd& coefficients) const override {
    // Above the diagonal these are the kernels still; on it stands the factor's own, and `diagonal_` has the kernels'.
    const MatrixXd& kernels = cholesky_->factor();
    const MatrixXd x = coefficients.transpose();
    MatrixXd result = product(polynomials_, x.bottomRows(tail_));
    for (Index out = 0; out < x.cols(); ++out) {
      const Vector c = sign_ * x.col(out).head(kernels.rows());
      result.col(out) += kernels.selfadjointView<Eigen::Upper>() * c;
      result.col(out) += (diagonal_ - kernels.diagonal()).cwiseProduct(c);
    }
    return result;
  }

 private:
  Index rows() const override { return cholesky_->rows() + tail_; }
  void apply(Vector& x) const override { solve(x); }

  /** [f; h] becomes [c; d], for a vector or for columns. */
  template <typename Columns>
  void solve(Columns& x) const {
    const Index n = cholesky_->rows();
    Columns c = x.topRows(n);
    side_.apply_transposed(c);
    auto d = x.bottomRows(tail_);
    const MatrixXd top = c.topRows(tail_);
    side_.solve_r_transposed(d);
    c.topRows(tail_).setZero();
    c.bottomRows(n - tail_) -= product(strip_.bottomRows(n - tail_), d);
    cholesky_->solve_in_place(c);
    c.topRows(tail_) = d;
    d = top - transposed_product(strip_, c);
    side_.solve_r(d);
    side_.apply(c);
    x.topRows(n) = c;
  }

  /** The 1-norm of the whole block matrix. */
  void set_norm(const MatrixXd& lower) {
    const Index n = lower.rows();
    Vector sums = polynomials_.cwiseAbs().rowwise().sum();
    for (Index j = 0; j < n; ++j) {
      const auto below = lower.col(j).tail(n - 1 - j).cwiseAbs();
      sums[j] += std::abs(lower(j, j)) + below.sum();
      sums.tail(n - 1 - j) += below;
    }
    norm_ = std::max(sums.maxCoeff<Eigen::PropagateNaN>(), one_norm(polynomials_));
  }

  Index tail_;
  double sign_;
  MatrixXd polynomials_;              // P
  Qr side_;                           // of P
  Vector diagonal_;                   // of R
  MatrixXd strip_;                    // B₁₁ and B₂₁
  std::optional<Cholesky> cholesky_;  // and the rest of R, in the other triangle
};

/** The null space of the side conditions P(centers)ᵀ c = 0, as Householder reflections: c = Q [0; z]. */
class SideConditions {
 public:
  SideConditions(RadialBasis& basis, const Matrix& centers)
      : k_(basis.centers()), fixed_(std::min(basis.tail(), k_)), qr_(tail_at(basis, basis.to_inner(centers), fixed_)) {}

  Index free() const { return k_ - fixed_; }

  /** The matrix of the least-squares problem without weights, [R N, P] with c = N z: n × (free() + tail). */
  void fill_design(RadialBasis& basis, const Matrix& points, Eigen::Ref<MatrixXd> out) const {
    constexpr Index block = 64;
    const Index n = points.rows(), tail = basis.tail();
    MatrixXd functions(basis.size(), std::min(block, n));  // one column per point
    for (Index first = 0; first < n; first += block) {
      const Index width = std::min(block, n - first);
      for (Index q = 0; q < width; ++q) basis.values(&points(first + q, 0), &functions(0, q));
      qr_.apply_transposed(functions.topLeftCorner(k_, width));
      out.block(first, 0, width, free()) = functions.block(fixed_, 0, free(), width).transpose();
      out.block(first, free(), width, tail) = functions.bottomRows(tail).leftCols(width).transpose();
    }
  }

  /** z (free()×m) becomes c (k×m). */
  MatrixXd expand(const Eigen::Ref<const MatrixXd>& z) const {
    MatrixXd c = MatrixXd::Zero(k_, z.cols());
    c.bottomRows(free()) = z;
    qr_.apply(c);
    return c;
  }

 private:
  Index k_, fixed_;
  Qr qr_;
};

class LeastSquaresFit final : public LinearFit {
 public:
  LeastSquaresFit(RadialBasis& basis, const Matrix& points, const Matrix& centers, double weight_decay, const Vector& row_weights)
      : points_(points.rows()), tail_(basis.tail()), side_(basis, centers) {
    const Index free = side_.free();
    const bool decays = weight_decay > 0;
    root_weights_ = row_weights.size() ? Vector(row_weights.cwiseSqrt()) : Vector::Ones(points_);
    MatrixXd stacked = MatrixXd::Zero(points_ + (decays ? free : 0), free + tail_);
    side_.fill_design(basis, points, stacked.topRows(points_));
    stacked.topRows(points_).array().colwise() *= root_weights_.array();
    if (decays) stacked.bottomLeftCorner(free, free).diagonal().setConstant(basis.amplitude_of_scale() * std::sqrt(weight_decay));
    qr_.emplace(std::move(stacked));
    norm_ = one_norm(qr_->r());
    condition_ = or_infinite(1 / qr_->rcond());
  }

  MatrixXd coefficients(const Matrix& values) const override {
    const Index free = side_.free();
    MatrixXd weighted = MatrixXd::Zero(qr_->rows(), values.cols());
    weighted.topRows(points_) = root_weights_.asDiagonal() * values;
    const MatrixXd x = qr_->solve(std::move(weighted)), c = side_.expand(x.topRows(free));
    MatrixXd result(values.cols(), c.rows() + tail_);
    result.leftCols(c.rows()) = c.transpose();
    result.rightCols(tail_) = x.bottomRows(tail_).transpose();
    return result;
  }

 private:
  Index points_, tail_;
  SideConditions side_;
  Vector root_weights_;
  std::optional<Qr> qr_;
};

/** Whether a theorem says that the kernel, with its sign, is positive definite on what the tail's side conditions leave. */
bool known_definite(const RadialBasis& basis) {
  const Kernel& kernel = basis.kernel();
  return basis.symmetric() && basis.degree() >= kernel.minimum_degree() && basis.dimension() <= kernel.definite_to_dimension();
}

}  // namespace

std::unique_ptr<LinearFit> fit_interpolant(RadialBasis& basis, const Matrix& points, double smoothing) {
  if (known_definite(basis)) {
    auto definite = std::make_unique<DefiniteFit>(basis, points, smoothing);
    if (definite->definite()) return definite;
  }
  return std::make_unique<SaddleFit>(basis, points, smoothing);
}

std::unique_ptr<LinearFit> fit_least_squares(RadialBasis& basis, const Matrix& points, const Matrix& centers, double weight_decay,
                                             const Vector& row_weights) {
  return std::make_unique<LeastSquaresFit>(basis, points, centers, weight_decay, row_weights);
}

MatrixXd design_matrix(RadialBasis& basis, const Matrix& points, const Matrix& centers) {
  const SideConditions side(basis, centers);
  MatrixXd matrix(points.rows(), side.free() + basis.tail());
  side.fill_design(basis, points, matrix);
  return matrix;
}

}  // namespace handlebody
