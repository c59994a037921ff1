// Shape deformation by interior radial basis functions (Levi & Levin, paper 001): positional constraints, local/global optimization
// of sphere distortion (§2.3, §4.6), on the reduced matrix that never touches centers or vertices.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/errors/result.hpp"
#include "core/irbf/basis.hpp"
#include "core/irbf/body.hpp"
#include "core/irbf/frame_kernel.hpp"
#include "core/irbf/handle_constraints.hpp"
#include "core/irbf/local_global.hpp"
#include "core/irbf/quality.hpp"
#include "core/irbf/reduced_system.hpp"
#include "core/mesh/vertex_normals.hpp"
#include "core/mesh/weld.hpp"

namespace handlebody {

struct IrbfOptions {
  /** Radial; its width h in mean center spacings. */
  Kernel kernel = Kernel::of(KernelKind::inverse_multiquadric, 2, 3);
  double smoothness = 0;       // λ of eq. (10); 0 chooses it, see sphere_energy.hpp
  double anchor_weight = 100;  // μ
  double edge_exponent = -1;   // α of eq. (8)
  ConstraintKind constraints = ConstraintKind::soft;
  FramePrecision precision = FramePrecision::fixed;
};

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

  /** Takes a body (checked here) and evaluates the basis at its spheres and vertices. Fails with BODY_INVALID, INVALID_OPTION,
   *  OUT_OF_MEMORY, or as Basis::evaluate does. */
  static Result<std::unique_ptr<Irbf>> create(Body body, const IrbfOptions& options);

  /** Sets the handles at `points` (k×3, model units); builds and factors the system. On failure the former handles stay. */
  Result<Done> set_handles(const ConstPoints& points, const std::vector<HandleKind>& kinds);

  Index handle_count() const { return constraints_.handles(); }

  /** target_size numbers per handle, in model units; at rest after set_handles. Written in place by the caller. */
  double* targets() { return targets_.data(); }

  /** Local/global iterations from the last solution until no sphere edge moves more than the tolerance. Goes on where it stopped
   *  when the targets are still the same. On failure the last solution stays. */
  Result<SolveReport> solve(const SolveOptions& options);

  /** Deformed vertices as stored, model units (vertex count × 3), and their normals if wanted. `rest_normals` are the authored ones
   *  to turn, or null for area-weighted normals. Allocates nothing. */
  void deform(float* positions, const float* rest_normals, float* normals);

  /** The deformation of any points (k×3, model units), in double precision. Far outside the model the affine part dominates, with
   *  the basis of the nearest voxels. Fails as Basis::evaluate does. */
  Result<Points> evaluate(const ConstPoints& points) const;

  /** How the present deformation treats volume and shape: on `tetrahedra` of vertices as stored (m×4), or on those that voxels make
   *  where there are none. Fails with MESH_INDEX_OUT_OF_RANGE, OUT_OF_MEMORY, or as Basis::evaluate does. */
  Result<Quality> quality(const Eigen::Ref<const Tetrahedra>& tetrahedra);

  Index vertex_count() const { return body_.positions.rows(); }
  const Body& body() const { return body_; }
  const Basis& basis() const { return *basis_; }
  /** λ, as given or as chosen. */
  double smoothness() const { return smoothness_; }
  /** Condition number of the equations for the present handles; 0 before there are any. */
  double condition() const { return system_.condition; }

 private:
  /** What a solve writes to, allocated once. */
  struct Workspace {
    Points targets, displacements;  // of the constraint points
    Columns3 solution;              // 4 + C
    Columns3 missed;                // constraints
    std::vector<Matrix3> warm;      // B
    std::vector<double> solved_targets;
  };

  Irbf() = default;
  Result<Done> prepare_spheres();
  Result<Done> prepare_vertices();
  std::unique_ptr<FrameKernel> make_handle_kernel(const ReducedSystem& system) const;

  IrbfOptions options_;
  Body body_;
  std::unique_ptr<Basis> basis_;
  std::unique_ptr<TriangleTree> surface_;  // made when a handle is set at a point
  double structure_radius_ = 0;            // of a rotation handle's six points
  double smoothness_ = 0;

  MatrixXd edge_rows_;  // 3B × (4 + C): √w [e 0 Δφ]
  MatrixXd gram_;       // lower triangle: edge_rowsᵀ edge_rows + λ on the coefficients

  Weld weld_;
  Triangles welded_triangles_;
  PointsF stored_;                                                            // as stored, model units
  PointsF rest_, displacement_, deformed_, rest_normals_, deformed_normals_;  // welded, solver space
  std::unique_ptr<FrameKernel> frame_kernel_;                                 // Ψ, times the coefficients of the centers
  MatrixF psi_;                                                               // kept where the other product may be the smaller one
  std::unique_ptr<FrameKernel> handle_kernel_;  // [x 1 Ψ] Z†, times the right-hand side of spheres and handles
  ColumnRanges surface_ranges_;                 // of the basis functions over the vertices
  std::unique_ptr<VoxelQuality> voxel_quality_;

  HandleConstraints constraints_;
  ReducedSystem system_;
  std::unique_ptr<LocalGlobal> local_global_;
  std::vector<double> targets_;
  Workspace work_;

  // The last solution, solver space: the displacement linear·x + translation + Ψ·coefficients.
  bool solved_ = false;
  std::vector<Matrix3> rotations_;  // M_b of every sphere
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
