// Which resolution a body is baked at, where that is left to the bake: as fine as a number of voxels inside allows. What is thin
// fills little of its box, so that it gets a finer grid than what is fat, for a file of the same size.
#pragma once

#include <memory>

#include "core/irbf/interior_voxels.hpp"

namespace handlebody {

/** What a bake may spend. */
enum class BakeQuality : unsigned { draft = 0, normal = 1, fine = 2 };
constexpr unsigned bake_quality_count = 3;

class InteriorSearch {
 public:
  /** As InteriorVoxels, for the grid over the positions' box with `resolution` voxels along its longest side; 0 looks for it. */
  InteriorSearch(const Points& positions, Triangles& triangles, int resolution, BakeQuality quality, InteriorOptions options);

  /** For a grid that is given. */
  InteriorSearch(const Points& positions, Triangles& triangles, const Grid& grid, InteriorOptions options);

  /** As InteriorVoxels::step. A grid is counted coarsely first; one on which limbs merge is refined once, where that helps. */
  Result<double> step();

  /** Once finished. */
  InteriorVoxels& found() { return *found_; }
  int resolution() const { return resolution_; }

 private:
  Result<Done> begin(int resolution);
  int next_resolution() const;

  const Points& positions_;
  Triangles& triangles_;
  const InteriorOptions options_;
  const BakeQuality quality_;
  bool looking_ = false, counted_ = false;  // whether found_ is the grid that the count asked for
  double progress_ = 0;
  int tried_ = 0;                          // grids that were finished or failed
  int resolution_ = 0, next_ = 0;          // of found_, and of the grid that is being filled
  std::unique_ptr<InteriorVoxels> found_;  // the last that was finished
  std::unique_ptr<InteriorVoxels> trial_;
};

}  // namespace handlebody
