// The last part of a bake: the vertices that become IRBF centers, each the farthest inside the body from those before (paper 001,
// §4.3), with the interior distances from every one to all voxels. In bounded steps.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/interior_distance.hpp"
#include "core/distance/interior_samples.hpp"
#include "core/distance/voxel_domain.hpp"
#include "core/numerics/indices.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class CenterSampling {
 public:
  /** `count` of the vertices at `positions` (n×3, the domain's space, n ≥ count), as dense as `density` says relative to 1 (n, or
   *  empty for 1 throughout). The domain, the positions and the distance, which is ready to measure, outlive this. */
  CenterSampling(const VoxelDomain& domain, const Points& positions, InteriorDistance& distance, Index count,
                 std::vector<double> density);

  /** A bounded piece of work: some vertices, a center. Returns the part done, 1 when finished. */
  double step();

  /** Vertices that lie so far from all voxels inside that their distances say little; the farthest of them, and how far. */
  struct Outside {
    Index count = 0, farthest = -1;
    double distance = 0;
  };
  /** Known once the first center is. */
  const Outside& outside() const { return outside_; }

  // ---- once finished -----------------------------------------------------------------------------------------------------------

  const Indices& centers() const { return centers_; }

  /** Centers × voxels: interior distance = distance_scale · code. To be moved from. */
  std::vector<std::uint16_t>& distances() { return distances_; }
  double distance_scale() const { return distance_scale_; }

 private:
  enum class Phase { stencils, centers, quantize, finished };

  void sample_vertices();
  void begin();
  void add_center();
  void quantize();

  const VoxelDomain& domain_;
  const Points& positions_;
  InteriorDistance& distance_;
  Index count_;
  std::vector<double> density_;

  Phase phase_ = Phase::stencils;
  InteriorSamples samples_;  // of the vertices
  Outside outside_;
  Index next_ = 0;                 // the vertex that becomes a center, then the center whose codes are next
  std::vector<double> field_;      // distances of all voxels from the newest center
  std::vector<double> ratios_;     // see InteriorSamples
  std::vector<double> coverage_;   // interior distance of each vertex from the nearest center so far
  std::vector<double> weight_;     // of coverage, from the density
  std::vector<Index> approached_;  // vertices that the newest center may be nearer to
  std::vector<double> scales_;     // of each center's codes, before they share one

  Indices centers_;
  std::vector<std::uint16_t> distances_;
  double distance_scale_ = 0;
};

}  // namespace handlebody
