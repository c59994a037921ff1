// The per-frame product: L x + t + Ψ a for every vertex, in SIMD float (paper 001, eq. (13)).
#pragma once

#include <array>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

class FrameKernel {
 public:
  /** Stores `positions` (n×3) and `psi` (n × centers) in tiles of eight vertices with the coefficients innermost: one pass over
   *  memory, three accumulators. Measured against Eigen's row-major product on 40,000 × 241: 7.5 against 11 ms. */
  FrameKernel(const PointsF& positions, const MatrixF& psi);

  /** displacement (n×3) = linear·x + translation + Ψ·coefficients. Displacements, not positions: a small one keeps its precision,
   *  and none at all leaves the rest shape exact. Allocates nothing. */
  void apply(const Matrix3& linear, const Vector3& translation, const Matrix& coefficients, PointsF& displacement);

 private:
  /** One number of eight vertices. A vector type of the compiler's (GCC's extension, which Clang shares) and not Eigen's: Eigen's
   *  packets can only be had for the whole program, at twice the size. */
  static constexpr Index lanes = 8;
  using Quad = float __attribute__((vector_size(16)));
  using Tile = std::array<Quad, 2>;

  Index vertices_;
  Index centers_;
  std::vector<Tile> positions_;  // 3 a tile: x, y, z
  std::vector<Tile> psi_;        // centers a tile
  PointsF coefficients_;
};

}  // namespace handlebody
