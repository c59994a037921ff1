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

/** λ chosen from the data: 7e-9 C² Σ w‖Δφ‖², over the C centers and the edges of all spheres. A function made up of C normalized
 *  kernels has coefficients that do not depend on C, so that λ‖c‖² would grow with C, while the curvature of eq. (9) that each
 *  coefficient has by itself falls with C²: with this λ a function costs the same part of the spheres' energy however many centers
 * make it up, whatever the model's size, the number of spheres, their weights by α and the width of the kernel.
 *
 *  The part was picked together with α, the width and the Poisson ratio, for how little tips leak and how well volume is kept on
 * ten animals, and for the distortion of a bent bar (npm run bench -- leakage, irbf): a fourth to four times as much changes the
 * leak of ten animals from 0.53 to 0.46 of ARAP's, and the bar's distortion from 2.5 to 3.9 of it. Rejected: 0.02 of Σ w‖Δφ‖²/C,
 * which is right for 200 centers and too little by nine times for 400. */
double automatic_smoothness(const SphereEnergy& energy);

}  // namespace handlebody
