#include "core/skinning/held_vertices.hpp"

#include <algorithm>
#include <limits>

namespace handlebody {

namespace {

Result<Done> check(const HeldVertices& held, Index vertex_count, Indices& owner_of) {
  if (held.handle_count == 0) {
    return Error(HB_ERROR_HANDLES_MISSING, {"There is no handle, so there is nothing that weights could belong to."},
                 {"Give one or more."});
  }
  // Of more handles than vertices are held one holds nothing, which the first of them tell.
  Indices holds(std::min<std::size_t>(held.handle_count, held.vertices.size() + 1), 0);
  owner_of.assign(vertex_count, no_index);
  for (std::size_t k = 0; k < held.vertices.size(); ++k) {
    const std::uint32_t vertex = held.vertices[k], owner = held.owners[k];
    if (!in_range(owner, held.handle_count))
      return Error(HB_ERROR_INVALID_OPTION, {"A vertex belongs to handle ", owner, ", which is not there."},
                   {"Count handles from 0."});
    if (!in_range(vertex, vertex_count)) {
      return Error(HB_ERROR_HANDLE_OUT_OF_RANGE,
                   {"Handle ", owner, " holds vertex ", vertex, ", but there are only ", vertex_count, "."},
                   {"Give a vertex number from 0 on."}, HB_CULPRIT_HANDLE, owner);
    }
    std::uint32_t& present = owner_of[vertex];
    if (present != no_index && present != owner) {
      return Error(HB_ERROR_HANDLE_CONFLICT, {"Handles ", present, " and ", owner, " both hold vertex ", vertex, "."},
                   {"Move one of them to another vertex, or refine the mesh there."}, HB_CULPRIT_HANDLE, owner);
    }
    present = owner;
    if (owner < holds.size()) ++holds[owner];
  }
  for (std::size_t owner = 0; owner < holds.size(); ++owner) {
    if (holds[owner] > 0) continue;
    return Error(HB_ERROR_HANDLE_OUT_OF_RANGE, {"Handle ", owner, " holds no vertex."}, {"Give it one or more."}, HB_CULPRIT_HANDLE,
                 static_cast<std::int64_t>(owner));
  }
  return Done{};
}

}  // namespace

Result<std::vector<Island>> complete(HeldVertices& held, const SimplexMesh& mesh, const Indices& parts) {
  const Index n = mesh.positions.rows();
  Indices owner_of;
  if (auto checked = check(held, n, owner_of); !checked) return checked.error();
  std::vector<Island> part_of(parts.empty() ? 0 : *std::max_element(parts.begin(), parts.end()) + 1, {no_index, 0, no_index});
  held.vertices.clear();
  held.owners.clear();
  for (std::size_t v = 0; v < parts.size(); ++v) {
    Island& part = part_of[parts[v]];
    if (part.count++ == 0) part.first = static_cast<std::uint32_t>(v);
    if (owner_of[v] == no_index) continue;
    part.handle = owner_of[v];
    held.vertices.push_back(static_cast<std::uint32_t>(v));
    held.owners.push_back(owner_of[v]);
  }

  std::vector<double> nearest(part_of.size(), std::numeric_limits<double>::infinity());
  // A vertex that no simplex uses may have no distance that is a number; it goes with the first handle then.
  Indices chosen(part_of.size(), held.owners.front());
  const std::size_t given = held.vertices.size();
  for (std::size_t v = 0; v < parts.size(); ++v) {
    const std::uint32_t part = parts[v];
    if (part_of[part].handle != no_index) continue;
    for (std::size_t k = 0; k < given; ++k) {
      const double distance = (mesh.positions.row(static_cast<Index>(v)) - mesh.positions.row(held.vertices[k])).squaredNorm();
      if (!(distance < nearest[part])) continue;
      nearest[part] = distance;
      chosen[part] = held.owners[k];
    }
  }
  std::vector<Island> islands;
  for (std::size_t part = 0; part < part_of.size(); ++part) {
    if (part_of[part].handle != no_index) continue;
    part_of[part].handle = chosen[part];
    islands.push_back(part_of[part]);
    held.vertices.push_back(part_of[part].first);
    held.owners.push_back(chosen[part]);
  }
  return islands;
}

}  // namespace handlebody
