// Small meshes out of bytes: boxes, sheets, strips and soups, sound or spoiled.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "abi/handlebody.h"
#include "bytes.hpp"

namespace handlebody::fuzz {

struct Mesh {
  std::vector<double> positions;
  std::vector<std::uint32_t> simplices;
  std::uint32_t dimension = 3, corners = 3;

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions.size() / dimension); }
  std::uint32_t simplex_count() const { return static_cast<std::uint32_t>(simplices.size() / corners); }
  hb_simplex_mesh view(Bytes& bytes) const {
    return {
        positions.data(),    simplices.data(), bytes.count(vertex_count()), bytes.count(dimension), bytes.count(simplex_count()),
        bytes.count(corners)};
  }
};

namespace detail {

/** An nx × ny sheet of triangles, in the plane or as a surface that waves. */
inline void add_sheet(Mesh& mesh, Bytes& bytes) {
  const std::uint32_t nx = bytes.from_to(1, 5), ny = bytes.from_to(1, 5), first = mesh.vertex_count();
  for (std::uint32_t j = 0; j <= ny; ++j) {
    for (std::uint32_t i = 0; i <= nx; ++i) {
      mesh.positions.insert(mesh.positions.end(), {double(i), double(j)});
      if (mesh.dimension == 3) mesh.positions.push_back(bytes.number() / 8);
    }
  }
  for (std::uint32_t j = 0; j < ny; ++j) {
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = first + i + (nx + 1) * j, b = a + 1, c = a + nx + 1, d = c + 1;
      mesh.simplices.insert(mesh.simplices.end(), {a, b, d, a, d, c});
    }
  }
}

/** A box of `across` cells: its surface, or Kuhn's six tetrahedra in each cell. */
inline void add_box(Mesh& mesh, Bytes& bytes) {
  const std::uint32_t n[3]{bytes.from_to(1, 3), bytes.from_to(1, 2), bytes.from_to(1, 2)}, first = mesh.vertex_count();
  const double at[3]{bytes.number(), bytes.number(), bytes.number()};
  const auto vertex = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return first + i + (n[0] + 1) * (j + (n[1] + 1) * k);
  };
  for (std::uint32_t k = 0; k <= n[2]; ++k)
    for (std::uint32_t j = 0; j <= n[1]; ++j)
      for (std::uint32_t i = 0; i <= n[0]; ++i) mesh.positions.insert(mesh.positions.end(), {at[0] + i, at[1] + j, at[2] + k});
  if (mesh.corners == 4) {
    constexpr int axes[6][3]{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (std::uint32_t k = 0; k < n[2]; ++k)
      for (std::uint32_t j = 0; j < n[1]; ++j)
        for (std::uint32_t i = 0; i < n[0]; ++i)
          for (const auto& order : axes) {
            std::uint32_t cell[3]{i, j, k};
            mesh.simplices.push_back(vertex(i, j, k));
            for (const int axis : order) ++cell[axis], mesh.simplices.push_back(vertex(cell[0], cell[1], cell[2]));
          }
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool far : {false, true}) {
      for (std::uint32_t j = 0; j < n[v]; ++j) {
        for (std::uint32_t i = 0; i < n[u]; ++i) {
          const auto corner = [&](std::uint32_t du, std::uint32_t dv) {
            std::uint32_t cell[3];
            cell[axis] = far ? n[axis] : 0, cell[u] = i + du, cell[v] = j + dv;
            return vertex(cell[0], cell[1], cell[2]);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (far)
            mesh.simplices.insert(mesh.simplices.end(), {a, b, c, a, c, d});
          else
            mesh.simplices.insert(mesh.simplices.end(), {a, c, b, a, d, c});
        }
      }
    }
  }
}

