// Eigen's dense decompositions, each instantiated once, since every file that names one compiles its own copy. They factor their
// argument in place, so that a system of 11,000 unknowns is not held twice.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <memory>

#include "core/numerics/types.hpp"

namespace handlebody {

/** The inverse of a matrix, known only by its products with vectors. */
class Inverse {
 public:
  virtual Index rows() const = 0;
  virtual void apply(Vector& x) const = 0;                      // x ← A⁻¹ x
  virtual void apply_transposed(Vector& x) const { apply(x); }  // x ← A⁻ᵀ x, the same for a symmetric matrix

 protected:
  ~Inverse() = default;
};

/** An estimate of ‖A⁻¹‖₁ from a handful of products: never above it, rarely below a third of it (Hager 1984; Higham, ACM TOMS 14,
 *  1988). This is Eigen's estimator; the rcond() of each of its decompositions would compile it once more: 4 kB gzipped in all. */
double inverse_norm_estimate(const Inverse& inverse);

/** ‖A‖₁, the largest sum of the absolute values in a column; 0 for a matrix without columns, NaN where any number is. */
double one_norm(const Eigen::Ref<const MatrixXd>& a);

/** A = L Lᵀ of a symmetric positive definite matrix (n×n), of which the lower triangle is read. Eigen::LLT. */
class Cholesky final : private Inverse {
 public:
  explicit Cholesky(MatrixXd a);

  /** Factors another matrix of the same size. Allocates nothing. */
  void compute(const MatrixXd& a);

  /** False where a pivot is not positive or any number of the factor is not finite: Eigen::LLT itself lets NaN pass. Nothing else
   * may be called then. */
  bool succeeded() const { return succeeded_; }

  Index rows() const override { return factor_->rows(); }

  /** L in the lower triangle; the upper one is A's. */
  const MatrixXd& factor() const { return *factor_; }

  /** Estimated reciprocal of the 1-norm condition number; 0 where that is beyond double precision. */
  double rcond() const { return 1 / (norm_ * inverse_norm_estimate(*this)); }

  /** x ← A⁻¹ x (n), without allocating; B ← A⁻¹ B (n×m). */
  void solve_in_place(Vector& x) const;
  void solve_in_place(MatrixXd& b) const;

 private:
  void apply(Vector& x) const override { solve_in_place(x); }
  void set_norm(const MatrixXd& a);

  // On the heap, since the decomposition refers to the matrix, and both move together.
  std::unique_ptr<MatrixXd> factor_;
  std::unique_ptr<Eigen::LLT<Eigen::Ref<MatrixXd>>> llt_;
  Vector sums_;      // of the absolute values in each of A's columns
  double norm_ = 0;  // ‖A‖₁
  bool succeeded_ = false;
};

/** P A = L U of a square matrix (n×n) with partial pivoting. A singular matrix is accepted, but its solutions are not finite.
 * Eigen::PartialPivLU. */
class Lu final : private Inverse {
 public:
  explicit Lu(MatrixXd a);

  Index rows() const override { return factor_->rows(); }

  /** ‖A‖₁ */
  double norm() const { return norm_; }

  /** As for Cholesky. */
  double rcond() const;

  /** A⁻¹ B (n×m). */
  MatrixXd solve(const MatrixXd& b) const;

 private:
  void apply(Vector& x) const override;
  void apply_transposed(Vector& x) const override;

  double norm_;  // before `factor_`, which takes the matrix
  std::unique_ptr<MatrixXd> factor_;
  std::unique_ptr<Eigen::PartialPivLU<Eigen::Ref<MatrixXd>>> lu_;
};

/** A = Q [R; 0] of a tall matrix (m×n, m ≥ n): least squares without squaring the condition number, as normal equations do.
 *  Eigen::HouseholderQR. */
class Qr {
 public:
  explicit Qr(MatrixXd a);
  Qr(Qr&&) noexcept;
  Qr& operator=(Qr&&) noexcept;
  ~Qr();

  Index rows() const;
  Index columns() const;

  /** R (n×n), with zeros below its diagonal. */
  MatrixXd r() const;

  /** B ← QᵀB or Q B (m×k). */
  void apply_transposed(Eigen::Ref<MatrixXd> b) const;
  void apply(Eigen::Ref<MatrixXd> b) const;

  /** S ← QᵀSQ for a symmetric matrix (m×m), of which the lower triangle is read and written. */
  void conjugate(MatrixXd& s) const;

  /** B ← R⁻¹B or R⁻ᵀB (n×k). */
  void solve_r(Eigen::Ref<MatrixXd> b) const;
  void solve_r_transposed(Eigen::Ref<MatrixXd> b) const;

  /** argmin ‖A X − B‖ (n×k) for B (m×k). Not finite where columns of A are linearly dependent. */
  MatrixXd solve(MatrixXd b) const;

  /** Estimated reciprocal of R's 1-norm condition number, as for Cholesky. */
  double rcond() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/** A P = Q R with column pivoting, for the span of A's columns (m×n). `sizes` are the |Rₖₖ|, descending; where r of them are above
 * a tolerance, the first r of Q's min(m, n) columns are an orthonormal basis of the span. Eigen::ColPivHouseholderQR. */
struct ColumnSpan {
  MatrixXd basis;
  Vector sizes;
};

ColumnSpan column_span(MatrixXd a);

/** A = V diag(λ) Vᵀ of a symmetric matrix (n×n), of which the lower triangle is read: λ ascending, V's columns orthonormal.
 *  Eigen::SelfAdjointEigenSolver. */
struct SymmetricEigen {
  Vector values;
  MatrixXd vectors;
};

SymmetricEigen symmetric_eigen(const MatrixXd& a);

}  // namespace handlebody
