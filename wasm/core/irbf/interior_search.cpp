#include "core/irbf/interior_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace handlebody {

namespace {

/** Voxels inside to aim at, and the most along the longest side, by quality. What drags of Spot, a hand, an octopus and an acrobat
 *  leak hardly changes from 16,000 voxels to 30,000 and more; the dog's leak half as much again with 3,600, where its legs are a
 * voxel wide. */
struct Budget {
  double voxels;
  int finest;
};
constexpr std::array<Budget, bake_quality_count> budgets{{{5000, 96}, {16000, 192}, {64000, 384}}};
/** Counting costs little on the first grid. One on which nothing is inside is followed by finer ones. */
constexpr int first_resolution = 48, coarsest = 16, most_tries = 4;
/** A grid whose number of voxels is off by less than this part is kept. */
constexpr double near_enough = 0.15;

}  // namespace

InteriorSearch::InteriorSearch(const Points& positions, Triangles& triangles, int resolution, BakeQuality quality,
                               InteriorOptions options)
    : positions_(positions),
      triangles_(triangles),
      options_(std::move(options)),
      quality_(quality),
      looking_(resolution == 0),
      next_(looking_ ? std::min(first_resolution, budgets[static_cast<unsigned>(quality)].finest) : resolution) {}

InteriorSearch::InteriorSearch(const Points& positions, Triangles& triangles, const Grid& grid, InteriorOptions options)
    : positions_(positions), triangles_(triangles), options_(std::move(options)), quality_(BakeQuality::normal) {
  trial_ = std::make_unique<InteriorVoxels>(positions_, triangles_, grid, options_);
}

Result<Done> InteriorSearch::begin(int resolution) {
  const Vector3 low = positions_.colwise().minCoeff(), high = positions_.colwise().maxCoeff();
  const auto grid = make_grid(low, high, resolution);
  if (!grid) return grid.error();
  InteriorOptions options = options_;
  options.resolution = resolution;
  trial_ = std::make_unique<InteriorVoxels>(positions_, triangles_, *grid, std::move(options));
  return Done{};
}

/** Another grid that is worth a try after the last, or 0. */
int InteriorSearch::next_resolution() const {
  if (!looking_ || tried_ >= most_tries) return 0;
  const Budget& budget = budgets[static_cast<unsigned>(quality_)];
  const auto inside = static_cast<double>(found_->domain().size());
  double wanted = resolution_;
  if (!counted_ && std::abs(inside / budget.voxels - 1) > near_enough) wanted *= std::cbrt(budget.voxels / inside);
  // Limbs that are merged there are told with the resolution that keeps them apart.
  for (const BakeWarning& warning : found_->warnings())
    if (counted_ && warning.code == HB_WARNING_LIMBS_MERGED) wanted = std::max(wanted, warning.value);
  if (wanted > budget.finest && counted_) return 0;
  const int next = static_cast<int>(std::clamp(std::round(wanted), double(coarsest), double(budget.finest)));
  return next == resolution_ ? 0 : next;
}

Result<double> InteriorSearch::step() {
  if (!trial_)
    if (auto begun = begin(next_); !begun) return begun.error();
  auto done = trial_->step();
  // Of a search, the count is a tenth of the work, and another grid, at most two, as much as is left.
  const double part = !looking_ ? 1 : found_ ? 0.45 : 0.1, from = found_ ? (counted_ ? 0.55 : 0.1) : 0;
  const auto told = [&](double progress) { return progress_ = std::max(progress_, progress); };
  if (done && *done < 1) return told(from + part * *done);
  ++tried_;
  if (!done) {
    trial_.reset();
    if (found_) return 1.0;  // a cloud that is too sparse for a finer grid, or memory for it, keeps the coarser one
    const int finest = budgets[static_cast<unsigned>(quality_)].finest;
    const bool sparse = options_.source == InteriorSource::cloud;
    const int other = sparse ? next_ / 2 : std::min(2 * next_, finest);
    if (!looking_ || tried_ >= most_tries || other == next_ || other < coarsest) return done.error();
    next_ = other;
    return told(0);
  }
  counted_ = found_ != nullptr;
  found_ = std::move(trial_);
  resolution_ = next_;
  next_ = next_resolution();
  if (next_ == 0) return 1.0;
  return told(counted_ ? 0.55 : 0.1);
}

}  // namespace handlebody
