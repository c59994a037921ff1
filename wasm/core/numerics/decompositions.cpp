#include "core/numerics/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <utility>

namespace handlebody {

// ---- Cholesky ---------------------------------------------------------------------------------------------------------------

Cholesky::Cholesky(MatrixXd a) : factor_(std::make_unique<MatrixXd>(std::move(a))) {
  Eigen::Ref<MatrixXd> place(*factor_);
  llt_ = std::make_unique<Eigen::LLT<Eigen::Ref<MatrixXd>>>(place);
  succeeded_ = llt_->info() == Eigen::Success && factor_->allFinite();
}

void Cholesky::compute(const MatrixXd& a) {
  llt_->compute(a);
  succeeded_ = llt_->info() == Eigen::Success && factor_->allFinite();
}

double Cholesky::rcond() const {
  return llt_->rcond();
}

void Cholesky::solve_in_place(Vector& x) const {
  llt_->solveInPlace(x);
}

void Cholesky::solve_in_place(MatrixXd& b) const {
  llt_->solveInPlace(b);
}

// ---- LU ---------------------------------------------------------------------------------------------------------------------

Lu::Lu(MatrixXd a) : factor_(std::make_unique<MatrixXd>(std::move(a))) {
  Eigen::Ref<MatrixXd> place(*factor_);
  lu_ = std::make_unique<Eigen::PartialPivLU<Eigen::Ref<MatrixXd>>>(place);
}

double Lu::rcond() const {
  return lu_->rcond();
}

Vector Lu::solve(const Vector& b) const {
  return lu_->solve(b);
}

MatrixXd Lu::solve(const MatrixXd& b) const {
  return lu_->solve(b);
}

// ---- QR ---------------------------------------------------------------------------------------------------------------------

namespace {

/** R as Eigen's estimator of condition numbers wants a decomposition: with solutions of R and of its transpose. */
struct Triangle {
  using MatrixType = MatrixXd;
  using Scalar = double;
  using RealScalar = double;

  const MatrixXd& r;

  Index rows() const { return r.rows(); }
  Vector solve(const Vector& b) const { return r.triangularView<Eigen::Upper>().solve(b); }
  auto adjoint() const { return r.transpose().triangularView<Eigen::Lower>(); }
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

void Qr::apply_transposed(MatrixXd& b) const {
  b.applyOnTheLeft(factors_->qr.householderQ().adjoint());
}

void Qr::apply(MatrixXd& b) const {
  b.applyOnTheLeft(factors_->qr.householderQ());
}

MatrixXd Qr::solve(MatrixXd b) const {
  apply_transposed(b);
  MatrixXd x = b.topRows(columns());
  factors_->matrix.topRows(columns()).triangularView<Eigen::Upper>().solveInPlace(x);
  return x;
}

double Qr::rcond() const {
  const MatrixXd upper = r();
  return Eigen::internal::rcond_estimate_helper(upper.cwiseAbs().colwise().sum().maxCoeff(), Triangle{upper});
}

// ---- eigenvalues ------------------------------------------------------------------------------------------------------------

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace handlebody
