#include "core/irbf/reduced_system.hpp"

#include <cmath>
#include <limits>

#include "core/numerics/condition_estimate.hpp"

namespace handlebody {

namespace {

/** Hard constraints whose Schur complement is worse than this have lost all digits. */
constexpr double most_condition = 1e13;

/** Estimated 1-norm condition number of a symmetric matrix from its lower triangle and its Cholesky factor. */
double condition_number(const MatrixXd& lower, const MatrixXd& factor) {
  const Index n = lower.rows();
  Vector sums = Vector::Zero(n);
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i) {
      sums[j] += std::abs(lower(i, j));
      if (i > j) sums[i] += std::abs(lower(i, j));
    }
  }
  double largest = 0;
  for (const double sum : sums) largest = sum > largest ? sum : largest;
  MatrixXd row(1, n);
  const auto solve = [&](double* x) {
    for (Index i = 0; i < n; ++i) row(0, i) = x[i];
    solve_cholesky(factor, row);
    for (Index i = 0; i < n; ++i) x[i] = row(0, i);
  };
  return largest * estimate_inverse_norm(n, solve, solve);
}

Error singular(const char* message) {
  return {HB_ERROR_SYSTEM_SINGULAR, {message}, {"Move handles apart, use fewer of them, or use soft constraints."}};
}

}  // namespace

Result<ReducedSystem> make_reduced_system(const MatrixXd& edge_rows, const MatrixXd& gram, const MatrixXd& rows, double mu,
                                          ConstraintKind kind) {
  const Index edges = edge_rows.rows(), constraints = rows.rows(), unknowns = gram.rows();
  const bool hard = kind == ConstraintKind::hard;
  ReducedSystem system;
  system.weight = hard ? 1 : mu;

  // M = Z₁ᵀZ₁ + λ + μ²SᵀS. Under hard constraints the last term changes nothing but makes M regular.
  MatrixXd lower = gram;
  add_gram(mu * rows, lower);
  MatrixXd factor = lower;
  if (!factor_cholesky(factor)) return singular("The system of handles and spheres is not positive definite.");
  system.condition = condition_number(lower, factor);
  MatrixXd solved(edges + constraints, unknowns);  // [Z₁; S] M⁻¹
  solved.topRows(edges) = edge_rows;
  solved.bottomRows(constraints) = rows;
  solve_cholesky(factor, solved);
  system.inverse = solved.transpose();

  MatrixXd schur, multipliers;  // Q = S M⁻¹ Sᵀ; ν + μ²T = Q⁻¹ [−S M⁻¹Z₁ᵀ  I] [Γ₁; T]
  if (hard) {
    const MatrixXd products = product(rows, system.inverse);  // S M⁻¹ [Z₁ᵀ Sᵀ]
    schur = products.rightCols(constraints);
    MatrixXd schur_factor = schur;
    if (!factor_cholesky(schur_factor) || !(condition_number(schur, schur_factor) < most_condition))
      return singular("The hard constraints repeat each other, or there are more of them than the centers can meet.");
    MatrixXd transposed(edges + constraints, constraints);
    transposed.topRows(edges) = -products.leftCols(edges).transpose();
    transposed.bottomRows(constraints).setIdentity();
    solve_cholesky(schur_factor, transposed);
    multipliers = transposed.transpose();
    const MatrixXd forced = product(system.inverse.rightCols(constraints), multipliers);
    system.inverse.rightCols(constraints).setZero();
    system.inverse += forced;
  } else {
    system.inverse.rightCols(constraints) *= mu;
  }

  system.hat.resize(edges + constraints, edges + constraints);
  system.hat.topRows(edges) = product(edge_rows, system.inverse);
  if (hard) {
    // The energy is Γ₁·(Γ₁ − Z₁Π) + T·ν with the multipliers ν.
    system.hat.bottomRows(constraints) = -multipliers;
    for (Index k = 0; k < constraints; ++k) system.hat(edges + k, edges + k) += 1 + mu * mu;
  } else {
    system.hat.bottomRows(constraints) = mu * product(rows, system.inverse);
  }
  return system;
}

}  // namespace handlebody
