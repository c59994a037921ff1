// The first part of a bake: which voxels of a grid lie inside a model, and whether limbs merge there. In bounded steps.
//
// Inside are the voxels around whose centers a closed surface winds, in either direction. Where the triangles as given are not
// closed, those that share edges are first turned to agree (orient_consistently). A surface that is then still open has a winding
// number of a half or more inside. Where hardly any is much more, the inside is what the triangles enclose as a shell of voxels
// (filled_shell), as for a point cloud. An open sheet encloses nothing: its own voxels are taken where that is allowed.
#pragma once

#include <optional>
#include <vector>

#include "core/distance/merged_limbs.hpp"
#include "core/distance/surface_crossings.hpp"
#include "core/distance/voxel_domain.hpp"
#include "core/errors/result.hpp"
#include "core/irbf/bake_warning.hpp"
#include "core/mesh/consistent_orientation.hpp"
#include "core/mesh/triangle_tree.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {

/** Where the inside comes from. */
enum class InteriorSource : unsigned { surface, cloud, voxels };

struct InteriorOptions {
  InteriorSource source = InteriorSource::surface;
  Indices voxels;            // of the source `voxels`: linear indices into the grid, ascending
  bool allow_sheet = false;  // take an open sheet's own voxels, instead of failing
  int resolution = 0;        // of the grid, for messages
  Index centers = 0;         // codes to keep per voxel: too many are refused
  Index flat = 0;            // the last so many triangles have no area: distances to the surface leave them out
};

class InteriorVoxels {
 public:
  static constexpr int highest_resolution = 512;

  /** `positions` (n×3) and `triangles` of a welded mesh, in the grid's space, both to outlive this; the points of a cloud are
   * triangles without extent. Turns triangles to agree with their neighbors. */
  InteriorVoxels(const Points& positions, Triangles& triangles, const Grid& grid, InteriorOptions options);

  /** A bounded piece of work: some triangles, a slab of voxels, an axis. Returns the part done, 1 when finished. Fails with
   *  MESH_NO_INTERIOR, CLOUD_TOO_SPARSE or OUT_OF_MEMORY; it is over then. */
  Result<double> step();

  // ---- once finished -----------------------------------------------------------------------------------------------------------

  /** The voxels inside, connected by bridges where they were not. To be moved from. */
  VoxelDomain& domain() { return domain_; }

  /** Whether the voxels are those of a sheet, which has no inside. */
  bool sheet() const { return sheet_; }

  /** 1 for the voxels of the domain that make a bridge, outside the surface. */
  const std::vector<std::uint8_t>& on_bridge() const { return on_bridge_; }

  /** Distances to the surface. */
  const TriangleTree& tree() const { return *tree_; }

  /** Places are in the grid's space. */
  const std::vector<BakeWarning>& warnings() const { return warnings_; }

 private:
  enum class Phase { orient, cross, voxelize, fill, domain, link, finished };

  void orient();
  bool cross_triangles(int axis);
  void voxelize_slab();
  Result<Done> fill();
  Result<Done> make_domain();
  void warn_of_few(Index voxels);
  Index count_inward() const;
  void link_axis();
  double progress() const;
  bool surface() const { return options_.source == InteriorSource::surface; }

  const Points& positions_;
  Triangles& triangles_;
  Grid grid_;
  InteriorOptions options_;

  Phase phase_ = Phase::orient;
  Index next_ = 0;                    // triangle or slab of the phase
  int axis_ = 0, crossed_axis_ = -1;  // of the phase; of the crossings that are complete
  Orientation orientation_{};
  std::optional<TriangleTree> tree_;
  std::optional<SurfaceCrossings> crossings_;
  bool uncounted_ = false;  // too many crossings to keep
  Indices inside_, crossed_;
  std::size_t sure_ = 0;  // voxels that the surface winds about by more than three quarters
  std::vector<CrossedLink> links_;

  VoxelDomain domain_;
  std::vector<std::uint8_t> on_bridge_;
  bool sheet_ = false;
  std::vector<BakeWarning> warnings_;
};

}  // namespace handlebody
