// Closed meshes that the tests make: a box of n×m×k cells, welded, outward-oriented.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "core/mesh/enclosed_volume.hpp"
#include "core/numerics/types.hpp"

namespace handlebody::test {

struct MadeMesh {
  Points positions;
  Triangles triangles;
};

/** The surface of the box [0, size] divided into cells[axis] along each axis. */
inline MadeMesh made_box(const Vector3& size, const std::array<int, 3>& cells) {
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  std::vector<Vector3> points;
  std::vector<std::uint32_t> corners;
  const auto number = [&](const std::array<int, 3>& key) {
    const auto [found, fresh] = numbers.try_emplace(key, static_cast<std::uint32_t>(points.size()));
    if (fresh) points.emplace_back(size.x() * key[0] / cells[0], size.y() * key[1] / cells[1], size.z() * key[2] / cells[2]);
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool high : {false, true}) {
      for (int i = 0; i < cells[u]; ++i) {
        for (int j = 0; j < cells[v]; ++j) {
          std::array<std::uint32_t, 4> quad{};
          for (int corner = 0; corner < 4; ++corner) {
            std::array<int, 3> key{};
            key[axis] = high ? cells[axis] : 0;
            key[u] = i + (corner == 1 || corner == 2);
            key[v] = j + (corner >= 2);
            quad[corner] = number(key);
          }
          if (!high) std::swap(quad[1], quad[3]);
          corners.insert(corners.end(), {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
        }
      }
    }
  }
  MadeMesh mesh;
  mesh.positions.resize(std::ssize(points), 3);
  for (std::size_t p = 0; p < points.size(); ++p) mesh.positions.row(static_cast<Index>(p)) = points[p];
  mesh.triangles = Eigen::Map<const Triangles>(corners.data(), static_cast<Index>(corners.size() / 3), 3);
  return mesh;
}

}  // namespace handlebody::test
