#include "core/irbf/bake.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/irbf/sphere_tree.hpp"

namespace handlebody {

namespace {

// Work of a bounded step: enough to be worth a call, little enough for a frame.
constexpr Index points_per_step = 1024, codes_per_step = 1 << 20;
constexpr double far_outside = 1.5;  // spacings beyond which stencils hold on to the nearest voxel
// An open sheet winds about the points on its hollow side a little more than half; an inside has at least a fourth of it
// surrounded.
constexpr double surely = 0.75;

Error invalid_option(const char* name, Index value, Index low, Index high) {
  return {HB_ERROR_INVALID_OPTION,
          {"The bake's ", name, " is ", value, "."},
          {"Use a number from ", low, " to ", high, "."},
          HB_CULPRIT_OPTION};
}

Result<Done> check_options(const BakeOptions& options, Index vertices) {
  if (options.centers < 1 || options.centers > 5000) return invalid_option("number of centers", options.centers, 1, 5000);
  if (options.resolution < 8 || options.resolution > Bake::highest_resolution) {
    return invalid_option("resolution", options.resolution, 8, Bake::highest_resolution);
  }
  if (options.max_spheres < 1 || options.max_spheres > 2000) {
    return invalid_option("number of spheres", options.max_spheres, 1, 2000);
  }
  if (!options.density.empty() && std::ssize(options.density) != vertices) {
    return Error(HB_ERROR_INVALID_SHAPE, {"There are ", options.density.size(), " densities for ", vertices, " vertices."},
                 {"Give one number a vertex, 1 where nothing special is wanted."}, HB_CULPRIT_OPTION);
  }
  for (std::size_t v = 0; v < options.density.size(); ++v) {
    if (options.density[v] >= 1e-6 && options.density[v] <= 1e6) continue;
    return Error(HB_ERROR_INVALID_OPTION, {"The density of vertex ", v, " is ", options.density[v], "."},
                 {"Use numbers from 0.000001 to 1000000, 1 where nothing special is wanted."}, HB_CULPRIT_VERTEX,
                 static_cast<std::int64_t>(v));
  }
  return Done{};
}

std::uint16_t nearest_code(double code) {
  const double above = code + 0.5;
  return static_cast<std::uint16_t>(above);
}

/** The domain that was given, in solver space. */
Result<Grid> solver_grid(const Grid& model, const std::vector<std::uint32_t>& voxels, const Normalization& normalization) {
  const double cells = double(model.dims[0]) * double(model.dims[1]) * double(model.dims[2]);
  if (model.dims[0] < 1 || model.dims[1] < 1 || model.dims[2] < 1 || cells > 64e6 || !model.origin.allFinite() ||
      !(model.spacing > 0) || !std::isfinite(model.spacing)) {
    return Error(HB_ERROR_INVALID_SHAPE,
                 {"The voxel volume has no origin and spacing that are finite, or not 1 to 64 million voxels."},
                 {"Give dimensions, spacing and origin of the volume."});
  }
  for (std::size_t v = 0; v < voxels.size(); ++v) {
    if (voxels[v] < cells && (v == 0 || voxels[v] > voxels[v - 1])) continue;
    return Error(HB_ERROR_INVALID_SHAPE, {"The voxels inside are not ascending indices into the volume."},
                 {"Give each once, in rising order."});
  }
  return Grid{normalization.to_solver(model.origin), model.spacing / normalization.diagonal, model.dims};
}

}  // namespace

// Out of line: there is a lot to move and to destroy.
Bake::Bake() = default;
Bake::Bake(Bake&&) noexcept = default;
Bake::~Bake() = default;

Result<Bake> Bake::begin(const ConstPoints& positions, const ConstTriangles& triangles, BakeOptions options) {
  if (auto checked = check_options(options, positions.rows()); !checked) return checked.error();
  if (auto checked = check_mesh(positions, triangles, options.cloud); !checked) return checked.error();
  if (options.cloud && options.method == DistanceMethod::mean_value) {
    return Error(HB_ERROR_MESH_NO_TRIANGLES, {"Mean value distances go along a surface, and a point cloud has none."},
                 {"Use another distance, or give a closed mesh."});
  }

  Bake bake;
  bake.options_ = std::move(options);
  bake.body_.positions = positions;
  bake.body_.triangles = triangles;
  bake.body_.normalization = normalize(positions);
  bake.weld_ = weld_vertices(positions);
  const auto vertices = std::ssize(bake.weld_.unique);
  bake.options_.centers = std::min(bake.options_.centers, vertices);
  bake.solver_positions_.resize(vertices, 3);
  for (Index v = 0; v < vertices; ++v) {
    bake.solver_positions_.row(v) = bake.body_.normalization.to_solver(positions.row(bake.weld_.unique[v]).transpose());
  }
  bake.triangles_ = weld_triangles(bake.weld_, triangles);
  if (bake.options_.cloud) {  // a point is a triangle without extent, to be near to
    bake.triangles_.resize(vertices, 3);
    for (Index v = 0; v < vertices; ++v) bake.triangles_.row(v).setConstant(static_cast<std::uint32_t>(v));
  }
  const Vector3 low = bake.solver_positions_.colwise().minCoeff(), high = bake.solver_positions_.colwise().maxCoeff();
  const auto& given = bake.options_.grid;
  auto grid =
      given ? solver_grid(*given, bake.options_.voxels, bake.body_.normalization) : make_grid(low, high, bake.options_.resolution);
  if (!grid) return grid.error();
  bake.grid_ = *grid;
  return bake;
}

Result<double> Bake::step() {
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
    case Phase::depth:
      measure_depth();
      break;
    case Phase::spheres:
      if (auto done = pack(); !done) return done.error();
      break;
    case Phase::prepare: {
      auto done = distance_->step();
      if (!done) return done.error();
      prepared_ = *done;
      if (prepared_ >= 1) phase_ = Phase::stencils;
      break;
    }
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
  return progress();
}

void Bake::measure_depth() {
  const auto count = static_cast<std::size_t>(body_.domain.size());
  const std::size_t end = sheet_ ? count : std::min(count, depth_.size() + points_per_step);
  for (std::size_t v = depth_.size(); v < end; ++v) {
    // No more than a step farther than the voxel before it, where that is its neighbor.
    const auto& voxels = body_.domain.voxels();
    const bool beside = v > 0 && !on_bridge_[v - 1] && voxels[v] == voxels[v - 1] + 1;
    const double bound = beside ? 1.0001 * (depth_[v - 1] + grid_.spacing) : std::numeric_limits<double>::infinity();
    depth_.push_back(sheet_ || on_bridge_[v] ? 0 : tree_->distance(body_.domain.center(static_cast<Index>(v)), bound));
  }
  if (end == count) phase_ = Phase::spheres;
}

Result<Done> Bake::pack() {
  SpherePackingOptions packing;
  packing.max_spheres = options_.max_spheres;
  body_.spheres = sheet_                                    ? spread_spheres(body_.domain, options_.max_spheres)
                  : options_.packing == SpherePacking::tree ? sphere_tree(body_.domain, depth_, packing)
                                                            : pack_spheres(body_.domain, depth_, packing);
  // A part whose only voxels lie on its surface still gets a sphere that has an extent.
  for (Sphere& sphere : body_.spheres) sphere.radius = std::max(sphere.radius, 0.05 * grid_.spacing);
  tree_.reset();
  depth_ = {};
  auto distance = make_interior_distance(options_.method, body_.domain, solver_positions_, triangles_);
  if (!distance) return distance.error();
  distance_ = std::move(*distance);
  phase_ = Phase::prepare;
  return Done{};
}

void Bake::sample_vertices() {
  const Index count = solver_positions_.rows();
  for (const Index end = std::min(count, samples_.size() + points_per_step); samples_.size() < end;) {
    const Index v = samples_.size();
    const Vector3 place = solver_positions_.row(v).transpose();
    samples_.add(body_.domain, place);
    const double far = (body_.domain.center(body_.domain.nearest(place)) - place).norm();
    if (far <= far_outside * grid_.spacing) continue;
    ++outside_;
    if (far > how_far_outside_) how_far_outside_ = far, farthest_outside_ = v;
  }
  if (samples_.size() < count) return;
  if (outside_ > 0) {
    const std::uint32_t vertex = weld_.unique[farthest_outside_];
    warnings_.push_back({HB_WARNING_PART_OUTSIDE, outside_, how_far_outside_ * body_.normalization.diagonal,
                         Vector3(body_.positions.row(vertex).transpose()), static_cast<Index>(vertex)});
  }

  // Farthest-point sampling (§4.3) starts at the vertex farthest from the middle of the box. Centers as dense by a factor are
  // closer by its root, on a surface: so much farther does a vertex count.
  const auto vertices = static_cast<std::size_t>(count);
  coverage_.assign(vertices, std::numeric_limits<double>::infinity());
  weight_.assign(vertices, 1);
  if (!options_.density.empty()) {
    for (std::size_t v = 0; v < vertices; ++v) weight_[v] = std::sqrt(options_.density[weld_.unique[v]]);
  }
  double best = -1;
  for (Index v = 0; v < count; ++v) {
    const double distance = weight_[v] * weight_[v] * solver_positions_.row(v).squaredNorm();
    if (distance > best) best = distance, next_center_ = v;
  }
  field_.resize(body_.domain.size());
  body_.distances.reserve(field_.size() * static_cast<std::size_t>(options_.centers));
  phase_ = Phase::centers;
}

void Bake::add_center() {
  body_.centers.push_back(weld_.unique[next_center_]);
  const Vector3 center = samples_.point(next_center_);
  distance_->measure(center, field_.data());

  // Codes to this center's own scale, so that no floats have to be kept until the longest distance is known. Bridges make the
  // domain connected; should a voxel still be out of reach, it is as far as can be.
  double longest = 1e-9;
  for (const double distance : field_) {
    if (distance > longest && distance <= std::numeric_limits<double>::max()) longest = distance;
  }
  scales_.push_back(longest / 65535);
  for (const double distance : field_) {
    body_.distances.push_back(nearest_code(std::min(distance, longest) * (65535 / longest)));
  }

  // The next center is the vertex that is farthest, inside the body, from all so far. Only vertices that lie nearer to the new one
  // as the crow flies than to any before can come nearer to it.
  const auto interior = [&](std::uint32_t v) { return field_[v]; };
  waiting_.clear();
  double farthest = -1;
  const auto compare = [&](Index v) {
    const double far = coverage_[v] * weight_[v];
    if (far > farthest || (far == farthest && v < next_center_)) farthest = far, next_center_ = v;
  };
  for (Index v = 0; v < samples_.size(); ++v) {
    if ((samples_.point(v) - center).squaredNorm() < coverage_[v] * coverage_[v]) {
      waiting_.push_back(v);
    } else {
      compare(v);
    }
  }
  const bool many = 4 * waiting_.size() > coverage_.size();
  if (many) samples_.distance_ratios(center, interior, ratios_);
  for (const Index v : waiting_) {
    const double distance = many ? samples_.distance(ratios_, center, v) : samples_.distance_from(center, interior, v);
    coverage_[v] = std::min(coverage_[v], distance);
    compare(v);
  }
  if (std::ssize(body_.centers) < options_.centers) return;
  body_.distance_scale = *std::max_element(scales_.begin(), scales_.end());
  next_ = 0;
  phase_ = Phase::quantize;
}

/** All centers' codes to one scale, which rounds them once more: they are off by one code at most. */
void Bake::quantize() {
  const auto row = std::ssize(field_);
  for (Index done = 0; done < codes_per_step && next_ < options_.centers; done += row, ++next_) {
    const double factor = scales_[next_] / body_.distance_scale;
    std::uint16_t* codes = body_.distances.data() + next_ * row;
    for (Index v = 0; v < row; ++v) codes[v] = nearest_code(codes[v] * factor);
  }
  if (next_ == options_.centers) phase_ = Phase::finished;
}

double Bake::progress() const {
  // Shares of the time on the dog with 200 centers at 96 voxels, native.
  const auto part = [](auto done, auto all) { return static_cast<double>(done) / std::max(1.0, static_cast<double>(all)); };
  switch (phase_) {
    case Phase::orient:
      return 0;
    case Phase::cross:
      return 0.10 + 0.02 * part(next_, triangles_.rows());
    case Phase::voxelize:
      return 0.12 + 0.02 * part(next_, grid_.dims[2]);
    case Phase::fill:
      return 0.14;
    case Phase::domain:
      return 0.15;
    case Phase::link:
      return 0.15 + 0.01 * axis_;
    case Phase::depth:
      return 0.18 + 0.08 * part(depth_.size(), body_.domain.size());
    case Phase::spheres:
      return 0.26;
    case Phase::prepare:
      return 0.27 + 0.05 * prepared_;
    case Phase::stencils:
      return 0.32 + 0.08 * part(samples_.size(), solver_positions_.rows());
    case Phase::centers:
      return 0.40 + 0.59 * part(body_.centers.size(), options_.centers);
    case Phase::quantize:
      return 0.99;
    case Phase::finished:
      return 1;
  }
  return 1;
}

}  // namespace handlebody
