// The energy of paper 001, eqs. (8)–(10), as rows of a least squares problem for the mapping's parameters.
#pragma once

#include "core/errors/result.hpp"
#include "core/irbf/basis.hpp"
#include "core/irbf/body.hpp"

namespace handlebody {

/** Three perpendicular edges per sphere. Eq. (8) squares a residual weighted by w = ‖e‖^α, so every row carries √w. */
struct SphereEnergy {
  Points edges;       // 3B×3: √w e
  Vector edge_scale;  // 3B: 1/√w
  MatrixXd rows;      // Z₁, 3B × (4 + C): √w [e 0 Δφ]
};

/** `exponent` is α. Fails as the basis does. */
Result<SphereEnergy> make_sphere_energy(const Body& body, const Basis& basis, double exponent);

/** λ chosen from the data: a fixed part, 0.02, of the curvature that a coefficient has by itself in eq. (9), on average over the
 * centers Σ w‖Δφ_c‖². So eq. (10) keeps its balance whatever the model's size, the number of spheres and of centers, their weights
 * by α and the width of the kernel, all of which change that curvature: for widths from 1 to 6 spacings by a factor of a hundred.
 *
 *  The part was picked by sweeps of λ over nine decades on a bar bent by 90° (5 to 18 spheres, 100 and 300 centers, widths 1 to 4)
 *  and the dog with a paw lifted (200 and 400 centers, widths 1.5 to 6), by the total distortion of tetrahedra and, on the dog, by
 *  how little the other leg moves. Distortion is then within about a third of the least of any λ on the bar and, for widths to 4,
 *  the dog of 200 centers. With 400 centers and widths of 3 or 4 far smaller λ do well, and it is two to three times the least: a
 *  part that is safe for few centers is cautious for many. Of the other rules that were tried, a fixed λ fails where the width
 *  changes, and a part of Σ w‖e‖² over the number of centers is as good at one width and 20 times too large at twice that. */
double automatic_smoothness(const SphereEnergy& energy);

}  // namespace handlebody
