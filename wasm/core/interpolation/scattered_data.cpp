#include "core/interpolation/scattered_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/numerics/indices.hpp"
#include "core/numerics/safe_norm.hpp"

namespace handlebody {
namespace {

Result<Done> check_finite(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values) {
  for (Index i = 0; i < points.rows(); ++i) {
    for (Index axis = 0; axis < points.cols(); ++axis)
      if (!std::isfinite(points(i, axis)))
        return Error(HB_ERROR_POINT_NOT_FINITE, {"Coordinate ", axis, " of point ", i, " is ", points(i, axis), "."},
                     {"Remove NaN and infinite coordinates."}, HB_CULPRIT_POINT, i);
    for (Index j = 0; j < values.cols(); ++j)
      if (!std::isfinite(values(i, j)))
        return Error(HB_ERROR_VALUE_NOT_FINITE, {"Value ", j, " of point ", i, " is ", values(i, j), "."},
                     {"Remove NaN and infinite values, with their points."}, HB_CULPRIT_POINT, i);
  }
  return Done{};
}

/** Fills `twin_of`. Points are compared along the sorted first axis, within the tolerance only. */
Result<Done> find_twins(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values, double tolerance,
                        std::vector<std::uint32_t>& twin_of) {
  const auto by_first_axis = [&](std::uint32_t a, std::uint32_t b) {
    return points(a, 0) != points(b, 0) ? points(a, 0) < points(b, 0) : a < b;
  };
  const Indices order = sorted_indices(twin_of.size(), by_first_axis);
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = a + 1; b < order.size() && points(order[b], 0) - points(order[a], 0) <= tolerance; ++b) {
      const std::uint32_t i = std::min(order[a], order[b]), j = std::max(order[a], order[b]);
      double squared = 0;
      for (Index axis = 0; axis < points.cols(); ++axis) {
        const double apart = (points(i, axis) - points(j, axis)) / (tolerance > 0 ? tolerance : 1);
        squared += apart * apart;
      }
      if (!(squared <= (tolerance > 0 ? 1 : 0))) continue;
      if ((values.row(i).array() != values.row(j).array()).any())
        return Error(HB_ERROR_POINT_DUPLICATE, {"Point ", j, " is at the same place as point ", i, " but has another value."},
                     {"Remove one of the two, average them, or allow smoothing."}, HB_CULPRIT_POINT, j);
      twin_of[j] = std::min(twin_of[j], twin_of[i]);
    }
  }
  return Done{};
}

}  // namespace

Result<ScatteredData> check_data(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                 Coincident coincident) {
  const Index count = points.rows();
  if (count == 0 || points.cols() == 0 || values.cols() == 0)
    return Error(HB_ERROR_POINTS_TOO_FEW, {"There are no points."}, {"Give at least one point with a value."});
  if (auto finite = check_finite(points, values); !finite) return finite.error();

  ScatteredData data;
  data.given = count;
  // Halving first keeps the extent of huge coordinates from overflowing.
  const Vector half = points.colwise().maxCoeff() / 2 - points.colwise().minCoeff() / 2;
  data.diagonal = 2 * safe_norm(half);
  if (!std::isfinite(data.diagonal) || (data.diagonal > 0 && !std::isfinite(1 / data.diagonal)))
    return Error(HB_ERROR_POINTS_DEGENERATE, {"The extent of the points, ", data.diagonal, ", is beyond double precision."},
                 {"Rescale the points to ordinary numbers."});
  data.twin_of.resize(count);
  std::iota(data.twin_of.begin(), data.twin_of.end(), 0u);
  if (coincident == Coincident::merge)
    if (auto twins = find_twins(points, values, coincidence * data.diagonal, data.twin_of); !twins) return twins.error();

  for (std::uint32_t i = 0; i < data.twin_of.size(); ++i) {
    data.twin_of[i] = data.twin_of[data.twin_of[i]];  // twins of twins: earlier ones are settled
    if (data.twin_of[i] == i) data.kept.push_back(i);
  }
  const auto n = std::ssize(data.kept);
  data.points.resize(n, points.cols());
  data.values.resize(n, values.cols());
  for (Index k = 0; k < n; ++k) {
    data.points.row(k) = points.row(data.kept[k]);
    data.values.row(k) = values.row(data.kept[k]);
  }
  return data;
}

Vector nearest_distances(const Matrix& points) {
  const Index count = points.rows(), d = points.cols();
  // Plain loops over plain memory: this file is compiled for size, and n² pairs are looked at.
  const double scale = std::max(points.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  Matrix scaled = points / scale;
  Vector squares = Vector::Constant(count, std::numeric_limits<double>::infinity());
  double* nearest = squares.data();
  const double* a = scaled.data();
  for (Index i = 0; i < count; ++i, a += d) {
    double least = nearest[i];
    const double* b = scaled.data();
    for (Index j = 0; j < i; ++j, b += d) {
      double squared = 0;
      for (Index axis = 0; axis < d; ++axis) squared += (a[axis] - b[axis]) * (a[axis] - b[axis]);
      if (squared < least) least = squared;
      if (squared < nearest[j]) nearest[j] = squared;
    }
    nearest[i] = least;
  }
  for (Index i = 0; i < count; ++i) nearest[i] = scale * std::sqrt(nearest[i]);
  return squares;
}

}  // namespace handlebody
