// How a deformation treats volume and shape: volume ratio, ARAP distortion and foldovers on tetrahedra (paper 001, §5), and how far
// the basis is from obeying the maximum principle (§6).
#pragma once

#include "core/errors/result.hpp"
#include "core/irbf/basis.hpp"
#include "core/irbf/body.hpp"

namespace handlebody {

using Tetrahedra = Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 4, Eigen::RowMajor>;

struct Quality {
  double volume_ratio = 1;      // of the deformed shape to that at rest
  double total_distortion = 0;  // Σ A min ‖df − R‖² over the tetrahedra, A their volumes: model units³
  double max_distortion = 0;
  Index flips = 0;  // tetrahedra turned inside out
  Index tetrahedra = 0;
  /** The most by which a basis function inside the body leaves the range that it has on the surface, over that range: 0 where the
   *  maximum principle holds. Evaluated at the voxels' corners only. */
  double maximum_principle = 0;
};

/** Distortion, foldovers and volume of tetrahedra at `rest` that came to lie at `deformed` (n×3 each). Those of no volume at rest,
 *  relative to their edges, are left out. */
Quality measure_tetrahedra(const Eigen::Ref<const Tetrahedra>& tetrahedra, const Points& rest, const Points& deformed);

struct ColumnRanges {
  std::vector<float> low, high;

  /** The ranges of each column of a matrix. */
  static ColumnRanges of(const MatrixF& matrix);
};

/** The voxels of the body, six tetrahedra each, with the basis at their corners. */
class VoxelQuality {
 public:
  /** Fails with OUT_OF_MEMORY or as the basis does. */
  static Result<std::unique_ptr<const VoxelQuality>> create(const Body& body, const Basis& basis, const ColumnRanges& on_surface);

  /** For the displacement linear·x + translation + Ψ·coefficients, solver space. */
  Quality measure(const Matrix3& linear, const Vector3& translation, const Matrix& coefficients, double diagonal) const;

 private:
  VoxelQuality() = default;

  Tetrahedra tetrahedra_;
  Points rest_;
  MatrixF psi_;
  double maximum_principle_ = 0;
};

}  // namespace handlebody
