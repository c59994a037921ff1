// Tetrahedra that fill a surface.
//
// behind: abi/tetrahedra.cpp core/distance/voxel_tetrahedra.cpp core/mesh/weld.cpp core/mesh/sound_surface.cpp
#include "meshes.hpp"
#include "target.hpp"

using namespace handlebody::fuzz;

FUZZ(bytes) {
  const Mesh mesh = make_mesh(bytes, 3, 3);
  const std::uint32_t vertices = bytes.count(mesh.vertex_count()), triangles = bytes.count(mesh.simplex_count()),
                      resolution = bytes.option(4, bytes.byte() < 240 ? 6 : 24);
  Owned<hb_tetrahedra_free> made;
  if (!made.make([&](hb_tetrahedra** out) {
        return hb_tetrahedra_create(mesh.positions.data(), vertices, mesh.simplices.data(), triangles, resolution, out);
      }))
    return;
  reached();
  hb_tetrahedra_view view;
  hb_tetrahedra_arrays(made.get(), &view);
  for (std::uint32_t i = 0; i < 4 * view.tetrahedron_count; ++i)
    require(view.tetrahedra[i] < view.vertex_count, "a corner is a vertex");
  for (std::uint32_t i = 0; i < 4 * mesh.vertex_count(); ++i) require(view.corners[i] < view.vertex_count, "a corner is a vertex");
}
