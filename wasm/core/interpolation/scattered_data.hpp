// The checks that all scattered data go through: shape, finiteness, and points that coincide.
#pragma once

#include <cstdint>
#include <vector>

#include "core/errors/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

struct ScatteredData {
  // Compiled once, because many places move one.
  ScatteredData();
  ScatteredData(const ScatteredData&);
  ScatteredData(ScatteredData&&) noexcept;
  ScatteredData& operator=(ScatteredData&&) noexcept;
  ~ScatteredData();

  Matrix points;                       // n×d, those that were kept
  Matrix values;                       // n×m
  std::vector<std::uint32_t> kept;     // n: the number of each in the data as given, ascending
  std::vector<std::uint32_t> twin_of;  // as given: the point that stands for this one; its own number where it was kept
  Index given = 0;                     // points as given
  double diagonal = 0;                 // of the points' bounding box; 0 where all coincide
  Vector measures;                     // d: what the coordinates were multiplied by, see comparable_axes(); or empty
};

/** What to do about points at one place: an interpolant cannot have both, a smoothing fit can. */
enum class Coincident {
  merge,  // keep the first of those whose values are equal; POINT_DUPLICATE where they are not
  keep,
};

/** Points count as one place where on every axis they are closer than this part of the points' extent on it: axes may be in units
 * that have nothing in common. (Of all axes together: no farther than that in the cube that the extents are scaled to, by its
 * diagonal.) */
constexpr double coincidence = 1e-9;

/** No axis counts as shorter than this part of the longest, in methods that compare distances on all axes. */
constexpr double shortest_axis = 1e-3;

/** What each coordinate is to be multiplied by (d) so that axes can be compared: 1, or more for an axis on which the points' extent
 * is below `shortest_axis` of the largest, which then counts as that part. So it is with a table of frequencies, 1e9 to 9e9, by
 * voltages, 0 to 1: squares of distances there have no digits left for the voltage. Empty where all are 1. An axis without extent
 * has no say. Fails with POINTS_DEGENERATE where the extents differ by more than 1e150. */
Result<Vector> comparable_axes(const Eigen::Ref<const Matrix>& points);

/** `points` (n×d) with each coordinate multiplied by its measure (d, or empty for 1). */
Matrix measured(const Eigen::Ref<const Matrix>& points, const Vector& measures);

/** Checks `points` (n×d) and `values` (n×m). Fails with POINTS_TOO_FEW (n = 0), POINT_NOT_FINITE, VALUE_NOT_FINITE,
 * POINTS_DEGENERATE (an extent beyond double precision) or POINT_DUPLICATE; the culprit is the point, as given. O(n²d) with
 * `merge`. Which points coincide is judged by `places` (n×d), unless it is null: the points in the metric in use. `else_allow` is
 * what the method has that lets points coincide, as the end of a remedy. */
Result<ScatteredData> check_data(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                 Coincident coincident, const Matrix* places = nullptr, const char* else_allow = "");

/** Makes the axes of checked data comparable: measures, points and diagonal. Fails as comparable_axes() does. */
Result<Done> compare_axes(ScatteredData& data);

/** The tolerance of each axis (d) for points at one place: they are where Σ (difference/tolerance)² ≤ 1, or no axis with a
 * tolerance of 0 tells them apart. */
Vector place_tolerances(const Eigen::Ref<const Matrix>& points);
bool at_one_place(const double* a, const double* b, const Vector& tolerances);

/** Distance from every point to its nearest neighbor (n); infinite for a single point. O(n²d). */
Vector nearest_distances(const Matrix& points);

}  // namespace handlebody
