#include "core/mesh/sound_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/mesh/triangle_tree.hpp"
#include "core/mesh/weld.hpp"

namespace handlebody {

namespace {

constexpr double farthest = 1e60;  // as check_simplex_mesh() has it

void count(LeftOut& kind, Index which) {
  if (kind.count++ == 0) kind.first = static_cast<std::uint32_t>(which);
}

/** Whether a vertex's coordinates can be computed with. Only those of vertices that nothing uses may not be. */
bool has_place(const SimplexMesh& stored, Index v, Index used) {
  return (stored.positions.row(v) - stored.positions.row(used)).cwiseAbs().sum() < farthest;
}

/** The vertices' places in space; one without any is put where the first vertex in use is. */
Points places_of(const SimplexMesh& stored, Index first_used) {
  Points places = Points::Zero(stored.positions.rows(), 3);
  for (Index v = 0; v < places.rows(); ++v)
    places.row(v).head(stored.positions.cols()) = stored.positions.row(has_place(stored, v, first_used) ? v : first_used);
  return places;
}

/** The places, each with its vertices. A vertex without a place of its own shares none. */
Weld join_places(const SimplexMesh& stored, const Points& places, Index first_used, bool join) {
  Weld found;
  if (join) found = weld_mesh(places, stored.simplices);
  Weld result;
  Indices number(found.unique.size(), no_index);
  for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(places.rows()); ++v) {
    const auto fresh = static_cast<std::uint32_t>(result.unique.size());
    std::uint32_t own = fresh;
    if (join && has_place(stored, v, first_used)) {
      std::uint32_t& known = number[found.to_unique[v]];
      if (known == no_index) known = fresh;
      own = known;
    }
    if (own == fresh) result.unique.push_back(v);
    result.to_unique.push_back(own);
  }
  return result;
}

/** For each simplex the first one with the same corners in any order; itself, where there is none before it. */
Indices first_alike(const Simplices& simplices) {
  Simplices sorted = simplices;
  const Index corners = simplices.cols();
  for (Index s = 0; s < sorted.rows(); ++s) std::sort(sorted.row(s).data(), sorted.row(s).data() + corners);
  const auto compare = [&](std::uint32_t s, std::uint32_t t) {
    for (Index k = 0; k < corners; ++k)
      if (sorted(s, k) != sorted(t, k)) return sorted(s, k) < sorted(t, k) ? -1 : 1;
    return 0;
  };
  const Indices order = sorted_indices(static_cast<std::size_t>(sorted.rows()), [&](std::uint32_t s, std::uint32_t t) {
    const int difference = compare(s, t);
    return difference != 0 ? difference < 0 : s < t;
  });
  Indices first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && compare(order[i], order[i - 1]) == 0 ? first[order[i - 1]] : order[i];
  return first;
}

/** How high a simplex is above its largest side. */
double lowest_height(const SimplexMesh& mesh, Index s) {
  if (mesh.simplices.cols() == 3) return 2 * simplex_volume(mesh, s) / longest_edge(mesh, s);
  double largest = 0;
  for (Index k = 0; k < 4; ++k) {
    const auto corner = [&](Index l) -> Vector3 { return mesh.positions.row(mesh.simplices(s, (k + l) % 4)); };
    largest = std::max(largest, (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2);
  }
  return 3 * simplex_volume(mesh, s) / largest;
}

/** For each simplex whether it is flat: without area or volume, or with one that may be rounding's alone, where it hangs on others
 * by a part of its vertices only. One that joins others stays, however low it is: without it there would be a slit. */
std::vector<char> flat_simplices(const SimplexMesh& mesh, double diagonal) {
  const Index count = mesh.simplices.rows(), corners = mesh.simplices.cols();
  std::vector<char> flat(count), low(count), held(mesh.positions.rows(), 0), part_is_held;
  for (Index s = 0; s < count; ++s) {
    flat[s] = is_flat(mesh, s);
    low[s] = flat[s] || lowest_height(mesh, s) < rounding(longest_edge(mesh, s), diagonal);
    for (Index k = 0; k < corners && !low[s]; ++k) held[mesh.simplices(s, k)] = 1;
  }
  if (std::find(low.begin(), low.end(), 1) == low.end()) return flat;
  const Indices parts = connected_parts(mesh);
  part_is_held.assign(parts.size(), 0);
  for (std::size_t v = 0; v < held.size(); ++v) part_is_held[parts[v]] |= held[v];
  for (Index s = 0; s < count; ++s)
    for (Index k = 0; k < corners && low[s] && !flat[s]; ++k) {
      const std::uint32_t v = mesh.simplices(s, k);
      flat[s] = !held[v] && part_is_held[parts[v]];
    }
  return flat;
}

/** The triangles of a surface, or all faces of tetrahedra. */
Triangles faces_of(const Simplices& simplices) {
  if (simplices.cols() == 3) return simplices;
  Triangles faces(4 * simplices.rows(), 3);
  for (Index f = 0; f < faces.rows(); ++f)
    for (Index k = 0; k < 3; ++k) faces(f, k) = simplices(f / 4, (f + 1 + k) % 4);
  return faces;
}

/** Barycentric coordinates of the point of a triangle that is nearest to `point`. */
std::array<double, 3> nearest_parts(const Vector3& point, const std::array<Vector3, 3>& p) {
  const Vector3 u = p[1] - p[0], v = p[2] - p[0], offset = point - p[0];
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), pu = offset.dot(u), pv = offset.dot(v), whole = uu * vv - uv * uv;
  const double second = (vv * pu - uv * pv) / whole, third = (uu * pv - uv * pu) / whole;
  if (second >= 0 && third >= 0 && second + third <= 1) return {1 - second - third, second, third};
  std::array<double, 3> parts{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const Vector3 edge = p[next] - p[k], from = point - p[k];
    const double t = std::clamp(from.dot(edge) / edge.squaredNorm(), 0.0, 1.0), distance = (from - t * edge).squaredNorm();
    if (!(distance < least)) continue;
    least = distance;
    parts = {};
    parts[k] = 1 - t;
    parts[next] = t;
  }
  return parts;
}

/** Says where on the sound simplices the places of `flat` are, and which vertex each of its stored vertices goes with. */
void attach(SoundMesh& result, const Points& places, const Weld& weld, const std::vector<char>& flat) {
  const Triangles faces = faces_of(result.mesh.simplices);
  Points corners(std::ssize(result.first), 3);
  for (Index v = 0; v < corners.rows(); ++v) corners.row(v) = places.row(result.first[v]);
  const TriangleTree tree(corners, faces, false);
  for (std::uint32_t v = 0; v < result.vertex_of.size(); ++v) {
    if (!flat[weld.to_unique[v]]) continue;
    const Vector3 point = places.row(v);
    const std::uint32_t face = tree.nearest(point);
    FlatVertex own{v, {faces(face, 0), faces(face, 1), faces(face, 2)}, {}};
    own.parts = nearest_parts(point, {corners.row(own.corners[0]), corners.row(own.corners[1]), corners.row(own.corners[2])});
    result.vertex_of[v] =
        own.corners[static_cast<std::size_t>(std::max_element(own.parts.begin(), own.parts.end()) - own.parts.begin())];
    result.flat_vertices.push_back(own);
  }
}

}  // namespace

