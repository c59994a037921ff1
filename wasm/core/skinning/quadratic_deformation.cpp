#include "core/skinning/quadratic_deformation.hpp"

#include <utility>

#include "core/mesh/cotangent_laplacian.hpp"
#include "core/mesh/mass_matrix.hpp"
#include "core/skinning/free_rows.hpp"

namespace handlebody {
namespace {

/** ½ ∫|∇f|² − area(f) of rows 2v and 2v + 1, the coordinates of vertex v. */
SparseMatrix conformal_matrix(const SimplexMesh& mesh, const SparseMatrix& laplacian) {
  const auto n = static_cast<std::uint32_t>(mesh.positions.rows());
  SparseEntries entries(2 * mesh.positions.rows());
  for (std::uint32_t v = 0; v < n; ++v)
    for (std::uint32_t e = laplacian.starts[v]; e < laplacian.starts[v + 1]; ++e)
      for (std::uint32_t axis = 0; axis < 2; ++axis)
        entries.put(2 * v + axis, 2 * laplacian.columns[e] + axis, laplacian.values[e]);
  for (Index t = 0; t < mesh.simplices.rows(); ++t) {
    const std::uint32_t* const corners = mesh.simplices.data() + 3 * t;
    const double sign = doubled_area(corners, mesh.positions.data()) > 0 ? 0.5 : -0.5;
    for (Index k = 0; k < 3; ++k) {  // area = ½ Σ x y′ − y x′ over the edges: half of it, twice, in a symmetric matrix
      const std::uint32_t from = 2 * corners[k], to = 2 * corners[(k + 1) % 3];
      entries.put(from, to + 1, -sign);
      entries.put(to + 1, from, -sign);
      entries.put(from + 1, to, sign);
      entries.put(to, from + 1, sign);
    }
  }
  const SparseMatrix all = entries.matrix();
  SparseMatrix kept;  // inner edges cancel to the last bit
  for (Index row = 0; row < all.rows(); ++row) {
    for (std::uint32_t e = all.starts[row]; e < all.starts[row + 1]; ++e) {
      if (all.values[e] == 0) continue;
      kept.columns.push_back(all.columns[e]);
      kept.values.push_back(all.values[e]);
    }
    kept.starts.push_back(static_cast<std::uint32_t>(kept.columns.size()));
  }
  return kept;
}

class QuadraticDeformation final : public HeldDeformation {
 public:
  static Result<std::unique_ptr<HeldDeformation>> create(SimplexMesh mesh, HeldVertices held, QuadraticEnergy energy) {
    auto setup = set_up(std::move(mesh), std::move(held));
    if (!setup) return setup.error();
    SparseMatrix matrix = cotangent_laplacian(setup->mesh);
    if (energy == QuadraticEnergy::laplacian) {
      const Vector mass = mass_matrix(setup->mesh, Mass::voronoi);
      matrix = symmetric_product(matrix, mass.unaryExpr([](double m) { return m > 0 ? 1 / m : 0.0; }), matrix);
    }
    const bool conformal = energy == QuadraticEnergy::conformal;
    if (conformal) matrix = conformal_matrix(setup->mesh, matrix);
    auto rows = FreeRows::create(std::move(matrix), setup->owner_of, conformal ? 2 : 1);
    if (!rows) return rows.error();
    return std::unique_ptr<HeldDeformation>(new QuadraticDeformation(std::move(*setup), std::move(*rows)));
  }

 private:
  QuadraticDeformation(Setup setup, std::unique_ptr<FreeRows> rows) : HeldDeformation(std::move(setup)), rows_(std::move(rows)) {}

  void minimize() override {
    for (std::size_t k = 0; k < displacements_.size(); ++k)
      if (owner_of_[k / 2] == no_index) displacements_[k] = 0;  // nothing of the last frame, not its rounding either
    rows_->solve(nullptr, displacements_.data());
    report_.energy = rows_->energy(displacements_.data());
    report_.iterations = 1;
  }

  std::unique_ptr<FreeRows> rows_;
};

}  // namespace

Result<std::unique_ptr<HeldDeformation>> quadratic_deformation(SimplexMesh mesh, HeldVertices held, QuadraticEnergy energy) {
  return QuadraticDeformation::create(std::move(mesh), std::move(held), energy);
}

}  // namespace handlebody
