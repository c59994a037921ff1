// Skinning weights of handles: the smoothest functions on a mesh that are 1 at their own handle and 0 at the others (lecture,
// "Weight calculation"; Botsch & Kobbelt 2004, Jacobson et al. 2010).
#pragma once

#include <memory>
#include <vector>

#include "core/mesh/mass_matrix.hpp"
#include "core/numerics/min_quad_with_fixed.hpp"
#include "core/skinning/held_vertices.hpp"

namespace handlebody {

/** Minimizes ∫|∇w|², ∫(Δw)² or ∫|∇Δw|² for the order 1, 2 or 3: wᵀ Q w with the Q of polyharmonic_energy.hpp. Order 1, harmonic,
 * has spikes at point handles; order 2, biharmonic, is smooth but leaves [0, 1]; order 3 is smoother and leaves it farther. Weights
 * always sum to 1.
 *
 * The matrix is factored for the first handles: W = Q_ff⁻¹ (−Q_fp) (lecture's x = −A⁻¹ B y). Later ones are small updates of that:
 * a newly held vertex adds the response to a force there, a released one its own weight function, with coefficients from a dense
 * system. Each function takes one solve unless it is known; where these add up to more than a new factorization, there is one.
 *
 * Products of the cotangents of nearly flat simplices may drown the others in rounding, so that Q cannot be factored or weights do
 * not sum to 1. Such simplices then count as thicker than they are, as polyharmonic_energy() has it, as little as helps. */
class PolyharmonicWeights {
 public:
  /** MESH_* as check_simplex_mesh(); INVALID_OPTION for an order other than 1, 2 or 3; OUT_OF_MEMORY as polyharmonic_energy(). */
  static Result<std::unique_ptr<PolyharmonicWeights>> create(SimplexMesh mesh, int order, Mass mass);

  /** Computes the weights. HANDLE_* as complete(), OUT_OF_MEMORY, or SYSTEM_SINGULAR where triangles are too thin for double
   * precision; the former handles and weights then stay. */
  Result<Done> set_handles(HeldVertices held);

  /** n × handles: rows sum to 1, e_j at vertices that handle j holds. */
  const Matrix& weights() const { return weights_; }
  const HeldVertices& held() const { return held_; }
  const std::vector<Island>& islands() const { return islands_; }

  /** Whether the last set_handles() factored anew. */
  bool factored() const { return factored_; }

  const SimplexMesh& mesh() const { return mesh_; }
  const SparseMatrix& energy() const { return energy_; }
  const Vector& mass() const { return mass_; }

 private:
  /** How other handles differ from the factored ones. */
  struct Change {
    std::vector<std::uint32_t> target;  // for each factored handle, the handle that its vertices belong to now, or none
    Indices released, added;            // vertices
    Indices new_owner;                  // of each added vertex
  };

  PolyharmonicWeights() = default;

  Result<Done> set_energy(double thinnest);
  /** What a factorization of the present energy gives. */
  struct Attempt {
    std::unique_ptr<MinQuadWithFixed> solver;
    Matrix weights;
    double error;  // the most that a row's sum differs from 1; infinite where Q could not be factored
  };

  Result<Done> factor(const HeldVertices& held);
  Result<Attempt> attempt(const HeldVertices& held, const Indices& free) const;
  bool find_change(const HeldVertices& held, Change& change) const;
  bool pays(const Change& change) const;
  bool update(const HeldVertices& held, const Change& change);

  SimplexMesh mesh_;
  Indices parts_;
  int order_ = 2;
  double thinnest_ = 0;  // of the simplices in energy_
  SparseMatrix energy_;
  Vector mass_;

  std::unique_ptr<MinQuadWithFixed> solver_;
  HeldVertices factored_held_;
  Indices factored_owner_of_;  // of each vertex, or `no_index`
  Matrix factored_weights_;

  Matrix weights_;
  HeldVertices held_;
  std::vector<Island> islands_;
  bool factored_ = false;
};

}  // namespace handlebody
