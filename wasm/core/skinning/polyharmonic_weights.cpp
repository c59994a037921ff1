#include "core/skinning/polyharmonic_weights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/mesh/cotangent_laplacian.hpp"
#include "core/numerics/dense.hpp"

namespace handlebody {

namespace {

constexpr std::size_t most_updates = 64;

void set_unit_rows(const HeldVertices& held, Matrix& weights) {
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
  const SparseMatrix laplacian = cotangent_laplacian(mesh);
  // Vertices in no simplex have no mass and no neighbors: nothing is divided by it.
  const Vector inverse_mass = result.mass_.unaryExpr([](double m) { return m > 0 ? 1 / m : 0.0; });
  result.energy_ = laplacian;
  for (int k = 1; k < order; ++k) result.energy_ = symmetric_product(laplacian, inverse_mass, result.energy_);
  result.mesh_ = std::move(mesh);
  return made;
}

Result<Done> PolyharmonicWeights::set_handles(HeldVertices held) {
  auto islands = complete(held, mesh_, parts_);
  if (!islands) return islands.error();
  Change change;
  const bool updated = cholesky_ && find_change(held, change) && pays(change) && update(held, change);
  if (!updated) {
    if (auto done = factor(held); !done) return done;
  }
  factored_ = !updated;
  held_ = std::move(held);
  islands_ = std::move(*islands);
  return Done{};
}

Result<Done> PolyharmonicWeights::factor(const HeldVertices& held) {
  const auto n = static_cast<std::size_t>(mesh_.positions.rows());
  Indices number_of(n, 0), free;
  for (const std::uint32_t vertex : held.vertices) number_of[vertex] = no_index;
  for (std::size_t v = 0; v < n; ++v) {
    if (number_of[v] == no_index) continue;
    number_of[v] = static_cast<std::uint32_t>(free.size());
    free.push_back(static_cast<std::uint32_t>(v));
  }
  const SparseMatrix free_energy = submatrix(energy_, number_of, std::ssize(free));
  auto analyzed = SparseCholesky::analyze(free_energy);
  if (!analyzed) return analyzed.error();
  std::unique_ptr<SparseCholesky> cholesky = std::move(*analyzed);
  if (!cholesky->factor(free_energy)) {
    return Error(HB_ERROR_SYSTEM_SINGULAR,
                 {"The weights' equations have no answer in double precision: some simplices are too thin."},
                 {"Improve the mesh, or lower the order."});
  }

  // The right-hand side −Q_fp y, and then the solution, in the rows of the free vertices.
  const Index h = held.handle_count;
  Matrix held_values = Matrix::Zero(static_cast<Index>(n), h), right(static_cast<Index>(n), h);
  set_unit_rows(held, held_values);
  energy_.multiply(held_values.data(), h, right.data());
  Matrix solution(std::ssize(free), h);
  for (std::size_t k = 0; k < free.size(); ++k) solution.row(static_cast<Index>(k)) = -right.row(free[k]);
  cholesky->solve(solution.data(), h);
  for (std::size_t k = 0; k < free.size(); ++k) held_values.row(free[k]) = solution.row(static_cast<Index>(k));

  cholesky_ = std::move(cholesky);
  number_of_ = std::move(number_of);
  free_ = std::move(free);
  factored_held_ = held;
  factored_weights_ = std::move(held_values);
  weights_ = factored_weights_;
  return Done{};
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
    if (number_of_[held.vertices[k]] == no_index) continue;
    change.added.push_back(held.vertices[k]);
    change.new_owner.push_back(held.owners[k]);
  }
  return true;
}

bool PolyharmonicWeights::pays(const Change& change) const {
  const std::size_t updates = change.released.size() + change.added.size();
  return updates <= most_updates && static_cast<double>(updates) * cholesky_->solve_cost() < cholesky_->factor_cost() / 2;
}

bool PolyharmonicWeights::update(const HeldVertices& held, const Change& change) {
  const Index n = mesh_.positions.rows(), h = held.handle_count, factored_h = factored_held_.handle_count;
  Matrix weights = Matrix::Zero(n, h);
  for (Index g = 0; g < factored_h; ++g) {
    const std::uint32_t target = change.target[g];
    if (target != no_index) weights.col(target) += factored_weights_.col(g);
  }

  // One function for each vertex let go of: its own weight function; and for each held anew: the response to a force there.
  const auto released = std::ssize(change.released), size = released + std::ssize(change.added);
  if (size > 0) {
    Indices holds(factored_h, 0), group(n, no_index);
    for (std::size_t k = 0; k < factored_held_.vertices.size(); ++k) {
      ++holds[factored_held_.owners[k]];
      group[factored_held_.vertices[k]] = factored_held_.owners[k];
    }
    Matrix functions = Matrix::Zero(size, n);
    Vector column(std::ssize(free_));
    for (Index k = 0; k < size; ++k) {
      const std::uint32_t vertex = k < released ? change.released[k] : change.added[k - released];
      if (k < released && holds[group[vertex]] == 1) {
        functions.row(k) = factored_weights_.col(group[vertex]).transpose();
        continue;
      }
      column.setZero();
      const auto row = static_cast<std::size_t>(vertex);
      if (k < released) {
        functions(k, vertex) = 1;
        for (std::uint32_t e = energy_.starts[row]; e < energy_.starts[row + 1]; ++e)
          if (number_of_[energy_.columns[e]] != no_index) column[number_of_[energy_.columns[e]]] = -energy_.values[e];
      } else {
        column[number_of_[vertex]] = energy_.diagonal(vertex);
      }
      cholesky_->solve(column.data());
      for (std::size_t f = 0; f < free_.size(); ++f) functions(k, free_[f]) = column[static_cast<Index>(f)];
    }

    // No force where a vertex was let go of; the right value where one is held anew.
    MatrixXd equations(size, size);
    Matrix right(size, h);
    for (Index i = 0; i < size; ++i) {
      if (i < released) {
        const std::uint32_t vertex = change.released[i];
        const double scale = 1 / energy_.diagonal(vertex);
        for (Index k = 0; k < size; ++k) equations(i, k) = scale * energy_.row_times(vertex, functions.data() + k * n);
        for (Index j = 0; j < h; ++j) right(i, j) = -scale * energy_.row_times(vertex, Vector(weights.col(j)).data());
      } else {
        const auto at = static_cast<std::size_t>(i - released);
        for (Index k = 0; k < size; ++k) equations(i, k) = functions(k, change.added[at]);
        right.row(i) = -weights.row(change.added[at]);
        right(i, change.new_owner[at]) += 1;
      }
    }
    std::vector<Index> pivots;
    factor_lu(equations, pivots);
    Vector coefficients(size);
    for (Index j = 0; j < h; ++j) {
      coefficients = right.col(j);
      solve_lu(equations, pivots, coefficients.data());
      if (!coefficients.allFinite()) return false;
      for (Index k = 0; k < size; ++k) weights.col(j) += coefficients[k] * functions.row(k).transpose();
    }
  }
  set_unit_rows(held, weights);
  weights_ = std::move(weights);
  return true;
}

}  // namespace handlebody
