// Minimization of the sphere energy (paper 001, §4.6) over the maps of the spheres, rotations or similarities: local/global
// iterations, whose steps are lengthened by a quasi-Newton direction (rotation_hessian.hpp), combined by Anderson acceleration, and
// guarded by the energy as by Peng et al. (2018). An iteration touches neither centers nor vertices.
//
// The dog, 112 spheres, 400 centers, a paw lifted; iterations from rest to within 10% and 1% of the least energy: local/global
// alone 277, 908; with Anderson (window 8) 40, 78; with the quasi-Newton direction 5, 12; with both 3, 6. An iteration takes the
// same time with each, 0.1 ms.
//
// Where volume is resisted (κ > 0), the energy gains κ Σ w‖e‖² (J − 1)², with J the factor by which a sphere's six points say its
// volume grows (sphere_strain.hpp). Local steps then aim at R + q cof F with the pressure q = −κ (J − 1), where the energy's
// gradient vanishes together with the least squares' one; the quasi-Newton step knows the pressures, too. Near incompressibility
// its steps may raise the energy: the local steps are accelerated in their place then, until the Hessian is made again. Spot, 32
// drags with ν = 0.48, mean iterations, and drags that end at 100: quasi-Newton steps alone 40, 3; with local steps once one was
// refused 39, 3; with the Hessian made again after 15 iterations, too, 19, none; with ν = 0.49 and all three 21, none.
// (Those iterations ended where a local step, shortened for volume's sake, was below the tolerance; now the whole way has to be.)
#pragma once

#include <vector>

#include "core/irbf/rotation_hessian.hpp"
#include "core/irbf/sphere_strain.hpp"
#include "core/numerics/anderson.hpp"

namespace handlebody {

struct LocalGlobalOptions {
  int max_iterations = 100;
  double tolerance = 1e-5;
  bool accelerate = true;
};

struct LocalGlobalReport {
  double energy = 0;  // eq. (10), with the soft constraints' misfit
  double change = 0;  // largest movement of a sphere edge in the last iteration that was kept
  int iterations = 0;
  bool converged = false;
};

class LocalGlobal {
 public:
  /** `edges`: three per sphere, weighted by √w (3B × 3); `edge_scale` 1/√w; `volume` κ, 0 where spheres may grow. */
  LocalGlobal(Points edges, Vector edge_scale, SphereFit fit, double volume = 0);
  // Compiled once, because many places move one.
  LocalGlobal(LocalGlobal&&) noexcept;
  LocalGlobal& operator=(LocalGlobal&&) noexcept;
  ~LocalGlobal();

  /** The matrix of ReducedSystem; must outlive the iterations. Maps stay. */
  void set_system(const MatrixXd& hat);

  /** The same matrix has another place. */
  void follow(const MatrixXd& hat) { hat_ = &hat; }

  /** Constraint rows of the right-hand side, to be written before start(): displacements, weighted. */
  auto constraints() { return right_hand_side_.bottomRows(right_hand_side_.rows() - edges_.rows()); }

  /** Target shapes, eq. (11): nine numbers a sphere, the rows of a linear map S. The identity keeps the sphere. Allocates nothing.
   */
  void shape(const double* shapes);

  /** Puts maps() to what leaves the shapes nearest to the spheres at rest, times `scale`. */
  void rest(double scale);

  /** M_b of every sphere. */
  std::vector<Matrix3>& maps() { return maps_; }

  /** The least energy for given maps and the present constraints. */
  double energy(const std::vector<Matrix3>& maps);

  /** Begins at `maps()`, for which energy() was called last and gave `energy`; forgets earlier steps. */
  void start(double energy);

  /** Goes on from where it stopped. Allocates nothing but where it drags on and the Hessian is made again. Leaves the best maps in
   * maps(), and their right-hand side. */
  LocalGlobalReport run(const LocalGlobalOptions& options);

  /** √w (M_b S − I) e, then the constraints. */
  const Columns3& right_hand_side() const { return right_hand_side_; }

 private:
  void measure();
  Matrix3 closest_map(const Matrix3& covariance, Index sphere) const;
  Matrix3 pressed(const Matrix3& turn, double pressure, Index sphere) const;
  double volume_energy(const std::vector<Matrix3>& maps);
  void plain_step(std::vector<Matrix3>& maps) const;
  void renew_hessian();
  void quasi_newton_step();
  void accelerated_step();

  SphereFit fit_;
  double volume_;
  Points edges_;
  Points shaped_;   // √w S e
  Vector squares_;  // B: Σ w‖S e‖²
  Vector edge_scale_;
  const MatrixXd* hat_ = nullptr;
  RotationHessian hessian_;
  Anderson anderson_;
  Columns3 right_hand_side_, image_;  // and hat times it
  Columns3 residual_;                 // their difference
  Columns3 displaced_;                // the edges' displacements at maps_
  Columns3 mapped_, stepped_;         // shaped edges under the maps, before and after a step
  std::vector<Matrix3> unshaped_;     // the rotations that take the shapes nearest to the spheres at rest
  std::vector<Matrix3> maps_, trial_;
  std::vector<Matrix3> inverse_grams_;  // (Σ w S e (S e)ᵀ)⁻¹
  std::vector<Strain> strains_;         // for the image
  std::vector<Matrix3> turns_;
  Vector held_, pressure_;
  bool newton_ = false;       // whether accelerated steps are quasi-Newton ones
  bool renewed_ = false;      // whether the Hessian was made again since they began
  int patience_ = 0;          // iterations until it is made again, twice as many wherever that did not help
  int age_ = 0;               // iterations since they began, or the Hessian was made again
  double plain_part_ = 1;     // of the way that a plain step goes
  bool stalled_ = false;      // whether not even the shortest lowers the energy
  bool accelerated_ = false;  // whether trial_ holds such a step
  double energy_ = 0;
};

}  // namespace handlebody
