// Compiled with -O3: see CMakeLists.txt.
#include "core/irbf/rotation_hessian.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace handlebody {

namespace {

/** The fraction of the local/global iteration's own curvature that is added. Rotations that nothing resists (a single handle) have
 * no curvature at all, and the terms with the residual, which are left out here, matter more than the curvature of the longest
 * waves. On the dog, 112 spheres, 200 centers and 400, iterations from rest to 10% and 1% of the least energy: 1e-3: 6, 10 and 3,
 * 5; 1e-2: 5, 8 and 4, 7; 3e-2: 7, 14 and 6, 10. */
constexpr double damping = 1e-2;
/** More spheres than this would take longer to factor than they save. */
constexpr Index most_spheres = 400;

/** exp of a rotation vector, as a matrix. */
Matrix3 exponential(const Vector3& turn) {
  const double half = turn.norm() / 2;
  const double sine = half > 1e-8 ? std::sin(half) / (2 * half) : 0.5;
  return Eigen::Quaterniond(std::cos(half), sine * turn.x(), sine * turn.y(), sine * turn.z()).normalized().toRotationMatrix();
}

}  // namespace

RotationHessian::RotationHessian(const Points& edges, const MatrixXd& hat, SphereFit fit)
    : freedoms_(fit == SphereFit::similarity ? 4 : 3) {
  const Index spheres = edges.rows() / 3;
  if (spheres > most_spheres) return;
  MatrixXd hessian = MatrixXd::Zero(freedoms_ * spheres, freedoms_ * spheres);
  gradient_.resize(hessian.rows());
  for (Index b = 0; b < spheres; ++b) {
    for (Index a = b; a < spheres; ++a) {
      // Σ k JₑᵀJ_f, where a turn ω and a scale's logarithm σ move an edge by Jₑ (ω, σ) = ω × e + σ e. Element by element, which
      // compiles to half the bytes of Eigen's blocks.
      double* const block = &hessian(freedoms_ * a, freedoms_ * b);
      for (Index i = 3 * a; i < 3 * a + 3; ++i) {
        for (Index j = 3 * b; j < 3 * b + 3; ++j) {
          const double k = (i == j ? 1 + damping : 0) - hat(i, j);
          const Vector3 e = edges.row(i), f = edges.row(j);
          const double along = e.dot(f);
          for (Index column = 0; column < 3; ++column) {
            double* const to = block + column * hessian.rows();
            for (Index row = 0; row < 3; ++row) to[row] += k * ((row == column ? along : 0) - f[row] * e[column]);  // [e]×ᵀ [f]×
          }
          if (freedoms_ == 3) continue;
          const Vector3 across = e.cross(f);
          double* const last = block + 3 * hessian.rows();
          for (Index axis = 0; axis < 3; ++axis) {
            last[axis] += k * across[axis];
            block[axis * hessian.rows() + 3] -= k * across[axis];
          }
          last[3] += k * along;
        }
      }
    }
  }
  factor_.emplace(std::move(hessian));
  if (!factor_->succeeded()) factor_.reset();
}

void RotationHessian::step(const Points& edges, const Columns3& residual, const std::vector<Matrix3>& maps,
                           std::vector<Matrix3>& stepped) {
  for (Index b = 0; b < std::ssize(maps); ++b) {
    const Matrix3& map = maps[b];
    Vector3 torque = Vector3::Zero();
    double growth = 0;
    for (Index i = 3 * b; i < 3 * b + 3; ++i) {
      const Vector3 edge = edges.row(i), pull = map.transpose() * residual.row(i).transpose();
      torque += edge.cross(pull);
      growth += edge.dot(pull);
    }
    gradient_.segment<3>(freedoms_ * b) = torque;
    if (freedoms_ == 4) gradient_[4 * b + 3] = growth;
  }
  factor_->solve_in_place(gradient_);
  for (Index b = 0; b < std::ssize(maps); ++b) {
    stepped[b] = maps[b] * exponential(-gradient_.segment<3>(freedoms_ * b));
    if (freedoms_ == 4) stepped[b] *= std::exp(-std::clamp(gradient_[4 * b + 3], -1.0, 1.0));
  }
}

}  // namespace handlebody
