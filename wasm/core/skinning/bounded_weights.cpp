#include "core/skinning/bounded_weights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace handlebody {

// What was tried on a gingerbread man of 2,250 vertices and 6 handles, processor time; libigl's bbw took 690 ms, 250 with 8 active
// sets:
//   sweeps, then Newton's method, λ by conjugate gradients   140 ms   taken: 40 sweeps of 0.8 ms, 9 steps of 12 ms; exact
//   the same, all handles' equations in one matrix           75 ms a step and more (SuperLU): 700,000 entries in its factor
//   Newton's method from the clamped unbounded weights       16 to 25 steps: bounds spread by about a ring of vertices a step
//   sweeps alone                                             energy 0.1% too high after 200
//   sweeps with Anderson's acceleration                      0.01% after 80, 1 ms each; but of two handles 0.1% after 200
//   penalties that grow by 3 or 10, by Newton's method       left 0.1% to 2% (on 600 vertices)
//   D = M for the sweeps                                     twice as many on a graded mesh
// Not tried: interior-point methods, which factor (handles − 1)³ times the work of one handle in each of 13 to 19 steps (Clarabel's
// count).
namespace {

constexpr int least_sweeps = 40, most_newton_steps = 30;
constexpr double most_factor_bytes = 1024.0 * 1024 * 1024;

}  // namespace

Result<std::unique_ptr<BoundedWeights>> BoundedWeights::create(const SparseMatrix& energy, const Vector& mass,
                                                               const HeldVertices& held, const Matrix& start,
                                                               const BoundedWeightsOptions& options) {
  std::unique_ptr<BoundedWeights> made(new BoundedWeights);
  BoundedWeights& self = *made;
  self.options_ = options;
  self.problem_ = std::make_unique<BoundedProblem>(energy, held, start);
  self.evaluated();
  if (self.done()) return made;

  // Every handle's own equations are some of all rows, for which this order is good too.
  self.order_ = minimum_degree_order(self.problem_->energy());
  auto sweeps = BoundedSweeps::create(*self.problem_, mass, self.order_);
  if (!sweeps) return sweeps.error();
  self.sweeps_ = std::move(*sweeps);
  self.most_sweeps_ = least_sweeps;
  const double entries = self.sweeps_->solve_cost() / 2 * static_cast<double>(held.handle_count);
  self.newton_fits_ = entries * (sizeof(double) + sizeof(std::uint32_t)) < most_factor_bytes;
  return made;
}

void BoundedWeights::evaluated() {
  report_.energy = problem_->best_energy();
  report_.gap = problem_->gap();
  if (problem_->solved(options_.tolerance)) phase_ = Phase::done;
}

double BoundedWeights::step() {
  switch (phase_) {
    case Phase::sweep:
      sweep();
      break;
    case Phase::factor:
      if (!newton_->factor(handle_)) {
        newton_fits_ = false;
        phase_ = Phase::sweep;
      } else if (++handle_ == problem_->load().cols()) {
        phase_ = Phase::solve;
      }
      break;
    case Phase::solve:
      newton_step();
      break;
    case Phase::done:
      return 1;
  }
  if (report_.sweeps + report_.newton_steps >= options_.most_steps) phase_ = Phase::done;
  return phase_ == Phase::done ? 1 : progress_;
}

void BoundedWeights::sweep() {
  sweeps_->sweep();
  ++report_.sweeps;
  progress_ = std::max(progress_, 0.3 * ++sweep_ / most_sweeps_);
  if (sweep_ < most_sweeps_) return;
  sweep_ = 0;
  problem_->evaluate(sweeps_->x());
  evaluated();
  if (phase_ != Phase::done && newton_fits_) start_newton();
}

void BoundedWeights::start_newton() {
  if (newton_)
    newton_->guess(sweeps_->projected());
  else
    newton_ = std::make_unique<BoundedNewton>(*problem_, sweeps_->projected(), order_);
  newton_step_ = 0;
  handle_ = 0;
  phase_ = Phase::factor;
}

void BoundedWeights::newton_step() {
  const Index changed = newton_->step(options_.tolerance);
  ++report_.newton_steps;
  progress_ = std::max(progress_, 1 - 0.7 * std::exp(-0.2 * ++newton_step_));
  evaluated();
  handle_ = 0;
  if (changed == 0) {
    phase_ = Phase::done;
  } else if (newton_step_ < most_newton_steps) {
    phase_ = Phase::factor;
  } else {
    most_sweeps_ *= 2;
    phase_ = Phase::sweep;
  }
}

}  // namespace handlebody
