// The first half of a bake: which voxels lie inside, and whether limbs run into one there.
#include <algorithm>
#include <cmath>

#include "core/distance/filled_shell.hpp"
#include "core/irbf/bake.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

constexpr Index triangles_per_step = 4096;
// An open sheet winds about the points on its hollow side a little more than half; an inside has at least a fourth of it
// surrounded.
constexpr double surely = 0.75;

}  // namespace

void Bake::orient() {
  if (surface()) {
    orientation_ = orient_consistently(solver_positions_, triangles_);
    if (orientation_.inside_out) warnings_.push_back({HB_WARNING_MESH_INSIDE_OUT, triangles_.rows()});
    if (orientation_.turned > 0) warnings_.push_back({HB_WARNING_ORIENTATION_MIXED, orientation_.turned});
  }
  tree_.emplace(solver_positions_, triangles_, !orientation_.closed);
  if (options_.grid) inside_ = std::move(options_.voxels);
  phase_ = options_.grid ? Phase::domain : options_.cloud ? Phase::fill : Phase::cross;
}

/** Some triangles' crossings with lines along an axis. True when all are there, or are too many to keep. */
bool Bake::cross_triangles(int axis) {
  if (uncounted_ || crossed_axis_ == axis) return true;
  if (next_ == 0) crossings_.emplace(grid_, axis);
  for (const Index end = std::min(triangles_.rows(), next_ + triangles_per_step); next_ < end && !uncounted_; ++next_) {
    uncounted_ = !crossings_->add(solver_positions_, triangles_.row(next_).data());
  }
  if (next_ < triangles_.rows() && !uncounted_) return false;
  crossings_->finish();
  crossed_axis_ = axis;
  next_ = 0;
  return true;
}

void Bake::voxelize_slab() {
  if (orientation_.closed && !uncounted_) {
    inside_ = enclosed_voxels(grid_, *crossings_);
    sure_ = inside_.size();
    next_ = grid_.dims[2];
  } else {
    if (orientation_.closed && next_ == 0) tree_.emplace(solver_positions_, triangles_);  // now with winding numbers
    for (int j = 0; j < grid_.dims[1]; ++j) {
      for (int i = 0; i < grid_.dims[0]; ++i) {
        const std::int64_t voxel = grid_.linear(i, j, static_cast<int>(next_));
        const double winding = std::abs(tree_->winding_number(grid_.center(voxel)));
        if (winding > 0.5) inside_.push_back(static_cast<std::uint32_t>(voxel));
        if (winding > surely) ++sure_;
      }
    }
    ++next_;
  }
  if (next_ < grid_.dims[2]) return;
  next_ = 0;
  phase_ = sure_ == 0 || 4 * sure_ < inside_.size() ? Phase::fill : Phase::domain;
}

/** What a shell of voxels encloses, where winding numbers do not tell; for a sheet, the shell itself. */
Result<Done> Bake::fill() {
  if (surface() && axis_ < 3) {
    if (!cross_triangles(axis_)) return Done{};
    crossed_voxels(grid_, *crossings_, crossed_);
    ++axis_;
    return Done{};
  }
  for (Index v = 0; v < solver_positions_.rows(); ++v) {
    const Vector3 cell = (solver_positions_.row(v).transpose() - grid_.origin) / grid_.spacing;
    crossed_.push_back(
        static_cast<std::uint32_t>(grid_.linear(int(std::lround(cell[0])), int(std::lround(cell[1])), int(std::lround(cell[2])))));
  }
  inside_ = filled_shell(grid_, crossed_);
  if (!inside_.empty()) {
    if (surface()) warnings_.push_back({HB_WARNING_SURFACE_FILLED, orientation_.open_edges});
  } else if (options_.method == DistanceMethod::euclidean) {
    warnings_.push_back({HB_WARNING_SURFACE_OPEN, orientation_.open_edges});
    sheet_ = true;
    inside_ = std::move(crossed_);
    sort(inside_, [](std::uint32_t u, std::uint32_t v) { return u < v; });
    inside_.erase(std::unique(inside_.begin(), inside_.end()), inside_.end());
  } else if (options_.cloud) {
    return Error(
        HB_ERROR_CLOUD_TOO_SPARSE,
        {"The ", solver_positions_.rows(), " points leave gaps that ", options_.resolution, " voxels along the longest side show."},
        {"Give a denser cloud, a coarser resolution, or a mesh."});
  } else {
    return Error(HB_ERROR_MESH_NO_INTERIOR, {"No voxel of the ", options_.resolution, "-voxel grid lies inside the model."},
                 {"Close the surface if it is an open sheet, or raise the resolution if the model is thin; Euclidean distances "
                  "need no inside."});
  }
  axis_ = 0;
  crossed_ = {};
  phase_ = Phase::domain;
  return Done{};
}

Result<Done> Bake::make_domain() {
  if (inside_.empty()) {
    return Error(HB_ERROR_MESH_NO_INTERIOR, {"The volume has no voxel that is inside."}, {"Mark the voxels inside with 1."});
  }
  std::vector<std::uint32_t> unbridged = inside_;
  bridge_components(grid_, inside_);
  const double bytes = static_cast<double>(inside_.size()) * static_cast<double>(options_.centers) * sizeof(std::uint16_t);
  if (bytes > 2e9) {
    return Error(HB_ERROR_OUT_OF_MEMORY,
                 {options_.centers, " centers × ", inside_.size(), " voxels would take ", static_cast<int>(bytes / 1e6), " MB."},
                 {"Use fewer centers or a coarser resolution."});
  }
  // A bridge runs outside the surface: no sphere may sit there.
  on_bridge_.resize(inside_.size());
  std::transform(inside_.begin(), inside_.end(), on_bridge_.begin(),
                 [&](std::uint32_t voxel) { return !std::binary_search(unbridged.begin(), unbridged.end(), voxel); });
  body_.domain = VoxelDomain(grid_, std::move(inside_));
  phase_ = surface() && !sheet_ ? Phase::link : Phase::depth;
  return Done{};
}

void Bake::link_axis() {
  if (axis_ < 3 && !uncounted_) {
    if (!cross_triangles(axis_)) return;
    if (!uncounted_) find_crossed_links(body_.domain, *crossings_, orientation_.closed, links_);
    ++axis_;
    return;
  }
  crossings_.reset();
  const MergedLimbs merged = find_merged_limbs(body_.domain, links_);
  links_ = {};
  if (merged.links > 0) {
    // The voxel must fit into the gap, wherever it falls.
    const double finer = std::ceil(1.2 * options_.resolution / std::max(merged.gap, 1e-6));
    warnings_.push_back({HB_WARNING_LIMBS_MERGED, merged.links, finer <= highest_resolution ? finer : 0,
                         body_.normalization.to_model(merged.place)});
  }
  phase_ = Phase::depth;
}

}  // namespace handlebody
