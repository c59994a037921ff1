// Fast marching: the viscosity solution of the eikonal equation |∇d| = 1 on a voxel domain (Sethian 1996), second order.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** Reusable state for many sources on one domain: marching allocates nothing after the first calls. The domain must
 *  outlive it. */
class FastMarching {
 public:
  explicit FastMarching(const VoxelDomain& domain);

  /** Interior distances from `source` (anywhere in or near the domain) to every voxel center, into `distances` (domain.size()).
   *  Voxels within a few spacings of the source that are connected to it inside that ball start exact (Euclidean), which is what
   *  keeps the source's kink from spoiling the order everywhere else. Voxels that cannot be reached get +infinity. */
  void march(const Vector3& source, double* distances);

 private:
  // A voxel before it is accepted: its trial distance, and of the equation that gave it Σ s²t and Σ s²t². `axes` has a bit for each
  // axis that has its term, and one for voxels on the boundary; `fourfold` is 4 Σ s².
  struct Cell {
    double d, st, stt;
    std::uint32_t axes, fourfold;
  };
  static constexpr int ring = 64;  // buckets

  void initialize(const Vector3& source);
  void accept(std::int32_t voxel);
  void join(Cell& cell, std::uint32_t axis, double a, double b) const;
  double simplices(const std::int32_t* sides, const double* around, double dw, int axis) const;
  void push(std::int32_t voxel, std::int32_t bucket);

  const VoxelDomain* domain_;
  std::vector<std::int32_t> neighbors_;  // VoxelDomain::face_neighbors()
  std::vector<double> accepted_;         // final distances, +infinity elsewhere and at the row that stands for "no voxel"
  std::vector<Cell> cells_, fresh_cells_;
  std::vector<std::int32_t> ball_;  // the voxels that start exact
  std::array<std::vector<std::int32_t>, ring> buckets_;
  std::int32_t current_ = 0;  // the bucket that is being emptied
  std::size_t waiting_ = 0;   // in all buckets
};

}  // namespace handlebody
