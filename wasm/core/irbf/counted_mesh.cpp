#include "core/irbf/counted_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/irbf/body.hpp"
#include "core/mesh/sound_surface.hpp"

namespace handlebody {
namespace {

/** The corners that are used, welded; `triangles` with their numbers. */
void take(CountedMesh& mesh, const ConstPoints& positions, const ConstTriangles& triangles, const std::vector<std::uint8_t>& used) {
  Indices number(used.size(), no_index);
  mesh.stored.clear();
  for (std::uint32_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    number[v] = static_cast<std::uint32_t>(mesh.stored.size());
    mesh.stored.push_back(v);
  }
  Points kept(std::ssize(mesh.stored), 3);
  for (std::size_t v = 0; v < mesh.stored.size(); ++v) kept.row(static_cast<Index>(v)) = positions.row(mesh.stored[v]);
  mesh.triangles = triangles.unaryExpr([&](std::uint32_t v) { return number[v]; });
  mesh.weld = weld_mesh(kept, mesh.triangles);
  mesh.positions.resize(std::ssize(mesh.weld.unique), 3);
  for (std::size_t v = 0; v < mesh.weld.unique.size(); ++v)
    mesh.positions.row(static_cast<Index>(v)) = kept.row(mesh.weld.unique[v]);
  mesh.triangles = weld_triangles(mesh.weld, mesh.triangles);
}

Error too_few(const CountedMesh& mesh) {
  return {HB_ERROR_MESH_TOO_FEW_VERTICES,
          {"Triangles use ", mesh.stored.size(), " vertices; a volume needs at least four."},
          {"Give a closed triangle mesh."}};
}

/** Vertices that do not count, and the one of them farthest from a place. Those in the place of one that counts are that one,
 * split. */
struct LeftOut {
  Index count = 0, farthest = -1;
};

LeftOut find_left_out(const ConstPoints& positions, const std::vector<std::uint8_t>& used, const Vector3& middle) {
  const Weld weld = weld_vertices(positions);
  std::vector<std::uint8_t> counts(weld.unique.size());
  for (std::size_t v = 0; v < used.size(); ++v) counts[weld.to_unique[v]] |= used[v];
  LeftOut left;
  double most = -1;
  for (Index v = 0; v < positions.rows(); ++v) {
    if (counts[weld.to_unique[v]]) continue;
    ++left.count;
    const double away = (positions.row(v).transpose() - middle).stableNorm();
    if (away > most) most = away, left.farthest = v;
  }
  return left;
}

}  // namespace

Result<CountedMesh> count_mesh(const ConstPoints& positions, const ConstTriangles& triangles, std::vector<std::uint8_t> used) {
  const auto count = static_cast<std::size_t>(positions.rows());
  if (used.empty()) used.assign(count, triangles.rows() == 0);
  for (Index k = 0; k < triangles.size(); ++k) used[triangles.data()[k]] = 1;
  CountedMesh mesh;
  take(mesh, positions, triangles, used);
  SoundSurface sound = sound_surface(mesh.positions, mesh.triangles);
  if (sound.flat > 0) {
    // Without them, a vertex may be left that nothing uses.
    std::vector<std::uint8_t> corner(static_cast<std::size_t>(mesh.positions.rows())), flat_only(corner.size());
    for (Index k = 0; k < mesh.triangles.size(); ++k) flat_only[mesh.triangles.data()[k]] = 1;
    for (Index k = 0; k < sound.triangles.size(); ++k) flat_only[sound.triangles.data()[k]] = 0;
    bool any = false;
    for (std::size_t v = 0; v < mesh.stored.size(); ++v) {
      if (!flat_only[mesh.weld.to_unique[v]]) continue;
      used[mesh.stored[v]] = 0;
      any = true;
    }
    if (any) {
      Triangles kept = sound.triangles;
      for (Index k = 0; k < kept.size(); ++k) kept.data()[k] = mesh.stored_number(kept.data()[k]);
      take(mesh, positions, kept, used);
      sound.triangles = mesh.triangles;
    }
  }
  mesh.triangles = std::move(sound.triangles);
  mesh.with_area = sound.with_area;

  if (mesh.stored.empty()) return too_few(mesh);  // there is no box to measure
  if (auto checked = check_extent(normalize(mesh.positions)); !checked) return checked.error();
  if (mesh.stored.size() < 4) return too_few(mesh);
  const auto [left_out, farthest] =
      mesh.stored.size() < count ? find_left_out(positions, used, normalize(mesh.positions).center) : LeftOut{};
  if (left_out > 0) {
    if (!positions.row(farthest).cast<float>().allFinite())
      return Error(HB_ERROR_MESH_NOT_FINITE,
                   {"Vertex ", farthest, ", which nothing uses, has a coordinate beyond the range of single precision."},
                   {"Remove that vertex: it is no part of the surface."}, HB_CULPRIT_VERTEX, farthest);
    mesh.warnings.push_back({HB_WARNING_VERTICES_UNUSED, left_out, 0, Vector3(positions.row(farthest).transpose()), farthest});
  }
  if (sound.flat > 0) mesh.warnings.push_back({HB_WARNING_TRIANGLES_FLAT, sound.flat});
  if (sound.doubled > 0) mesh.warnings.push_back({HB_WARNING_TRIANGLES_DOUBLED, sound.doubled});
  return mesh;
}

}  // namespace handlebody
