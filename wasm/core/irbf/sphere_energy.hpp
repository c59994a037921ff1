// The energy of paper 001, eqs. (8)–(10), as rows of a least squares problem for the mapping's parameters.
#pragma once

#include "core/errors/result.hpp"
#include "core/irbf/basis.hpp"
#include "core/irbf/body.hpp"
#include "core/irbf/sphere_structure.hpp"

namespace handlebody {

/** Three perpendicular edges per sphere. Eq. (8) squares a residual weighted by w = ‖e‖^α, so every row carries √w.
 *
 *  A structure of more edges E (n×3, weighted) has as much to say of a sphere's map M as three do: with E = Q R, Q of three
 * orthogonal columns, ‖E Mᵀ − E′‖² = ‖R Mᵀ − Qᵀ E′‖² + ‖(I − Q Qᵀ) E′‖². So R and Qᵀ Z take the place of edges and rows, and what
 * is beside them, a bend, say, wants to vanish whatever M is: an iteration takes no longer.
 *
 *  An ellipsoid's w is that of a sphere as thick, for each thickness of its length: it counts as the row of spheres in whose place
 *  it stands. */
struct SphereEnergy {
  Points edges;       // 3B×3: √w e
  Vector edge_scale;  // 3B: 1/√w
  MatrixXd rows;      // Z₁, 3B × (4 + C): √w [e 0 Δφ]
  double curvature = 0;  // Σ w‖Δφ‖² of the rows, of an ellipsoid as if it were no longer than thick: λ is not to follow from bones
  MatrixXd beside;  // (I − Q Qᵀ) √w [e 0 Δφ]: no rows for a sphere of six points
};

/** `exponent` is α. Fails as the basis does. */
Result<SphereEnergy> make_sphere_energy(const Body& body, const Basis& basis, double exponent,
                                        SphereStructure structure = SphereStructure::octahedron);

/** λ chosen from the data: 3e-4 Σ w‖Δφ‖², over all centers and the edges of all spheres. Coefficients of normalized kernels are
 * about as large as the function that they make up, however many centers do so: λ‖c‖² would grow with C, and Σ w‖Δφ‖² falls with
 * it. So eq. (10) keeps its balance whatever the number of centers and spheres, the model's size, the weights by α and the width of
 * the kernel.
 *
 *  The part was picked together with α, the width and the Poisson ratio, for how little the tips of fourteen models leak and how
 *  well they keep their volume (npm run bench -- leakage), and for the distortion of a bent bar (npm run bench -- irbf): more of it
 *  leaks less, loses more volume and distorts the bar more. Rejected: 0.02 of Σ w‖Δφ‖²/C, under which 400 centers leak more than
 * 100, and C² times as much as now, under which a bar with many centers is too soft. */
double automatic_smoothness(const SphereEnergy& energy);

}  // namespace handlebody
