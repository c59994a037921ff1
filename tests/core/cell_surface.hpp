// Closed surfaces that the tests make: of sets of cells between parallel planes, and of an extruded ring.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

#include "made_meshes.hpp"

namespace handlebody::test {

using Planes = std::array<std::vector<double>, 3>;

/** 0, 1/n, …, size. */
inline std::vector<double> evenly(double size, int n) {
  std::vector<double> planes;
  for (int i = 0; i <= n; ++i) planes.push_back(size * i / n);
  return planes;
}

/** The surface of the cells (i, j, k) for which `inside` holds, outward-oriented, two triangles a face, their diagonals in turn. */
template <typename Inside>
MadeMesh cell_surface(const Planes& planes, const Inside& inside) {
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  std::vector<Vector3> points;
  std::vector<std::uint32_t> corners;
  const auto number = [&](const std::array<int, 3>& key) {
    const auto [found, fresh] = numbers.try_emplace(key, static_cast<std::uint32_t>(points.size()));
    if (fresh) points.emplace_back(planes[0][key[0]], planes[1][key[1]], planes[2][key[2]]);
    return found->second;
  };
  const auto filled = [&](const std::array<int, 3>& cell) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (cell[a] < 0 || cell[a] + 1 >= static_cast<int>(planes[a].size())) return false;
    }
    return static_cast<bool>(inside(cell[0], cell[1], cell[2]));
  };
  std::array<int, 3> cell;
  for (cell[0] = 0; cell[0] + 1 < static_cast<int>(planes[0].size()); ++cell[0]) {
    for (cell[1] = 0; cell[1] + 1 < static_cast<int>(planes[1].size()); ++cell[1]) {
      for (cell[2] = 0; cell[2] + 1 < static_cast<int>(planes[2].size()); ++cell[2]) {
        if (!filled(cell)) continue;
        for (int face = 0; face < 6; ++face) {
          const std::size_t axis = static_cast<std::size_t>(face) / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
          const bool high = face % 2;
          std::array<int, 3> beside = cell;
          beside[axis] += high ? 1 : -1;
          if (filled(beside)) continue;
          std::array<std::uint32_t, 4> quad{};
          for (int corner = 0; corner < 4; ++corner) {
            std::array<int, 3> key = cell;
            key[axis] += high;
            key[u] += corner == 1 || corner == 2;
            key[v] += corner >= 2;
            quad[corner] = number(key);
          }
          if (!high) std::swap(quad[1], quad[3]);
          const std::size_t s = (cell[0] + cell[1] + cell[2]) % 2;
          corners.insert(corners.end(), {quad[s], quad[s + 1], quad[s + 2], quad[s], quad[s + 2], quad[(s + 3) % 4]});
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

/** The ring of known_geodesics.hpp, of radii .3 and .5 about (.5, .5), `height` high. */
inline MadeMesh ring_surface(double height, int around, int across, int up) {
  std::vector<std::array<double, 2>> outline;  // radius and height, counter-clockwise with the radius to the right
  for (int i = 0; i < across; ++i) outline.push_back({.3 + .2 * i / across, 0});
  for (int i = 0; i < up; ++i) outline.push_back({.5, height * i / up});
  for (int i = 0; i < across; ++i) outline.push_back({.5 - .2 * i / across, height});
  for (int i = 0; i < up; ++i) outline.push_back({.3, height - height * i / up});
  const int n = static_cast<int>(outline.size());
  MadeMesh mesh;
  mesh.positions.resize(Index{around} * n, 3);
  mesh.triangles.resize(Index{2} * around * n, 3);
  for (int a = 0; a < around; ++a) {
    const double angle = 2 * std::numbers::pi * a / around;
    for (int k = 0; k < n; ++k) {
      const auto [r, z] = outline[k];
      mesh.positions.row(a * n + k) = Vector3(.5 + r * std::cos(angle), .5 + r * std::sin(angle), z);
      const auto p = static_cast<std::uint32_t>(a * n + k), q = static_cast<std::uint32_t>(a * n + (k + 1) % n);
      const auto r1 = static_cast<std::uint32_t>((a + 1) % around * n + (k + 1) % n),
                 s = static_cast<std::uint32_t>((a + 1) % around * n + k);
      if ((a + k) % 2) {
        mesh.triangles.row(2 * (a * n + k)) << p, r1, s;
        mesh.triangles.row(2 * (a * n + k) + 1) << p, q, r1;
      } else {
        mesh.triangles.row(2 * (a * n + k)) << p, q, s;
        mesh.triangles.row(2 * (a * n + k) + 1) << q, r1, s;
      }
    }
  }
  if (enclosed_volume(mesh.positions, mesh.triangles) < 0) mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

/** A sphere of radius 1: an octahedron whose faces are divided into `divisions`² triangles. */
inline MadeMesh octahedral_sphere(int divisions) {
  // Points of |x| + |y| + |z| = divisions, pushed out to the sphere.
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  std::vector<Vector3> points;
  std::vector<std::uint32_t> corners;
  const auto number = [&](const std::array<int, 3>& key) {
    const auto [found, fresh] = numbers.try_emplace(key, static_cast<std::uint32_t>(points.size()));
    if (fresh) points.push_back(Vector3(key[0], key[1], key[2]).normalized());
    return found->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, sz = octant & 4 ? -1 : 1;
    const auto at = [&](int i, int j) { return number({sx * i, sy * j, sz * (divisions - i - j)}); };
    const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      if (sx * sy * sz < 0) std::swap(b, c);
      corners.insert(corners.end(), {a, b, c});
    };
    for (int i = 0; i < divisions; ++i) {
      for (int j = 0; i + j < divisions; ++j) {
        put(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < divisions) put(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
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
