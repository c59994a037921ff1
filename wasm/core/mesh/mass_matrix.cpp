#include "core/mesh/mass_matrix.hpp"

#include <array>

namespace handlebody {

namespace {

/** Mixed Voronoi areas of the corners, from the squared edges across from them and the area. */
std::array<double, 3> mixed_voronoi(const std::array<double, 3>& squared, double area) {
  std::array<double, 3> mass, cotangent;
  for (std::size_t k = 0; k < 3; ++k) {
    cotangent[k] = (squared[(k + 1) % 3] + squared[(k + 2) % 3] - squared[k]) / (4 * area);
    if (cotangent[k] >= 0) continue;
    mass = {area / 4, area / 4, area / 4};
    mass[k] = area / 2;
    return mass;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    mass[k] = (squared[a] * cotangent[a] + squared[b] * cotangent[b]) / 8;
  }
  return mass;
}

}  // namespace

Vector mass_matrix(const SimplexMesh& mesh, Mass kind) {
  Vector mass = Vector::Zero(mesh.positions.rows());
  const Index corners = mesh.simplices.cols(), d = mesh.positions.cols();
  for (Index s = 0; s < mesh.simplices.rows(); ++s) {
    const std::uint32_t* const v = mesh.simplices.data() + s * corners;
    const double volume = simplex_volume(mesh, s);
    if (kind == Mass::barycentric || corners == 4) {
      for (Index k = 0; k < corners; ++k) mass[v[k]] += volume / static_cast<double>(corners);
      continue;
    }
    std::array<double, 3> squared{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double *const a = mesh.positions.data() + v[(k + 1) % 3] * d, *const b = mesh.positions.data() + v[(k + 2) % 3] * d;
      for (Index axis = 0; axis < d; ++axis) squared[k] += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    }
    const std::array<double, 3> own = mixed_voronoi(squared, volume);
    for (std::size_t k = 0; k < 3; ++k) mass[v[k]] += own[k];
  }
  return mass;
}

}  // namespace handlebody
