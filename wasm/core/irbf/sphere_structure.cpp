#include "core/irbf/sphere_structure.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace handlebody {
namespace {

/** cos and sin of 2πk/5. */
constexpr std::array<std::array<double, 2>, 5> fifths{{{1, 0},
                                                       {0.30901699437494745, 0.9510565162951535},
                                                       {-0.8090169943749475, 0.5877852522924731},
                                                       {-0.8090169943749475, -0.5877852522924731},
                                                       {0.30901699437494745, -0.9510565162951535}}};

/** Points about the center, evenly spread over the ellipsoid of these half axes, in pairs; the center comes last. */
class Around {
 public:
  Around(const Vector3& center, const Matrix3& axes) : center_(center), axes_(axes) {}

  void ends() {
    for (const double side : {1.0, -1.0}) made_.points.push_back(center_ + side * axes_.col(0));
  }

  /** Five points at a height along the first axis, and those opposite; `turn` 1, or −1 for the fifths between. */
  void ring(double height, double turn) {
    const double around = turn * std::sqrt(1 - height * height);
    for (const double side : {1.0, -1.0})
      for (const auto& [c, s] : fifths)
        made_.points.push_back(center_ + side * (height * axes_.col(0) + around * (c * axes_.col(1) + s * axes_.col(2))));
  }

  StructureEdges joined_to_center() {
    const std::size_t middle = made_.points.size();
    made_.points.push_back(center_);
    for (std::size_t i = 0; i < middle; ++i) made_.edges.push_back({middle, i, 2});
    made_.share = 3.0 / static_cast<double>(middle);
    return made_;
  }

 private:
  const Vector3& center_;
  const Matrix3& axes_;
  StructureEdges made_;
};

}  // namespace

Matrix3 half_axes(const Sphere& sphere) {
  if (!is_long(sphere)) return sphere.radius * Matrix3::Identity();
  Matrix3 axes;
  axes.col(0) = sphere.axis;
  axes.col(1) = sphere.radius * sphere.axis.unitOrthogonal();
  axes.col(2) = sphere.radius * sphere.axis.normalized().cross(axes.col(1)).normalized();
  return axes;
}

StructureEdges structure_edges(const Sphere& sphere, SphereStructure structure) {
  const bool long_one = is_long(sphere);
  if (!long_one && structure == SphereStructure::octahedron) {
    StructureEdges made;
    for (Index i = 0; i < 6; ++i) made.points.push_back(structure_point(sphere.center, sphere.radius, i));
    made.edges = {{0, 1, 1}, {2, 3, 1}, {4, 5, 1}};
    made.share = 1;
    return made;
  }
  const Matrix3 axes = half_axes(sphere);
  Around around(sphere.center, axes);
  around.ends();
  around.ring(std::sqrt(0.2), 1);
  if (long_one) {
    // The vertices of a dodecahedron, over the faces of the icosahedron.
    around.ring(0.7946544722917661, -1);
    around.ring(0.1875924740850799, -1);
  }
  StructureEdges made = around.joined_to_center();
  made.share *= long_one ? axes.col(0).norm() / sphere.radius : 1;
  return made;
}

}  // namespace handlebody
