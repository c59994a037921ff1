// Baking: from a surface, a point cloud or a volume to a Body, in bounded steps so that any thread can show progress and stop.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/distance/interior_distance.hpp"
#include "core/irbf/bake_warning.hpp"
#include "core/irbf/body.hpp"
#include "core/irbf/bones.hpp"
#include "core/irbf/center_sampling.hpp"
#include "core/irbf/counted_mesh.hpp"
#include "core/irbf/interior_search.hpp"

namespace handlebody {

/** Spheres along a curve skeleton and beside it, from an octree, or greedily along the medial axis. */
enum class SpherePacking : unsigned { skeleton = 0, tree = 1, medial = 2 };
constexpr unsigned sphere_packing_count = 3;

struct BakeOptions {
  Index centers = 0;   // 0: chosen, see automatic_centers in bake.cpp
  int resolution = 0;  // voxels along the longest side of the box; 0: chosen, see interior_search.hpp
  BakeQuality quality = BakeQuality::normal;
  DistanceMethod method = DistanceMethod::fast_marching;
  int max_spheres = 0;  // 0: chosen
  SpherePacking packing = SpherePacking::skeleton;
  double overlap = 0;              // of two spheres, in parts of the smaller radius
  double smallest_radius = 0;      // of spheres, in diagonals; 0: chosen by the voxels
  int tree_level = 0;              // of the octree, from 1, its whole; 0: the deepest whose spheres are no more than allowed
  bool straight_bones = false;     // ellipsoids where limbs are straight
  std::vector<Bone> bones;         // ellipsoids between these places, model units
  std::vector<double> density;     // of centers, relative to 1, one per vertex; empty for 1 throughout
  std::vector<std::uint8_t> used;  // one per vertex, not 0 for those of a solid: empty for those that triangles use
  bool cloud = false;              // no triangles: the positions are a dense sample of a surface or solid
  std::optional<Grid> grid;        // with `voxels`: the domain, in model units, instead of one found from the surface
  Indices voxels;
};

class Bake {
 public:
  static constexpr int highest_resolution = InteriorVoxels::highest_resolution;

  /** Checks the input and the options; fails with MESH_* codes, INVALID_SHAPE or INVALID_OPTION. What counts as inside is told in
   *  interior_voxels.hpp; an open sheet, which has no inside, bakes with Euclidean distances only. */
  static Result<std::unique_ptr<Bake>> begin(const ConstPoints& positions, const ConstTriangles& triangles, BakeOptions options);

  ~Bake();

  /** A bounded piece of work: some triangles, a slab of voxels, a center. Returns the part done, 1 when finished. Fails with
   *  MESH_NO_INTERIOR, CLOUD_TOO_SPARSE, OUT_OF_MEMORY, INVALID_OPTION (a bone that is not inside) or, with mean value distances,
   * MESH_OPEN or MESH_NOT_CONNECTED; the bake is over then. */
  Result<double> step();

  bool finished() const { return phase_ == Phase::finished; }

  /** The result of a finished bake. */
  const Body& body() const { return body_; }
  const std::vector<BakeWarning>& warnings() const { return warnings_; }

 private:
  enum class Phase { interior, depth, spheres, distance, prepare, centers, finished };

  Bake();
  void enter(Phase phase);
  void take_interior();
  void measure_depth();
  Result<Done> pack();
  Result<Done> put_bones();
  void begin_sampling();
  void take_centers();
  Result<Done> measure();
  double progress() const;

  BakeOptions options_;
  Body body_;
  std::vector<BakeWarning> warnings_;
  CountedMesh mesh_;         // its triangles are turned to agree
  Points solver_positions_;  // of its places
  Index most_centers_ = 0;   // spread evenly, and for the sake of spheres

  Phase phase_ = Phase::interior;
  double part_ = 0;  // the fraction of the phase that is done
  std::unique_ptr<InteriorSearch> interior_;
  std::vector<double> depth_;  // distance of each voxel from the surface
  std::unique_ptr<InteriorDistance> distance_;
  std::unique_ptr<CenterSampling> sampling_;
};

}  // namespace handlebody
