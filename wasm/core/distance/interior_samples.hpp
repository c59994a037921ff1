// Interior distances at many points: their stencils in flat arrays, applied to one center's field after another.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class InteriorSamples {
 public:
  /** Adds one more point (solver space). The domain is the same for all. */
  void add(const VoxelDomain& domain, const Vector3& point);

  Index size() const { return std::ssize(points_); }
  const Vector3& point(Index i) const { return points_[i]; }

  /** The field that stencils interpolate, at the voxels that they use: the ratio of interior to Euclidean distance from `center`.
   * It is 1 in view of the center, so that distances there are exact. `interior(v)` is the interior distance of voxel v. */
  template <typename Interior>
  void distance_ratios(const Vector3& center, const Interior& interior, std::vector<double>& ratios) const {
    ratios.resize(voxels_.size());
    for (std::size_t k = 0; k < ratios.size(); ++k) {
      const double euclidean = (places_[k] - center).norm();
      ratios[k] = euclidean > 0 ? interior(voxels_[k]) / euclidean : 1;
    }
  }

  /** The same distance without the ratios, for few points. */
  template <typename Interior>
  double distance_from(const Vector3& center, const Interior& interior, Index i) const {
    const auto row = static_cast<std::size_t>(i);
    double ratio = 0;
    for (std::size_t k = offsets_[row]; k < offsets_[row + 1]; ++k) {
      const double euclidean = (places_[slots_[k]] - center).norm();
      ratio += weights_[k] * (euclidean > 0 ? interior(voxels_[slots_[k]]) / euclidean : 1);
    }
    return std::max(ratio, 1.0) * (points_[row] - center).norm();
  }

  /** Interior distance of point i from `center`, whose ratios are given; at least the Euclidean distance. */
  double distance(const std::vector<double>& ratios, const Vector3& center, Index i) const {
    const auto row = static_cast<std::size_t>(i);
    double ratio = 0;
    for (std::size_t k = offsets_[row]; k < offsets_[row + 1]; ++k) {
      ratio += weights_[k] * ratios[slots_[k]];
    }
    return std::max(ratio, 1.0) * (points_[row] - center).norm();
  }

  /** The ratios of `lanes` centers at once, those of a voxel side by side: interior distances are scale · codes[lane][v]. */
  template <typename Scalar, int lanes>
  void block_ratios(const std::array<Vector3, lanes>& centers, const std::array<const std::uint16_t*, lanes>& codes, Scalar scale,
                    std::vector<Scalar>& ratios) const {
    ratios.resize(voxels_.size() * lanes);
    Scalar x[lanes], y[lanes], z[lanes], interior[lanes];
    for (int l = 0; l < lanes; ++l) {
      const Vector3& center = centers[l];
      x[l] = static_cast<Scalar>(center[0]), y[l] = static_cast<Scalar>(center[1]), z[l] = static_cast<Scalar>(center[2]);
    }
    for (std::size_t k = 0; k < voxels_.size(); ++k) {
      const auto px = static_cast<Scalar>(places_[k][0]), py = static_cast<Scalar>(places_[k][1]),
                 pz = static_cast<Scalar>(places_[k][2]);
      for (int l = 0; l < lanes; ++l) interior[l] = scale * static_cast<Scalar>(codes[l][voxels_[k]]);
      Scalar* ratio = ratios.data() + k * lanes;
      for (int l = 0; l < lanes; ++l) {
        const Scalar dx = px - x[l], dy = py - y[l], dz = pz - z[l];
        const Scalar squared = dx * dx + dy * dy + dz * dz;
        ratio[l] = squared > 0 ? interior[l] / std::sqrt(squared) : 1;
      }
    }
  }

  /** Interior distances of `count` points from `from` on, as distance() gives them, `lanes` centers side by side. */
  template <typename Scalar, int lanes>
  void block_distances(const std::array<Vector3, lanes>& centers, const std::vector<Scalar>& ratios, Index from, Index count,
                       Scalar* distances) const {
    Scalar x[lanes], y[lanes], z[lanes];
    for (int l = 0; l < lanes; ++l) {
      const Vector3& center = centers[l];
      x[l] = static_cast<Scalar>(center[0]), y[l] = static_cast<Scalar>(center[1]), z[l] = static_cast<Scalar>(center[2]);
    }
    for (Index i = 0; i < count; ++i, distances += lanes) {
      const auto row = static_cast<std::size_t>(from + i);
      Scalar sum[lanes] = {};
      for (std::size_t k = offsets_[row]; k < offsets_[row + 1]; ++k) {
        const auto weight = static_cast<Scalar>(weights_[k]);
        const Scalar* ratio = ratios.data() + std::size_t{slots_[k]} * lanes;
        for (int l = 0; l < lanes; ++l) sum[l] += weight * ratio[l];
      }
      const auto px = static_cast<Scalar>(points_[row][0]), py = static_cast<Scalar>(points_[row][1]),
                 pz = static_cast<Scalar>(points_[row][2]);
      for (int l = 0; l < lanes; ++l) {
        const Scalar dx = px - x[l], dy = py - y[l], dz = pz - z[l];
        distances[l] = std::max(sum[l], Scalar{1}) * std::sqrt(dx * dx + dy * dy + dz * dz);
      }
    }
  }

 private:
  std::vector<Vector3> points_;
  std::vector<std::size_t> offsets_{0};
  std::vector<std::uint32_t> slots_;  // of each stencil: indices into voxels_
  std::vector<double> weights_;
  std::vector<std::uint32_t> voxels_;   // used by any stencil
  std::vector<Vector3> places_;         // their centers
  std::vector<std::uint32_t> slot_of_;  // of each voxel of the domain: its index in voxels_, or `unused`
};

}  // namespace handlebody
