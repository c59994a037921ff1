// Interior distances at many points: their stencils in flat arrays, applied to one center's field after another.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** The field that stencils interpolate: the ratio of interior to Euclidean distance from `center` (see stencil.hpp), for every voxel.
 *  `interior(v)` is the interior distance of voxel v. `ratios` is resized to the domain. */
template <typename Interior>
void distance_ratios(const VoxelDomain& domain, const Vector3& center, const Interior& interior, std::vector<double>& ratios) {
  ratios.resize(domain.voxels().size());
  for (std::size_t v = 0; v < ratios.size(); ++v) {
    const double euclidean = (domain.center(static_cast<Index>(v)) - center).norm();
    ratios[v] = euclidean > 0 ? interior(v) / euclidean : 1;
  }
}

class InteriorSamples {
 public:
  /** Adds one more point (solver space). */
  void add(const VoxelDomain& domain, const Vector3& point);

  Index size() const { return static_cast<Index>(points_.size()); }
  const Vector3& point(Index i) const { return points_[static_cast<std::size_t>(i)]; }

  /** Interior distance of point i from `center`, whose ratios are given; at least the Euclidean distance. */
  double distance(const std::vector<double>& ratios, const Vector3& center, Index i) const {
    const auto row = static_cast<std::size_t>(i);
    double ratio = 0;
    for (std::size_t k = offsets_[row]; k < offsets_[row + 1]; ++k) {
      ratio += weights_[k] * ratios[static_cast<std::size_t>(voxels_[k])];
    }
    return std::max(ratio, 1.0) * (points_[row] - center).norm();
  }

 private:
  std::vector<Vector3> points_;
  std::vector<std::size_t> offsets_{0};
  std::vector<std::int32_t> voxels_;
  std::vector<double> weights_;
};

}  // namespace handlebody
