// The per-frame product: L x + t + M c for every vertex (paper 001, eq. (13)), in 16-bit fixed point or in float, the reference.
//
// Rejected: tiles of 16 vertices, 5% faster natively and 30% slower in wasm, which runs out of registers; low-rank pieces of the
// matrix, cluster by cluster, which take a third of the multiplications for errors of 1e-4 but twice the time to load, since
// distances on voxels are not smooth enough.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

enum class FramePrecision : unsigned { fixed = 0, floating = 1 };

class FrameKernel {
 public:
  /** Stores `positions` (n×3) and `matrix` (n × columns) in tiles of vertices with the columns innermost: one pass over memory.
   *
   *  In fixed point, products of two columns at a time are added up by one instruction. A column is stored as its difference from
   *  its mean, scaled to 16 bits; the mean comes back as a translation. Coefficients are scaled for every 32 columns, as far as no
   *  row's sum of them can overflow: the largest keeps 12 bits or more. */
  FrameKernel(const PointsF& positions, const MatrixF& matrix, FramePrecision precision);

  /** The coefficients of one product, in the kernel's own form. Whoever multiplies brings their own, so that the kernel can be
   * shared. */
  struct Scratch {
    PointsF floats;
    std::vector<std::int32_t> packed;  // pairs × 3: two coefficients each
    std::vector<float> worth;          // chunks × 3: the value of 1 in a chunk's sums
  };

  Index columns() const { return columns_; }

  /** As large as apply() wants it. */
  Scratch scratch() const;

  /** displacement (n×3) = linear·x + translation + M·coefficients (columns × 3). Displacements, not positions: a small one keeps
   * its precision, and none at all leaves the rest shape exact. Allocates nothing. */
  void apply(const Matrix3& linear, const Vector3& translation, const Matrix& coefficients, Scratch& scratch,
             PointsF& displacement) const;

 private:
  /** The compiler's vector types (GCC's extension, which Clang shares) and not Eigen's: Eigen's packets can only be enabled for the
   *  whole program, at twice the size. */
  using Quad = float __attribute__((vector_size(16)));
  using Pairs = std::int16_t __attribute__((vector_size(16)));  // two columns of four vertices, a vertex's pair side by side
  static constexpr Index quads = 2, lanes = 4 * quads;          // of a tile
  using FloatTile = std::array<Quad, quads>;
  using FixedTile = std::array<Pairs, quads>;
  static constexpr Index chunk = 16;  // pairs of columns between two conversions to float

  void store_floats(const MatrixF& matrix);
  void store_fixed(const MatrixF& matrix);
  void scale_coefficients(const Matrix& coefficients, Scratch& scratch) const;
  void add_floats(Index tile, const Scratch& scratch, std::array<FloatTile, 3>& sums) const;
  void add_fixed(Index tile, const Scratch& scratch, std::array<FloatTile, 3>& sums) const;

  FramePrecision precision_;
  Index vertices_, columns_;
  std::vector<FloatTile> positions_;  // 3 per tile: x, y, z

  std::vector<FloatTile> floats_;  // columns per tile

  std::vector<FixedTile> fixed_;       // pairs of columns per tile
  std::vector<double> means_, units_;  // of the columns: a number is mean + unit · code
  std::vector<double> largest_sums_;   // of each chunk: the largest Σ |code| of a row
};

}  // namespace handlebody
