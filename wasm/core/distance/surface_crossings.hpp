// Where the lines of voxel centers cross a surface: exactly what is inside a closed one, and which neighboring voxels it separates.
#pragma once

#include <cstdint>
#include <vector>

#include "core/distance/voxel_domain.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

/** The crossings of a surface with the grid's lines along one axis. Add all triangles, then finish. */
class SurfaceCrossings {
 public:
  struct Crossing {
    double at;          // in cells along the axis
    std::int32_t sign;  // what it adds to the winding number of points beyond it
  };

  SurfaceCrossings(const Grid& grid, int axis);

  /** False when the surface crosses lines too often to keep (4 million times): give up then. `corners` are the triangle's vertex
   *  numbers, welded: two triangles that share an edge agree on which side of it a line runs, so that a closed surface's signs add
   *  up to 0 on every line, whatever the rounding. */
  bool add(const Points& positions, const std::uint32_t* corners);
  void finish();

  int axis() const { return axis_; }
  /** The line of voxel (i, j, k), and its crossings in rising order. */
  std::size_t line_of(const std::array<std::int32_t, 3>& cell) const;
  std::size_t lines() const { return starts_.size() - 1; }
  const Crossing* begin(std::size_t line) const { return sorted_.data() + starts_[line]; }
  const Crossing* end(std::size_t line) const { return sorted_.data() + starts_[line + 1]; }
  /** The linear index of the first voxel of a line, and the step to the next. */
  std::int64_t first_voxel(std::size_t line) const;
  std::int64_t stride() const;

 private:
  struct Found {
    std::uint32_t line;
    Crossing crossing;
  };
  Grid grid_;
  int axis_, u_, v_;
  double visits_ = 0;
  std::vector<Found> found_;
  std::vector<std::size_t> starts_;
  std::vector<Crossing> sorted_;
};

/** What a closed surface encloses. */
struct EnclosedVoxels {
  std::vector<std::uint32_t> voxels;  // that it winds around, in either direction; ascending
  bool both_ways = false;             // it winds around some in one direction, around others in the other: parts face opposite ways
};

/** `crossings` are those along x. Whether it winds both ways is told by three voxels in a line: of two surfaces in one place,
 * rounding may swap the order at one voxel's center. */
EnclosedVoxels enclosed_voxels(const Grid& grid, const SurfaceCrossings& crossings);

/** The voxels nearest to the crossings, appended in any order, more than once each. */
void crossed_voxels(const Grid& grid, const SurfaceCrossings& crossings, std::vector<std::uint32_t>& voxels);

}  // namespace handlebody
