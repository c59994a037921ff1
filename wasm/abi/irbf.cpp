#include "core/irbf/irbf.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "abi/host_kernel.hpp"
#include "abi/memory.hpp"
#include "abi/support.hpp"

using handlebody::check_arrays;
using handlebody::fail;
using handlebody::Irbf;
using handlebody::KernelKind;
using handlebody::Points;

struct hb_irbf {
  std::unique_ptr<Irbf> irbf;
};

namespace {

/** The voxel domain of a body from outside. Refuses a grid that cannot be indexed, and voxels outside of it. */
handlebody::Result<handlebody::VoxelDomain> read_domain(const hb_body& body) {
  handlebody::Grid grid;
  grid.origin = Eigen::Map<const handlebody::Vector3>(body.origin);
  grid.spacing = body.spacing;
  double cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.dims[axis] = handlebody::signed_count(body.dims[axis]);
    cells *= grid.dims[axis];
  }
  const bool usable = cells > 0 && cells <= 6.4e7 && grid.origin.allFinite() && std::isfinite(grid.spacing) && grid.spacing > 0;
  std::vector<uint32_t> voxels(body.voxels, body.voxels + body.voxel_count);
  const bool ascending = std::adjacent_find(voxels.begin(), voxels.end(), std::greater_equal<>()) == voxels.end();
  if (!usable || !ascending || (!voxels.empty() && voxels.back() >= static_cast<uint64_t>(grid.size()))) {
    return handlebody::Error(HB_ERROR_BODY_INVALID,
                             {"The baked body's voxel grid is not usable, or its voxels lie outside the grid."},
                             {"Bake the model again with this version."});
  }
  return handlebody::VoxelDomain(grid, std::move(voxels));
}

}  // namespace

