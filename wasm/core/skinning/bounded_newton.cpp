#include "core/skinning/bounded_newton.hpp"

#include <cmath>
#include <utility>

namespace handlebody {

namespace {

constexpr int most_conjugate_steps = 60;

}  // namespace

BoundedNewton::BoundedNewton(BoundedProblem& problem, const Matrix& guess, Indices order)
    : problem_(&problem), order_(std::move(order)), diagonal_(problem.energy().diagonal()) {
  const Index m = problem.load().rows(), h = problem.load().cols();
  active_.resize(m * h);
  shared_.resize(m);
  parts_.resize(h);
  x_.resize(m, h);
  change_.resize(m, h);
  for (Vector* vector : {&multiplier_, &force_, &column_, &residual_, &direction_, &image_}) vector->resize(m);
  this->guess(guess);
}

void BoundedNewton::guess(const Matrix& feasible) {
  for (std::size_t k = 0; k < active_.size(); ++k) active_[k] = feasible.data()[k] <= 0;
  find_multipliers();
}

/** λ from the forces where no bound holds; and the rows in which more than one weight is free. */
void BoundedNewton::find_multipliers() {
  const Matrix& forces = problem_->forces();
  const Index h = forces.cols();
  for (Index i = 0; i < forces.rows(); ++i) {
    double sum = 0;
    int count = 0;
    for (Index j = 0; j < h; ++j) {
      if (active_[i * h + j]) continue;
      sum += forces(i, j);
      ++count;
    }
    multiplier_[i] = -sum / count;
    shared_[i] = count > 1;
  }
}

bool BoundedNewton::factor(Index handle) {
  const Index h = x_.cols();
  Indices rows, position(shared_.size(), no_index);
  for (std::uint32_t i = 0; i < shared_.size(); ++i) {
    if (!shared_[i] || active_[i * h + handle]) continue;
    position[i] = static_cast<std::uint32_t>(rows.size());
    rows.push_back(i);
  }
  auto& part = parts_[handle];
  if (part && part->free() == rows) return true;
  Indices order;  // these rows, in the order of all rows
  order.reserve(rows.size());
  for (const std::uint32_t i : order_)
    if (position[i] != no_index) order.push_back(position[i]);
  auto made = MinQuadWithFixed::create(problem_->energy(), std::move(rows), {.columns = 1, .order = std::move(order)});
  if (!made) return false;
  part = std::move(*made);
  return part->succeeded();
}

void BoundedNewton::solve_handles(double enough) {
  const Index m = x_.rows(), h = x_.cols();
  for (Index j = 0; j < h; ++j) {
    for (Index i = 0; i < m; ++i) column_[i] = !shared_[i] && !active_[i * h + j] ? 1 : 0;
    force_ = -problem_->load().col(j) - multiplier_;
    parts_[j]->solve(force_, column_);
    x_.col(j) = column_;
  }
  for (Index i = 0; i < m; ++i) residual_[i] = shared_[i] ? x_.row(i).sum() - 1 : 0;

  double before = 0;
  for (int round = 0; round < most_conjugate_steps; ++round) {
    image_.noalias() = problem_->energy() * residual_;
    const double size = residual_.dot(image_);
    if (!(size > enough)) break;
    for (Index i = 0; i < m; ++i) {
      const double along = round > 0 ? size / before * direction_[i] : 0;
      direction_[i] = shared_[i] ? image_[i] + along : 0;
    }
    before = size;
    for (Index j = 0; j < h; ++j) {
      column_.setZero();
      parts_[j]->solve(direction_, column_);
      change_.col(j) = column_;
    }
    image_ = change_.rowwise().sum();
    const double curvature = direction_.dot(image_);
    if (!(curvature > 0)) break;
    const double length = size / curvature;
    residual_ -= length * image_;
    x_ -= length * change_;
  }
}

Index BoundedNewton::step(double tolerance) {
  solve_handles(0.01 * tolerance * problem_->best_energy());
  problem_->evaluate(x_);
  if (problem_->solved(tolerance)) return 0;
  find_multipliers();
  const Index changed = update_active(0.01 * tolerance * problem_->best_energy() / static_cast<double>(x_.rows()));
  find_multipliers();
  return changed;
}

/** Fixes at 0 the weights that fell below it, and releases those that the forces pull up, except for differences too small to show
 * in the energy. Returns how many changed. Every row keeps its greatest weight. */
Index BoundedNewton::update_active(double pull) {
  const Matrix& forces = problem_->forces();
  const Index m = x_.rows(), h = x_.cols();
  Index changed = 0;
  for (Index i = 0; i < m; ++i) {
    const double depth = std::sqrt(pull / diagonal_[i]);
    for (Index j = 0; j < h; ++j) {
      unsigned char& active = active_[i * h + j];
      const unsigned char now = active ? forces(i, j) + multiplier_[i] > -pull : x_(i, j) < -depth;
      changed += now != active;
      active = now;
    }
  }
  return changed;
}

}  // namespace handlebody
