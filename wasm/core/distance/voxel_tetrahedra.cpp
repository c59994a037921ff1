#include "core/distance/voxel_tetrahedra.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/distance/voxel_domain.hpp"
#include "core/mesh/kuhn_tetrahedra.hpp"
#include "core/mesh/sound_surface.hpp"
#include "core/mesh/weld.hpp"

namespace handlebody {

namespace {

constexpr double near = 1e-9;     // of a voxel
constexpr double farthest = 1e9;  // voxels
constexpr double infinite = std::numeric_limits<double>::infinity();

/** Whether a triangle and a cube about the origin touch: no plane lies between them (Akenine-Möller 2001). */
bool touches(const std::array<Vector3, 3>& p, double half) {
  const auto separates = [&](const Vector3& axis) {
    const double a = axis.dot(p[0]), b = axis.dot(p[1]), c = axis.dot(p[2]);
    const double reach = half * axis.cwiseAbs().sum() * (1 + 1e-12);
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  for (int axis = 0; axis < 3; ++axis)
    if (separates(Vector3::Unit(axis))) return false;
  const std::array<Vector3, 3> edges{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  if (separates(edges[0].cross(edges[1]))) return false;
  for (const Vector3& edge : edges)
    for (int axis = 0; axis < 3; ++axis)
      if (separates(edge.cross(Vector3::Unit(axis)))) return false;
  return true;
}

/** Calls `visit` with each voxel that triangle t touches, where the voxels are scaled by 1 − `slack`. */
template <typename Visit>
void for_each_touched(const Grid& grid, const ConstPoints& positions, const ConstTriangles& triangles, Index t, double slack,
                      const Visit& visit) {
  std::array<Vector3, 3> p;
  std::array<std::int32_t, 3> low, high;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = (positions.row(triangles(t, static_cast<Index>(k))).transpose() - grid.origin) / grid.spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
    const auto a = static_cast<std::size_t>(axis);
    low[a] = std::max(static_cast<std::int32_t>(std::floor(least + 0.5 - near)), 0);
    high[a] = std::min(static_cast<std::int32_t>(std::floor(most + 0.5 + near)), grid.dims[a] - 1);
  }
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        const Vector3 center(i, j, k);
        if (touches({p[0] - center, p[1] - center, p[2] - center}, 0.5 - slack))
          visit(static_cast<std::size_t>(grid.linear(i, j, k)));
      }
    }
  }
}

/** The voxels that are inside or touched. A triangle that lies between two voxels marks both, unless one is marked already. */
std::vector<char> mark_voxels(const Grid& grid, const ConstPoints& positions, const ConstTriangles& triangles) {
  std::vector<char> marked(static_cast<std::size_t>(grid.size()), 0);
  for (Index t = 0; t < triangles.rows(); ++t)
    for_each_touched(grid, positions, triangles, t, near, [&](std::size_t v) { marked[v] = 1; });
  const TriangleTree tree(positions, triangles);
  for (std::size_t v = 0; v < marked.size(); ++v)
    if (!marked[v]) marked[v] = std::abs(tree.winding_number(grid.center(static_cast<std::int64_t>(v)))) > 0.5;
  for (Index t = 0; t < triangles.rows(); ++t) {
    bool covered = false;
    for_each_touched(grid, positions, triangles, t, -near, [&](std::size_t v) { covered |= marked[v] != 0; });
    if (!covered) for_each_touched(grid, positions, triangles, t, -near, [&](std::size_t v) { marked[v] = 1; });
  }
  return marked;
}

/** Finds a marked voxel that contains the place, or the nearest one; `part` becomes the place within it, 0 to 1 along each axis. */
std::array<std::int32_t, 3> locate(const Grid& grid, const std::vector<char>& marked, const Vector3& place,
                                   std::array<double, 3>& part) {
  std::array<std::int32_t, 3> cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = place[static_cast<Index>(axis)] + 0.5;
    cell[axis] = static_cast<std::int32_t>(std::clamp(std::floor(at), 0., grid.dims[axis] - 1.));
    part[axis] = at - cell[axis];
  }
  std::array<std::int32_t, 3> best = cell;
  double least = infinite;
  const auto consider = [&](int i, int j, int k) {
    if (i < 0 || j < 0 || k < 0 || i >= grid.dims[0] || j >= grid.dims[1] || k >= grid.dims[2]) return;
    if (!marked[static_cast<std::size_t>(grid.linear(i, j, k))]) return;
    const double squared = ((place - Vector3(i, j, k)).cwiseAbs().array() - 0.5).cwiseMax(0).square().sum();
    if (squared < least) least = squared, best = {i, j, k};
  };
  consider(cell[0], cell[1], cell[2]);
  // On the border between two voxels the other one may be the marked one. A vertex in no triangle may be far from all marked
  // voxels: then all are searched.
  for (int k = -1; k <= 1 && !(least < near); ++k)
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) consider(cell[0] + i, cell[1] + j, cell[2] + k);
  const bool lost = !(least < infinite);
  for (int k = 0; k < grid.dims[2] && lost; ++k)
    for (int j = 0; j < grid.dims[1]; ++j)
      for (int i = 0; i < grid.dims[0]; ++i) consider(i, j, k);
  for (std::size_t axis = 0; axis < 3; ++axis) part[axis] = std::clamp(part[axis] + cell[axis] - best[axis], 0.0, 1.0);
  return best;
}

}  // namespace