Result<SoundMesh> sound_mesh(const SimplexMesh& stored, const SoundMeshOptions& options) {
  if (auto checked = check_simplex_mesh(stored); !checked) return checked.error();
  const std::vector<char> used = used_vertices(stored);
  const auto first_used = static_cast<Index>(std::find(used.begin(), used.end(), 1) - used.begin());
  const Points places = places_of(stored, first_used);
  const Weld weld = join_places(stored, places, first_used, options.weld);

  SimplexMesh welded{Matrix(std::ssize(weld.unique), stored.positions.cols()), stored.simplices};
  for (Index u = 0; u < welded.positions.rows(); ++u)
    welded.positions.row(u) = places.row(weld.unique[u]).head(stored.positions.cols());
  for (Index i = 0; i < welded.simplices.size(); ++i) welded.simplices.data()[i] = weld.to_unique[welded.simplices.data()[i]];

  SoundMesh result;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v]) count(result.unused, static_cast<Index>(v));
  const bool solid = stored.simplices.cols() == 4;
  const char* const one = solid ? "Tetrahedron " : "Triangle ";
  const hb_culprit culprit = solid ? HB_CULPRIT_TETRAHEDRON : HB_CULPRIT_TRIANGLE;
  const std::vector<char> is_thin = flat_simplices(welded, used_diagonal(places, stored.simplices));
  const Indices alike = first_alike(welded.simplices);
  Indices kept;
  std::vector<char> sound(weld.unique.size(), 0), flat(weld.unique.size(), 0);
  for (Index s = 0; s < welded.simplices.rows(); ++s) {
    const bool repeats = alike[s] != static_cast<std::uint32_t>(s);
    if (is_thin[s]) {
      count(result.flat, s);
    } else if (repeats) {
      result.doubled.push_back(static_cast<std::uint32_t>(s));
      if (options.strict) {
        return Error(HB_ERROR_MESH_DEGENERATE, {one, s, " has the same corners as ", alike[s], "."}, {"Remove one of the two."},
                     culprit, s);
      }
    } else {
      kept.push_back(static_cast<std::uint32_t>(s));
    }
    for (Index k = 0; k < welded.simplices.cols(); ++k) (is_thin[s] ? flat : sound)[welded.simplices(s, k)] = 1;
  }
  if (result.flat.count > 0 && (options.strict || kept.empty())) {
    return Error(HB_ERROR_MESH_DEGENERATE, {one, result.flat.first, solid ? " has no volume." : " has no area."},
                 {"Remove it, or move its vertices apart."}, culprit, result.flat.first);
  }

  Indices number(weld.unique.size(), no_index);
  for (std::size_t u = 0; u < number.size(); ++u) {
    flat[u] = flat[u] && !sound[u];
    if (flat[u]) continue;
    number[u] = static_cast<std::uint32_t>(result.first.size());
    result.first.push_back(weld.unique[u]);
  }
  result.mesh.positions.resize(std::ssize(result.first), welded.positions.cols());
  for (std::size_t u = 0; u < number.size(); ++u)
    if (!flat[u]) result.mesh.positions.row(number[u]) = welded.positions.row(static_cast<Index>(u));
  result.mesh.simplices.resize(std::ssize(kept), welded.simplices.cols());
  for (std::size_t s = 0; s < kept.size(); ++s)
    for (Index k = 0; k < welded.simplices.cols(); ++k)
      result.mesh.simplices(static_cast<Index>(s), k) = number[welded.simplices(kept[s], k)];

  result.vertex_of.resize(used.size());
  result.place_of.resize(used.size());
  for (std::size_t v = 0; v < used.size(); ++v) {
    result.vertex_of[v] = number[weld.to_unique[v]];
    result.place_of[v] = weld.unique[weld.to_unique[v]];
  }
  if (std::find(flat.begin(), flat.end(), 1) != flat.end()) attach(result, places, weld, flat);
  return result;
}

}  // namespace handlebody