/** Simplices of vertices at random. */
inline void add_soup(Mesh& mesh, Bytes& bytes) {
  const std::uint32_t first = mesh.vertex_count(), vertices = bytes.from_to(mesh.corners, 12), simplices = bytes.from_to(1, 12);
  for (std::uint32_t i = 0; i < vertices * mesh.dimension; ++i) mesh.positions.push_back(bytes.number());
  for (std::uint32_t i = 0; i < simplices * mesh.corners; ++i) mesh.simplices.push_back(first + bytes.below(vertices));
}

/** What exporters and tools do to meshes, and what no one should. */
inline void spoil(Mesh& mesh, Bytes& bytes) {
  const std::uint32_t n = mesh.vertex_count(), d = mesh.dimension, c = mesh.corners;
  for (std::uint32_t times = bytes.flip() ? bytes.below(6) : 0; times > 0; --times) {
    double* const vertex = mesh.positions.data() + bytes.below(n) * d;
    const std::size_t simplex = std::size_t{bytes.below(mesh.simplex_count())} * c;
    switch (bytes.below(8)) {
      case 0:
        vertex[bytes.below(d)] += bytes.number();
        break;
      case 1:
        vertex[bytes.below(d)] = bytes.number();
        break;
      case 2:  // two at one place
        std::copy_n(mesh.positions.data() + bytes.below(n) * d, d, vertex);
        break;
      case 3:
        mesh.simplices[simplex + bytes.below(c)] = bytes.index(n);
        break;
      case 4:  // turned over
        std::swap(mesh.simplices[simplex], mesh.simplices[simplex + 1]);
        break;
      case 5:  // a copy
        for (std::uint32_t k = 0; k < c; ++k) mesh.simplices.push_back(mesh.simplices[simplex + k]);
        break;
      case 6:  // a hole
        if (mesh.simplex_count() > 1) mesh.simplices.resize(mesh.simplices.size() - c);
        break;
      case 7:  // flat
        mesh.simplices[simplex] = mesh.simplices[simplex + 1];
        break;
    }
  }
}

}  // namespace detail

/** A mesh of one to three parts. `corners` 4 wants `dimension` 3. */
inline Mesh make_mesh(Bytes& bytes, std::uint32_t dimension, std::uint32_t corners) {
  Mesh mesh{{}, {}, dimension, corners};
  for (std::uint32_t parts = bytes.byte() < 200 ? 1 : bytes.from_to(1, 3); parts > 0; --parts) {
    const std::uint8_t kind = bytes.byte();
    if (kind < 40)
      detail::add_soup(mesh, bytes);
    else if (corners == 4 || (dimension == 3 && kind < 200))
      detail::add_box(mesh, bytes);
    else
      detail::add_sheet(mesh, bytes);
  }
  detail::spoil(mesh, bytes);
  if (const double scale = bytes.scale(); scale != 1)
    for (double& x : mesh.positions) x *= scale;
  return mesh;
}

/** Which vertices handles hold: mostly one or two each. */
struct Held {
  std::vector<std::uint32_t> vertices, owners;
  std::uint32_t handle_count = 0;

  hb_held_vertices view(Bytes& bytes) const {
    return {vertices.data(), owners.data(), bytes.count(static_cast<std::uint32_t>(vertices.size())), bytes.count(handle_count)};
  }
};

inline Held hold(Bytes& bytes, std::uint32_t vertex_count) {
  Held held;
  held.handle_count = bytes.wildly() ? 0 : bytes.from_to(1, 4);
  const std::uint32_t step = std::max(1u, vertex_count / std::max(1u, held.handle_count));
  for (std::uint32_t handle = 0; handle < held.handle_count; ++handle) {
    // Most often in different places: handles that meet are refused.
    held.vertices.push_back(bytes.wildly() ? bytes.index(vertex_count)
                                           : (handle * step + bytes.below(step)) % std::max(1u, vertex_count));
    held.owners.push_back(bytes.wildly() ? bytes.index(held.handle_count) : handle);
    if (bytes.byte() < 60) held.vertices.push_back(bytes.index(vertex_count)), held.owners.push_back(handle);
  }
  return held;
}

}  // namespace handlebody::fuzz
