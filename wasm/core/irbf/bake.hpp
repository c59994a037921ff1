// Baking: from a surface, a point cloud or a volume to a Body, in bounded steps so that any thread can show progress and stop.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/distance/interior_distance.hpp"
#include "core/distance/interior_samples.hpp"
#include "core/distance/merged_limbs.hpp"
#include "core/distance/surface_crossings.hpp"
#include "core/irbf/body.hpp"
#include "core/mesh/consistent_orientation.hpp"
#include "core/mesh/triangle_tree.hpp"
#include "core/mesh/weld.hpp"

namespace handlebody {

enum class SpherePacking : unsigned { skeleton = 0, tree = 1 };
constexpr unsigned sphere_packing_count = 2;

struct BakeOptions {
  Index centers = 200;
  int resolution = 96;  // voxels along the longest side of the box
  DistanceMethod method = DistanceMethod::fast_marching;
  int max_spheres = 120;
  SpherePacking packing = SpherePacking::skeleton;
  std::vector<double> density;  // of centers, relative to 1, one a vertex; empty for 1 throughout
  bool cloud = false;           // no triangles: the positions are a dense sample of a surface or solid
  std::optional<Grid> grid;     // with `voxels`: the domain, in model units, instead of one found from the surface
  std::vector<std::uint32_t> voxels;
};

/** Something to tell the user about a bake that worked. What it means stands with the codes; `count` things (triangles, links,
 *  vertices), of which the worst is at `place` (model units) and is vertex `vertex`, if it is one. */
struct BakeWarning {
  hb_warning_code code;
  Index count = 0;
  double value =
      0;  // LIMBS_MERGED: a resolution that would do, 0 where none up to 512 does. PART_OUTSIDE: how far out, model units
  std::optional<Vector3> place = std::nullopt;
  Index vertex = -1;
};

class Bake {
 public:
  static constexpr int highest_resolution = 512;

  /** Checks the input and the options; fails with MESH_* codes, INVALID_SHAPE or INVALID_OPTION.
   *
   *  What lies inside: the voxels whose centers a closed surface winds about, whichever way. Where triangles are not closed as they
   *  are, those that share edges are first turned to agree (orient_consistently). A surface that is then still open winds about a
   *  point at least half. Where it hardly winds more about any, what the triangles enclose as a shell of voxels (filled_shell), as
   * for a point cloud. An open sheet encloses nothing: it bakes with Euclidean distances only, over the voxels that it passes
   * through.
   */
  static Result<Bake> begin(const ConstPoints& positions, const ConstTriangles& triangles, BakeOptions options);

  Bake(Bake&&) noexcept;
  ~Bake();

  /** A bounded piece of work: some triangles, a slab of voxels, a center. Returns the part done, 1 when finished. Fails with
   *  MESH_NO_INTERIOR, CLOUD_TOO_SPARSE, OUT_OF_MEMORY or, with mean value distances, MESH_OPEN or MESH_NOT_CONNECTED; the bake is
   * over then. */
  Result<double> step();

  bool finished() const { return phase_ == Phase::finished; }

  /** The result of a finished bake. */
  const Body& body() const { return body_; }
  const std::vector<BakeWarning>& warnings() const { return warnings_; }

 private:
  enum class Phase { orient, cross, voxelize, fill, domain, link, depth, spheres, prepare, stencils, centers, quantize, finished };

  // Movable only before the first step: distances keep the address of the body's domain.
  Bake();
  void orient();
  bool cross_triangles(int axis);
  void voxelize_slab();
  Result<Done> fill();
  Result<Done> make_domain();
  void link_axis();
  void measure_depth();
  Result<Done> pack();
  void sample_vertices();
  void add_center();
  void quantize();
  double progress() const;
  bool surface() const { return !options_.cloud && !options_.grid; }

  BakeOptions options_;
  Body body_;
  std::vector<BakeWarning> warnings_;
  Points solver_positions_;  // of the welded vertices
  Triangles triangles_;      // welded, turned to agree
  Weld weld_;
  Orientation orientation_{};
  std::optional<TriangleTree> tree_;
  Grid grid_;

  Phase phase_ = Phase::orient;
  Index next_ = 0;                    // triangle, slab or center of the phase
  int axis_ = 0, crossed_axis_ = -1;  // of the phase; of the crossings that are complete
  std::optional<SurfaceCrossings> crossings_;
  bool uncounted_ = false;  // too many crossings to keep
  std::vector<std::uint32_t> inside_, crossed_;
  std::size_t sure_ = 0;  // voxels that the surface winds about by more than three quarters
  std::vector<CrossedLink> links_;
  std::vector<std::uint8_t> on_bridge_;
  std::vector<double> depth_;  // distance of each voxel from the surface
  bool sheet_ = false;
  InteriorSamples samples_;  // of the welded vertices
  std::unique_ptr<InteriorDistance> distance_;
  double prepared_ = 0;
  std::vector<double> field_, ratios_;
  std::vector<double> scales_;    // of each center's codes, before they share one
  std::vector<double> coverage_;  // interior distance of each welded vertex from the nearest center so far
  std::vector<double> weight_;    // of coverage, from the density
  std::vector<Index> waiting_;    // vertices that the new center may be nearer to
  Index next_center_ = 0;
  Index outside_ = 0, farthest_outside_ = -1;
  double how_far_outside_ = 0;
};

}  // namespace handlebody
