#include "core/irbf/bake.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/irbf/curve_skeleton.hpp"
#include "core/irbf/skeleton_spheres.hpp"
#include "core/irbf/sphere_tree.hpp"

namespace handlebody {

namespace {

/** Voxels whose depth is measured in a step: enough to be worth a call, little enough for a frame. */
constexpr Index voxels_per_step = 1024;
/** Diagonals of the body that a voxel inside may be away from its middle: what is farther is a volume of something else. */
constexpr double farthest_voxel = 100;
/** Diagonals of the body that a voxel measures at least: 64 million in a row would not be as long as it is. */
constexpr double smallest_voxel = 1e-8;

/** Centers and spheres where they are chosen: some for any body, more for each branch of its skeleton (a torso, a leg, a tail). The
 *  drags of ten animals leak as little with 100 evenly spread centers as with 200, and a tenth more with 120 spheres than with 200.
 */
constexpr Index centers_of_any = 80, centers_of_branch = 5, most_automatic_centers = 300;
constexpr int spheres_of_any = 40, spheres_of_branch = 6, most_automatic_spheres = 200;
/** Paper 001, §4.3: centers that cover each sphere. */
constexpr Index centers_of_sphere = 4;
/** Codes of interior distances, by quality. Coarser ones make smaller files. Rounded to 8,191, a vertex of Spot or the dog moves by
 *  4e-4 diagonals at most in any drag of the leakage table, to 16,383 by 1.3e-4 and to 4,095 by 5e-4. */
constexpr std::array<double, bake_quality_count> most_codes{4095, 8191, 65535};
/** Radius of the smallest spheres, in spacings: along the skeleton, and beside it. */
constexpr double least_on_skeleton = 0.75, least_beside = 1.5;
/** Half the length of an ellipsoid that is found, in its radii. */
constexpr double least_bone = 2;
constexpr int most_spheres = 2000;
constexpr int most_tree_level = 10;  // 512 voxels halved as often

Error invalid_option(const char* name, Index value, Index low, Index high) {
  return {HB_ERROR_INVALID_OPTION,
          {"The bake's ", name, " is ", value, "."},
          {"Use a number from ", low, " to ", high, "."},
          HB_CULPRIT_OPTION};
}

Result<Done> check_options(const BakeOptions& options, Index vertices) {
  if (options.centers < 0 || options.centers > 5000) return invalid_option("number of centers", options.centers, 1, 5000);
  if (options.resolution != 0 && (options.resolution < 8 || options.resolution > Bake::highest_resolution)) {
    return invalid_option("resolution", options.resolution, 8, Bake::highest_resolution);
  }
  if (options.max_spheres < 0 || options.max_spheres > most_spheres) {
    return invalid_option("number of spheres", options.max_spheres, 1, most_spheres);
  }
  if (!(options.overlap >= -4 && options.overlap <= 1)) {
    return Error(HB_ERROR_INVALID_OPTION, {"The bake's overlap of spheres is ", options.overlap, "."},
                 {"Use a number from -4 to 1, such as 0."}, HB_CULPRIT_OPTION);
  }
  if (!(options.smallest_radius >= 0 && options.smallest_radius <= 1)) {
    return Error(HB_ERROR_INVALID_OPTION, {"The bake's smallest radius is ", options.smallest_radius, "."},
                 {"Use a part of the diagonal from 0 to 1, such as 0.01, or have it chosen."}, HB_CULPRIT_OPTION);
  }
  if (options.tree_level < 0 || options.tree_level > most_tree_level)
    return invalid_option("octree level", options.tree_level, 1, most_tree_level);
  if (std::ssize(options.bones) > most_spheres) {
    return Error(HB_ERROR_INVALID_OPTION, {"There are ", options.bones.size(), " bones; a body takes up to 2000."},
                 {"Give fewer bones."}, HB_CULPRIT_OPTION);
  }
  for (std::size_t k = 0; k < options.bones.size(); ++k) {
    if (options.bones[k].from.allFinite() && options.bones[k].to.allFinite()) continue;
    return Error(HB_ERROR_INVALID_OPTION, {"Bone ", k, " has a coordinate that is not a finite number."},
                 {"Give x, y and z of both ends as ordinary numbers."}, HB_CULPRIT_OPTION);
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
  const Grid grid{normalization.to_solver(model.origin), model.spacing / normalization.diagonal, model.dims};
  if (!(grid.spacing >= smallest_voxel && grid.spacing <= farthest_voxel)) {
    return Error(HB_ERROR_INVALID_SHAPE,
                 {"The voxels are not those of this body: the edge of one is ", grid.spacing, " of its diagonal."},
                 {"Give the volume's origin and spacing in the units of the vertices."});
  }
  for (const std::uint32_t voxel : voxels) {
    const double away = grid.center(voxel).norm();
    if (away <= farthest_voxel) continue;
    return Error(HB_ERROR_INVALID_SHAPE,
                 {"The voxels inside are not those of this body: voxel ", voxel, " is ", away, " of its diagonals away from it."},
                 {"Give the volume's origin and spacing in the units of the vertices."});
  }
  return grid;
}

}  // namespace

Bake::Bake() = default;
Bake::~Bake() = default;

Result<std::unique_ptr<Bake>> Bake::begin(const ConstPoints& positions, const ConstTriangles& triangles, BakeOptions options) {
  if (auto checked = check_options(options, positions.rows()); !checked) return checked.error();
  if (auto checked = check_mesh(positions, triangles, options.cloud); !checked) return checked.error();
  if (options.cloud && options.method == DistanceMethod::mean_value) {
    return Error(HB_ERROR_MESH_NO_TRIANGLES, {"Mean value distances go along a surface, and a point cloud has none."},
                 {"Use another distance, or give a closed mesh."});
  }

  std::unique_ptr<Bake> made(new Bake);
  Bake& bake = *made;
  bake.options_ = std::move(options);
  bake.body_.positions = positions;
  bake.body_.triangles = triangles;
  auto counted = count_mesh(positions, triangles, std::move(bake.options_.used));
  if (!counted) return counted.error();
  bake.mesh_ = std::move(*counted);
  bake.warnings_ = bake.mesh_.warnings;
  const Normalization normalization = bake.body_.normalization = normalize(bake.mesh_.positions);
  const Index vertices = bake.mesh_.positions.rows();
  bake.options_.centers = std::min(bake.options_.centers, vertices);
  bake.solver_positions_.resize(vertices, 3);
  for (Index v = 0; v < vertices; ++v)
    bake.solver_positions_.row(v) = normalization.to_solver(bake.mesh_.positions.row(v).transpose());
  if (bake.options_.cloud) {  // a point is a triangle without extent, to measure distances to
    bake.mesh_.triangles.resize(vertices, 3);
    for (Index v = 0; v < vertices; ++v) bake.mesh_.triangles.row(v).setConstant(static_cast<std::uint32_t>(v));
    bake.mesh_.with_area = vertices;
  }

  const auto& given = bake.options_.grid;
  InteriorOptions interior;
  interior.source = given ? InteriorSource::voxels : bake.options_.cloud ? InteriorSource::cloud : InteriorSource::surface;
  interior.allow_sheet = bake.options_.method == DistanceMethod::euclidean;
  interior.centers = bake.options_.centers > 0 ? bake.options_.centers : centers_of_any;
  interior.flat = bake.mesh_.triangles.rows() - bake.mesh_.with_area;
  Points& places = bake.solver_positions_;
  Triangles& turned = bake.mesh_.triangles;
  if (given) {
    auto grid = solver_grid(*given, bake.options_.voxels, normalization);
    if (!grid) return grid.error();
    interior.voxels = std::move(bake.options_.voxels);
    bake.interior_ = std::make_unique<InteriorSearch>(places, turned, *grid, std::move(interior));
  } else {
    bake.interior_ =
        std::make_unique<InteriorSearch>(places, turned, bake.options_.resolution, bake.options_.quality, std::move(interior));
  }
  return made;
}

Result<double> Bake::step() {
  switch (phase_) {
    case Phase::interior: {
      auto done = interior_->step();
      if (!done) return done.error();
      part_ = *done;
      if (part_ >= 1) take_interior();
      break;
    }
    case Phase::depth:
      measure_depth();
      break;
    case Phase::spheres:
      if (auto done = pack(); !done) return done.error();
      break;
    case Phase::distance:
      if (auto done = measure(); !done) return done.error();
      break;
    case Phase::prepare: {
      auto done = distance_->step();
      if (!done) return done.error();
      part_ = *done;
      if (part_ >= 1) begin_sampling();
      break;
    }
    case Phase::centers:
      part_ = sampling_->step();
      if (part_ >= 1) take_centers();
      break;
    case Phase::finished:
      break;
  }
  return progress();
}

void Bake::enter(Phase phase) {
  phase_ = phase;
  part_ = 0;
}

void Bake::take_interior() {
  body_.domain = std::move(interior_->found().domain());
  for (BakeWarning warning : interior_->found().warnings()) {
    if (warning.place) warning.place = body_.normalization.to_model(*warning.place);
    warnings_.push_back(warning);
  }
  enter(Phase::depth);
}

void Bake::measure_depth() {
  const bool sheet = interior_->found().sheet();
  const auto& on_bridge = interior_->found().on_bridge();
  const auto& voxels = body_.domain.voxels();
  const std::size_t count = voxels.size();
  const std::size_t end = sheet ? count : std::min(count, depth_.size() + voxels_per_step);
  for (std::size_t v = depth_.size(); v < end; ++v) {
    // At most one spacing farther than the voxel before it, where that is its neighbor.
    const bool beside = v > 0 && !on_bridge[v - 1] && voxels[v] == voxels[v - 1] + 1;
    const double bound = beside ? 1.0001 * (depth_[v - 1] + body_.domain.grid().spacing) : std::numeric_limits<double>::infinity();
    const Vector3 center = body_.domain.center(static_cast<Index>(v));
    depth_.push_back(sheet || on_bridge[v] ? 0 : interior_->found().tree().distance(center, bound));
  }
  if (end == count) enter(Phase::spheres);
}

Result<Done> Bake::pack() {
  const bool sheet = interior_->found().sheet();
  Index branches = 0;
  if (!sheet) {
    body_.skeleton = curve_skeleton(body_.domain, depth_);
    branches = std::ssize(body_.skeleton.branches);
    body_.smooth_length = smooth_length(body_.skeleton);
  }
  if (options_.max_spheres == 0 && options_.tree_level > 0) options_.max_spheres = most_spheres;  // the level bounds them
  if (options_.max_spheres == 0)
    options_.max_spheres = static_cast<int>(std::min<Index>(spheres_of_any + spheres_of_branch * branches, most_automatic_spheres));
  most_centers_ = options_.centers;
  if (options_.centers == 0) {
    const Index vertices = solver_positions_.rows();
    most_centers_ = std::min(most_automatic_centers, vertices);
    options_.centers = std::min(centers_of_any + centers_of_branch * branches, most_centers_ / 2 + 1);
  }

  SpherePackingOptions packing;
  packing.max_spheres = options_.max_spheres;
  packing.max_overlap = options_.overlap;
  const double smallest = options_.smallest_radius / body_.domain.grid().spacing;
  if (smallest > 0) packing.min_radius = smallest;
  if (sheet) {
    body_.spheres = spread_spheres(body_.domain, options_.max_spheres);
  } else if (options_.packing == SpherePacking::tree) {
    body_.spheres = sphere_tree(body_.domain, depth_, packing, options_.tree_level);
  } else if (options_.packing == SpherePacking::medial) {
    body_.spheres = pack_spheres(body_.domain, depth_, packing);
  } else {
    packing.min_radius = smallest > 0 ? smallest : least_on_skeleton;
    packing.medial_slope = 1;  // what is wide is filled
    SkeletonSphereOptions along;
    along.packing = packing;
    along.fill_radius = smallest > 0 ? smallest : least_beside;
    for (const SkeletonSphere& sphere : skeleton_spheres(body_.domain, depth_, body_.skeleton, along)) {
      body_.spheres.push_back(sphere);
      body_.sphere_branches.push_back(sphere.branch);
    }
  }
  if (!sheet) body_.sphere_branches.resize(body_.spheres.size(), -1);
  if (auto done = put_bones(); !done) return done.error();
  // A part whose only voxels lie on its surface still gets a sphere that has an extent.
  for (Sphere& sphere : body_.spheres) sphere.radius = std::max(sphere.radius, 0.05 * body_.domain.grid().spacing);
  interior_.reset();
  depth_ = {};
  enter(Phase::distance);
  return Done{};
}

/** Ellipsoids, given and found, in the place of the spheres there. A sheet has no depth, and keeps its spheres. */
Result<Done> Bake::put_bones() {
  if (interior_->found().sheet()) return Done{};
  const double shrink = SpherePackingOptions{}.shrink;
  std::vector<Sphere> ellipsoids;
  for (std::size_t k = 0; k < options_.bones.size(); ++k) {
    const Bone bone{body_.normalization.to_solver(options_.bones[k].from), body_.normalization.to_solver(options_.bones[k].to)};
    const auto ellipsoid = bone_ellipsoid(body_.domain, depth_, bone, shrink);
    if (!ellipsoid) {
      return Error(HB_ERROR_INVALID_OPTION, {"Bone ", k, " leaves the model, or has no length."},
                   {"Give it two ends between which all is inside, such as two places on the curve skeleton."}, HB_CULPRIT_OPTION);
    }
    ellipsoids.push_back(*ellipsoid);
  }
  if (options_.straight_bones) {
    for (const Bone& bone : straight_bones(body_.skeleton)) {
      const auto ellipsoid = bone_ellipsoid(body_.domain, depth_, bone, shrink);
      // What is hardly longer than thick is better filled by spheres.
      if (ellipsoid && ellipsoid->axis.norm() >= least_bone * ellipsoid->radius) ellipsoids.push_back(*ellipsoid);
    }
  }
  if (ellipsoids.empty()) return Done{};
  add_bones(ellipsoids, body_.skeleton, body_.spheres, body_.sphere_branches);
  // Bones bend at their joints: one smooth function is half as long as they are, as it is half as long as a limb elsewhere.
  double halves = 0, bones = 0;
  for (const Sphere& sphere : body_.spheres) {
    if (is_long(sphere)) halves += sphere.axis.norm(), ++bones;
  }
  body_.smooth_length = std::min(body_.smooth_length, halves / bones);
  return Done{};
}

Result<Done> Bake::measure() {
  auto distance = make_interior_distance(options_.method, body_.domain, solver_positions_, mesh_.triangles);
  if (!distance) return distance.error();
  distance_ = std::move(*distance);
  enter(Phase::prepare);
  return Done{};
}

void Bake::begin_sampling() {
  std::vector<double> density;
  if (!options_.density.empty())
    for (std::uint32_t place = 0; place < mesh_.weld.unique.size(); ++place)
      density.push_back(options_.density[mesh_.stored_number(place)]);
  CenterSamplingOptions sampling;
  sampling.count = options_.centers;
  sampling.most = most_centers_;
  sampling.per_sphere = most_centers_ > options_.centers ? centers_of_sphere : 0;
  sampling.most_code = most_codes[static_cast<unsigned>(options_.quality)];
  sampling.density = std::move(density);
  sampling_ = std::make_unique<CenterSampling>(body_.domain, solver_positions_, *distance_, body_.spheres, std::move(sampling));
  enter(Phase::centers);
}

void Bake::take_centers() {
  const CenterSampling::Outside& outside = sampling_->outside();
  if (outside.count > 0) {
    const std::uint32_t vertex = mesh_.stored_number(static_cast<std::uint32_t>(outside.farthest));
    warnings_.push_back({HB_WARNING_PART_OUTSIDE, outside.count, outside.distance * body_.normalization.diagonal,
                         Vector3(body_.positions.row(vertex).transpose()), static_cast<Index>(vertex)});
  }
  for (const std::uint32_t center : sampling_->centers()) body_.centers.push_back(mesh_.stored_number(center));
  body_.distances = std::move(sampling_->distances());
  body_.distance_scale = sampling_->distance_scale();
  sampling_.reset();
  enter(Phase::finished);
}

/** Shares of the time on the dog with 200 centers at 96 voxels, native. */
double Bake::progress() const {
  switch (phase_) {
    case Phase::interior:
      return 0.18 * part_;
    case Phase::depth:
      return 0.18 + 0.08 * static_cast<double>(depth_.size()) / static_cast<double>(body_.domain.size());
    case Phase::spheres:
    case Phase::distance:
      return 0.26;
    case Phase::prepare:
      return 0.27 + 0.05 * part_;
    case Phase::centers:
      return 0.32 + 0.68 * part_;
    case Phase::finished:
      return 1;
  }
  return 1;
}

}  // namespace handlebody
