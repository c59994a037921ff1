#include "core/distance/interior_samples.hpp"

#include "core/distance/stencil.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {

void InteriorSamples::add(const VoxelDomain& domain, const Vector3& point) {
  const Stencil stencil = make_stencil(domain, point);
  points_.push_back(point);
  slot_of_.resize(domain.voxels().size(), no_index);
  for (std::size_t k = 0; k < stencil.voxels.size(); ++k) {
    const auto voxel = static_cast<std::uint32_t>(stencil.voxels[k]);
    std::uint32_t& slot = slot_of_[voxel];
    if (slot == no_index) {
      slot = static_cast<std::uint32_t>(voxels_.size());
      voxels_.push_back(voxel);
      places_.push_back(domain.center(stencil.voxels[k]));
    }
    slots_.push_back(slot);
    weights_.push_back(stencil.weights[k]);
  }
  offsets_.push_back(slots_.size());
}

}  // namespace handlebody
