// Fast marching: the viscosity solution of the eikonal equation |∇d| = 1 on a voxel domain (Sethian 1996), second order.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** Reusable state for many sources on one domain: marching allocates nothing after the first call. The domain must
 *  outlive it. */
class FastMarching {
 public:
  explicit FastMarching(const VoxelDomain& domain);

  /** Interior distances from `source` (anywhere in or near the domain) to every voxel center, into `distances` (domain.size()).
   *  Voxels within a few spacings of the source that are connected to it inside that ball start exact (Euclidean), which is what
   *  keeps the source's kink from spoiling the order everywhere else. Voxels that cannot be reached get +infinity. */
  void march(const Vector3& source, double* distances);

 private:
  double solve(std::int32_t voxel) const;
  double solve_upwind(std::int32_t voxel) const;
  double solve_simplices(std::int32_t voxel, double distance) const;
  void initialize(const Vector3& source);
  void accept(std::int32_t voxel, double distance);
  void push(std::int32_t voxel, double distance);
  void sift_up(std::int32_t place, double distance, std::int32_t voxel);
  void sift_down(std::int32_t place, double distance, std::int32_t voxel);
  std::int32_t pop(double& distance);

  struct Trial {
    double distance;
    std::int32_t voxel;
  };

  const VoxelDomain* domain_;
  std::vector<std::int32_t> neighbors_;  // VoxelDomain::face_neighbors()
  std::vector<double> accepted_;         // final distances, +infinity elsewhere and at the row that stands for "no voxel"
  std::vector<std::int32_t> places_;     // of each voxel in the heap, or `unseen`, or `done`
  std::vector<Trial> heap_;
  std::vector<std::int32_t> ball_;  // the voxels that start exact
};

}  // namespace handlebody
