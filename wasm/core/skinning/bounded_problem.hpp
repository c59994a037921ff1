// Bounded weights as a convex problem in the weights x of the m free vertices, m × handles:
//
//   minimize E(x) = E₀ + ⟨F, x⟩ + ½ ⟨x, B x⟩   where   xᵢⱼ ≥ 0 and Σⱼ xᵢⱼ = 1,
//
// with B the energy's matrix among free vertices, F the part of the forces that held vertices add to B x, and E₀ their own energy.
#pragma once

#include "core/numerics/sparse.hpp"
#include "core/skinning/held_vertices.hpp"

namespace handlebody {

/** w (h numbers) ← the nearest w with w ≥ 0 and Σ w = 1 (Michelot 1986). */
void project_to_simplex(double* w, Index h);

/** The problem, and the best that was found so far. */
class BoundedProblem {
 public:
  /** `energy`: of all n vertices; `start`: n × handles, with any rows for held vertices. */
  BoundedProblem(const SparseMatrix& energy, const HeldVertices& held, Matrix start);

  const Indices& free() const { return free_; }           // vertices, ascending
  const SparseMatrix& energy() const { return energy_; }  // B
  const Matrix& load() const { return load_; }            // F
  const Matrix& start() const { return start_; }          // n × handles, eⱼ where handle j holds
  Matrix free_start() const;                              // its rows of free vertices

  /** E(x). */
  double value(const Matrix& x);

  /** For any x: makes it feasible and keeps that if it is the best so far, bounds the least energy from below, and sets forces().
   */
  void evaluate(const Matrix& x);

  /** B x + F of the last x. */
  const Matrix& forces() const { return forces_; }

  /** Energy of the best; the least energy is lower by at most `gap`. */
  double best_energy() const { return best_energy_; }
  double gap() const { return gap_; }

  /** Whether the gap is at most this part of the energy, or rounding. */
  bool solved(double tolerance) const { return gap_ <= tolerance * best_energy_ + rounding_; }

  /** n × handles: the best. */
  Matrix weights() const;

 private:
  Indices free_;
  SparseMatrix energy_;
  Matrix load_, start_;
  double held_energy_ = 0, rounding_ = 0;

  Matrix forces_, feasible_, image_, best_;
  double best_energy_ = 0, bound_ = 0, gap_ = 0;
};

}  // namespace handlebody
