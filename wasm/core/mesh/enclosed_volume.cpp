#include "core/mesh/enclosed_volume.hpp"

#include <Eigen/Geometry>

namespace handlebody {

double enclosed_volume(const ConstPoints& positions, const ConstTriangles& triangles) {
  if (triangles.rows() == 0) return 0;
  const Vector3 origin = positions.row(triangles(0, 0));  // on the surface: another vertex may be far away
  double sum = 0;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const auto corner = [&](Index k) -> Vector3 { return positions.row(triangles(t, k)).transpose() - origin; };
    sum += corner(0).dot(corner(1).cross(corner(2)));
  }
  return sum / 6;
}

}  // namespace handlebody
