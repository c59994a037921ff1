#include "core/irbf/center_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace handlebody {

namespace {

// Work of a bounded step: enough to be worth a call, little enough for a frame.
constexpr Index points_per_step = 1024, codes_per_step = 1 << 20;
constexpr double far_outside = 1.5;  // spacings beyond which stencils hold on to the nearest voxel
constexpr double finest_code = 65535;
constexpr double least_gap = 0.1;   // between centers that serve a sphere, in its radii
constexpr double sphere_reach = 3;  // radii within which a sphere's centers lie

std::uint16_t nearest_code(double code) {
  const double above = code + 0.5;
  return static_cast<std::uint16_t>(above);
}

}  // namespace

CenterSampling::CenterSampling(const VoxelDomain& domain, const Points& positions, InteriorDistance& distance,
                               const std::vector<Sphere>& spheres, CenterSamplingOptions options)
    : domain_(domain), positions_(positions), distance_(distance), spheres_(spheres), options_(std::move(options)) {}

double CenterSampling::step() {
  switch (phase_) {
    case Phase::stencils:
      sample_vertices();
      break;
    case Phase::centers:
      add_center();
      break;
    case Phase::quantize:
      quantize();
      break;
    case Phase::finished:
      break;
  }
  // Shares of the time on the dog with 200 centers at 96 voxels, native.
  switch (phase_) {
    case Phase::stencils:
      return 0.12 * static_cast<double>(samples_.size()) / static_cast<double>(positions_.rows());
    case Phase::centers:
      return 0.12 +
             0.86 * static_cast<double>(centers_.size()) / static_cast<double>(std::max(options_.most, std::ssize(centers_)));
    case Phase::quantize:
      return 0.98;
    case Phase::finished:
      return 1;
  }
  return 1;
}

void CenterSampling::sample_vertices() {
  const Index count = positions_.rows();
  for (const Index end = std::min(count, samples_.size() + points_per_step); samples_.size() < end;) {
    const Index v = samples_.size();
    const Vector3 place = positions_.row(v).transpose();
    samples_.add(domain_, place);
    const double far = (domain_.center(domain_.nearest(place)) - place).norm();
    if (far <= far_outside * domain_.grid().spacing) continue;
    ++outside_.count;
    if (far > outside_.distance) outside_.distance = far, outside_.farthest = v;
  }
  if (samples_.size() == count) begin();
}

/** Sampling starts at the vertex farthest from the middle of the box. Where centers are to be `density` times as dense on a
 * surface, their spacing shrinks by the square root of it: distances are weighted by that root when the farthest vertex is looked
 * for. */
void CenterSampling::begin() {
  const auto vertices = static_cast<std::size_t>(positions_.rows());
  coverage_.assign(vertices, std::numeric_limits<double>::infinity());
  weight_.assign(vertices, 1);
  for (std::size_t v = 0; v < options_.density.size(); ++v) weight_[v] = std::sqrt(options_.density[v]);
  double best = -1;
  for (Index v = 0; v < positions_.rows(); ++v) {
    const double distance = weight_[v] * weight_[v] * positions_.row(v).squaredNorm();
    if (distance > best) best = distance, next_ = v;
  }
  field_.resize(domain_.size());
  distances_.reserve(field_.size() * static_cast<std::size_t>(options_.count));
  for (const Sphere& sphere : spheres_) middles_.add(domain_, sphere.center);
  near_.assign(spheres_.size(), 0);
  given_up_.assign(spheres_.size(), 0);
  phase_ = Phase::centers;
}

void CenterSampling::add_center() {
  centers_.push_back(static_cast<std::uint32_t>(next_));
  const Vector3 center = samples_.point(next_);
  distance_.measure(center, field_.data());

  // Codes in this center's own scale, so that no floats have to be kept until the longest distance is known. Bridges make the
  // domain connected; a voxel that is still out of reach would get the longest distance.
  double longest = 1e-9;
  for (const double distance : field_) {
    if (distance > longest && distance <= std::numeric_limits<double>::max()) longest = distance;
  }
  scales_.push_back(longest / finest_code);
  for (const double distance : field_) distances_.push_back(nearest_code(std::min(distance, longest) * (finest_code / longest)));

  // The next center is the vertex that is farthest, inside the body, from all so far. Only vertices whose straight distance to the
  // new one is below their interior distance to every earlier one can come nearer to it.
  const auto interior = [&](std::uint32_t v) { return field_[v]; };
  approached_.clear();
  double farthest = -1;
  const auto compare = [&](Index v) {
    const double far = coverage_[v] * weight_[v];
    if (far > farthest || (far == farthest && v < next_)) farthest = far, next_ = v;
  };
  for (Index v = 0; v < samples_.size(); ++v) {
    if ((samples_.point(v) - center).squaredNorm() < coverage_[v] * coverage_[v]) {
      approached_.push_back(v);
    } else {
      compare(v);
    }
  }
  const bool many = 4 * approached_.size() > coverage_.size();
  if (many) samples_.distance_ratios(center, interior, ratios_);
  for (const Index v : approached_) {
    const double distance = many ? samples_.distance(ratios_, center, v) : samples_.distance_from(center, interior, v);
    coverage_[v] = std::min(coverage_[v], distance);
    compare(v);
  }
  for (std::size_t s = 0; s < spheres_.size(); ++s) {
    const Sphere& sphere = spheres_[s];
    const double reach = sphere_reach * sphere.radius;
    if ((sphere.center - center).squaredNorm() > reach * reach) continue;
    near_[s] += middles_.distance_from(center, interior, static_cast<Index>(s)) <= reach;
  }
  if (std::ssize(centers_) < options_.count || serve_spheres()) return;
  distance_scale_ = *std::max_element(scales_.begin(), scales_.end()) * (finest_code / options_.most_code);
  next_ = 0;
  phase_ = Phase::quantize;
}

/** Looks for a vertex that is to be a center for the sake of a sphere that has too few near it: of those within its reach, the one
 *  that is farthest from all centers. Whether it is within reach inside the body, too, its own distances tell. */
bool CenterSampling::serve_spheres() {
  if (std::ssize(centers_) >= options_.most) return false;
  for (std::size_t s = 0; s < spheres_.size(); ++s) {
    if (near_[s] >= options_.per_sphere || given_up_[s]) continue;
    const double reach = sphere_reach * spheres_[s].radius;
    double farthest = 0;
    for (Index v = 0; v < samples_.size(); ++v) {
      if (coverage_[v] <= farthest || (samples_.point(v) - spheres_[s].center).squaredNorm() > reach * reach) continue;
      farthest = coverage_[v];
      next_ = v;
    }
    // Centers closer than a part of the radius would tell no more.
    if (farthest > least_gap * spheres_[s].radius) return true;
    given_up_[s] = 1;
  }
  return false;
}

/** Brings all centers' codes to one scale, which rounds them once more: they are off by one code at most. */
void CenterSampling::quantize() {
  const auto row = std::ssize(field_);
  for (Index done = 0; done < codes_per_step && next_ < std::ssize(centers_); done += row, ++next_) {
    const double factor = scales_[next_] / distance_scale_;
    std::uint16_t* codes = distances_.data() + next_ * row;
    for (Index v = 0; v < row; ++v) codes[v] = nearest_code(codes[v] * factor);
  }
  if (next_ == std::ssize(centers_)) phase_ = Phase::finished;
}

}  // namespace handlebody
