#include "core/distance/voxel_domain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

constexpr double max_voxels = 64e6;
constexpr int margin = 2;
constexpr int block = 8;        // cells along a block's side
constexpr int near_shells = 6;  // of the search for the nearest voxel, before it goes by blocks

/** Disjoint sets with path halving; the root is the lowest member. */
class Sets {
 public:
  explicit Sets(std::int32_t count) : parent_(count) {
    for (std::int32_t i = 0; i < count; ++i) parent_[i] = i;
  }
  std::int32_t root(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  bool join(std::int32_t i, std::int32_t j) {
    i = root(i), j = root(j);
    parent_[std::max(i, j)] = std::min(i, j);
    return i != j;
  }

 private:
  std::vector<std::int32_t> parent_;
};

/** The cells strictly between `from` and `to` of a face-connected digital segment, appended to `voxels`. */
void lay_bridge(const Grid& grid, std::array<std::int32_t, 3> from, const std::array<std::int32_t, 3>& to,
                std::vector<std::uint32_t>& voxels) {
  std::array<int, 3> steps{}, done{0, 0, 0};
  for (int a = 0; a < 3; ++a) steps[a] = std::abs(to[a] - from[a]);
  for (int left = steps[0] + steps[1] + steps[2]; left > 1; --left) {
    // Step along the axis whose next crossing, (done + ½)/steps, the straight line meets first.
    int axis = -1;
    for (int a = 0; a < 3; ++a) {
      if (done[a] == steps[a]) continue;
      if (axis < 0 || (2 * done[a] + 1) * std::int64_t{steps[axis]} < (2 * done[axis] + 1) * std::int64_t{steps[a]}) axis = a;
    }
    ++done[axis];
    from[axis] += to[axis] > from[axis] ? 1 : -1;
    voxels.push_back(static_cast<std::uint32_t>(grid.linear(from[0], from[1], from[2])));
  }
}

}  // namespace

Vector3 Grid::center(std::int64_t linear_index) const {
  const auto [i, j, k] = cell(linear_index);
  return origin + spacing * Vector3(i, j, k);
}

std::array<std::int32_t, 3> Grid::cell(std::int64_t linear_index) const {
  const auto row = static_cast<std::uint32_t>(linear_index) / static_cast<std::uint32_t>(dims[0]);
  return {static_cast<std::int32_t>(linear_index - std::int64_t{row} * dims[0]),
          static_cast<std::int32_t>(row % static_cast<std::uint32_t>(dims[1])),
          static_cast<std::int32_t>(row / static_cast<std::uint32_t>(dims[1]))};
}

Result<Grid> make_grid(const Vector3& low, const Vector3& high, int resolution) {
  const Vector3 extent = high - low;
  if (resolution < 1) {
    return Error(HB_ERROR_INVALID_OPTION, {"The resolution is ", resolution, "."},
                 {"Give at least 1 voxel along the longest side."}, HB_CULPRIT_OPTION);
  }
  if (!low.allFinite() || !extent.allFinite()) {
    return Error(HB_ERROR_MESH_NOT_FINITE, {"The bounding box of the mesh is not finite."},
                 {"Remove vertices that are infinite or not numbers."});
  }
  Grid grid;
  grid.spacing = extent.maxCoeff() / resolution;
  const double magnitude = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  if (!(grid.spacing > magnitude * 16 * std::numeric_limits<double>::epsilon())) {
    return Error(HB_ERROR_MESH_ZERO_EXTENT, {"All vertices of the mesh coincide."},
                 {"Check the mesh's positions and its node's scale."});
  }

  double size = 1;
  for (int a = 0; a < 3; ++a) {
    // Rounding must not add a layer: a side of exactly n spacings has n voxels.
    const double count = std::max(1.0, std::ceil(extent[a] / grid.spacing - 1e-9)) + 2 * margin;
    size *= count;
    grid.dims[a] = static_cast<std::int32_t>(std::min(count, 2e9));
    grid.origin[a] = low[a] + 0.5 * extent[a] - 0.5 * (count - 1) * grid.spacing;
  }
  if (size > max_voxels) {
    return Error(HB_ERROR_MESH_TOO_LARGE,
                 {"A grid of ", grid.dims[0], " x ", grid.dims[1], " x ", grid.dims[2], " voxels exceeds 64 million."},
                 {"Lower the resolution."}, HB_CULPRIT_OPTION);
  }
  return grid;
}

