// Compiled with -O3: see CMakeLists.txt.
#include "core/irbf/rotation_hessian.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/products.hpp"

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

RotationHessian::RotationHessian(const Points& edges, const MatrixXd& hat, SphereFit fit, double volume)
    : freedoms_(fit == SphereFit::similarity ? 4 : 3), volume_(volume) {
  const Index spheres = edges.rows() / 3;
  if (spheres > most_spheres) return;
  turned_.assign(spheres, Matrix3::Identity());
  gradient_.resize(freedoms_ * spheres);
  Columns3 rest(edges.rows(), 3);
  rest = edges;
  factor(rest, hat, nullptr);
}

bool RotationHessian::renew(const Columns3& mapped, const MatrixXd& hat, const Columns3& residual,
                            const std::vector<Matrix3>& turns) {
  if (freedoms_ != 3 || !(factor(mapped, hat, &residual) || factor(mapped, hat, nullptr))) return false;
  turned_ = turns;
  return true;
}

bool RotationHessian::factor(const Columns3& edges, const MatrixXd& hat, const Columns3* residual) {
  const Index spheres = edges.rows() / 3;
  // A fourth number of each sphere comes after the turns of all.
  const Index turns = 3 * spheres, all = freedoms_ == 4 || volume_ > 0 ? turns + spheres : turns;
  MatrixXd hessian = MatrixXd::Zero(all, all);
  for (Index b = 0; b < spheres; ++b) {
    for (Index a = b; a < spheres; ++a) {
      // Σ k JₑᵀJ_f, where a turn ω and a scale's logarithm (or a pressure) σ move an edge by Jₑ (ω, σ) = ω × e + σ e. Element by
      // element, which compiles to half the bytes of Eigen's blocks.
      for (Index i = 3 * a; i < 3 * a + 3; ++i) {
        for (Index j = 3 * b; j < 3 * b + 3; ++j) {
          const double k = (i == j ? 1 + damping : 0) - hat(i, j);
          const Vector3 e = edges.row(i), f = edges.row(j);
          const double along = e.dot(f);
          for (Index column = 0; column < 3; ++column) {
            for (Index row = 0; row < 3; ++row)  // [e]×ᵀ [f]×
              hessian(3 * a + row, 3 * b + column) += k * ((row == column ? along : 0) - f[row] * e[column]);
          }
          if (all == turns) continue;
          const Vector3 across = e.cross(f);
          for (Index axis = 0; axis < 3; ++axis) {
            hessian(turns + a, 3 * b + axis) -= k * across[axis];
            if (a != b) hessian(turns + b, 3 * a + axis) += k * across[axis];
          }
          hessian(turns + a, turns + b) += (volume_ > 0 ? (i == j ? 1 / (3 * volume_) : 0) + hat(i, j) : k) * along;
        }
      }
    }
  }
  if (residual) {
    // A turn's second derivative moves an edge by ω × (ω × e), against the residual.
    for (Index i = 0; i < edges.rows(); ++i) {
      const Vector3 e = edges.row(i), r = residual->row(i);
      const double along = e.dot(r);
      for (Index column = 0; column < 3; ++column)
        for (Index row = 0; row < 3; ++row)
          hessian(i / 3 * 3 + row, i / 3 * 3 + column) +=
              (r[row] * e[column] + e[row] * r[column]) / 2 - (row == column ? along : 0);
    }
  }
  std::optional<Cholesky> pressures;
  MatrixXd coupling;
  if (volume_ > 0) {
    pressures.emplace(hessian.bottomRightCorner(spheres, spheres));
    if (!pressures->succeeded()) return false;
    coupling = hessian.bottomLeftCorner(spheres, turns);
    MatrixXd solved = coupling;
    pressures->solve_in_place(solved);
    hessian = MatrixXd(hessian.topLeftCorner(turns, turns)) + transposed_product(coupling, solved);
  }
  Cholesky turning(std::move(hessian));
  if (!turning.succeeded()) return false;
  factor_ = std::move(turning);
  if (volume_ > 0) {
    pressure_factor_ = std::move(pressures);
    coupling_ = std::move(coupling);
    transposed_ = coupling_.transpose();
    pulled_.resize(spheres);
    torques_.resize(turns);
  }
  return true;
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
    gradient_.segment<3>(3 * b) = turned_[b] * torque;
    if (freedoms_ == 4) gradient_[3 * std::ssize(maps) + b] = growth;
  }
  factor_->solve_in_place(gradient_);
  for (Index b = 0; b < std::ssize(maps); ++b) {
    stepped[b] = maps[b] * exponential(-(turned_[b].transpose() * gradient_.segment<3>(3 * b)));
    if (freedoms_ == 4) stepped[b] *= std::exp(-std::clamp(gradient_[3 * std::ssize(maps) + b], -1.0, 1.0));
  }
}

void RotationHessian::step(const Columns3& mapped, const Columns3& residual, const std::vector<Matrix3>& turns, Vector& pressure,
                           std::vector<Matrix3>& stepped) {
  for (Index b = 0; b < std::ssize(turns); ++b) {
    Vector3 torque = Vector3::Zero();
    for (Index i = 3 * b; i < 3 * b + 3; ++i) torque += mapped.row(i).cross(residual.row(i)).transpose();
    gradient_.segment<3>(3 * b) = turned_[b] * (turns[b].transpose() * torque);
  }
  pulled_ = pressure;
  pressure_factor_->solve_in_place(pulled_);
  multiply(transposed_, pulled_, torques_);
  gradient_ += torques_;
  factor_->solve_in_place(gradient_);
  multiply(coupling_, gradient_, pulled_);
  pressure -= pulled_;
  pressure_factor_->solve_in_place(pressure);
  for (Index b = 0; b < std::ssize(turns); ++b)
    stepped[b] = turns[b] * exponential(-(turned_[b].transpose() * gradient_.segment<3>(3 * b)));
}

}  // namespace handlebody
