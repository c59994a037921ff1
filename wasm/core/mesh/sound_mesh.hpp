// Meshes as they come, made fit for operators: renderers split vertices at seams and creases, and much that is modeled or scanned
// has simplices without volume, or the same one twice. Neither changes the shape, so neither may change what is computed on it.
#pragma once

#include <array>
#include <vector>

#include "core/mesh/simplex_mesh.hpp"

namespace handlebody {

struct SoundMeshOptions {
  bool weld = true;     // join vertices at one place; otherwise a vertex is a number
  bool strict = false;  // refuse flat and repeated simplices instead of leaving them out
};

/** A stored vertex that only flat simplices use. It goes with the point of a sound simplex that is nearest: Σ parts[k] · corners[k]
 * of the sound mesh, where parts are not negative and sum to 1. */
struct FlatVertex {
  std::uint32_t vertex;
  std::array<std::uint32_t, 3> corners;
  std::array<double, 3> parts;
};

/** How many simplices or vertices of a kind there were, and which came first. */
struct LeftOut {
  std::uint32_t count = 0, first = no_index;
};

struct SoundMesh {
  /** The sound simplices, in stored order. Its vertices are the places of stored ones in the order of their first, without those of
   * flat vertices. Vertices that no simplex uses stay; one whose coordinates cannot be computed with gets those of the first vertex
   * in use, without being joined to it. */
  SimplexMesh mesh;
  Indices first;      // for each vertex of `mesh` the first stored vertex at its place
  Indices vertex_of;  // for each stored vertex its vertex of `mesh`; for a flat vertex the corner that has the largest part
  Indices place_of;   // for each stored vertex the first stored vertex at its place
  std::vector<FlatVertex> flat_vertices;
  LeftOut flat;     // simplices
  Indices doubled;  // numbers of the simplices that have the corners of one before them, in any order
  LeftOut unused;   // vertices that no simplex uses
};

/** Vertices are at one place where they are equal (−0 equals 0), or so near that only rounding can have parted them: nearer than a
 * millionth of the diagonal of all that simplices use, and than a thousandth of the longest edge at either. A simplex is flat where
 * is_flat() says so, and where its height is as little as that and it has a vertex that only such simplices use, unless its whole
 * part of the mesh is of them. Takes O((n + m) log (n + m)). Fails as check_simplex_mesh(), or with MESH_DEGENERATE where nothing
 * is left, or `strict` finds something to leave out. */
Result<SoundMesh> sound_mesh(const SimplexMesh& stored, const SoundMeshOptions& options);

}  // namespace handlebody
