#include "core/mesh/cotangent_laplacian.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace handlebody {

namespace {

/** Normals of the edges or faces opposite each corner of a simplex, with their length or area for a length: the gradients of the
 * hat functions times −d·volume. */
void face_normals(const std::array<Vector3, 4>& p, Index corners, std::array<Vector3, 4>& normals) {
  if (corners == 3) {
    // The normal is the edge turned by a right angle. Only products of two normals matter, so the edges themselves will do.
    for (std::size_t k = 0; k < 3; ++k) normals[k] = p[(k + 2) % 3] - p[(k + 1) % 3];
    return;
  }
  normals[0] = (p[3] - p[1]).cross(p[2] - p[1]) / 2;
  normals[1] = (p[2] - p[0]).cross(p[3] - p[0]) / 2;
  normals[2] = (p[3] - p[0]).cross(p[1] - p[0]) / 2;
  normals[3] = (p[1] - p[0]).cross(p[2] - p[0]) / 2;
}

}  // namespace

SparseMatrix cotangent_laplacian(const SimplexMesh& mesh, double thinnest) {
  const Index corners = mesh.simplices.cols(), d = mesh.positions.cols();
  const double order = static_cast<double>(corners) - 1;
  std::vector<Triplet> entries;
  entries.reserve(2 * mesh.simplices.rows() * corners * (corners - 1));
  std::array<Vector3, 4> p, normals;
  for (Index s = 0; s < mesh.simplices.rows(); ++s) {
    const std::uint32_t* const v = mesh.simplices.data() + s * corners;
    for (Index k = 0; k < corners; ++k) {
      const double* const at = mesh.positions.data() + v[k] * d;
      p[k] = {at[0], at[1], d == 3 ? at[2] : 0.0};
    }
    face_normals(p, corners, normals);
    // ∫ ∇φᵢ·∇φⱼ = nᵢ·nⱼ / (d² volume). The diagonal is minus the sum of the others, so that constants vanish to the last bit.
    const double volume = std::max(simplex_volume(mesh, s), thinnest * std::pow(longest_edge(mesh, s), order));
    const double scale = 1 / (order * order * volume);
    for (Index i = 0; i < corners; ++i) {
      for (Index j = 0; j < i; ++j) {
        const double entry = scale * normals[i].dot(normals[j]);
        entries.emplace_back(v[i], v[j], entry);
        entries.emplace_back(v[j], v[i], entry);
        entries.emplace_back(v[i], v[i], -entry);
        entries.emplace_back(v[j], v[j], -entry);
      }
    }
  }
  SparseMatrix laplacian(mesh.positions.rows(), mesh.positions.rows());
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return laplacian;
}

}  // namespace handlebody