Result<VoxelTetrahedra> make_voxel_tetrahedra(const SimplexMesh& surface, int resolution) {
  if (resolution < 4 || resolution > 256) {
    return Error(HB_ERROR_INVALID_OPTION, {"The resolution ", resolution, " is not from 4 to 256."},
                 {"Give voxels along the longest side."}, HB_CULPRIT_OPTION);
  }
  if (auto checked = check_simplex_mesh(surface); !checked) return checked.error();
  const Points positions = surface.positions;
  // The surface, without what is none of it; its box is that of the vertices it uses.
  const Weld weld = weld_vertices(positions);
  Points welded(std::ssize(weld.unique), 3);
  for (std::size_t v = 0; v < weld.unique.size(); ++v) welded.row(static_cast<Index>(v)) = positions.row(weld.unique[v]);
  const SoundSurface sound = sound_surface(welded, weld_triangles(weld, surface.simplices));
  const Triangles triangles = sound.triangles.topRows(sound.with_area);
  Vector3 low = welded.row(triangles(0, 0)), high = low;
  for (Index k = 0; k < triangles.size(); ++k) {
    low = low.cwiseMin(welded.row(triangles.data()[k]).transpose());
    high = high.cwiseMax(welded.row(triangles.data()[k]).transpose());
  }
  auto made = make_grid(low, high, resolution);
  if (!made) return made.error();
  const Grid& grid = *made;

  const std::vector<char> marked = mark_voxels(grid, welded, triangles);

  // Corners are numbered as they are met; there is one more along each axis than there are voxels.
  const std::array<std::int64_t, 3> across{grid.dims[0] + 1, grid.dims[1] + 1, grid.dims[2] + 1};
  Indices number(static_cast<std::size_t>(across[0] * across[1] * across[2]), no_index);
  std::vector<double> places;
  Indices indices;
  const auto corner = [&](const std::array<std::int32_t, 3>& cell, int c) {
    const std::array<std::int64_t, 3> at{cell[0] + (c & 1), cell[1] + ((c >> 1) & 1), cell[2] + (c >> 2)};
    std::uint32_t& own = number[static_cast<std::size_t>(at[0] + across[0] * (at[1] + across[1] * at[2]))];
    if (own == no_index) {
      own = static_cast<std::uint32_t>(places.size() / 3);
      for (std::size_t axis = 0; axis < 3; ++axis)
        places.push_back(grid.origin[static_cast<Index>(axis)] + (static_cast<double>(at[axis]) - 0.5) * grid.spacing);
    }
    return own;
  };
  for (std::size_t v = 0; v < marked.size(); ++v) {
    if (!marked[v]) continue;
    const std::array<std::int32_t, 3> cell = grid.cell(static_cast<std::int64_t>(v));
    for (const auto& own : kuhn_tetrahedra)
      for (const int c : own) indices.push_back(corner(cell, c));
  }

  VoxelTetrahedra result;
  result.mesh.positions = Eigen::Map<const Matrix>(places.data(), static_cast<Index>(places.size() / 3), 3);
  result.mesh.simplices = Eigen::Map<const Simplices>(indices.data(), static_cast<Index>(indices.size() / 4), 4);
  result.corners.resize(positions.rows());
  result.coordinates.resize(result.corners.size());
  for (std::size_t p = 0; p < result.corners.size(); ++p) {
    // A vertex in no triangle may be anywhere, and nowhere.
    Vector3 place = (positions.row(static_cast<Index>(p)).transpose() - grid.origin) / grid.spacing;
    place = place.unaryExpr([](double x) { return std::isnan(x) ? 0 : std::clamp(x, -farthest, farthest); });
    std::array<double, 3> part;
    const std::array<std::int32_t, 3> cell = locate(grid, marked, place, part);
    // The place is in the tetrahedron whose axes have descending parts; coordinates are the differences of these.
    std::array<int, 3> order{0, 1, 2};
    if (part[order[0]] < part[order[1]]) std::swap(order[0], order[1]);
    if (part[order[1]] < part[order[2]]) std::swap(order[1], order[2]);
    if (part[order[0]] < part[order[1]]) std::swap(order[0], order[1]);
    const int second = 1 << order[0], third = second | 1 << order[1];
    const double a = part[order[0]], b = part[order[1]], c = part[order[2]];
    result.corners[p] = {corner(cell, 0), corner(cell, second), corner(cell, third), corner(cell, 7)};
    result.coordinates[p] = {1 - a, a - b, b - c, c};
  }
  return result;
}

}  // namespace handlebody
