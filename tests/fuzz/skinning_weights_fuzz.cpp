// Sound meshes, skinning weights, their bounds and measures.
//
// behind: abi/simplex_mesh.cpp abi/skinning_weights.cpp core/mesh/sound_mesh.cpp core/mesh/simplex_mesh.cpp core/mesh/mass_matrix.cpp core/mesh/cotangent_laplacian.cpp core/mesh/polyharmonic_energy.cpp
// behind: core/skinning/bounded_newton.cpp core/skinning/bounded_problem.cpp core/skinning/bounded_sweeps.cpp core/skinning/bounded_weights.cpp core/skinning/held_vertices.cpp core/skinning/measure_weights.cpp core/skinning/polyharmonic_weights.cpp core/numerics/sparse_cholesky.cpp
#include "meshes.hpp"
#include "target.hpp"

using namespace handlebody::fuzz;

namespace {

/** The mesh without what weights refuse, as callers make it. */
void make_sound(Bytes& bytes, Mesh& mesh) {
  Owned<hb_sound_mesh_free> sound;
  const hb_simplex_mesh given = mesh.view(bytes);
  const std::uint32_t weld = bytes.option(1, 1), strict = bytes.option(0, bytes.byte() < 20);
  if (!sound.make([&](hb_sound_mesh** out) { return hb_sound_mesh_create(&given, weld, strict, out); })) return;
  reached();
  hb_sound_mesh_view view;
  hb_sound_mesh_get(sound.get(), &view);
  require(view.vertex_count <= mesh.vertex_count() && view.simplex_count <= mesh.simplex_count(),
          "a sound mesh has no more than there was");
  for (std::uint32_t v = 0; v < view.vertex_count; ++v)
    require(view.first[v] < mesh.vertex_count(), "its vertices are some of those that came");
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    require(view.place_of[v] <= v, "the first vertex at a place is not after it");
    require(view.vertex_of[v] < view.vertex_count, "each vertex that came has one of the sound mesh");
  }
  for (std::uint32_t i = 0; i < view.flat_vertex_count; ++i)
    require(view.flat_vertices[i].vertex < mesh.vertex_count(), "a flat vertex is one that came");
  for (std::uint32_t i = 0; i < view.doubled_count; ++i)
    require(view.doubled[i] < mesh.simplex_count(), "a doubled simplex is one that came");
  mesh.positions.assign(view.positions, view.positions + std::size_t{view.vertex_count} * mesh.dimension);
  mesh.simplices.assign(view.simplices, view.simplices + std::size_t{view.simplex_count} * mesh.corners);
}

void bound(Bytes& bytes, hb_skinning_weights* weights) {
  if (!worked(hb_skinning_weights_bound_begin(weights, bytes.flip() ? 1e-6 : bytes.positive() / 8))) return;
  double progress = 0;
  hb_bounded_report report{};
  for (unsigned left = bytes.byte() < 40 ? bytes.byte() % 8u : 100000; progress < 1 && left > 0; --left)
    if (!worked(hb_skinning_weights_bound_step(weights, &progress, &report))) return;
}

}  // namespace

FUZZ(bytes) {
  const std::uint32_t corners = bytes.byte() < 80 ? 4 : 3, dimension = corners == 4 || bytes.flip() ? 3 : 2;
  Mesh mesh = make_mesh(bytes, dimension, corners);
  if (bytes.byte() < 200) make_sound(bytes, mesh);
  const hb_simplex_mesh view = mesh.view(bytes);
  const Held held = hold(bytes, mesh.vertex_count());
  const hb_held_vertices holding = held.view(bytes);
  if (bytes.byte() < 40) {
    const std::vector<double> given = bytes.numbers(std::size_t{mesh.vertex_count()} * held.handle_count);
    std::vector<double> support(held.handle_count + 1, 7);
    hb_weight_measures measures;
    if (worked(hb_measure_weights(&view, &holding, given.data(), support.data(), &measures))) reached();
    require(support.back() == 7, "support has one number for each handle");
    return;
  }
  Owned<hb_skinning_weights_free> weights;
  if (!weights.make([&](hb_skinning_weights** out) {
        return hb_skinning_weights_create(&view, bytes.option(1, 3), bytes.option(0, 1), out);
      }))
    return;
  if (bytes.byte() < 10) bound(bytes, weights.get());
  if (!worked(hb_skinning_weights_set_handles(weights.get(), &holding))) return;
  reached();
  require(hb_skinning_weights_factored(weights.get()) == 1, "the first handles are factored for");
  for (unsigned times = bytes.byte() < 100 ? bytes.below(4) : 0; times > 0; --times) {
    const Held next = hold(bytes, mesh.vertex_count());
    const hb_held_vertices other = next.view(bytes);
    worked(hb_skinning_weights_set_handles(weights.get(), &other));
  }
  if (bytes.byte() < 100) bound(bytes, weights.get());
  require(hb_skinning_weights_values(weights.get()) != nullptr && hb_skinning_weights_mass(weights.get()) != nullptr,
          "weights and masses are there");
  const hb_island* islands = nullptr;
  const std::uint32_t count = hb_skinning_weights_islands(weights.get(), &islands);
  for (std::uint32_t i = 0; i < count; ++i) require(islands[i].first < mesh.vertex_count(), "an island begins with a vertex");
  hb_sparse_matrix energy;
  const std::uint32_t entries = hb_skinning_weights_energy(weights.get(), &energy);
  require(energy.starts[mesh.vertex_count()] == entries, "the last row ends with the last entry");
  for (std::uint32_t i = 0; i < entries; ++i) require(energy.columns[i] < mesh.vertex_count(), "a column is a vertex");
}
