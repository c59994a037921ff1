#include "core/mesh/simplex_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace handlebody {

namespace {

constexpr Index most_vertices = 4'000'000, most_simplices = 24'000'000;

Vector3 corner(const SimplexMesh& mesh, Index simplex, Index k) {
  const double* const p = mesh.positions.data() + mesh.simplices(simplex, k) * mesh.positions.cols();
  return {p[0], p[1], mesh.positions.cols() == 3 ? p[2] : 0.0};
}

}  // namespace

double simplex_volume(const SimplexMesh& mesh, Index simplex) {
  const Vector3 a = corner(mesh, simplex, 0);
  const Vector3 across = (corner(mesh, simplex, 1) - a).cross(corner(mesh, simplex, 2) - a);
  if (mesh.simplices.cols() == 3) return across.norm() / 2;
  return std::abs(across.dot(corner(mesh, simplex, 3) - a)) / 6;
}

double longest_edge(const SimplexMesh& mesh, Index simplex) {
  double longest = 0;
  for (Index k = 0; k < mesh.simplices.cols(); ++k)
    for (Index l = 0; l < k; ++l) longest = std::max(longest, (corner(mesh, simplex, k) - corner(mesh, simplex, l)).norm());
  return longest;
}

bool is_flat(const SimplexMesh& mesh, Index simplex) {
  const double longest = longest_edge(mesh, simplex), cube = mesh.simplices.cols() == 4 ? longest : 1.0;
  return !(simplex_volume(mesh, simplex) > 1e-14 * longest * longest * cube);
}

std::vector<char> used_vertices(const SimplexMesh& mesh) {
  std::vector<char> used(mesh.positions.rows(), 0);
  for (Index i = 0; i < mesh.simplices.size(); ++i) used[mesh.simplices.data()[i]] = 1;
  return used;
}

double longest_side(const SimplexMesh& mesh) {
  double longest = 0;
  for (Index axis = 0; axis < mesh.positions.cols(); ++axis) {
    double low = mesh.positions(mesh.simplices(0, 0), axis), high = low;
    for (Index i = 0; i < mesh.simplices.size(); ++i) {
      const double x = mesh.positions(mesh.simplices.data()[i], axis);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    longest = std::max(longest, high - low);
  }
  return longest;
}

Result<Done> check_simplex_mesh(const SimplexMesh& mesh) {
  const Index n = mesh.positions.rows(), m = mesh.simplices.rows(), corners = mesh.simplices.cols();
  const bool solid = corners == 4;
  const char *const one = solid ? "Tetrahedron " : "Triangle ", *const many = solid ? " tetrahedra" : " triangles";
  const hb_culprit culprit = solid ? HB_CULPRIT_TETRAHEDRON : HB_CULPRIT_TRIANGLE;
  if (n > most_vertices || m > most_simplices) {
    return Error(HB_ERROR_MESH_TOO_LARGE,
                 {"The mesh has ", n, " vertices and ", m, many, "; operators take up to 4 million and 24 million."},
                 {"Simplify the mesh first."});
  }
  if (n < corners) {
    return Error(HB_ERROR_MESH_TOO_FEW_VERTICES, {"The mesh has ", n, " vertices; one simplex has ", corners, "."},
                 {"Give a mesh of triangles or tetrahedra."});
  }
  if (m == 0) return Error(HB_ERROR_MESH_NO_TRIANGLES, {"The mesh has no", many, "."}, {"Give a mesh of triangles or tetrahedra."});
  for (Index s = 0; s < m; ++s) {
    std::uint32_t highest = 0;
    for (Index k = 0; k < corners; ++k) highest = std::max(highest, mesh.simplices(s, k));
    if (!in_range(highest, n)) {
      return Error(HB_ERROR_MESH_INDEX_OUT_OF_RANGE, {one, s, " uses vertex ", highest, ", but there are only ", n, "."},
                   {"Give vertex numbers from 0 on."}, culprit, s);
    }
  }
  const std::vector<char> used = used_vertices(mesh);
  for (Index v = 0; v < n; ++v) {
    if (!used[v] || mesh.positions.row(v).allFinite()) continue;
    return Error(HB_ERROR_MESH_NOT_FINITE, {"Vertex ", v, " has a coordinate that is not a finite number."},
                 {"Repair or remove that vertex."}, HB_CULPRIT_VERTEX, v);
  }
  // Products of four coordinates must neither overflow nor vanish.
  const double largest = longest_side(mesh);
  if (!(largest < 1e60))
    return Error(HB_ERROR_MESH_NOT_FINITE, {"The mesh's coordinates are too large to compute with."}, {"Scale the mesh down."});
  if (!(largest > 1e-60))
    return Error(HB_ERROR_MESH_ZERO_EXTENT, {"All vertices of the mesh coincide, or nearly."}, {"Give a mesh with some extent."});
  return Done{};
}

Result<Done> check_volumes(const SimplexMesh& mesh) {
  const bool solid = mesh.simplices.cols() == 4;
  for (Index s = 0; s < mesh.simplices.rows(); ++s) {
    if (!is_flat(mesh, s)) continue;
    return Error(HB_ERROR_MESH_DEGENERATE,
                 {solid ? "Tetrahedron " : "Triangle ", s, solid ? " has no volume" : " has no area", ", so it has no cotangents."},
                 {"Remove it, or move its vertices apart."}, solid ? HB_CULPRIT_TETRAHEDRON : HB_CULPRIT_TRIANGLE, s);
  }
  return Done{};
}

Indices connected_parts(const SimplexMesh& mesh) {
  const auto n = static_cast<std::size_t>(mesh.positions.rows());
  Indices root(n);
  for (std::size_t v = 0; v < n; ++v) root[v] = static_cast<std::uint32_t>(v);
  const auto find = [&root](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (Index s = 0; s < mesh.simplices.rows(); ++s) {
    for (Index k = 1; k < mesh.simplices.cols(); ++k) {
      const std::uint32_t a = find(mesh.simplices(s, 0)), b = find(mesh.simplices(s, k));
      root[std::max(a, b)] = std::min(a, b);  // so that a part's root is its first vertex
    }
  }
  std::uint32_t count = 0;
  Indices part(n);
  for (std::size_t v = 0; v < n; ++v) {
    const std::uint32_t first = find(static_cast<std::uint32_t>(v));
    part[v] = first == v ? count++ : part[first];
  }
  return part;
}

}  // namespace handlebody
