// The checks that all scattered data go through: shape, finiteness, and points that coincide.
#pragma once

#include <cstdint>
#include <vector>

#include "core/errors/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

struct ScatteredData {
  Matrix points;                       // n×d, those that were kept
  Matrix values;                       // n×m
  std::vector<std::uint32_t> kept;     // n: the number of each in the data as given, ascending
  std::vector<std::uint32_t> twin_of;  // as given: the point that stands for this one; its own number where it was kept
  Index given = 0;                     // points as given
  double diagonal = 0;                 // of the points' bounding box; 0 where all coincide
};

/** What to do about points at one place: an interpolant cannot have both, a smoothing fit can. */
enum class Coincident {
  merge,  // keep the first of those whose values are equal; POINT_DUPLICATE where they are not
  keep,
};

/** Points closer than this part of the bounding box's diagonal count as one place. */
constexpr double coincidence = 1e-9;

/** Checks `points` (n×d) and `values` (n×m). Fails with POINTS_TOO_FEW (n = 0), POINT_NOT_FINITE, VALUE_NOT_FINITE,
 * POINTS_DEGENERATE (an extent beyond double precision) or POINT_DUPLICATE; the culprit is the point, as given. O(n²d) with
 * `merge`. */
Result<ScatteredData> check_data(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                 Coincident coincident);

/** Distance from every point to its nearest neighbor (n); infinite for a single point. O(n²d). */
Vector nearest_distances(const Matrix& points);

}  // namespace handlebody
