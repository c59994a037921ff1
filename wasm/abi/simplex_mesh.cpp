#include "abi/simplex_mesh.hpp"

namespace handlebody {

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
  return {{vertices, vertices + count}, {owners, owners + count}, static_cast<Index>(handle_count)};
}

}  // namespace handlebody
