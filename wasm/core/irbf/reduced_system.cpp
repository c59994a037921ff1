#include "core/irbf/reduced_system.hpp"

#include <utility>

#include "core/numerics/decompositions.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {

namespace {

/** Hard constraints whose Schur complement is worse than this have lost all digits. */
constexpr double most_condition = 1e13;

Error singular(const char* message) {
  return {HB_ERROR_SYSTEM_SINGULAR, {message}, {"Move handles apart, use fewer of them, or use soft constraints."}};
}

}  // namespace

ReducedSystem::ReducedSystem() = default;
ReducedSystem::ReducedSystem(ReducedSystem&&) noexcept = default;
ReducedSystem& ReducedSystem::operator=(ReducedSystem&&) noexcept = default;
ReducedSystem::~ReducedSystem() = default;

Result<ReducedSystem> make_reduced_system(const MatrixXd& edge_rows, const MatrixXd& gram, const MatrixXd& rows, double mu,
                                          ConstraintKind kind) {
  const Index edges = edge_rows.rows(), constraints = rows.rows(), unknowns = gram.rows();
  const bool hard = kind == ConstraintKind::hard;
  ReducedSystem system;
  system.weight = hard ? 1 : mu;

  // M = Z₁ᵀZ₁ + λ + μ²SᵀS. Under hard constraints the last term changes nothing but makes M regular.
  MatrixXd normal = gram;
  normal.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose(), mu * mu);
  const Cholesky factor(std::move(normal));
  if (!factor.succeeded()) return singular("The system of handles and spheres is not positive definite.");
  system.condition = 1 / factor.rcond();
  system.inverse.resize(unknowns, edges + constraints);  // M⁻¹ [Z₁ᵀ Sᵀ]
  system.inverse << edge_rows.transpose(), rows.transpose();
  factor.solve_in_place(system.inverse);

  MatrixXd multipliers;  // ν + μ²T = Q⁻¹ [−S M⁻¹Z₁ᵀ  I] [Γ₁; T] with Q = S M⁻¹ Sᵀ
  if (hard) {
    const MatrixXd products = product(rows, system.inverse);  // S M⁻¹ [Z₁ᵀ Sᵀ]
    const Cholesky schur(products.rightCols(constraints));
    if (!schur.succeeded() || !(1 / schur.rcond() < most_condition))
      return singular("The hard constraints repeat each other, or there are more of them than the centers can meet.");
    multipliers.resize(constraints, edges + constraints);
    multipliers << -products.leftCols(edges), MatrixXd::Identity(constraints, constraints);
    schur.solve_in_place(multipliers);
    const MatrixXd response = system.inverse.rightCols(constraints);  // M⁻¹ Sᵀ
    system.inverse.rightCols(constraints).setZero();
    system.inverse += product(response, multipliers);
  } else {
    system.inverse.rightCols(constraints) *= mu;
  }

  system.hat.resize(edges + constraints, edges + constraints);
  system.hat.topRows(edges) = product(edge_rows, system.inverse);
  if (hard) {
    // The energy is Γ₁·(Γ₁ − Z₁Π) + T·ν with the multipliers ν.
    system.hat.bottomRows(constraints) = -multipliers;
    system.hat.diagonal().tail(constraints).array() += 1 + mu * mu;
  } else {
    system.hat.bottomRows(constraints) = mu * product(rows, system.inverse);
  }
  return system;
}

}  // namespace handlebody
