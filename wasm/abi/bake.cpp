#include "core/irbf/bake.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "abi/memory.hpp"
#include "abi/support.hpp"

using handlebody::Bake;
using handlebody::ConstPoints;

/** Owns the bake, and the flat copies that hb_body points at. */
struct hb_bake {
  explicit hb_bake(std::unique_ptr<Bake> begun) : bake(std::move(begun)) {}
  std::unique_ptr<Bake> bake;
  std::vector<double> spheres, axes, nodes;
  std::vector<uint32_t> steps, lengths;
  std::vector<int32_t> parents;
};

namespace {

int32_t unfinished() {
  return handlebody::fail({HB_ERROR_INTERNAL, {"The bake is not finished."}, {"Step it until its progress is 1."}});
}

}  // namespace

extern "C" {

int32_t hb_mesh_check_size(double vertex_count, double triangle_count) {
  const auto whole = [](double count) { return static_cast<std::int64_t>(count >= 0 && count < 1e15 ? count : 1e15); };
  auto checked = handlebody::check_mesh_size(whole(vertex_count), whole(triangle_count));
  return checked ? HB_OK : handlebody::fail(checked.error());
}

int32_t hb_bake_begin(const double* positions, uint32_t vertex_count, const uint32_t* triangles, uint32_t triangle_count,
                      const hb_bake_options* given, hb_bake** bake) {
  handlebody::making();
  if (given->method >= handlebody::distance_method_count || given->packing >= handlebody::sphere_packing_count ||
      given->quality >= handlebody::bake_quality_count) {
    return handlebody::fail(
        {HB_ERROR_INVALID_OPTION,
         {"There is no distance method ", given->method, ", no packing ", given->packing, " or no quality ", given->quality, "."},
         {"Use the numbers that the header lists."},
         HB_CULPRIT_OPTION});
  }
  if (const int32_t status = hb_mesh_check_size(vertex_count, triangle_count)) return status;
  if (const int32_t status = handlebody::check_arrays({{positions, "positions", vertex_count, 3},
                                                       {triangles, "triangles", triangle_count, 3},
                                                       {given->voxels, "voxels", given->voxel_count},
                                                       {given->bones, "bones", given->bone_count, 6}}))
    return status;
  handlebody::BakeOptions options;
  options.centers = handlebody::signed_count(given->center_count);
  options.resolution = handlebody::signed_count(given->resolution);
  options.method = static_cast<handlebody::DistanceMethod>(given->method);
  options.max_spheres = handlebody::signed_count(given->max_spheres);
  options.packing = static_cast<handlebody::SpherePacking>(given->packing);
  options.quality = static_cast<handlebody::BakeQuality>(given->quality);
  options.cloud = given->cloud != 0;
  options.tree_level = handlebody::signed_count(given->tree_level);
  options.straight_bones = given->straight_bones != 0;
  options.overlap = given->overlap;
  options.smallest_radius = given->smallest_radius;
  for (uint32_t b = 0; b < std::min(given->bone_count, 2001u); ++b) {  // more are refused
    const Eigen::Map<const handlebody::Vector3> from(given->bones + 6 * b), to(given->bones + 6 * b + 3);
    options.bones.push_back({from, to});
  }
  if (given->density != nullptr) options.density.assign(given->density, given->density + vertex_count);
  if (given->used != nullptr) options.used.assign(given->used, given->used + vertex_count);
  if (given->voxel_count > 0) {
    handlebody::Grid grid;
    grid.spacing = given->spacing;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      grid.origin[static_cast<handlebody::Index>(axis)] = given->origin[axis];
      grid.dims[axis] = handlebody::signed_count(given->dims[axis]);
    }
    options.grid = grid;
    options.voxels.assign(given->voxels, given->voxels + given->voxel_count);
  }
  auto begun = Bake::begin(Eigen::Map<const handlebody::Points>(positions, vertex_count, 3),
                           Eigen::Map<const handlebody::Triangles>(triangles, triangle_count, 3), std::move(options));
  if (!begun) return handlebody::fail(begun.error());
  *bake = new hb_bake(std::move(*begun));
  return HB_OK;
}

