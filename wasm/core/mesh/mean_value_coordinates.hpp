// Mean value coordinates of closed triangle meshes (Floater, Kós & Reimers 2005; Ju, Schaefer & Warren 2005): a function on the
// surface is extended to the inside as its mean over all directions of view, where near surfaces count more (1/r).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

/** The share of one triangle in the coordinates of a point: weights of its corners, not yet divided by the sum over all triangles.
 *  Positive where the triangle shows the point its inner side, negative where its outer side, none where it is seen edge-on. */
struct TriangleShare {
  std::array<double, 3> weights{};
  int side = 0;           // +1 inner, −1 outer, 0 edge-on
  bool contains = false;  // the point lies on the triangle, an edge or a corner: `weights` are barycentric, and all there is
};

TriangleShare triangle_share(const Vector3& point, const Vector3& a, const Vector3& b, const Vector3& c);

/** Coordinates of a point with respect to every vertex of a closed mesh; they sum to 1. With all triangles they reproduce linear
 *  functions, but on shapes that are not convex some are negative, and near a surface that faces another across a thin gap they
 *  grow without bound. With `one_side` only triangles that show the point their inner side count (their outer side, for a point
 *  outside the mesh): coordinates are then never negative, still continuous, and the same on a convex mesh. */
Vector mean_value_coordinates(const ConstPoints& positions, const ConstTriangles& triangles, const Vector3& point, bool one_side);

/** Functions on a closed surface, extended to many points by one-sided coordinates. Distant triangles are treated in groups, each
 *  as one, on the side that the sum of their area vectors shows. Inside off by about 0.05% of the range of the values, 0.5% at
 * most; far outside, where whole bodies are one group that shows neither side, anything within the range. */
class MeanValueField {
 public:
  /** `values` has one row per vertex. Copies what it needs; about 8 + (columns + 16)/2 floats per triangle on top of the mesh and
   * values. */
  MeanValueField(const ConstPoints& positions, const ConstTriangles& triangles, const MatrixF& values);

  Index columns() const { return values_.cols(); }

  /** The functions at `point` (columns() numbers), which may lie anywhere. Not from two threads at once. */
  void evaluate(const Vector3& point, float* out);

 private:
  // Depth first: the left child of an inner node follows it, `skip` is the first node after its subtree.
  struct Node {
    Vector3 center;              // of area
    double radius;               // of a ball around it that contains the triangles
    Vector3 area;                // vector area, Σ n A
    std::uint32_t first, count;  // triangles of a leaf; count is 0 in an inner node
    std::uint32_t skip;
  };

  void build(std::uint32_t* first, std::uint32_t* last);
  Node summarize(const std::uint32_t* first, const std::uint32_t* last, float* moments) const;
  double gather(const Vector3& point, int side, double& other, bool& on_surface);
  Vector3 corner(std::uint32_t triangle, int k) const { return positions_.row(triangles_(triangle, k)).transpose(); }

  Points positions_;
  Triangles triangles_;
  MatrixF values_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  // of the triangles, in the leaves
  std::vector<float> moments_;        // of each node: Σ A n f of every function, three rows of columns()
  std::vector<float> sums_;
  std::vector<float> low_, high_;  // of each function: coordinates are never negative, so that what they carry lies between
};

}  // namespace handlebody
