// Shape deformation by interior radial basis functions (Levi & Levin, paper 001): soft positional constraints (appendix),
// local/global optimization of sphere distortion (§2.3, §4.6), on the reduced matrix that never touches centers or vertices.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/irbf/basis.hpp"
#include "core/irbf/body.hpp"
#include "core/irbf/frame_kernel.hpp"
#include "core/mesh/vertex_normals.hpp"
#include "core/mesh/weld.hpp"
#include "core/numerics/closest_rotation.hpp"
#include "core/numerics/dense.hpp"
#include "core/numerics/result.hpp"

namespace handlebody {

struct IrbfOptions {
  KernelKind kernel = KernelKind::inverse_multiquadric;
  double relative_width = 2;   // h, in mean center spacings
  double smoothness = 1e-6;    // λ of eq. (10)
  double anchor_weight = 100;  // μ
  double edge_exponent = -1;   // α of eq. (8)
};

enum class HandleKind : unsigned { position = 0, rotation = 1 };

struct SolveReport {
  double energy = 0;        // eq. (10), solver space
  double anchor_error = 0;  // model units
  double change = 0;        // largest movement of a sphere edge in the last iteration, solver space
  int iterations = 0;
  bool converged = false;
};

class Irbf {
 public:
  static constexpr Index target_size = 10;  // position xyz, quaternion xyzw, scale xyz

  /** Takes a body (checked here) and evaluates the basis at its spheres and vertices. */
  static Result<std::unique_ptr<Irbf>> create(Body body, const IrbfOptions& options);

  /** Sets the handles at `points` (k×3, model units); builds and factors the system. On failure the former handles stay. */
  Result<Done> set_handles(const ConstPoints& points, const std::vector<HandleKind>& kinds);

  Index handle_count() const { return static_cast<Index>(handles_.kinds.size()); }

  /** target_size numbers a handle, in model units; at rest after set_handles. Written in place by the caller. */
  double* targets() { return targets_.data(); }

  /** Local/global iterations from the last solution until no sphere edge moves more than `tolerance`, or `max_iterations`. On
   *  failure the last solution stays. */
  Result<SolveReport> solve(int max_iterations, double tolerance);

  /** Deformed vertices as stored, model units (vertex count × 3), and their normals if wanted. `rest_normals` are the authored ones
   *  to turn, or null for area-weighted normals. Allocates nothing. */
  void deform(float* positions, const float* rest_normals, float* normals);

  /** The deformation of any points (k×3, model units). */
  Points evaluate(const ConstPoints& points) const;

  Index vertex_count() const { return body_.positions.rows(); }
  const Body& body() const { return body_; }
  const Basis& basis() const { return *basis_; }

 private:
  /** Everything that depends on which points are held. "Constraints" are the rows below the sphere edges in the appendix's Z. */
  struct Handles {
    std::vector<HandleKind> kinds;
    std::vector<Index> same_as;  // an earlier handle at the same point, or −1
    Points points;               // constraint points, solver space: a handle's own, then a rotation handle's six structure points
    MatrixXd rows;               // constraints × (4 + C): μ[s 1 φ(s)] and, for rotation handles, μ[e 0 Δφ]
    MatrixXd inverse;            // Z†: (4 + C) × (3B + constraints)
    MatrixXd reduced;            // edge_rows·Z†, the reduced iteration: 3B × (3B + constraints)
  };

  /** What a solve writes to, taken once. */
  struct Workspace {
    Points targets, displacements;         // of the constraint points
    Columns3 right_hand_side;              // 3B + constraints
    Columns3 edges, previous;              // 3B
    Columns3 solution;                     // 4 + C
    Columns3 missed;                       // constraints
    std::vector<Matrix3> rotations, warm;  // B
  };

  Irbf() = default;
  void prepare_spheres();
  void prepare_vertices();
  Result<Points> constraint_points(const ConstPoints& handles, const std::vector<HandleKind>& kinds) const;
  MatrixXd constraint_rows(const Points& points, const std::vector<HandleKind>& kinds) const;
  Result<Done> read_targets();
  void set_constraint_targets();
  void set_edge_targets(const std::vector<Matrix3>& rotations);
  double energy();
  void iterate(int max_iterations, double tolerance, SolveReport& report);
  double largest_miss() const;

  IrbfOptions options_;
  Body body_;
  std::unique_ptr<Basis> basis_;
  std::unique_ptr<TriangleTree> surface_;
  double structure_radius_ = 0;  // of a rotation handle's six points

  Points edges_;        // 3B×3: √w e
  Vector edge_scale_;   // 3B: 1/√w
  MatrixXd edge_rows_;  // 3B × (4 + C): √w [e 0 Δφ]
  MatrixXd gram_;       // lower triangle: edge_rowsᵀ edge_rows + λ on the coefficients

  Weld weld_;
  Triangles welded_triangles_;
  PointsF stored_;                                                            // as stored, model units
  PointsF rest_, displacement_, deformed_, rest_normals_, deformed_normals_;  // welded, solver space
  std::unique_ptr<FrameKernel> frame_kernel_;

  Handles handles_;
  std::vector<double> targets_;
  Workspace work_;

  // The last solution, solver space: the displacement linear·x + translation + Ψ·coefficients.
  bool solved_ = false;
  std::vector<Matrix3> rotations_;  // M_b of every sphere
  Matrix3 linear_ = Matrix3::Zero();
  Vector3 translation_ = Vector3::Zero();
  Matrix coefficients_;
};

}  // namespace handlebody