int32_t hb_bake_step(hb_bake* bake, double* progress) {
  handlebody::changing(bake);
  auto done = bake->bake->step();
  if (!done) return handlebody::fail(done.error());
  *progress = *done;
  return HB_OK;
}

int32_t hb_bake_body(hb_bake* bake, hb_body* out) {
  handlebody::changing(bake);
  if (!bake->bake->finished()) return unfinished();
  const handlebody::Body& body = bake->bake->body();
  bake->spheres.clear(), bake->axes.clear();
  bool long_ones = false;
  for (const auto& sphere : body.spheres) {
    bake->spheres.insert(bake->spheres.end(), {sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius});
    bake->axes.insert(bake->axes.end(), sphere.axis.begin(), sphere.axis.end());
    long_ones = long_ones || handlebody::is_long(sphere);
  }
  const handlebody::Grid& grid = body.domain.grid();
  for (int axis = 0; axis < 3; ++axis) {
    out->center[axis] = body.normalization.center(axis);
    out->origin[axis] = grid.origin(axis);
    out->dims[axis] = static_cast<uint32_t>(grid.dims[axis]);
  }
  out->diagonal = body.normalization.diagonal;
  out->spacing = grid.spacing;
  out->distance_scale = body.distance_scale;
  out->smooth_length = body.smooth_length;
  out->vertex_count = static_cast<uint32_t>(body.positions.rows());
  out->triangle_count = static_cast<uint32_t>(body.triangles.rows());
  out->voxel_count = static_cast<uint32_t>(body.domain.size());
  out->center_count = static_cast<uint32_t>(body.centers.size());
  out->sphere_count = static_cast<uint32_t>(body.spheres.size());
  out->positions = body.positions.data();
  out->triangles = body.triangles.data();
  out->voxels = body.domain.voxels().data();
  out->centers = body.centers.data();
  out->distances = body.distances.data();
  out->spheres = bake->spheres.data();
  out->sphere_axes = long_ones ? bake->axes.data() : nullptr;
  return HB_OK;
}

int32_t hb_bake_skeleton(hb_bake* bake, hb_skeleton* out) {
  handlebody::changing(bake);
  if (!bake->bake->finished()) return unfinished();
  const handlebody::Body& body = bake->bake->body();
  bake->nodes.clear(), bake->steps.clear(), bake->lengths.clear(), bake->parents.clear();
  for (const auto& node : body.skeleton.nodes)
    bake->nodes.insert(bake->nodes.end(), {node.place.x(), node.place.y(), node.place.z(), node.radius});
  for (const auto& branch : body.skeleton.branches) {
    bake->steps.insert(bake->steps.end(), branch.nodes.begin(), branch.nodes.end());
    bake->lengths.push_back(static_cast<uint32_t>(branch.nodes.size()));
    bake->parents.push_back(branch.parent);
  }
  out->node_count = static_cast<uint32_t>(body.skeleton.nodes.size());
  out->branch_count = static_cast<uint32_t>(bake->lengths.size());
  out->step_count = static_cast<uint32_t>(bake->steps.size());
  out->sphere_count = static_cast<uint32_t>(body.sphere_branches.size());
  out->nodes = bake->nodes.data();
  out->steps = bake->steps.data();
  out->lengths = bake->lengths.data();
  out->parents = bake->parents.data();
  out->sphere_branches = body.sphere_branches.data();
  return HB_OK;
}

uint32_t hb_bake_get_warning(hb_bake* bake, uint32_t index, hb_bake_warning* out) {
  const auto& warnings = bake->bake->warnings();
  if (index < warnings.size()) {
    const handlebody::BakeWarning& warning = warnings[index];
    out->code = warning.code;
    out->vertex = static_cast<int32_t>(warning.vertex);
    out->count = static_cast<uint32_t>(warning.count);
    out->placed = warning.place.has_value();
    out->value = warning.value;
    for (int axis = 0; axis < 3; ++axis) out->place[axis] = warning.place ? (*warning.place)[axis] : 0;
  }
  return static_cast<uint32_t>(warnings.size());
}

void hb_bake_free(hb_bake* bake) {
  delete bake;
  handlebody::gone(bake);
}
}
