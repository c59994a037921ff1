#include "core/distance/filled_shell.hpp"

#include <algorithm>

namespace handlebody {
namespace {

constexpr int largest_radius = 3;
constexpr std::int64_t least_deep = 20;  // one enclosed voxel in so many must be deep: in a fold of a sheet, fewer are

/** Sets all cells within `radius` of a set one, along each axis in turn: a cube. */
void dilate(const Grid& grid, std::vector<std::uint8_t>& cells, int radius) {
  std::vector<std::uint8_t> line;
  if (radius == 0) return;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t stride = axis == 0 ? 1 : axis == 1 ? grid.dims[0] : std::int64_t{grid.dims[0]} * grid.dims[1];
    const int count = grid.dims[axis];
    for (std::int64_t c = 0; c < grid.size(); ++c) {
      if (c / stride % count != 0) continue;  // the first of a line
      const auto at = [&](int i) { return static_cast<std::size_t>(c + stride * i); };
      line.assign(count, 0);
      int last = -radius - 1;
      for (int i = 0; i < count; ++i) {
        if (cells[at(i)]) last = i;
        line[i] = i - last <= radius;
      }
      last = count + radius;
      for (int i = count - 1; i >= 0; --i) {
        if (cells[at(i)]) last = i;
        if (last - i <= radius) line[i] = 1;
      }
      for (int i = 0; i < count; ++i) cells[at(i)] = line[i];
    }
  }
}

/** The cells that a flood through faces from the grid's border reaches, around those that are set. */
std::vector<std::uint8_t> flood(const Grid& grid, const std::vector<std::uint8_t>& blocked) {
  std::vector<std::uint8_t> reached(blocked.size());
  std::vector<std::int64_t> queue;
  const auto visit = [&](std::int64_t c) {
    const auto at = static_cast<std::size_t>(c);
    if (blocked[at] || reached[at]) return;
    reached[at] = 1;
    queue.push_back(c);
  };
  for (std::int64_t c = 0; c < grid.size(); ++c) {
    const auto cell = grid.cell(c);
    for (int a = 0; a < 3; ++a) {
      if (cell[a] == 0 || cell[a] == grid.dims[a] - 1) visit(c);
    }
  }
  while (!queue.empty()) {
    const std::int64_t c = queue.back();
    queue.pop_back();
    const auto cell = grid.cell(c);
    const std::int64_t strides[3] = {1, grid.dims[0], std::int64_t{grid.dims[0]} * grid.dims[1]};
    for (int a = 0; a < 3; ++a) {
      if (cell[a] > 0) visit(c - strides[a]);
      if (cell[a] + 1 < grid.dims[a]) visit(c + strides[a]);
    }
  }
  return reached;
}

}  // namespace

std::vector<std::uint32_t> filled_shell(const Grid& given, const std::vector<std::uint32_t>& voxels) {
  // Room for the shell on all sides.
  constexpr int room = largest_radius + 2;
  Grid grid = given;
  for (int& n : grid.dims) n += 2 * room;
  const auto place_of = [&](std::int64_t c) {
    const auto cell = given.cell(c);
    return static_cast<std::size_t>(grid.linear(cell[0] + room, cell[1] + room, cell[2] + room));
  };
  std::vector<std::uint8_t> splat(static_cast<std::size_t>(grid.size()));
  for (const std::uint32_t voxel : voxels) splat[place_of(voxel)] = 1;
  std::vector<std::uint8_t> taken;
  std::int64_t taken_count = 0;
  for (int radius = 0; radius <= largest_radius + 1; ++radius) {
    std::vector<std::uint8_t> outside = splat;
    dilate(grid, outside, radius);
    outside = flood(grid, outside);
    dilate(grid, outside, radius);
    const std::int64_t count = std::count(outside.begin(), outside.end(), 0);
    if (taken_count > 0 && 2 * count < 3 * taken_count) {
      std::vector<std::uint32_t> inside;
      for (std::int64_t c = 0; c < given.size(); ++c) {
        if (!taken[place_of(c)]) inside.push_back(static_cast<std::uint32_t>(c));
      }
      return inside;
    }
    std::vector<std::uint8_t> shallow = outside;
    dilate(grid, shallow, 1);
    const std::int64_t deep = std::count(shallow.begin(), shallow.end(), 0);
    taken_count = deep * least_deep >= count ? count : 0;
    if (taken_count > 0) taken.swap(outside);
  }
  return {};
}

}  // namespace handlebody
