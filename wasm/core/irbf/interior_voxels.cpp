#include "core/irbf/interior_voxels.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/distance/filled_shell.hpp"
#include "core/mesh/enclosed_volume.hpp"

namespace handlebody {
namespace {

constexpr Index triangles_per_step = 4096;
// On the hollow side of an open sheet the winding number is a little above a half. Of an inside, at least a fourth of the voxels
// has a winding number above this.
constexpr double surely = 0.75;

/** Fewer voxels than this are a handful. Bars of 1 : 4 to 1 : 40, a plate, thin capsules, a ring, a ball and a cube, turned against
 * the grid, were baked at 8 to 96: with 8 to 49 voxels their volume came out 1.3 to 12 times too large, with 60 and more it was
 * right to a sixth, and from 64 on distances were too. */
constexpr Index few = 64;

/** Triangles of which it is looked which way they face. */
constexpr Index most_looked_at = 2048;

}  // namespace

InteriorVoxels::InteriorVoxels(const Points& positions, Triangles& triangles, const Grid& grid, InteriorOptions options)
    : positions_(positions), triangles_(triangles), grid_(grid), options_(std::move(options)) {}

Result<double> InteriorVoxels::step() {
  switch (phase_) {
    case Phase::orient:
      orient();
      break;
    case Phase::cross:
      if (cross_triangles(0)) phase_ = Phase::voxelize;
      break;
    case Phase::voxelize:
      voxelize_slab();
      break;
    case Phase::fill:
      if (auto done = fill(); !done) return done.error();
      break;
    case Phase::domain:
      if (auto done = make_domain(); !done) return done.error();
      break;
    case Phase::link:
      link_axis();
      break;
    case Phase::finished:
      break;
  }
  return progress();
}

/** Shares of the time on the dog at 96 voxels, native. */
double InteriorVoxels::progress() const {
  const auto part = [](auto done, auto all) { return static_cast<double>(done) / std::max(1.0, static_cast<double>(all)); };
  switch (phase_) {
    case Phase::orient:
      return 0;
    case Phase::cross:
      return 0.55 + 0.11 * part(next_, triangles_.rows());
    case Phase::voxelize:
      return 0.66 + 0.11 * part(next_, grid_.dims[2]);
    case Phase::fill:
      return 0.77;
    case Phase::domain:
      return 0.83;
    case Phase::link:
      return 0.83 + 0.05 * axis_;
    case Phase::finished:
      return 1;
  }
  return 1;
}

void InteriorVoxels::orient() {
  if (surface()) {
    orientation_ = orient_consistently(positions_, triangles_);
    if (orientation_.inside_out) warnings_.push_back({HB_WARNING_MESH_INSIDE_OUT, triangles_.rows()});
    if (orientation_.turned > 0) warnings_.push_back({HB_WARNING_ORIENTATION_MIXED, orientation_.turned});
  }
  tree_.emplace(positions_, triangles_.topRows(triangles_.rows() - options_.flat), !orientation_.closed);
  switch (options_.source) {
    case InteriorSource::surface:
      phase_ = Phase::cross;
      break;
    case InteriorSource::cloud:
      phase_ = Phase::fill;
      break;
    case InteriorSource::voxels:
      inside_ = std::move(options_.voxels);
      phase_ = Phase::domain;
      break;
  }
}

/** Some triangles' crossings with lines along an axis. True when all are there, or are too many to keep. */
bool InteriorVoxels::cross_triangles(int axis) {
  if (uncounted_ || crossed_axis_ == axis) return true;
  if (next_ == 0) crossings_.emplace(grid_, axis);
  for (const Index end = std::min(triangles_.rows(), next_ + triangles_per_step); next_ < end && !uncounted_; ++next_) {
    uncounted_ = !crossings_->add(positions_, triangles_.row(next_).data());
  }
  if (next_ < triangles_.rows() && !uncounted_) return false;
  crossings_->finish();
  crossed_axis_ = axis;
  next_ = 0;
  return true;
}

void InteriorVoxels::voxelize_slab() {
  if (orientation_.closed && !uncounted_) {
    EnclosedVoxels enclosed = enclosed_voxels(grid_, *crossings_);
    inside_ = std::move(enclosed.voxels);
    if (enclosed.both_ways && orientation_.turned == 0) {
      std::erase_if(warnings_, [](const BakeWarning& warning) { return warning.code == HB_WARNING_MESH_INSIDE_OUT; });
      warnings_.push_back({HB_WARNING_ORIENTATION_MIXED, count_inward()});
    }
    sure_ = inside_.size();
    next_ = grid_.dims[2];
  } else {
    if (orientation_.closed && next_ == 0)
      tree_.emplace(positions_, triangles_.topRows(triangles_.rows() - options_.flat));  // now with winding numbers
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

/** What a shell of voxels encloses, where winding numbers do not decide; for a sheet, the shell itself. */
Result<Done> InteriorVoxels::fill() {
  if (surface() && axis_ < 3) {
    if (!cross_triangles(axis_)) return Done{};
    crossed_voxels(grid_, *crossings_, crossed_);
    ++axis_;
    return Done{};
  }
  for (Index v = 0; v < positions_.rows(); ++v) {
    const Vector3 cell = (positions_.row(v).transpose() - grid_.origin) / grid_.spacing;
    crossed_.push_back(
        static_cast<std::uint32_t>(grid_.linear(int(std::lround(cell[0])), int(std::lround(cell[1])), int(std::lround(cell[2])))));
  }
  inside_ = filled_shell(grid_, crossed_);
  if (!inside_.empty()) {
    if (surface()) warnings_.push_back({HB_WARNING_SURFACE_FILLED, orientation_.open_edges});
  } else if (options_.allow_sheet) {
    warnings_.push_back({HB_WARNING_SURFACE_OPEN, orientation_.open_edges});
    sheet_ = true;
    inside_ = std::move(crossed_);
    sort(inside_, [](std::uint32_t u, std::uint32_t v) { return u < v; });
    inside_.erase(std::unique(inside_.begin(), inside_.end()), inside_.end());
  } else if (options_.source == InteriorSource::cloud) {
    return Error(
        HB_ERROR_CLOUD_TOO_SPARSE,
        {"The ", positions_.rows(), " points leave gaps that ", options_.resolution, " voxels along the longest side show."},
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

Result<Done> InteriorVoxels::make_domain() {
  if (inside_.empty()) {
    return Error(HB_ERROR_MESH_NO_INTERIOR, {"The volume has no voxel that is inside."}, {"Mark the voxels inside with 1."});
  }
  const Indices unbridged = inside_;
  bridge_components(grid_, inside_);
  const double bytes = static_cast<double>(inside_.size()) * static_cast<double>(options_.centers) * sizeof(std::uint16_t);
  if (bytes > 2e9) {
    return Error(HB_ERROR_OUT_OF_MEMORY,
                 {options_.centers, " centers × ", inside_.size(), " voxels would take ", bytes / 1e6, " MB."},
                 {"Use fewer centers or a coarser resolution."});
  }
  warn_of_few(std::ssize(unbridged));
  // A bridge runs outside the surface: no sphere may sit there.
  on_bridge_.resize(inside_.size());
  std::transform(inside_.begin(), inside_.end(), on_bridge_.begin(),
                 [&](std::uint32_t voxel) { return !std::binary_search(unbridged.begin(), unbridged.end(), voxel); });
  domain_ = VoxelDomain(grid_, std::move(inside_));
  phase_ = surface() && !sheet_ ? Phase::link : Phase::finished;
  return Done{};
}

/** About how many triangles of a closed surface face inward: in front of them it winds the other way. */
Index InteriorVoxels::count_inward() const {
  const TriangleTree tree(positions_, triangles_);
  const Index step = (triangles_.rows() + most_looked_at - 1) / most_looked_at;
  Index inward = 0;
  for (Index t = 0; t < triangles_.rows(); t += step) {
    const Vector3 a = positions_.row(triangles_(t, 0)), b = positions_.row(triangles_(t, 1)), c = positions_.row(triangles_(t, 2));
    const Vector3 normal = (b - a).cross(c - a);
    const Vector3 front = (a + b + c) / 3 + 1e-3 * std::sqrt(normal.norm()) * normal.normalized();
    if (tree.winding_number(front) < -0.5) inward += step;
  }
  return std::min(inward, triangles_.rows());
}

/** Says where the inside is a handful of voxels, and at which resolution it is not: twice as many are aimed at, by the number there
 *  is and by the volume that the surface encloses. */
void InteriorVoxels::warn_of_few(Index voxels) {
  if (voxels >= few || sheet_) return;
  double finer = 0;
  if (surface()) {
    double expected = static_cast<double>(voxels);
    if (orientation_.closed)
      expected = std::min(expected, std::abs(enclosed_volume(positions_, triangles_)) / std::pow(grid_.spacing, 3));
    finer = std::ceil(options_.resolution * std::cbrt(2 * few / std::max(expected, 1e-9)));
  }
  warnings_.push_back({HB_WARNING_VOXELS_FEW, voxels, finer <= highest_resolution ? finer : 0});
}

void InteriorVoxels::link_axis() {
  if (axis_ < 3 && !uncounted_) {
    if (!cross_triangles(axis_)) return;
    if (!uncounted_) find_crossed_links(domain_, *crossings_, orientation_.closed, links_);
    ++axis_;
    return;
  }
  crossings_.reset();
  const MergedLimbs merged = find_merged_limbs(domain_, links_);
  links_ = {};
  if (merged.links > 0) {
    // The voxel must fit into the gap, wherever it falls.
    const double finer = std::ceil(1.2 * options_.resolution / std::max(merged.gap, 1e-6));
    warnings_.push_back({HB_WARNING_LIMBS_MERGED, merged.links, finer <= highest_resolution ? finer : 0, merged.place});
  }
  phase_ = Phase::finished;
}

}  // namespace handlebody
