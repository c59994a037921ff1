#include "core/numerics/closest_rotation.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace handlebody {

Matrix3 closest_rotation(const Matrix3& covariance) {
  const Eigen::JacobiSVD<Matrix3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 u = svd.matrixU();
  // The reflection is cheapest along the smallest singular value, which Eigen puts last.
  if (u.determinant() * svd.matrixV().determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

RigidMotion closest_rigid_motion(const ConstPoints& source, const ConstPoints& target) {
  RigidMotion motion;
  motion.from = source.colwise().mean();
  motion.to = target.colwise().mean();
  const Points from = source.rowwise() - motion.from.transpose();
  const Points to = target.rowwise() - motion.to.transpose();
  const Matrix3 covariance = to.transpose() * from;
  // A trace of the identity decides what the data leave open and is lost in rounding where they do not.
  const double bias = 1e-9 * from.squaredNorm();
  motion.rotation = bias > 0 ? closest_rotation(covariance + bias * Matrix3::Identity()) : Matrix3::Identity();
  return motion;
}

}  // namespace handlebody
