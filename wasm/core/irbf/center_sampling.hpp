// The last part of a bake: the vertices that become IRBF centers, each the farthest inside the body from those before (paper 001,
// §4.3), with the interior distances from every one to all voxels. In bounded steps.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/interior_distance.hpp"
#include "core/distance/interior_samples.hpp"
#include "core/distance/voxel_domain.hpp"
#include "core/irbf/sphere_packing.hpp"
#include "core/numerics/indices.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

struct CenterSamplingOptions {
  Index count = 0;              // of the centers that are spread evenly, 1 to the number of vertices
  Index most = 0;               // of all centers, `count` or more
  Index per_sphere = 0;         // centers within three radii of each sphere, where there are vertices for them and `most` allows
  double most_code = 65535;     // of the distances; fewer make smaller files
  std::vector<double> density;  // of centers, relative to 1, a vertex each; empty for 1 throughout
};

class CenterSampling {
 public:
  /** Of the vertices at `positions` (n×3, the domain's space). The domain, the positions, the spheres and the distance, which is
   *  ready to measure, outlive this. */
  CenterSampling(const VoxelDomain& domain, const Points& positions, InteriorDistance& distance, const std::vector<Sphere>& spheres,
                 CenterSamplingOptions options);

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
  bool serve_spheres();

  const VoxelDomain& domain_;
  const Points& positions_;
  InteriorDistance& distance_;
  const std::vector<Sphere>& spheres_;
  CenterSamplingOptions options_;

  Phase phase_ = Phase::stencils;
  InteriorSamples samples_;  // of the vertices
  Outside outside_;
  Index next_ = 0;                      // the vertex that becomes a center, then the center whose codes are next
  std::vector<double> field_;           // distances of all voxels from the newest center
  std::vector<double> ratios_;          // see InteriorSamples
  std::vector<double> coverage_;        // interior distance of each vertex from the nearest center so far
  std::vector<double> weight_;          // of coverage, from the density
  std::vector<Index> approached_;       // vertices that the newest center may be nearer to
  std::vector<double> scales_;          // of each center's codes, before they share one
  InteriorSamples middles_;             // of the spheres
  std::vector<Index> near_;             // centers within three radii of each sphere, inside
  std::vector<std::uint8_t> given_up_;  // spheres that no vertex is left for

  Indices centers_;
  std::vector<std::uint16_t> distances_;
  double distance_scale_ = 0;
};

}  // namespace handlebody
