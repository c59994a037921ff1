#include "core/distance/interior_samples.hpp"

#include "core/distance/stencil.hpp"

namespace handlebody {

void InteriorSamples::add(const VoxelDomain& domain, const Vector3& point) {
  const Stencil stencil = make_stencil(domain, point);
  points_.push_back(point);
  voxels_.insert(voxels_.end(), stencil.voxels.begin(), stencil.voxels.end());
  weights_.insert(weights_.end(), stencil.weights.begin(), stencil.weights.end());
  offsets_.push_back(voxels_.size());
}

}  // namespace handlebody
