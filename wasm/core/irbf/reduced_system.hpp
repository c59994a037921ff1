// The global step of paper 001, factored once for a set of handles: soft constraints by the appendix, hard ones by §4.6's Lagrange
// multipliers. Both become one matrix times the right-hand side, of which an iteration needs only the rows that it looks at.
#pragma once

#include "core/errors/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

enum class ConstraintKind : unsigned { soft = 0, hard = 1 };

/** minimize ‖Z₁Π − Γ₁‖² + λ‖a‖² with SΠ = T weighted by μ² (soft) or exactly (hard); Π stacks Aᵀ, t and the coefficients a. The
 *  right-hand side stacks Γ₁ and `weight`·T. */
struct ReducedSystem {
  // Compiled once, because many places move one.
  ReducedSystem();
  ReducedSystem(ReducedSystem&&) noexcept;
  ReducedSystem& operator=(ReducedSystem&&) noexcept;
  ~ReducedSystem();

  MatrixXd inverse;      // Π = inverse · right-hand side: (4 + C) × (3B + K)
  MatrixXd hat;          // (3B + K) × (3B + K): its first 3B rows give Z₁Π; the least energy is rhsᵀ(I − hat) rhs
  double weight = 1;     // of the constraints in the right-hand side: μ, or 1 where they are hard
  double condition = 0;  // estimated 1-norm condition number of the normal equations
};

/** `edge_rows` is Z₁ (3B × (4 + C)), `gram` the lower triangle of Z₁ᵀZ₁ + λ on the coefficients, `rows` S (K × (4 + C)), μ > 0.
 *  Fails with SYSTEM_SINGULAR: hard constraints that repeat or contradict each other, or more of them than there are unknowns. */
Result<ReducedSystem> make_reduced_system(const MatrixXd& edge_rows, const MatrixXd& gram, const MatrixXd& rows, double mu,
                                          ConstraintKind kind);

}  // namespace handlebody
