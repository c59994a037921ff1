#include "abi/simplex_mesh.hpp"

#include <cstddef>
#include <utility>

#include "abi/memory.hpp"
#include "core/mesh/sound_mesh.hpp"

using namespace handlebody;

struct hb_sound_mesh {
  SoundMesh made;
};

static_assert(sizeof(FlatVertex) == sizeof(hb_flat_vertex) && offsetof(FlatVertex, parts) == offsetof(hb_flat_vertex, parts));

namespace handlebody {

int32_t check_mesh(const hb_simplex_mesh& mesh) {
  const auto [positions, simplices, vertex_count, dimension, simplex_count, corners] = mesh;
  return check_arrays({{positions, "positions", vertex_count, dimension}, {simplices, "simplices", simplex_count, corners}});
}

int32_t check_held(const hb_held_vertices& held) {
  return check_arrays({{held.vertices, "held vertices", held.count}, {held.owners, "owners", held.count}});
}

Result<SimplexMesh> read_mesh(const hb_simplex_mesh& mesh) {
  const auto [positions, simplices, vertex_count, dimension, simplex_count, corners] = mesh;
  const bool shaped = (dimension == 2 && corners == 3) || (dimension == 3 && (corners == 3 || corners == 4));
  if (!shaped) {
    return Error(HB_ERROR_INVALID_SHAPE,
                 {"Simplices of ", corners, " corners in ", dimension, " dimensions are none that weights know."},
                 {"Give triangles in 2 or 3 dimensions, or tetrahedra in 3."});
  }
  return SimplexMesh{Eigen::Map<const Matrix>(positions, static_cast<Index>(vertex_count), static_cast<Index>(dimension)),
                     Eigen::Map<const Simplices>(simplices, static_cast<Index>(simplex_count), static_cast<Index>(corners))};
}

HeldVertices read_held(const hb_held_vertices& held) {
  const auto [vertices, owners, count, handle_count] = held;
  return {{vertices, vertices + count}, {owners, owners + count}, signed_count(handle_count)};
}

}  // namespace handlebody

extern "C" {

int32_t hb_sound_mesh_create(const hb_simplex_mesh* mesh, uint32_t weld, uint32_t strict, hb_sound_mesh** sound) {
  handlebody::making();
  if (!mesh || !sound)
    return fail({HB_ERROR_INVALID_SHAPE, {"A pointer to the mesh or the result is NULL."}, {"Pass valid pointers."}});
  if (const int32_t status = check_mesh(*mesh)) return status;
  if (weld > 1 || strict > 1)
    return fail({HB_ERROR_INVALID_OPTION,
                 {"Welding ", weld, " or strictness ", strict, " is unknown."},
                 {"Use 0 or 1."},
                 HB_CULPRIT_OPTION});
  auto read = read_mesh(*mesh);
  if (!read) return fail(read.error());
  auto made = handlebody::sound_mesh(*read, {weld == 1, strict == 1});
  if (!made) return fail(made.error());
  *sound = new hb_sound_mesh{std::move(*made)};
  return HB_OK;
}

void hb_sound_mesh_get(hb_sound_mesh* sound, hb_sound_mesh_view* view) {
  const SoundMesh& made = sound->made;
  const SimplexMesh& mesh = made.mesh;
  *view = {mesh.positions.data(),
           mesh.simplices.data(),
           static_cast<uint32_t>(mesh.positions.rows()),
           static_cast<uint32_t>(mesh.simplices.rows()),
           made.first.data(),
           made.vertex_of.data(),
           made.place_of.data(),
           reinterpret_cast<const hb_flat_vertex*>(made.flat_vertices.data()),
           made.doubled.data(),
           static_cast<uint32_t>(made.flat_vertices.size()),
           static_cast<uint32_t>(made.doubled.size()),
           made.flat.count,
           made.flat.first,
           made.unused.count,
           made.unused.first};
}

void hb_sound_mesh_free(hb_sound_mesh* sound) {
  delete sound;
  handlebody::gone(sound);
}
}
