#include "core/numerics/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

namespace handlebody {

// ---- Cholesky ---------------------------------------------------------------------------------------------------------------

Cholesky::Cholesky(MatrixXd a) : factor_(std::make_unique<MatrixXd>(std::move(a))), sums_(factor_->rows()) {
  set_norm(*factor_);
  Eigen::Ref<MatrixXd> place(*factor_);
  llt_ = std::make_unique<Eigen::LLT<Eigen::Ref<MatrixXd>>>(place);
  // If a number below the diagonal is not finite, neither is the diagonal; numbers above it are not read.
  succeeded_ = llt_->info() == Eigen::Success && factor_->diagonal().allFinite();
}

/** ‖A‖₁ of a symmetric matrix, from its lower triangle. */
void Cholesky::set_norm(const MatrixXd& a) {
  sums_.setZero();
  for (Index j = 0; j < a.cols(); ++j) {
    const auto below = a.col(j).tail(a.rows() - 1 - j).cwiseAbs();
    sums_[j] += std::abs(a(j, j)) + below.sum();
    sums_.tail(a.rows() - 1 - j) += below;
  }
  norm_ = sums_.size() == 0 ? 0 : sums_.maxCoeff<Eigen::PropagateNaN>();
}

void Cholesky::compute(const MatrixXd& a) {
  set_norm(a);
  llt_->compute(a);
  succeeded_ = llt_->info() == Eigen::Success && factor_->allFinite();
}

void Cholesky::solve_in_place(Vector& x) const {
  llt_->solveInPlace(x);
}

void Cholesky::solve_in_place(MatrixXd& b) const {
  llt_->solveInPlace(b);
}

// ---- LU ---------------------------------------------------------------------------------------------------------------------

Lu::Lu(MatrixXd a) : norm_(one_norm(a)), factor_(std::make_unique<MatrixXd>(std::move(a))) {
  Eigen::Ref<MatrixXd> place(*factor_);
  lu_ = std::make_unique<Eigen::PartialPivLU<Eigen::Ref<MatrixXd>>>(place);
}

double Lu::rcond() const {
  // A zero pivot makes solutions that are not finite, which the estimator cannot handle.
  return (factor_->diagonal().array() != 0).all() ? 1 / (norm_ * inverse_norm_estimate(*this)) : 0;
}

MatrixXd Lu::solve(const MatrixXd& b) const {
  return lu_->solve(b);
}

void Lu::apply(Vector& x) const {
  x = solve(MatrixXd(x));
}

void Lu::apply_transposed(Vector& x) const {
  const auto factor = factor_->transpose();
  factor.triangularView<Eigen::Lower>().solveInPlace(x);
  factor.triangularView<Eigen::UnitUpper>().solveInPlace(x);
  x = lu_->permutationP().transpose() * x;
}

// ---- QR ---------------------------------------------------------------------------------------------------------------------

namespace {

/** The inverse of R. */
class TriangleInverse final : public Inverse {
 public:
  explicit TriangleInverse(const Qr& qr) : qr_(qr) {}

  Index rows() const override { return qr_.columns(); }
  void apply(Vector& x) const override { qr_.solve_r(x); }
  void apply_transposed(Vector& x) const override { qr_.solve_r_transposed(x); }

 private:
  const Qr& qr_;
};

}  // namespace

struct Qr::Factors {
  explicit Factors(MatrixXd&& a) : matrix(std::move(a)), place(matrix), qr(place) {}

  MatrixXd matrix;
  Eigen::Ref<MatrixXd> place;
  Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr;
};

Qr::Qr(MatrixXd a) : factors_(std::make_unique<Factors>(std::move(a))) {}
Qr::Qr(Qr&&) noexcept = default;
Qr& Qr::operator=(Qr&&) noexcept = default;
Qr::~Qr() = default;

Index Qr::rows() const {
  return factors_->matrix.rows();
}

Index Qr::columns() const {
  return factors_->matrix.cols();
}

MatrixXd Qr::r() const {
  return factors_->matrix.topRows(columns()).triangularView<Eigen::Upper>();
}

void Qr::apply_transposed(Eigen::Ref<MatrixXd> b) const {
  b.applyOnTheLeft(factors_->qr.householderQ().adjoint());
}

void Qr::apply(Eigen::Ref<MatrixXd> b) const {
  b.applyOnTheLeft(factors_->qr.householderQ());
}

void Qr::conjugate(MatrixXd& s) const {
  // Applies one reflection H = I − τ v vᵀ after the other from both sides, as in tridiagonalization: H S H = S − v wᵀ − w vᵀ with
  // w = τ S v − ½ τ² (vᵀS v) v.
  Vector v(rows()), w(rows());
  for (Index k = 0; k < columns(); ++k) {
    const double tau = factors_->qr.hCoeffs()[k];
    v.head(k).setZero();
    v[k] = 1;
    v.tail(rows() - k - 1) = factors_->matrix.col(k).tail(rows() - k - 1);
    w.noalias() = s.selfadjointView<Eigen::Lower>() * (tau * v);
    w -= (0.5 * tau * v.dot(w)) * v;
    s.selfadjointView<Eigen::Lower>().rankUpdate(v, w, -1);
  }
}

void Qr::solve_r(Eigen::Ref<MatrixXd> b) const {
  factors_->matrix.topRows(columns()).triangularView<Eigen::Upper>().solveInPlace(b);
}

void Qr::solve_r_transposed(Eigen::Ref<MatrixXd> b) const {
  factors_->matrix.topRows(columns()).transpose().triangularView<Eigen::Lower>().solveInPlace(b);
}

MatrixXd Qr::solve(MatrixXd b) const {
  apply_transposed(b);
  MatrixXd x = b.topRows(columns());
  solve_r(x);
  return x;
}

double Qr::rcond() const {
  const MatrixXd upper = r();
  if (!(upper.diagonal().array() != 0).all()) return 0;
  return 1 / (one_norm(upper) * inverse_norm_estimate(TriangleInverse(*this)));
}

ColumnSpan column_span(MatrixXd a) {
  const Index count = std::min(a.rows(), a.cols());
  if (count == 0) return {MatrixXd(a.rows(), 0), Vector()};
  const Eigen::ColPivHouseholderQR<Eigen::Ref<MatrixXd>> qr(a);
  MatrixXd basis = MatrixXd::Identity(a.rows(), count);
  basis.applyOnTheLeft(qr.householderQ());
  return {std::move(basis), qr.matrixQR().diagonal().cwiseAbs()};
}

// ---- norms ------------------------------------------------------------------------------------------------------------------

double one_norm(const Eigen::Ref<const MatrixXd>& a) {
  return a.cols() == 0 ? 0 : a.cwiseAbs().colwise().sum().maxCoeff<Eigen::PropagateNaN>();
}

namespace {

/** The interface that Eigen's estimator expects of a decomposition. */
struct Solver {
  using MatrixType = MatrixXd;
  using Scalar = double;
  using RealScalar = double;

  const Inverse& inverse;
  bool transposed = false;

  Index rows() const { return inverse.rows(); }
  Index cols() const { return inverse.rows(); }
  Solver adjoint() const { return {inverse, !transposed}; }
  Vector solve(Vector x) const {
    if (transposed)
      inverse.apply_transposed(x);
    else
      inverse.apply(x);
    return x;
  }
};

}  // namespace

double inverse_norm_estimate(const Inverse& inverse) {
  return Eigen::internal::rcond_invmatrix_L1_norm_estimate(Solver{inverse});
}

// ---- eigenvalues ------------------------------------------------------------------------------------------------------------

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace handlebody
