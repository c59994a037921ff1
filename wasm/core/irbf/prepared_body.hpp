// What of a deformation by interior RBFs depends on the body and the options, and on no handle: nearly all of its memory, and the
// time to make it. Deformations of one body, each with handles of its own, share it.
#pragma once

#include <memory>

#include "core/errors/result.hpp"
#include "core/irbf/basis.hpp"
#include "core/irbf/body.hpp"
#include "core/irbf/frame_kernel.hpp"
#include "core/irbf/quality.hpp"
#include "core/irbf/reduced_system.hpp"
#include "core/irbf/rotation_hessian.hpp"
#include "core/irbf/sphere_structure.hpp"
#include "core/mesh/triangle_tree.hpp"
#include "core/mesh/weld.hpp"

namespace handlebody {

struct IrbfOptions {
  /** Radial; its width h in mean center spacings, 0 for one that is chosen. */
  Kernel kernel = Kernel::of(KernelKind::inverse_multiquadric, 0, 3);
  double smoothness = 0;       // λ of eq. (10); 0 chooses it, see sphere_energy.hpp
  double anchor_weight = 100;  // μ, relative to the edges of spheres
  double edge_exponent = 2;    // α of eq. (8)
  ConstraintKind constraints = ConstraintKind::soft;
  FramePrecision precision = FramePrecision::fixed;
  SphereFit sphere_fit = SphereFit::rigid;
  SphereStructure structure = SphereStructure::octahedron;  // of spheres
  double poisson_ratio = 0.4;                               // below 0.5, at which nothing changes volume; 0 is paper 001's energy

  /** κ of local_global.hpp: λ/2μ of fixed corotated elasticity. */
  double volume() const { return poisson_ratio / (1 - 2 * poisson_ratio); }
};

struct PreparedBody {
  /** Takes a body (checked here) and evaluates the basis at its spheres and vertices. Fails with BODY_INVALID, INVALID_OPTION,
   *  OUT_OF_MEMORY, or as Basis::evaluate does. */
  static Result<std::shared_ptr<const PreparedBody>> create(Body body, const IrbfOptions& options);

  PreparedBody(Body body, const IrbfOptions& options);
  PreparedBody(const PreparedBody&) = delete;  // the basis points into the body
  PreparedBody& operator=(const PreparedBody&) = delete;

  const IrbfOptions options;
  const Body body;
  const Basis basis;
  double smoothness = 0;        // λ, as given or as chosen
  double anchor_weight = 0;     // μ, times the root of the mean of w‖e‖ over the spheres' edges, which is 1 for the paper's w
  double structure_radius = 0;  // of a rotation handle's six points

  MatrixXd edge_rows;  // 3B × (4 + C): √w [e 0 Δφ]
  MatrixXd gram;       // lower triangle: edge_rowsᵀ edge_rows + λ on the coefficients, and what denser structures add
  Points edges;        // of the spheres at rest, weighted by √w (3B × 3)
  Vector edge_scale;   // 1/√w

  Weld weld;
  Triangles triangles;                        // welded
  PointsF stored;                             // vertices as stored, model units
  PointsF rest, rest_normals;                 // welded, solver space
  std::unique_ptr<const FrameKernel> kernel;  // Ψ, times the coefficients of the centers
  MatrixF psi;                                // kept where a product with the handles' matrix may be the smaller one
  ColumnRanges surface_ranges;                // of the basis functions over the vertices

  // Made by the deformation that first needs them, kept for all. Like all else here, for one thread at a time.
  mutable std::unique_ptr<TriangleTree> surface;
  mutable std::unique_ptr<const VoxelQuality> voxel_quality;

 private:
  Result<Done> prepare_spheres();
  Result<Done> prepare_vertices();
};

/** Multiplications that setting handles may spend on a smaller matrix for the frames: some ten milliseconds. */
constexpr double most_handle_products = 5e7;

}  // namespace handlebody
