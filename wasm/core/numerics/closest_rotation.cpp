// Compiled with -O3: see CMakeLists.txt.
#include "core/numerics/closest_rotation.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/numerics/orthogonal_columns.hpp"

namespace handlebody {

/** With H = Σ σᵢ uᵢ vᵢᵀ, σ descending, R takes v₁ to u₁, v₂ to u₂ and v₁ × v₂ to u₁ × u₂. That is a rotation by construction: where
 *  H reflects, it gives up the third direction. */

Matrix3 closest_rotation(const Matrix3& covariance) {
  const double size = covariance.cwiseAbs().maxCoeff();
  if (!(size > 0)) return Matrix3::Identity();
  const auto [columns, v] = orthogonal_columns(covariance / size);
  const Vector3 u1 = columns.col(0).normalized();
  Vector3 u2 = columns.col(1) - u1.dot(columns.col(1)) * u1;
  const double second = u2.norm();
  u2 = second > 1e-150 ? Vector3(u2 / second) : u1.unitOrthogonal();
  const Vector3 v1 = v.col(0), v2 = v.col(1);
  return u1 * v1.transpose() + u2 * v2.transpose() + u1.cross(u2) * v1.cross(v2).transpose();
}

RigidMotion closest_rigid_motion(const ConstPoints& source, const ConstPoints& target) {
  RigidMotion motion;
  for (Index i = 0; i < source.rows(); ++i) {
    motion.from += source.row(i).transpose();
    motion.to += target.row(i).transpose();
  }
  motion.from /= static_cast<double>(source.rows());
  motion.to /= static_cast<double>(source.rows());
  Matrix3 covariance = Matrix3::Zero();
  double spread = 0;
  for (Index i = 0; i < source.rows(); ++i) {
    const Vector3 from = source.row(i).transpose() - motion.from, to = target.row(i).transpose() - motion.to;
    covariance += to * from.transpose();
    spread += from.squaredNorm();
  }
  // A small multiple of the identity decides what the data leave open; where they leave nothing open, it is lost in rounding.
  const double bias = 1e-9 * spread;
  motion.rotation = bias > 0 ? closest_rotation(covariance + bias * Matrix3::Identity()) : Matrix3::Identity();
  return motion;
}

}  // namespace handlebody
