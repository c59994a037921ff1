// The curvature of the sphere energy over the rotations of the spheres, or over their similarities, factored once for a set of
// handles.
//
// With the mapping solved for, eq. (10) is a function of the rotations alone: F = rhsᵀ(I − hat) rhs. Local/global iterations take
// steps that bound its curvature by that of hat = 0. They are slow for the long waves, where a limb's spheres turn together, since
// I − hat hardly resists these. The Gauss-Newton Hessian at rest, kept in the spheres' own frames, has that small curvature. A
// sphere that may grow has a fourth number beside the three of its turn: the logarithm of its scale.
//
// Where volume is resisted, the fourth is a pressure q: the target of a sphere's edges is R (I + q cof F) instead of R. With it the
// energy is F's least over turns and its greatest over pressures, since κ (J − 1)² = max over q of −2q (J − 1) − q²/κ. Newton's
// equations [A Bᵀ; B −C] are solved by two Cholesky factors, C's and that of A + Bᵀ C⁻¹ B.
//
// At rest most bends are solved in some ten iterations. Far from it the Hessian is another: where a solve drags on, it is made
// again for the turns at hand, with the residual's part where that leaves it definite.
//
// Rejected: Anderson acceleration without it, ten times as many iterations; a Hessian factored in every iteration, which takes as
// long as sixty of them.
#pragma once

#include <optional>
#include <vector>

#include "core/numerics/decompositions.hpp"

namespace handlebody {

/** What of a sphere's map is free: eq. (8)'s closest rigid map, or §4.5's closest similarity. */
enum class SphereFit : unsigned { rigid = 0, similarity = 1 };

class RotationHessian {
 public:
  RotationHessian() = default;

  /** `edges` √w e (3B×3), `hat` of ReducedSystem, `volume` κ. Stays empty where there are too many spheres for it to pay off. */
  RotationHessian(const Points& edges, const MatrixXd& hat, SphereFit fit = SphereFit::rigid, double volume = 0);

  bool empty() const { return !factor_.has_value(); }

  /** Makes it again where the spheres' edges are `mapped` and their turns `turns`, for the residual Γ₁ − Z₁Π. Of spheres that are
   *  rigid only; false, and as before, where there are no factors. */
  bool renew(const Columns3& mapped, const MatrixXd& hat, const Columns3& residual, const std::vector<Matrix3>& turns);

  /** Turns (and scales) the spheres' maps by the Newton step, from the residual Γ₁ − Z₁Π at them. Allocates nothing. */
  void step(const Points& edges, const Columns3& residual, const std::vector<Matrix3>& maps, std::vector<Matrix3>& stepped);

  /** Turns the spheres, whose edges the targets take to `mapped`, and takes `pressure` from the energy's derivatives by the
   * spheres' pressures, halved, to the pressures' steps. Allocates nothing. */
  void step(const Columns3& mapped, const Columns3& residual, const std::vector<Matrix3>& turns, Vector& pressure,
            std::vector<Matrix3>& stepped);

 private:
  bool factor(const Columns3& edges, const MatrixXd& hat, const Columns3* residual);

  Index freedoms_ = 3;  // of a sphere
  double volume_ = 0;
  std::vector<Matrix3> turned_;  // the spheres' turns where it was made: at rest there are none
  std::optional<Cholesky> factor_, pressure_factor_;
  MatrixXd coupling_, transposed_;  // B (B×3B), Bᵀ
  Vector gradient_, pulled_, torques_;
};

}  // namespace handlebody
