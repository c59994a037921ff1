#include "core/skinning/as_rigid_as_possible.hpp"

#include <cmath>
#include <utility>

#include "core/mesh/cotangent_laplacian.hpp"

namespace handlebody {
namespace {

class AsRigidAsPossible final : public HeldDeformation {
 public:
  static Result<std::unique_ptr<HeldDeformation>> create(SimplexMesh mesh, HeldVertices held) {
    auto setup = set_up(std::move(mesh), std::move(held));
    if (!setup) return setup.error();
    auto solver = free_solver(cotangent_laplacian(setup->mesh), setup->owner_of);
    if (!solver) return solver.error();
    return std::unique_ptr<HeldDeformation>(new AsRigidAsPossible(std::move(*setup), std::move(*solver)));
  }

 private:
  AsRigidAsPossible(Setup setup, std::unique_ptr<MinQuadWithFixed> solver)
      : HeldDeformation(std::move(setup)), solver_(std::move(solver)), forces_(vertices_, 2) {
    tolerance_ = 1e-7 * longest_side(mesh_);
  }

  double fit_rotations();

  void minimize() override {
    double change = tolerance_ + 1;
    for (; report_.iterations < most_iterations_ && change > tolerance_; ++report_.iterations) {
      fit_rotations();
      change = solver_->solve(forces_, displacements_);
    }
    report_.energy = fit_rotations();
  }

  std::unique_ptr<MinQuadWithFixed> solver_;
  Matrix forces_;  // n×2
  double tolerance_;
};

/** The local step: writes the forces of the closest rotations, and returns E. */
double AsRigidAsPossible::fit_rotations() {
  forces_.setZero();
  const double *const positions = mesh_.positions.data(), *const u = displacements_.data();
  double energy = 0;
  for (Index t = 0; t < mesh_.simplices.rows(); ++t) {
    const std::uint32_t *const corners = mesh_.simplices.data() + 3 * t;
    const double doubled = doubled_area(corners, positions), sign = doubled > 0 ? 1 : -1, area = sign * doubled / 2;
    double normals[6], g[4] = {};  // area ∇φ of the corners, and Σ u ⊗ area ∇φ
    for (Index k = 0; k < 3; ++k) {
      const double *from = positions + 2 * corners[(k + 1) % 3], *to = positions + 2 * corners[(k + 2) % 3];
      normals[2 * k] = sign * (from[1] - to[1]) / 2;
      normals[2 * k + 1] = sign * (to[0] - from[0]) / 2;
      for (Index e = 0; e < 4; ++e) g[e] += u[2 * corners[k] + e / 2] * normals[2 * k + e % 2];
    }
    const double j[4] = {1 + g[0] / area, g[1] / area, g[2] / area, 1 + g[3] / area};
    // The closest rotation turns by the angle of (j₀₀ + j₁₁, j₁₀ − j₀₁); where that vanishes, any rotation is closest.
    const double x = j[0] + j[3], y = j[2] - j[1], length = std::sqrt(x * x + y * y);
    const double cosine = length > 0 ? x / length : 1, sine = length > 0 ? y / length : 0;
    const double r[4] = {cosine, -sine, sine, cosine};
    for (Index e = 0; e < 4; ++e) energy += area * (j[e] - r[e]) * (j[e] - r[e]) / 2;
    for (Index k = 0; k < 3; ++k) {
      forces_(corners[k], 0) += (cosine - 1) * normals[2 * k] - sine * normals[2 * k + 1];
      forces_(corners[k], 1) += sine * normals[2 * k] + (cosine - 1) * normals[2 * k + 1];
    }
  }
  return energy;
}

}  // namespace

Result<std::unique_ptr<HeldDeformation>> as_rigid_as_possible(SimplexMesh mesh, HeldVertices held) {
  return AsRigidAsPossible::create(std::move(mesh), std::move(held));
}

}  // namespace handlebody
