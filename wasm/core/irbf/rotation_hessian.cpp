// Compiled with -O3: see CMakeLists.txt.
#include "core/irbf/rotation_hessian.hpp"

#include <Eigen/Geometry>
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

RotationHessian::RotationHessian(const Points& edges, const MatrixXd& hat) {
  const Index spheres = edges.rows() / 3;
  if (spheres > most_spheres) return;
  MatrixXd hessian = MatrixXd::Zero(edges.rows(), edges.rows());
  gradient_.resize(edges.rows());
  for (Index b = 0; b < spheres; ++b) {
    for (Index a = b; a < spheres; ++a) {
      Matrix3 block = Matrix3::Zero();  // Σ k [e]×ᵀ [f]× = Σ k ((e·f) I − f eᵀ)
      for (Index i = 3 * a; i < 3 * a + 3; ++i) {
        for (Index j = 3 * b; j < 3 * b + 3; ++j) {
          const double k = (i == j ? 1 + damping : 0) - hat(i, j);
          const Vector3 e = edges.row(i), f = edges.row(j);
          block += k * (e.dot(f) * Matrix3::Identity() - f * e.transpose());
        }
      }
      hessian.block<3, 3>(3 * a, 3 * b) = block;
    }
  }
  factor_.emplace(std::move(hessian));
  if (!factor_->succeeded()) factor_.reset();
}

void RotationHessian::step(const Points& edges, const Columns3& residual, const std::vector<Matrix3>& rotations,
                           std::vector<Matrix3>& turned) {
  for (Index b = 0; b < std::ssize(rotations); ++b) {
    const Matrix3& rotation = rotations[b];
    Vector3 torque = Vector3::Zero();
    for (Index i = 3 * b; i < 3 * b + 3; ++i)
      torque += Vector3(edges.row(i)).cross(Vector3(rotation.transpose() * residual.row(i).transpose()));
    gradient_.segment<3>(3 * b) = torque;
  }
  factor_->solve_in_place(gradient_);
  for (std::size_t b = 0; b < rotations.size(); ++b)
    turned[b] = rotations[b] * exponential(-gradient_.segment<3>(3 * static_cast<Index>(b)));
}

}  // namespace handlebody
