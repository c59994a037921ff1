// Bounded biharmonic weights (Jacobson et al. 2011) of all handles as one convex problem, in which their sum is a constraint:
//
//   minimize ½ Σⱼ wⱼᵀ B wⱼ   where   wᵢⱼ ≥ 0 and Σⱼ wᵢⱼ = 1 at every vertex i,   wᵢⱼ = 1 at the vertices i that handle j holds.
//
// The paper bounds each handle's weights separately and divides rows by their sums afterwards, which costs smoothness: on the
// gingerbread man of 2,250 vertices and 6 handles that energy lies 6% above the least.
#pragma once

#include <memory>

#include "core/skinning/bounded_newton.hpp"
#include "core/skinning/bounded_sweeps.hpp"

namespace handlebody {

struct BoundedWeightsOptions {
  double tolerance = 1e-6;  // of the energy: how far above the least one it may be
  int most_steps = 2000;
};

struct BoundedWeightsReport {
  int sweeps = 0, newton_steps = 0;
  double energy = 0;  // ½ Σⱼ wⱼᵀ B wⱼ
  double gap = 0;     // the least energy is between energy − gap and energy
};

/** Works in steps, so that it can show progress and be stopped at any time: weights() are feasible from the start and only get
 * better. Sweeps (bounded_sweeps.hpp) find out roughly which bounds hold; then Newton's method (bounded_newton.hpp) finds the
 * minimum itself. A duality gap tells how near it is. */
class BoundedWeights {
 public:
  /** `energy`: B, n×n, symmetric, positive semidefinite, rows summing to 0; `mass`: of the n vertices; `start`: n × handles, the
   * unbounded weights of the same handles. Each connected part must have a held vertex. SYSTEM_SINGULAR where B is not positive
   * definite for the free vertices, OUT_OF_MEMORY. */
  static Result<std::unique_ptr<BoundedWeights>> create(const SparseMatrix& energy, const Vector& mass, const HeldVertices& held,
                                                        const Matrix& start, const BoundedWeightsOptions& options = {});

  /** Works for about as long as one of the handles' unbounded weights takes. Returns progress, 1 when it is done. */
  double step();
  bool done() const { return phase_ == Phase::done; }

  /** n × handles: the best weights so far, ≥ 0, e_j where handle j holds; rows sum to 1 but for rounding. */
  Matrix weights() const { return problem_->weights(); }

  /** Where the gap stayed above the tolerance, all steps were used or double precision did not suffice. */
  const BoundedWeightsReport& report() const { return report_; }

 private:
  enum class Phase { sweep, factor, solve, done };

  BoundedWeights() = default;

  void evaluated();
  void sweep();
  void start_newton();
  void newton_step();

  BoundedWeightsOptions options_;
  BoundedWeightsReport report_;
  Phase phase_ = Phase::sweep;
  double progress_ = 0;
  int sweep_ = 0, most_sweeps_ = 0, newton_step_ = 0;
  Index handle_ = 0;
  bool newton_fits_ = false;  // in memory, with one factor per handle

  std::unique_ptr<BoundedProblem> problem_;
  Indices order_;  // of elimination
  std::unique_ptr<BoundedSweeps> sweeps_;
  std::unique_ptr<BoundedNewton> newton_;
};

}  // namespace handlebody