VoxelDomain::VoxelDomain(const Grid& grid, std::vector<std::uint32_t> voxels)
    : grid_(grid), voxels_(std::move(voxels)), numbers_(static_cast<std::size_t>(grid.size()), -1) {
  const auto blocks = [&](int axis) { return (grid.dims[axis] + block - 1) / block; };
  std::vector<std::uint8_t> occupied(static_cast<std::size_t>(blocks(0)) * blocks(1) * blocks(2));
  for (std::size_t v = 0; v < voxels_.size(); ++v) {
    numbers_[voxels_[v]] = static_cast<std::int32_t>(v);
    const auto cell = grid.cell(voxels_[v]);
    auto& here =
        occupied[cell[0] / block + std::size_t(blocks(0)) * (cell[1] / block + std::size_t(blocks(1)) * (cell[2] / block))];
    if (!here) blocks_.push_back({cell[0] / block * block, cell[1] / block * block, cell[2] / block * block});
    here = 1;
  }
}

std::int32_t VoxelDomain::number(std::int64_t linear_index) const {
  if (linear_index < 0 || linear_index >= static_cast<std::int64_t>(numbers_.size())) return -1;
  return numbers_[static_cast<std::size_t>(linear_index)];
}

std::int32_t VoxelDomain::number(int i, int j, int k) const {
  if (i < 0 || j < 0 || k < 0 || i >= grid_.dims[0] || j >= grid_.dims[1] || k >= grid_.dims[2]) return -1;
  return numbers_[static_cast<std::size_t>(grid_.linear(i, j, k))];
}

std::int32_t VoxelDomain::nearest(const Vector3& point) const {
  if (voxels_.empty()) return -1;
  const Vector3 p = (point - grid_.origin) / grid_.spacing;  // in cells
  const auto& dims = grid_.dims;
  const Vector3 clamped = p.cwiseMax(0).cwiseMin(Vector3(dims[0] - 1, dims[1] - 1, dims[2] - 1));
  const double outside2 = (p - clamped).squaredNorm();
  std::array<int, 3> c{};
  for (int a = 0; a < 3; ++a) c[a] = static_cast<int>(std::lround(clamped[a]));

  std::int32_t found = -1;
  double best = std::numeric_limits<double>::infinity();
  const auto visit = [&](int i, int j, int k) {
    const std::int32_t v = numbers_[static_cast<std::size_t>(grid_.linear(i, j, k))];
    if (v < 0) return;
    const double distance2 = (Vector3(i, j, k) - p).squaredNorm();
    if (distance2 < best || (distance2 == best && v < found)) best = distance2, found = v;
  };
  // Shells of cells at Chebyshev distance r; those of shell r are at least r − ½ cells away from the clamped point.
  for (int r = 0; r <= near_shells && (r < 1 || (r - 0.5) * (r - 0.5) + outside2 <= best); ++r) {
    const int i0 = std::max(c[0] - r, 0), i1 = std::min(c[0] + r, dims[0] - 1);
    for (int k = std::max(c[2] - r, 0); k <= std::min(c[2] + r, dims[2] - 1); ++k) {
      for (int j = std::max(c[1] - r, 0); j <= std::min(c[1] + r, dims[1] - 1); ++j) {
        if (std::abs(k - c[2]) == r || std::abs(j - c[1]) == r) {
          for (int i = i0; i <= i1; ++i) visit(i, j, k);
        } else {
          if (c[0] - r >= 0) visit(c[0] - r, j, k);
          if (c[0] + r < dims[0]) visit(c[0] + r, j, k);
        }
      }
    }
  }
  const double seen = near_shells + 0.5;  // cells nearer than this to the clamped point have been visited
  if (best <= seen * seen + outside2) return found;
  for (const auto& first : blocks_) {
    Vector3 gap;
    for (int a = 0; a < 3; ++a) gap[a] = std::max({first[a] - p[a], p[a] - (first[a] + block - 1), 0.0});
    if (gap.squaredNorm() > best) continue;
    for (int k = first[2]; k < std::min(first[2] + block, dims[2]); ++k) {
      for (int j = first[1]; j < std::min(first[1] + block, dims[1]); ++j) {
        for (int i = first[0]; i < std::min(first[0] + block, dims[0]); ++i) visit(i, j, k);
      }
    }
  }
  return found;
}

std::vector<std::int32_t> VoxelDomain::face_neighbors() const {
  const auto none = static_cast<std::int32_t>(size());
  std::vector<std::int32_t> table(6 * (voxels_.size() + 1), none);
  for (std::size_t v = 0; v < voxels_.size(); ++v) {
    const auto cell = grid_.cell(voxels_[v]);
    for (int side = 0; side < 6; ++side) {
      auto next = cell;
      next[side / 2] += side % 2 ? 1 : -1;
      const std::int32_t u = number(next[0], next[1], next[2]);
      if (u >= 0) table[6 * v + side] = u;
    }
  }
  return table;
}

