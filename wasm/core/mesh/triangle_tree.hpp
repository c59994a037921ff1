// A bounding volume hierarchy over triangles, for the two questions that the voxel domain asks of a surface: the generalized
// winding number of a point (Jacobson, Kavan & Sorkine-Hornung 2013, by the tree of Barill et al. 2018) and the distance to the
// surface.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

class TriangleTree {
 public:
  /** Copies what it needs. Indices must be in range; zero-area triangles are allowed. `winding`: whether it will be asked for
   * winding numbers; their expansions take more than half of the construction time. */
  TriangleTree(const ConstPoints& positions, const ConstTriangles& triangles, bool winding = true);

  /** Generalized winding number of `point`: about 1 inside a closed, outward-oriented surface, 0 outside, 1/2 on it; for several
   *  parts, the sum. Within 0.01 of the exact value. */
  double winding_number(const Vector3& point) const;

  /** Distance from `point` to the nearest triangle, or `bound` if none is nearer. */
  double distance(const Vector3& point, double bound = std::numeric_limits<double>::infinity()) const;

  /** The number of a triangle that is nearest to `point`. There must be one. */
  std::uint32_t nearest(const Vector3& point) const;

 private:
  struct Triangle {
    Vector3 a, b, c;
    bool flat;                                       // practically no area: it has a distance but no solid angle
    Vector3 centroid3() const { return a + b + c; }  // thrice the centroid
    double distance2(const Vector3& point) const;
  };

  // Depth first: the left child of an inner node follows it, `skip` is the first node after its subtree.
  struct Node {
    std::uint32_t first, count;  // triangles of a leaf; count is 0 in an inner node
    std::uint32_t skip;
  };

  struct Box {
    Vector3 low, high;
    void extend(const Vector3& point);
    double distance2(const Vector3& point) const;
  };

  // Taylor expansion of the subtree's winding number about `center`: three harmonic polynomials of the offset, used beyond
  // `reach2`.
  struct Expansion {
    Vector3 center;
    double reach2;
    Vector3 dipole;
    std::array<double, 6> quadrupole;  // xx yy zz xy xz yz
    std::array<double, 10> octupole;   // xxx yyy zzz xxy xxz yyx yyz zzx zzy xyz
    double operator()(const Vector3& offset, double length2) const;
  };

  void arrange(std::uint32_t* first, std::uint32_t* last) const;

  void build(std::uint32_t first, std::uint32_t last);
  Expansion expand(std::uint32_t first, std::uint32_t last) const;

  std::vector<Triangle> triangles_;     // in the order of the leaves
  std::vector<std::uint32_t> numbers_;  // theirs in the order that they were given in
  std::vector<Node> nodes_;
  std::vector<Box> boxes_;
  std::vector<Expansion> expansions_;  // empty where `winding` is false
  bool winding_;
};

}  // namespace handlebody
