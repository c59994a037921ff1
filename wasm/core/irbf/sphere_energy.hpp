// The energy of paper 001, eqs. (8)–(10), as rows of a least squares problem: what the spheres say of the mapping's parameters.
#pragma once

#include "core/irbf/basis.hpp"
#include "core/irbf/body.hpp"
#include "core/numerics/dense.hpp"
#include "core/numerics/result.hpp"

namespace handlebody {

/** Three perpendicular edges a sphere. Eq. (8) squares a residual weighted by w = ‖e‖^α, so every row carries √w. */
struct SphereEnergy {
  Points edges;       // 3B×3: √w e
  Vector edge_scale;  // 3B: 1/√w
  MatrixXd rows;      // Z₁, 3B × (4 + C): √w [e 0 Δφ]
};

/** `exponent` is α. Fails as the basis does. */
Result<SphereEnergy> make_sphere_energy(const Body& body, const Basis& basis, double exponent);

/** λ chosen from the data: coefficients as large as the model shall cost `automatic_part` of what collapsing every sphere would,
 *  λ C = part · Σ w‖e‖². The sum grows with the number of spheres and with α's weights, C with the centers that share a
 * displacement among them, and neither depends on the model's size: so the balance of eq. (10) stays where any of them changes. */
double automatic_smoothness(const SphereEnergy& energy);

}  // namespace handlebody