std::vector<std::int32_t> face_components(const VoxelDomain& domain) {
  const auto count = static_cast<std::int32_t>(domain.size());
  const std::vector<std::int32_t> neighbors = domain.face_neighbors();
  std::vector<std::int32_t> component(count, -1), queue;
  std::int32_t components = 0;
  for (std::int32_t seed = 0; seed < count; ++seed) {
    if (component[seed] >= 0) continue;
    component[seed] = components;
    queue.assign(1, seed);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      for (int side = 0; side < 6; ++side) {
        const std::int32_t u = neighbors[6 * std::size_t(queue[head]) + side];
        if (u == count || component[u] >= 0) continue;
        component[u] = components;
        queue.push_back(u);
      }
    }
    ++components;
  }
  return component;
}

/** Mehlhorn 1988: a minimum spanning tree of the parts uses only gaps between adjacent cells of the parts' Voronoi diagram. The
 *  diagram grows breadth first from all voxels at once; the fronts that meet in round d are 2d + 1 or 2d + 2 face steps apart, so
 *  Kruskal's algorithm can run along with the fronts and stop them as soon as one part is left. */
int bridge_components(const Grid& grid, std::vector<std::uint32_t>& voxels) {
  std::vector<std::int32_t> part;  // of each voxel
  std::vector<std::int32_t> site;  // of each cell that the front has reached: the voxel it came from
  {
    const VoxelDomain domain(grid, voxels);
    part = face_components(domain);
    const std::int32_t parts = part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1;
    if (parts < 2) return 0;
    site.resize(static_cast<std::size_t>(grid.size()));
    for (std::size_t c = 0; c < site.size(); ++c) site[c] = domain.number(static_cast<std::int64_t>(c));
  }

  struct Gap {
    std::int32_t length;     // in face steps, one more than the cells to fill
    std::int64_t straight2;  // squared length of the straight line
    std::int32_t from, to;   // voxels
    auto key() const { return std::tie(length, straight2, from, to); }
  };
  const auto gap_between = [&](std::int32_t u, std::int32_t v) {
    const auto a = grid.cell(voxels[std::min(u, v)]), b = grid.cell(voxels[std::max(u, v)]);
    Gap gap{-1, 0, std::min(u, v), std::max(u, v)};
    for (int x = 0; x < 3; ++x) gap.length += std::abs(a[x] - b[x]), gap.straight2 += std::int64_t{a[x] - b[x]} * (a[x] - b[x]);
    return gap;
  };

  Sets sets(*std::max_element(part.begin(), part.end()) + 1);
  std::int32_t left = *std::max_element(part.begin(), part.end()) + 1;
  int bridges = 0;
  std::vector<std::uint32_t> front = voxels, next, filled;
  std::vector<Gap> gaps;
  for (; left > 1 && !front.empty(); front.swap(next)) {
    next.clear();
    gaps.clear();
    for (const std::uint32_t cell : front) {
      const auto at = grid.cell(cell);
      for (int side = 0; side < 6; ++side) {
        auto beside = at;
        beside[side / 2] += side % 2 ? 1 : -1;
        if (beside[side / 2] < 0 || beside[side / 2] >= grid.dims[side / 2]) continue;
        const auto c = static_cast<std::uint32_t>(grid.linear(beside[0], beside[1], beside[2]));
        if (site[c] < 0) {
          site[c] = site[cell];
          next.push_back(c);
        } else if (sets.root(part[site[c]]) != sets.root(part[site[cell]])) {
          gaps.push_back(gap_between(site[c], site[cell]));
        }
      }
    }
    for (const std::uint32_t g :
         sorted_indices(gaps.size(), [&](std::uint32_t u, std::uint32_t v) { return gaps[u].key() < gaps[v].key(); })) {
      const Gap& gap = gaps[g];
      if (!sets.join(part[gap.from], part[gap.to])) continue;
      lay_bridge(grid, grid.cell(voxels[gap.from]), grid.cell(voxels[gap.to]), filled);
      ++bridges;
      --left;
    }
  }

  voxels.insert(voxels.end(), filled.begin(), filled.end());
  sort(voxels, [](std::uint32_t u, std::uint32_t v) { return u < v; });
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  return bridges;
}

}  // namespace handlebody
