#include "core/skinning/bounded_problem.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "core/numerics/min_quad_with_fixed.hpp"

namespace handlebody {

void project_to_simplex(double* w, Index h) {
  // max(w − θ, 0), where θ depends only on the numbers above it: fewer of them with each round, or, where rounding hides the 1,
  // none.
  double theta = -1e300, sum = 0;
  for (Index before = h + 1, count = 0;; before = count) {
    count = 0;
    sum = 0;
    for (Index j = 0; j < h; ++j) {
      if (!(w[j] > theta)) continue;
      sum += w[j];
      ++count;
    }
    if (count == 0 || count >= before) break;
    theta = (sum - 1) / static_cast<double>(count);
  }
  sum = 0;
  const Index largest = std::max_element(w, w + h) - w;
  for (Index j = 0; j < h; ++j) sum += w[j] = std::max(w[j] - theta, 0.0);
  if (!(sum > 0)) {
    std::fill(w, w + h, 0.0);
    w[largest] = sum = 1;
  }
  for (Index j = 0; j < h; ++j) w[j] /= sum;
}

BoundedProblem::BoundedProblem(const SparseMatrix& energy, const HeldVertices& held, Matrix start) : start_(std::move(start)) {
  const Index n = energy.rows(), h = held.handle_count;
  Matrix fixed = Matrix::Zero(n, h);
  std::vector<bool> is_held(n, false);
  for (std::size_t k = 0; k < held.vertices.size(); ++k) {
    is_held[held.vertices[k]] = true;
    fixed(held.vertices[k], held.owners[k]) = 1;
    start_.row(held.vertices[k]) = fixed.row(held.vertices[k]);
  }
  for (std::uint32_t v = 0; v < is_held.size(); ++v)
    if (!is_held[v]) free_.push_back(v);
  FreeRows rows = free_rows(energy, free_);
  energy_.swap(rows.among_free);
  load_.noalias() = rows.to_fixed * fixed;
  image_.noalias() = energy * fixed;
  held_energy_ = fixed.cwiseProduct(image_).sum() / 2;
  rounding_ = 1e-14 * energy_.diagonal().sum();
  best_energy_ = std::numeric_limits<double>::infinity();
  evaluate(free_start());
}

Matrix BoundedProblem::free_start() const {
  Matrix x(std::ssize(free_), start_.cols());
  for (Index k = 0; k < x.rows(); ++k) x.row(k) = start_.row(free_[k]);
  return x;
}

double BoundedProblem::value(const Matrix& x) {
  image_.noalias() = energy_ * x;
  return held_energy_ + x.cwiseProduct(image_ / 2 + load_).sum();
}

/** The lower bound: with the forces Y = B x + F, x minimizes E − ⟨Y, ·⟩, and ⟨Y, ·⟩ is least on a corner of each row's simplex. */
void BoundedProblem::evaluate(const Matrix& x) {
  forces_.noalias() = energy_ * x;
  double below = held_energy_ - x.cwiseProduct(forces_).sum() / 2;
  forces_ += load_;
  for (Index i = 0; i < x.rows(); ++i) below += forces_.row(i).minCoeff();
  bound_ = std::max(bound_, below);

  feasible_ = x.cwiseMax(0.0);
  for (Index i = 0; i < x.rows(); ++i) feasible_.row(i) /= feasible_.row(i).sum();
  const double energy = value(feasible_);
  if (energy < best_energy_) {
    best_ = feasible_;
    best_energy_ = energy;
  }
  gap_ = std::max(best_energy_ - bound_, 0.0);
}

Matrix BoundedProblem::weights() const {
  Matrix weights = start_;
  for (Index k = 0; k < best_.rows(); ++k) weights.row(free_[k]) = best_.row(k);
  return weights;
}

}  // namespace handlebody
