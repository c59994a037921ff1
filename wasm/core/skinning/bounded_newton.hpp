// Bounded weights by Newton's method with primal–dual active sets (Hintermüller, Ito & Kunisch 2002): exact, mostly in 3 to 12
// steps, from a guess of the bounds that hold.
//
// At the minimum, forces are Yᵢⱼ = μᵢⱼ − λᵢ: λ for the sum of a row, μ ≥ 0 for a bound that holds, 0 for others. A step minimizes
// the energy with the bounds that are thought to hold as equations. Given λ, the handles' equations are independent of each other:
//
//   Bⱼ xⱼ = −Fⱼ − λ   on the vertices where handle j's weight is neither 0 nor 1, for which it has a factorization of its own.
//
// Σⱼ xⱼ = 1 then is an equation Σⱼ Bⱼ⁻¹ λ = …, which conjugate gradients solve in 3 to 12 rounds with B as preconditioner: a sum of
// inverses of B's parts is nearly the inverse of B.
#pragma once

#include <memory>
#include <vector>

#include "core/numerics/min_quad_with_fixed.hpp"
#include "core/skinning/bounded_problem.hpp"

namespace handlebody {

class BoundedNewton {
 public:
  /** `problem` must outlive it and be evaluated; a bound holds where `guess` (feasible) is 0. `order`: of elimination, for B. */
  BoundedNewton(BoundedProblem& problem, const Matrix& guess, Indices order);

  /** Factors B among the vertices where this handle's weight is neither 0 nor 1, unless they are the same as before. To be called
   * for every handle before each step. False where that is not possible: there is nothing more to do then. */
  bool factor(Index handle);

  /** Solves, evaluates, and decides anew which bounds hold. Returns how many of these changed; at 0 the minimum is found. Exact to
   * a hundredth of `tolerance`, a part of the energy. */
  Index step(double tolerance);

  /** Starts again from another guess, with the factorizations there are. */
  void guess(const Matrix& feasible);

 private:
  void find_multipliers();
  void solve_handles(double tolerance);
  Index update_active(double pull);

  BoundedProblem* problem_;
  Indices order_;
  Vector diagonal_;                                       // of B
  std::vector<unsigned char> active_;                     // m × handles: xᵢⱼ is held at 0
  std::vector<unsigned char> shared_;                     // rows in which two weights or more are not
  std::vector<std::unique_ptr<MinQuadWithFixed>> parts_;  // Bⱼ
  Matrix x_, change_;
  Vector multiplier_;  // λ
  Vector force_, column_, residual_, direction_, image_;
};

}  // namespace handlebody