extern "C" {

int32_t hb_irbf_create(const hb_body* from, const hb_irbf_options* given, hb_irbf** out) {
  handlebody::making();
  if (given->constraints > 1 || given->precision > 1 || given->sphere_fit > 1 ||
      given->structure >= handlebody::sphere_structure_count || given->kernel > static_cast<uint32_t>(KernelKind::custom) ||
      given->order < 2 || given->order > 8) {
    return fail(
        {HB_ERROR_INVALID_OPTION,
         {"The number of a kernel, its order, the constraints, the precision, the fit or the structure of spheres is unknown."},
         {"Use those that the header lists."},
         HB_CULPRIT_OPTION});
  }
  if (auto checked = handlebody::check_mesh_size(from->vertex_count, from->triangle_count); !checked) return fail(checked.error());
  if (const int32_t status = check_arrays({{from->positions, "positions", from->vertex_count, 3},
                                           {from->triangles, "triangles", from->triangle_count, 3},
                                           {from->voxels, "voxels", from->voxel_count},
                                           {from->centers, "centers", from->center_count},
                                           {from->distances, "distances", from->center_count, from->voxel_count},
                                           {from->spheres, "spheres", from->sphere_count, 4}}))
    return status;
  if (const int32_t status = from->sphere_axes ? check_arrays({{from->sphere_axes, "sphere axes", from->sphere_count, 3}}) : HB_OK)
    return status;
  auto domain = read_domain(*from);
  if (!domain) return fail(domain.error());
  handlebody::Body body;
  body.positions = Eigen::Map<const Points>(from->positions, from->vertex_count, 3);
  body.triangles = Eigen::Map<const handlebody::Triangles>(from->triangles, from->triangle_count, 3);
  body.normalization = {Eigen::Map<const handlebody::Vector3>(from->center), from->diagonal};
  body.domain = std::move(*domain);
  body.centers.assign(from->centers, from->centers + from->center_count);
  body.distances.assign(from->distances, from->distances + std::size_t{from->center_count} * from->voxel_count);
  body.distance_scale = from->distance_scale;
  body.smooth_length = from->smooth_length;
  for (uint32_t s = 0; s < from->sphere_count; ++s) {
    const double* sphere = from->spheres + 4 * s;
    body.spheres.push_back({handlebody::Vector3(sphere[0], sphere[1], sphere[2]), sphere[3]});
    if (from->sphere_axes) body.spheres.back().axis = Eigen::Map<const handlebody::Vector3>(from->sphere_axes + 3 * s);
  }
  handlebody::IrbfOptions options;
  options.kernel = handlebody::Kernel::of(static_cast<KernelKind>(given->kernel), given->relative_width, 3, given->order);
  options.kernel.support = given->support;
  options.kernel.custom = handlebody::host_kernel(given->host_kernel);
  options.smoothness = given->smoothness;
  options.anchor_weight = given->anchor_weight;
  options.edge_exponent = given->edge_exponent;
  options.poisson_ratio = given->poisson_ratio;
  options.constraints = static_cast<handlebody::ConstraintKind>(given->constraints);
  options.precision = static_cast<handlebody::FramePrecision>(given->precision);
  options.structure = static_cast<handlebody::SphereStructure>(given->structure);
  options.sphere_fit = static_cast<handlebody::SphereFit>(given->sphere_fit);
  auto irbf = Irbf::create(std::move(body), options);
  if (!irbf) return fail(irbf.error());
  *out = new hb_irbf{std::move(*irbf)};
  return HB_OK;
}

int32_t hb_irbf_share(const hb_irbf* irbf, hb_irbf** shared) {
  handlebody::changing(irbf->irbf->prepared().get());
  *shared = new hb_irbf{std::make_unique<Irbf>(irbf->irbf->prepared())};
  return HB_OK;
}

int32_t hb_irbf_set_handles(hb_irbf* irbf, const double* points, const uint32_t* kinds, uint32_t count) {
  handlebody::changing(irbf->irbf->prepared().get());
  if (const int32_t status = check_arrays({{points, "handles", count, 3}, {kinds, "kinds", count}})) return status;
  std::vector<handlebody::HandleKind> list(count);
  std::transform(kinds, kinds + count, list.begin(),
                 [](uint32_t kind) { return kind == 1 ? handlebody::HandleKind::rotation : handlebody::HandleKind::position; });
  auto done = irbf->irbf->set_handles(Eigen::Map<const Points>(points, count, 3), list);
  return done ? HB_OK : fail(done.error());
}

const double* hb_irbf_positions(const hb_irbf* irbf) {
  return irbf->irbf->prepared()->body.positions.data();
}

double* hb_irbf_targets(hb_irbf* irbf) {
  return irbf->irbf->targets();
}

double* hb_irbf_shapes(hb_irbf* irbf) {
  return irbf->irbf->shapes();
}

int32_t hb_irbf_solve(hb_irbf* irbf, uint32_t max_iterations, double tolerance, uint32_t accelerate, hb_irbf_report* report) {
  handlebody::changing(irbf->irbf->prepared().get());
  const auto solved = irbf->irbf->solve({static_cast<int>(std::min(max_iterations, 1u << 20)), tolerance, accelerate != 0});
  if (!solved) return fail(solved.error());
  report->energy = solved->energy;
  report->anchor_error = solved->anchor_error;
  report->change = solved->change;
  report->iterations = static_cast<uint32_t>(solved->iterations);
  report->converged = solved->converged ? 1 : 0;
  return HB_OK;
}

int32_t hb_irbf_deform(hb_irbf* irbf, float* positions, const float* rest_normals, float* normals) {
  handlebody::changing(irbf->irbf->prepared().get());
  irbf->irbf->deform(positions, rest_normals, normals);
  return HB_OK;
}

int32_t hb_irbf_evaluate(hb_irbf* irbf, const double* points, uint32_t count, double* out) {
  handlebody::changing(irbf->irbf->prepared().get());
  if (const int32_t status = check_arrays({{points, "points", count, 3}, {out, "results", count, 3}})) return status;
  const auto deformed = irbf->irbf->evaluate(Eigen::Map<const Points>(points, count, 3));
  if (!deformed) return fail(deformed.error());
  Eigen::Map<Points>(out, count, 3) = *deformed;
  return HB_OK;
}

int32_t hb_irbf_measure(hb_irbf* irbf, const uint32_t* tetrahedra, uint32_t count, hb_irbf_quality* out) {
  handlebody::changing(irbf->irbf->prepared().get());
  if (const int32_t status = check_arrays({{tetrahedra, "tetrahedra", count, 4}})) return status;
  const auto quality = irbf->irbf->quality(Eigen::Map<const handlebody::Tetrahedra>(tetrahedra, count, 4));
  if (!quality) return fail(quality.error());
  out->volume_ratio = quality->volume_ratio;
  out->total_distortion = quality->total_distortion;
  out->max_distortion = quality->max_distortion;
  out->maximum_principle = quality->maximum_principle;
  out->condition = irbf->irbf->condition();
  out->smoothness = irbf->irbf->smoothness();
  out->relative_width = irbf->irbf->prepared()->basis.relative_width();
  out->flips = static_cast<uint32_t>(quality->flips);
  out->tetrahedra = static_cast<uint32_t>(quality->tetrahedra);
  return HB_OK;
}

void hb_irbf_free(hb_irbf* irbf) {
  // What the last one shared goes with it.
  const void* prepared = irbf && irbf->irbf->prepared().use_count() == 1 ? irbf->irbf->prepared().get() : nullptr;
  delete irbf;
  if (prepared) handlebody::gone(prepared);
}
}
