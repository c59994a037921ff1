#include "core/skinning/quadratic_deformation.hpp"

#include <utility>
#include <vector>

#include "core/mesh/cotangent_laplacian.hpp"
#include "core/mesh/mass_matrix.hpp"
#include "core/mesh/polyharmonic_energy.hpp"

namespace handlebody {
namespace {

constexpr double most_shift_error = 1e-6;

/** ½ ∫|∇f|² − area(f) of rows 2v and 2v + 1, the coordinates of vertex v. */
SparseMatrix conformal_matrix(const SimplexMesh& mesh, const SparseMatrix& laplacian) {
  std::vector<Triplet> entries;
  entries.reserve(2 * laplacian.nonZeros() + 12 * mesh.simplices.rows());
  for (Index v = 0; v < laplacian.rows(); ++v)
    for (SparseMatrix::InnerIterator entry(laplacian, v); entry; ++entry)
      for (Index axis = 0; axis < 2; ++axis) entries.emplace_back(2 * v + axis, 2 * entry.col() + axis, entry.value());
  for (Index t = 0; t < mesh.simplices.rows(); ++t) {
    const std::uint32_t* const corners = mesh.simplices.data() + 3 * t;
    const double sign = doubled_area(corners, mesh.positions.data()) > 0 ? 0.5 : -0.5;
    for (Index k = 0; k < 3; ++k) {  // area = ½ Σ x y′ − y x′ over the edges: half of it, twice, in a symmetric matrix
      const std::uint32_t from = 2 * corners[k], to = 2 * corners[(k + 1) % 3];
      entries.emplace_back(from, to + 1, -sign);
      entries.emplace_back(to + 1, from, -sign);
      entries.emplace_back(from + 1, to, sign);
      entries.emplace_back(to, from + 1, sign);
    }
  }
  SparseMatrix energy(2 * laplacian.rows(), 2 * laplacian.rows());
  energy.setFromTriplets(entries.begin(), entries.end());
  energy.prune([](Index, Index, double value) { return value != 0; });  // inner edges cancel to the last bit
  return energy;
}

class QuadraticDeformation final : public HeldDeformation {
 public:
  static Result<std::unique_ptr<HeldDeformation>> create(SimplexMesh mesh, HeldVertices held, QuadraticEnergy energy) {
    auto setup = set_up(std::move(mesh), std::move(held));
    if (!setup) return setup.error();
    if (energy == QuadraticEnergy::laplacian) return create_laplacian(*setup);
    SparseMatrix q = cotangent_laplacian(setup->mesh);
    if (energy == QuadraticEnergy::conformal) q = conformal_matrix(setup->mesh, q);
    auto solver = free_solver(q, setup->owner_of);
    if (!solver) return solver.error();
    return std::unique_ptr<HeldDeformation>(new QuadraticDeformation(std::move(*setup), q, std::move(*solver)));
  }

 private:
  /** Nearly flat triangles count as thicker until Q can be factored and reproduces shifts, as those of PolyharmonicWeights do. */
  static Result<std::unique_ptr<HeldDeformation>> create_laplacian(Setup& setup) {
    const Vector mass = mass_matrix(setup.mesh, Mass::voronoi);
    for (double thinnest = 0, of_mesh = -1;;) {
      auto q = polyharmonic_energy(setup.mesh, mass, 2, thinnest);
      if (!q) return q.error();
      auto solver = free_solver(*q, setup.owner_of);
      if (!solver && solver.error().code != HB_ERROR_SYSTEM_SINGULAR) return solver.error();
      const double error = solver ? shift_error(**solver, setup.owner_of) : most_shift_error + 1;
      if (error > most_shift_error) {
        if (of_mesh < 0) of_mesh = thinnest_simplex(setup.mesh);
        const double next = thicker(thinnest, 2, of_mesh);
        if (next > 0) {
          thinnest = next;
          continue;
        }
        if (!solver) return solver.error();
      }
      return std::unique_ptr<HeldDeformation>(new QuadraticDeformation(std::move(setup), *q, std::move(*solver)));
    }
  }

  /** The most that a shift by 1 of the held vertices moves a free one otherwise. */
  static double shift_error(MinQuadWithFixed& solver, const Indices& owner_of) {
    Matrix shift(std::ssize(owner_of), 2);
    for (std::size_t v = 0; v < owner_of.size(); ++v) shift.row(static_cast<Index>(v)).setConstant(owner_of[v] == no_index ? 0 : 1);
    solver.solve(shift);
    return (shift.array() - 1).abs().maxCoeff();
  }

  /** Takes the contents of q. */
  QuadraticDeformation(Setup setup, SparseMatrix& q, std::unique_ptr<MinQuadWithFixed> solver)
      : HeldDeformation(std::move(setup)), solver_(std::move(solver)), product_(q.rows()) {
    q_.swap(q);  // Eigen would copy a sparse matrix that is moved
  }

  void minimize() override {
    const Index columns = displacements_.size() / q_.rows();  // 1 where x and y are unknowns of the same equations
    solver_->solve(Eigen::Map<Matrix>(displacements_.data(), q_.rows(), columns));
    report_.energy = 0;
    for (Index j = 0; j < columns; ++j) {
      const Eigen::Map<const Vector, 0, Eigen::InnerStride<>> u(displacements_.data() + j, q_.rows(),
                                                                Eigen::InnerStride<>(columns));
      product_.noalias() = q_ * u;
      report_.energy += u.dot(product_) / 2;
    }
    report_.iterations = 1;
  }

  SparseMatrix q_;
  std::unique_ptr<MinQuadWithFixed> solver_;
  Vector product_;
};

}  // namespace

Result<std::unique_ptr<HeldDeformation>> quadratic_deformation(SimplexMesh mesh, HeldVertices held, QuadraticEnergy energy) {
  return QuadraticDeformation::create(std::move(mesh), std::move(held), energy);
}

}  // namespace handlebody
