// Distances along the surface, extended to the inside by mean value coordinates (Rustamov, Lipman & Funkhouser 2009; paper 001,
// §4.1 "MVC").
//
// With D the distances between surface vertices and w(p) the coordinates of p,
//
//    d(p, q)² = −½ (w(p) − w(q))ᵀ D² (w(p) − w(q)),      D² entry by entry,
//
// which for vertices is the distance along the surface. D² is as large as the mesh squared, so it is approximated from `landmarks`
// vertices: it has few large eigenvalues, and every vertex gets `coordinates` numbers x with D²ᵢⱼ ≈ Σₖ ±ₖ (xᵢₖ − xⱼₖ)² (landmark
// multidimensional scaling, de Silva & Tenenbaum 2004). Distances along surfaces are not Euclidean, hence the signs; without
// negative ones they would be a third too long. x is extended to the voxels once; a center costs one pass over them.
//
// It measures paths along the surface, not through the inside. Across a limb they are as long as half its girth, and across a thin
// plate as long as the path around its rim. But surfaces that touch without being joined, like a clam's closed lips, stay apart
// however coarse the grid is, which no method on voxels can do.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/errors/result.hpp"
#include "core/mesh/mean_value_coordinates.hpp"
#include "core/mesh/surface_geodesics.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class MeanValueDistance {
 public:
  static constexpr Index most_landmarks = 64, most_coordinates = 32;

  /** Checks the surface, in the domain's units (solver space), which must be closed and of one connected part: vertices at one
   *  position count as one, triangles without three different corners are ignored, and it may face either way. Positions must be
   *  finite and indices in range. The domain must outlive the object.
   *  @errors MESH_OPEN (an edge without a triangle on its other side: the culprit), MESH_NOT_CONNECTED (a triangle of another part
   *          is the culprit), OUT_OF_MEMORY (refused before allocating) */
  static Result<MeanValueDistance> begin(const ConstPoints& positions, const ConstTriangles& triangles, const VoxelDomain& domain);

  /** A bounded part of what all sources share: distances from one landmark, or the coordinates of some hundred voxels. Returns the
   *  part done; at 1 all is ready, and further calls do nothing. */
  double step();

  /** Distances from `source` (anywhere; meant for the surface and inside) to every voxel center, into `distances` (domain.size()),
   *  in the grid's units. All are finite, never below Euclidean ones, and symmetric. Only after step() returned 1; allocates
   *  nothing. */
  void measure(const Vector3& source, double* distances);

 private:
  enum class Phase { landmarks, embed, voxels, ready };

  MeanValueDistance() = default;
  void add_landmark();
  void embed();
  void carry();

  const VoxelDomain* domain_ = nullptr;
  Points positions_;  // welded
  Triangles triangles_;
  Phase phase_ = Phase::landmarks;
  std::optional<SurfaceGeodesics> geodesics_;
  std::vector<std::uint32_t> landmarks_;
  std::vector<double> from_landmark_, coverage_;  // distances of each vertex: from the last landmark, from the nearest
  MatrixF squared_;                               // vertices × landmarks: squared distances
  std::vector<float> signs_;                      // of the coordinates: +1 or −1
  std::unique_ptr<MeanValueField> field_;         // the coordinates on the surface
  MatrixF coordinates_;                           // and at the voxels
  Index next_voxel_ = 0;
  std::vector<float> at_source_;
};

}  // namespace handlebody
