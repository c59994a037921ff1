#include "core/mesh/vertex_normals.hpp"

#include <Eigen/Geometry>

namespace handlebody {

void vertex_normals(const PointsF& positions, const Triangles& triangles, PointsF& normals) {
  normals.setZero();
  for (Index t = 0; t < triangles.rows(); ++t) {
    const auto a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
    const Eigen::RowVector3f origin = positions.row(a);
    const Eigen::RowVector3f normal = (positions.row(b) - origin).cross(positions.row(c) - origin);
    normals.row(a) += normal;
    normals.row(b) += normal;
    normals.row(c) += normal;
  }
  for (Index v = 0; v < normals.rows(); ++v) {
    const float length = normals.row(v).norm();
    if (length > 0) {
      normals.row(v) /= length;
    } else {
      normals.row(v) << 0, 1, 0;
    }
  }
}

}  // namespace handlebody
