#include "core/irbf/bake.hpp"

#include <memory>
#include <utility>

#include "abi/support.hpp"

using handlebody::Bake;
using handlebody::ConstPoints;

/** Owns the bake, and the flat copies that hb_body points at. */
struct hb_bake {
  explicit hb_bake(Bake begun) : bake(std::move(begun)) {}
  Bake bake;
  std::vector<double> spheres;
};

extern "C" {

int32_t hb_bake_begin(const double* positions, uint32_t vertex_count, const uint32_t* triangles, uint32_t triangle_count,
                      uint32_t center_count, uint32_t resolution, uint32_t method, uint32_t max_spheres, hb_bake** bake) {
  if (method > static_cast<uint32_t>(handlebody::DistanceMethod::euclidean)) {
    return handlebody::fail({HB_ERROR_INVALID_OPTION,
                             {"There is no distance method ", method, "."},
                             {"Use 0 for fast marching or 1 for Euclidean."},
                             HB_CULPRIT_OPTION});
  }
  handlebody::BakeOptions options;
  options.centers = center_count;
  options.resolution = static_cast<int>(std::min(resolution, 100000u));
  options.method = static_cast<handlebody::DistanceMethod>(method);
  options.max_spheres = static_cast<int>(std::min(max_spheres, 100000u));
  auto begun = Bake::begin(Eigen::Map<const handlebody::Points>(positions, vertex_count, 3),
                           Eigen::Map<const handlebody::Triangles>(triangles, triangle_count, 3), options);
  if (!begun) return handlebody::fail(begun.error());
  *bake = new hb_bake(std::move(*begun));
  return HB_OK;
}

int32_t hb_bake_step(hb_bake* bake, double* progress) {
  auto done = bake->bake.step();
  if (!done) return handlebody::fail(done.error());
  *progress = *done;
  return HB_OK;
}

int32_t hb_bake_body(hb_bake* bake, hb_body* out) {
  if (!bake->bake.finished()) {
    return handlebody::fail({HB_ERROR_INTERNAL, {"The bake is not finished."}, {"Step it until its progress is 1."}});
  }
  const handlebody::Body& body = bake->bake.body();
  bake->spheres.clear();
  for (const auto& sphere : body.spheres) {
    bake->spheres.insert(bake->spheres.end(), {sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius});
  }
  const handlebody::Grid& grid = body.domain.grid();
  for (int axis = 0; axis < 3; ++axis) {
    out->center[axis] = body.normalization.center(axis);
    out->origin[axis] = grid.origin(axis);
    out->dims[axis] = static_cast<uint32_t>(grid.dims[static_cast<std::size_t>(axis)]);
  }
  out->diagonal = body.normalization.diagonal;
  out->spacing = grid.spacing;
  out->distance_scale = body.distance_scale;
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
  return HB_OK;
}

void hb_bake_free(hb_bake* bake) {
  delete bake;
}
}
