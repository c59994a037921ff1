#include "core/irbf/sphere_strain.hpp"

#include <Eigen/Geometry>

#include "core/numerics/closest_rotation.hpp"

namespace handlebody {

Strain strain_of(const Matrix3& gradient) {
  Strain strain;
  strain.turn = closest_rotation(gradient);
  const Matrix3 stretch = strain.turn.transpose() * gradient;
  const Vector3 x = stretch.col(0), y = stretch.col(1), z = stretch.col(2);
  strain.cofactor.col(0) = y.cross(z);
  strain.cofactor.col(1) = z.cross(x);
  strain.cofactor.col(2) = x.cross(y);
  strain.growth = x.dot(strain.cofactor.col(0)) - 1;
  return strain;
}

}  // namespace handlebody
