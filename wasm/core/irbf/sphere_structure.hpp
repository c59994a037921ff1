// The points by which a sphere, or an ellipsoid, feels how it is deformed (paper 001, §2.3, §2.4 and Fig. 7).
#pragma once

#include <array>
#include <vector>

#include "core/irbf/sphere_packing.hpp"

namespace handlebody {

/** The paper's six points on three perpendicular axes, or twelve spread evenly over the sphere about its center. Six feel what is
 *  linear about the center only: all that they can say is in their three edges. An ellipsoid has 32 in any case, the twelve and the
 *  twenty between them: it is to keep its whole length straight, as a bone does. */
enum class SphereStructure : unsigned { octahedron = 0, icosahedron = 1 };
constexpr unsigned sphere_structure_count = 2;

/** Points of the minimal structure of a sphere (Fig. 7a): the ends of three perpendicular edges, −x +x −y +y −z +z. */
inline Vector3 structure_point(const Vector3& center, double radius, Index i) {
  Vector3 point = center;
  point(i / 2) += i % 2 == 0 ? -radius : radius;
  return point;
}

/** Half the axes of a sphere or an ellipsoid, as columns; of an ellipsoid, the long one comes first. */
Matrix3 half_axes(const Sphere& sphere);

/** Edges between points of a structure. */
struct StructureEdges {
  struct Edge {
    std::size_t from, to;  // of the points
    double scale;          // of their difference: 2 for one from the center, which is then as long as a diameter
  };
  std::vector<Vector3> points;
  std::vector<Edge> edges;
  double share;  // of the weight of a sphere as thick: three edges' worth, however many there are, for each thickness of its length
};

StructureEdges structure_edges(const Sphere& sphere, SphereStructure structure);

}  // namespace handlebody
