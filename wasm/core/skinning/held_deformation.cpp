#include "core/skinning/held_deformation.hpp"

#include <utility>

namespace handlebody {
namespace {

constexpr std::uint32_t several = no_index - 1;

}  // namespace

double doubled_area(const std::uint32_t* corners, const double* p, const double* u) {
  double e[4];
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t from = 2 * std::size_t{corners[0]} + k % 2, to = 2 * std::size_t{corners[1 + k / 2]} + k % 2;
    e[k] = p[to] - p[from] + (u ? u[to] - u[from] : 0);
  }
  return e[0] * e[3] - e[1] * e[2];
}

Result<HeldDeformation::Setup> HeldDeformation::set_up(SimplexMesh mesh, HeldVertices held) {
  if (mesh.positions.cols() != 2 || mesh.simplices.cols() != 3)
    return Error(HB_ERROR_INVALID_SHAPE, {"Energies are minimized on triangles in the plane."}, {"Give a mesh of two dimensions."});
  if (auto checked = check_simplex_mesh(mesh); !checked) return checked.error();
  if (auto checked = check_volumes(mesh); !checked) return checked.error();
  const auto n = static_cast<std::size_t>(mesh.positions.rows());
  const Indices parts = connected_parts(mesh);
  HeldVertices given = held;
  const auto islands = complete(held, mesh, parts);
  if (!islands) return islands.error();

  Indices owner_of(n, no_index), only_vertex(given.handle_count, no_index);
  for (std::size_t k = 0; k < given.vertices.size(); ++k) {
    std::uint32_t& only = only_vertex[given.owners[k]];
    only = only == no_index || only == given.vertices[k] ? given.vertices[k] : several;
    owner_of[given.vertices[k]] = given.owners[k];
  }
  Indices around(n, no_index);  // the one handle that a vertex is next to, or `several`
  for (Index t = 0; t < mesh.simplices.rows(); ++t)
    for (Index k = 0; k < 3; ++k) {
      const std::uint32_t owner = owner_of[mesh.simplices(t, k)];
      if (owner == no_index || only_vertex[owner] == several) continue;
      for (Index other = 0; other < 3; ++other) {
        std::uint32_t& next_to = around[mesh.simplices(t, other)];
        next_to = next_to == no_index || next_to == owner ? owner : several;
      }
    }
  for (std::size_t v = 0; v < n; ++v)
    if (owner_of[v] == no_index && around[v] != several) owner_of[v] = around[v];
  for (const Island& island : *islands)
    for (std::size_t v = island.first; v < n; ++v)
      if (parts[v] == parts[island.first]) owner_of[v] = island.handle;
  return Setup{std::move(mesh), std::move(owner_of), given.handle_count};
}

Result<std::unique_ptr<MinQuadWithFixed>> HeldDeformation::free_solver(const SparseMatrix& q, const Indices& owner_of) {
  const Index rows_per_vertex = q.rows() / std::ssize(owner_of);
  Indices free;
  for (std::size_t row = 0; row < static_cast<std::size_t>(q.rows()); ++row)
    if (owner_of[row / rows_per_vertex] == no_index) free.push_back(static_cast<std::uint32_t>(row));
  auto made = MinQuadWithFixed::create(q, std::move(free), {.columns = 2 / rows_per_vertex, .order = {}});
  if (made && !(*made)->succeeded()) {
    return Error(HB_ERROR_SYSTEM_SINGULAR,
                 {"The handles do not determine the shape: some triangles are too thin, or hang on one vertex only."},
                 {"Improve the mesh, or hold more of it."});
  }
  return made;
}

HeldDeformation::HeldDeformation(Setup setup)
    : Skin(setup.mesh.positions.rows(), 2, setup.handles),
      mesh_(std::move(setup.mesh)),
      owner_of_(std::move(setup.owner_of)),
      displacements_(Matrix::Zero(vertices_, 2)) {}

void HeldDeformation::move(float* out) {
  const double* const positions = mesh_.positions.data();
  double* const u = displacements_.data();
  for (Index v = 0; v < vertices_; ++v) {
    if (owner_of_[v] == no_index) continue;
    const double *t = transforms_.data() + 6 * owner_of_[v], x = positions[2 * v], y = positions[2 * v + 1];
    u[2 * v] = (t[0] - 1) * x + t[1] * y + t[2];
    u[2 * v + 1] = t[3] * x + (t[4] - 1) * y + t[5];
  }
  report_ = {};
  minimize();
  for (Index k = 0; k < 2 * vertices_; ++k) out[k] = static_cast<float>(positions[k] + u[k]);
  for (Index t = 0; t < mesh_.simplices.rows(); ++t) {
    const std::uint32_t* corners = mesh_.simplices.data() + 3 * t;
    if (!(doubled_area(corners, positions) * doubled_area(corners, positions, u) > 0)) ++report_.flips;
  }
}

}  // namespace handlebody
