#include "core/skinning/polyharmonic_weights.hpp"

#include <limits>
#include <utility>

#include "core/mesh/polyharmonic_energy.hpp"
#include "core/numerics/decompositions.hpp"

namespace handlebody {

namespace {

constexpr std::size_t most_updates = 64;
constexpr double most_weights = 0x1p27;
constexpr double most_error[] = {1e-6, 1e-6, 1e-4};  // of the sums of weights, for each order: more is worth another factorization
constexpr double worst_error = 0.05;                 // more is no answer

template <typename Weights>
void set_unit_rows(const HeldVertices& held, Weights& weights) {
  for (std::size_t k = 0; k < held.vertices.size(); ++k) {
    weights.row(held.vertices[k]).setZero();
    weights(held.vertices[k], held.owners[k]) = 1;
  }
}

}  // namespace

Result<std::unique_ptr<PolyharmonicWeights>> PolyharmonicWeights::create(SimplexMesh mesh, int order, Mass mass) {
  if (order < 1 || order > 3)
    return Error(HB_ERROR_INVALID_OPTION, {"There are no weights of order ", order, "."},
                 {"Use 1 (harmonic), 2 (biharmonic) or 3 (triharmonic)."}, HB_CULPRIT_OPTION);
  if (auto checked = check_simplex_mesh(mesh); !checked) return checked.error();
  if (auto checked = check_volumes(mesh); !checked) return checked.error();
  std::unique_ptr<PolyharmonicWeights> made(new PolyharmonicWeights);
  PolyharmonicWeights& result = *made;
  result.parts_ = connected_parts(mesh);
  result.mass_ = mass_matrix(mesh, mass);
  result.order_ = order;
  result.mesh_ = std::move(mesh);
  if (auto done = result.set_energy(0); !done) return done.error();
  return made;
}

Result<Done> PolyharmonicWeights::set_energy(double thinnest) {
  auto energy = polyharmonic_energy(mesh_, mass_, order_, thinnest);
  if (!energy) return energy.error();
  energy_.swap(*energy);
  thinnest_ = thinnest;
  return Done{};
}

Result<Done> PolyharmonicWeights::set_handles(HeldVertices held) {
  auto islands = complete(held, mesh_, parts_);
  if (!islands) return islands.error();
  const double numbers = static_cast<double>(mesh_.positions.rows()) * static_cast<double>(held.handle_count);
  if (numbers > most_weights)
    return Error(HB_ERROR_OUT_OF_MEMORY,
                 {"The weights of ", held.handle_count, " handles at ", mesh_.positions.rows(), " vertices take ", numbers * 8e-9,
                  " GB; 1 GB is the most that is allocated."},
                 {"Use fewer handles or fewer vertices."});
  Change change;
  const bool updated = solver_ && find_change(held, change) && pays(change) && update(held, change);
  if (!updated) {
    if (auto done = factor(held); !done) return done;
  }
  factored_ = !updated;
  held_ = std::move(held);
  islands_ = std::move(*islands);
  return Done{};
}

Result<Done> PolyharmonicWeights::factor(const HeldVertices& held) {
  const Index n = mesh_.positions.rows();
  Indices owner_of(n, no_index), free;
  for (std::size_t k = 0; k < held.vertices.size(); ++k) owner_of[held.vertices[k]] = held.owners[k];
  for (std::uint32_t v = 0; v < owner_of.size(); ++v)
    if (owner_of[v] == no_index) free.push_back(v);
  auto best = attempt(held, free);
  if (!best) return best.error();
  if (best->error > most_error[order_ - 1]) {
    const double of_mesh = thinnest_simplex(mesh_);
    solver_.reset();  // of another energy from here on
    double thinnest_of_best = thinnest_;
    for (double next = thicker(thinnest_, order_, of_mesh); next > 0 && best->error > most_error[order_ - 1];
         next = thicker(next, order_, of_mesh)) {
      if (auto done = set_energy(next); !done) return done;
      auto other = attempt(held, free);
      if (!other) return other.error();
      if (!(other->error < best->error / 2)) continue;
      best = std::move(other);
      thinnest_of_best = next;
    }
    if (thinnest_ != thinnest_of_best)
      if (auto done = set_energy(thinnest_of_best); !done) return done;
  }
  if (!(best->error < worst_error)) {
    return Error(HB_ERROR_SYSTEM_SINGULAR,
                 {"The weights' equations have no answer in double precision: some simplices are too thin, or the mesh is too fine "
                  "for the order."},
                 {"Improve the mesh, or lower the order."});
  }
  // What takes memory comes first: where that runs out, the former factor and what it is of stay together.
  HeldVertices kept = held;
  auto weights = best->weights;
  solver_ = std::move(best->solver);
  factored_held_ = std::move(kept);
  factored_owner_of_ = std::move(owner_of);
  factored_weights_ = std::move(best->weights);
  weights_ = std::move(weights);
  return Done{};
}

Result<PolyharmonicWeights::Attempt> PolyharmonicWeights::attempt(const HeldVertices& held, const Indices& free) const {
  Attempt result{nullptr, {}, std::numeric_limits<double>::infinity()};
  auto solver = MinQuadWithFixed::create(energy_, free, {.columns = held.handle_count, .order = {}});
  if (!solver) return solver.error();
  if (!(*solver)->succeeded()) return result;
  result.weights = Matrix::Zero(mesh_.positions.rows(), held.handle_count);
  set_unit_rows(held, result.weights);
  (*solver)->solve(result.weights);
  result.solver = std::move(*solver);
  result.error = (result.weights.rowwise().sum().array() - 1).abs().maxCoeff();
  return result;
}

/** False where the vertices of one factored handle went to several: then its weights are of no use. */
bool PolyharmonicWeights::find_change(const HeldVertices& held, Change& change) const {
  Indices owner_of(mesh_.positions.rows(), no_index);
  for (std::size_t k = 0; k < held.vertices.size(); ++k) owner_of[held.vertices[k]] = held.owners[k];
  change.target.assign(factored_held_.handle_count, no_index);
  for (std::size_t k = 0; k < factored_held_.vertices.size(); ++k) {
    const std::uint32_t vertex = factored_held_.vertices[k], owner = owner_of[vertex];
    if (owner == no_index) {
      change.released.push_back(vertex);
      continue;
    }
    std::uint32_t& target = change.target[factored_held_.owners[k]];
    if (target != no_index && target != owner) return false;
    target = owner;
  }
  for (std::size_t k = 0; k < held.vertices.size(); ++k) {
    if (factored_owner_of_[held.vertices[k]] != no_index) continue;
    change.added.push_back(held.vertices[k]);
    change.new_owner.push_back(held.owners[k]);
  }
  return true;
}

bool PolyharmonicWeights::pays(const Change& change) const {
  const std::size_t updates = change.released.size() + change.added.size();
  return updates <= most_updates && static_cast<double>(updates) * solver_->solve_cost() < solver_->factor_cost() / 2;
}

bool PolyharmonicWeights::update(const HeldVertices& held, const Change& change) {
  const Index n = mesh_.positions.rows(), h = held.handle_count, factored_h = factored_held_.handle_count;
  MatrixXd weights = MatrixXd::Zero(n, h);
  for (Index g = 0; g < factored_h; ++g) {
    const std::uint32_t target = change.target[g];
    if (target != no_index) weights.col(target) += factored_weights_.col(g);
  }

  const auto released = std::ssize(change.released), size = released + std::ssize(change.added);
  if (size > 0) {
    // One function for each released vertex, its own weight function, and for each newly held one, the response to a force there.
    Indices holds(factored_h, 0);
    for (const std::uint32_t owner : factored_held_.owners) ++holds[owner];
    MatrixXd functions(n, size);
    Vector function(n), force = Vector::Zero(n);
    for (Index k = 0; k < size; ++k) {
      function.setZero();
      if (k < released) {
        const std::uint32_t vertex = change.released[k], owner = factored_owner_of_[vertex];
        function[vertex] = 1;
        if (holds[owner] == 1)
          function = factored_weights_.col(owner);
        else
          solver_->solve(function);
      } else {
        const std::uint32_t vertex = change.added[k - released];
        force[vertex] = energy_.coeff(vertex, vertex);
        solver_->solve(force, function);
        force[vertex] = 0;
      }
      functions.col(k) = function;
    }

    // No force at a released vertex; the right value at a newly held one.
    MatrixXd equations(size, size), right(size, h);
    for (Index i = 0; i < size; ++i) {
      if (i < released) {
        const std::uint32_t vertex = change.released[i];
        const double scale = 1 / energy_.coeff(vertex, vertex);
        for (Index k = 0; k < size; ++k) equations(i, k) = scale * energy_.row(vertex).dot(functions.col(k));
        for (Index j = 0; j < h; ++j) right(i, j) = -scale * energy_.row(vertex).dot(weights.col(j));
      } else {
        const std::uint32_t vertex = change.added[i - released];
        equations.row(i) = functions.row(vertex);
        right.row(i) = -weights.row(vertex);
        right(i, change.new_owner[i - released]) += 1;
      }
    }
    const MatrixXd coefficients = Lu(std::move(equations)).solve(right);
    if (!coefficients.allFinite()) return false;
    for (Index j = 0; j < h; ++j) weights.col(j).noalias() += functions * coefficients.col(j);
  }
  set_unit_rows(held, weights);
  weights_ = weights;
  return true;
}

}  // namespace handlebody
