// Shape deformation by interior radial basis functions (Levi & Levin, paper 001): positional constraints, local/global optimization
// of sphere distortion (§2.3, §4.6), on the reduced matrix that never touches centers or vertices.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/errors/result.hpp"
#include "core/irbf/handle_constraints.hpp"
#include "core/irbf/local_global.hpp"
#include "core/irbf/prepared_body.hpp"
#include "core/numerics/closest_rotation.hpp"

namespace handlebody {

struct SolveOptions {
  int max_iterations = 100;
  double tolerance = 1e-5;  // of the diagonal
  bool accelerate = true;
};

struct SolveReport {
  double energy = 0;        // eq. (10), with the soft constraints' misfit; solver space
  double anchor_error = 0;  // model units
  double change = 0;        // largest movement of a sphere edge in the last iteration, solver space
  int iterations = 0;
  bool converged = false;
};

class Irbf {
 public:
  static constexpr Index target_size = HandleConstraints::target_size;
  static constexpr Index shape_size = 9;

  /** Of a body that is prepared for it. Fails as PreparedBody::create does. */
  static Result<std::unique_ptr<Irbf>> create(Body body, const IrbfOptions& options);

  /** Another deformation of a body, at rest and without handles. */
  explicit Irbf(std::shared_ptr<const PreparedBody> body);

  /** To be shared with further deformations of the same body. */
  const std::shared_ptr<const PreparedBody>& prepared() const { return prepared_; }

  /** Sets the handles at `points` (k×3, model units); builds and factors the system. On failure the former handles stay. */
  Result<Done> set_handles(const ConstPoints& points, const std::vector<HandleKind>& kinds);

  Index handle_count() const { return constraints_.handles(); }

  /** target_size numbers per handle, in model units; at rest after set_handles. Written in place by the caller. */
  double* targets() { return targets_.data(); }

  /** What each sphere is to become, eq. (11): the rows of a linear map S of its edges at rest, shape_size numbers. The identity at
   *  first; written in place by the caller, read by solve(). */
  double* shapes() { return shapes_.data(); }

  /** Local/global iterations from the last solution until no sphere edge moves more than the tolerance. Goes on where it stopped
   *  when targets and shapes are still the same. Fails with HANDLES_MISSING, TARGET_NOT_FINITE, HANDLE_CONFLICT or SHAPE_INVERTED;
   * the last solution stays then. */
  Result<SolveReport> solve(const SolveOptions& options);

  /** Deformed vertices as stored, model units (vertex count × 3), and their normals if wanted. `rest_normals` are the authored ones
   *  to turn, or null for area-weighted normals. Allocates nothing. */
  void deform(float* positions, const float* rest_normals, float* normals);

  /** The deformation of any points (k×3, model units), in double precision. Far outside the model the affine part dominates, with
   *  the basis of the nearest voxels. Fails with QUERY_NOT_FINITE, or as Basis::evaluate does. */
  Result<Points> evaluate(const ConstPoints& points) const;

  /** How the present deformation treats volume and shape: on `tetrahedra` of vertices as stored (m×4), or on those that voxels make
   *  where there are none. Fails with MESH_INDEX_OUT_OF_RANGE, OUT_OF_MEMORY, or as Basis::evaluate does. */
  Result<Quality> quality(const Eigen::Ref<const Tetrahedra>& tetrahedra);

  Index vertex_count() const { return prepared_->body.positions.rows(); }
  const Body& body() const { return prepared_->body; }
  const Basis& basis() const { return prepared_->basis; }
  /** λ, as given or as chosen. */
  double smoothness() const { return prepared_->smoothness; }
  /** Condition number of the equations for the present handles; 0 before there are any. */
  double condition() const { return system_.condition; }

 private:
  /** What a solve writes to, allocated once. */
  struct Workspace {
    Points targets, displacements;  // of the constraint points
    Columns3 solution;              // 4 + C
    Columns3 missed;                // constraints
    std::vector<Matrix3> warm;      // B
    std::vector<double> solved_targets, solved_shapes;
  };

  Result<Done> check_shapes() const;
  void begin(const RigidMotion& frame);

  std::unique_ptr<const FrameKernel> make_handle_kernel(const ReducedSystem& system) const;

  std::shared_ptr<const PreparedBody> prepared_;
  PointsF displacement_, deformed_, deformed_normals_;  // welded, solver space
  FrameKernel::Scratch frame_;
  std::unique_ptr<const FrameKernel> handle_kernel_;  // [x 1 Ψ] Z†, times the right-hand side of spheres and handles
  FrameKernel::Scratch handle_frame_;

  HandleConstraints constraints_;
  ReducedSystem system_;
  LocalGlobal local_global_;
  std::vector<double> targets_, shapes_;
  Workspace work_;

  // The last solution, solver space: the displacement linear·x + translation + Ψ·coefficients.
  bool solved_ = false;
  std::vector<Matrix3> maps_;  // M_b of every sphere
  Matrix3 linear_ = Matrix3::Zero();
  Vector3 translation_ = Vector3::Zero();
  Matrix coefficients_;
  // The same in the handles' product: the displacement linear·x + translation + [x 1 Ψ] Z†·right_hand_side.
  bool by_handles_ = false;
  Matrix3 carried_linear_ = Matrix3::Zero();
  Vector3 carried_translation_ = Vector3::Zero();
  Matrix right_hand_side_;
};

}  // namespace handlebody
