// The tetrahedra section of handlebody.h.
#include <utility>

#include "abi/memory.hpp"
#include "abi/support.hpp"
#include "core/distance/voxel_tetrahedra.hpp"

using namespace handlebody;

struct hb_tetrahedra {
  VoxelTetrahedra made;
};

extern "C" {

int32_t hb_tetrahedra_create(const double* positions, uint32_t vertex_count, const uint32_t* triangles, uint32_t triangle_count,
                             uint32_t resolution, hb_tetrahedra** out) {
  handlebody::making();
  if (const int32_t status = check_arrays({{positions, "positions", vertex_count, 3}, {triangles, "triangles", triangle_count, 3}}))
    return status;
  SimplexMesh surface;
  surface.positions = Eigen::Map<const Matrix>(positions, static_cast<Index>(vertex_count), 3);
  surface.simplices = Eigen::Map<const Simplices>(triangles, static_cast<Index>(triangle_count), 3);
  auto made = make_voxel_tetrahedra(surface, signed_count(resolution));
  if (!made) return fail(made.error());
  *out = new hb_tetrahedra{std::move(*made)};
  return HB_OK;
}

void hb_tetrahedra_arrays(hb_tetrahedra* tetrahedra, hb_tetrahedra_view* out) {
  const VoxelTetrahedra& made = tetrahedra->made;
  *out = {static_cast<uint32_t>(made.mesh.positions.rows()),
          static_cast<uint32_t>(made.mesh.simplices.rows()),
          made.mesh.positions.data(),
          made.mesh.simplices.data(),
          made.corners.data()->data(),
          made.coordinates.data()->data()};
}

void hb_tetrahedra_free(hb_tetrahedra* tetrahedra) {
  delete tetrahedra;
  handlebody::gone(tetrahedra);
}
}
