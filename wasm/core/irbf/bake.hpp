// Baking: from a triangle mesh to a Body, in bounded steps so that any thread can show progress and stop.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/distance/fast_marching.hpp"
#include "core/distance/interior_samples.hpp"
#include "core/irbf/body.hpp"
#include "core/mesh/triangle_tree.hpp"
#include "core/mesh/weld.hpp"

namespace handlebody {

enum class DistanceMethod : unsigned {
  fast_marching = 0,
  euclidean = 1,  // paper 001, §4.1: for convex shapes, and to see what interior distances buy
};

struct BakeOptions {
  Index centers = 200;
  int resolution = 96;  // voxels along the longest side of the box
  DistanceMethod method = DistanceMethod::fast_marching;
  int max_spheres = 120;
};

class Bake {
 public:
  /** Checks the mesh and the options; fails with MESH_* codes or INVALID_OPTION. */
  static Result<Bake> begin(const ConstPoints& positions, const ConstTriangles& triangles, const BakeOptions& options);

  /** One slab of voxels, one center or one of the short phases between. Returns the part done, 1 when finished.
   *  Fails with MESH_NO_INTERIOR or OUT_OF_MEMORY; the bake is over then. */
  Result<double> step();

  bool finished() const { return phase_ == Phase::finished; }

  /** The result of a finished bake. */
  const Body& body() const { return body_; }

 private:
  enum class Phase { voxelize, domain, surface_distance, spheres, stencils, centers, quantize, finished };

  // Movable only before the first step: fast marching keeps the address of the body's domain.
  Bake() = default;
  Result<Done> voxelize_slab();
  Result<Done> make_domain();
  void measure_surface_distances();
  void pack();
  void sample_vertices();
  void add_center();
  void quantize();
  double progress() const;

  BakeOptions options_;
  Body body_;
  Points solver_positions_;
  Weld weld_;
  std::optional<TriangleTree> tree_;
  Grid grid_;

  Phase phase_ = Phase::voxelize;
  int slab_ = 0;
  std::vector<std::uint32_t> inside_;
  std::vector<std::uint8_t> on_bridge_;
  std::vector<double> surface_distance_;
  InteriorSamples samples_;  // of the welded vertices
  std::optional<FastMarching> marching_;
  std::vector<double> field_, ratios_;
  std::vector<float> fields_;     // centers × voxels
  std::vector<double> coverage_;  // interior distance of each welded vertex from the nearest center so far
  Index next_center_ = 0;
};

}  // namespace handlebody
