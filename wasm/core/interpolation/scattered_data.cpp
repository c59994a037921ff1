#include "core/interpolation/scattered_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

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

/** Fills `twin_of`. Places are compared along the sorted first axis, within the tolerance only. */
Result<Done> find_twins(const Matrix& places, const Eigen::Ref<const Matrix>& values, const char* else_allow,
                        std::vector<std::uint32_t>& twin_of) {
  const Vector tolerances = place_tolerances(places);
  const auto by_first_axis = [&](std::uint32_t a, std::uint32_t b) {
    return places(a, 0) != places(b, 0) ? places(a, 0) < places(b, 0) : a < b;
  };
  const Indices order = sorted_indices(twin_of.size(), by_first_axis);
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = a + 1; b < order.size() && places(order[b], 0) - places(order[a], 0) <= tolerances[0]; ++b) {
      const std::uint32_t i = std::min(order[a], order[b]), j = std::max(order[a], order[b]);
      if (!at_one_place(&places(i, 0), &places(j, 0), tolerances)) continue;
      if ((values.row(i).array() != values.row(j).array()).any())
        return Error(HB_ERROR_POINT_DUPLICATE, {"Point ", j, " is at the same place as point ", i, " but has another value."},
                     {"Remove one of the two, or average them", else_allow, "."}, HB_CULPRIT_POINT, j);
      twin_of[j] = std::min(twin_of[j], twin_of[i]);
    }
  }
  return Done{};
}

/** Halves of the extents (d): halving first keeps those of huge coordinates from overflowing. */
Vector half_extents(const Eigen::Ref<const Matrix>& points) {
  return points.colwise().maxCoeff() / 2 - points.colwise().minCoeff() / 2;
}

}  // namespace

ScatteredData::ScatteredData() = default;
ScatteredData::ScatteredData(const ScatteredData&) = default;
ScatteredData::ScatteredData(ScatteredData&&) noexcept = default;
ScatteredData& ScatteredData::operator=(ScatteredData&&) noexcept = default;
ScatteredData::~ScatteredData() = default;

Vector place_tolerances(const Eigen::Ref<const Matrix>& points) {
  return 2 * coincidence * std::sqrt(static_cast<double>(points.cols())) * half_extents(points);
}

bool at_one_place(const double* a, const double* b, const Vector& tolerances) {
  double squared = 0;
  for (Index axis = 0; axis < tolerances.size(); ++axis) {
    if (a[axis] == b[axis]) continue;
    const double apart = (a[axis] - b[axis]) / tolerances[axis];
    squared += apart * apart;
  }
  return squared <= 1;
}

Result<Vector> comparable_axes(const Eigen::Ref<const Matrix>& points) {
  const Vector half = half_extents(points);
  const double least = shortest_axis * half.maxCoeff();
  Vector measures = Vector::Ones(half.size());
  bool all_one = true;
  for (Index axis = 0; axis < half.size(); ++axis) {
    if (!(half[axis] > 0 && half[axis] < least)) continue;
    measures[axis] = least / half[axis];
    all_one = false;
  }
  if (all_one) return Vector();
  if (measures.maxCoeff() <= 1e150) return measures;
  return Error(HB_ERROR_POINTS_DEGENERATE, {"The extents of the axes differ by more than 1e150."},
               {"Rescale the points to ordinary numbers."});
}

Matrix measured(const Eigen::Ref<const Matrix>& points, const Vector& measures) {
  Matrix result = points;
  for (Index axis = 0; axis < measures.size(); ++axis) result.col(axis) *= measures[axis];
  return result;
}

Result<Done> compare_axes(ScatteredData& data) {
  auto measures = comparable_axes(data.points);
  if (!measures) return measures.error();
  if (measures->size() == 0) return Done{};
  data.measures = std::move(*measures);
  data.points = measured(data.points, data.measures);
  data.diagonal = 2 * safe_norm(half_extents(data.points));
  return Done{};
}

Result<ScatteredData> check_data(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                 Coincident coincident, const Matrix* places, const char* else_allow) {
  const Index count = points.rows();
  if (count == 0 || points.cols() == 0 || values.cols() == 0)
    return Error(HB_ERROR_POINTS_TOO_FEW, {"There are no points."}, {"Give at least one point with a value."});
  if (auto finite = check_finite(points, values); !finite) return finite.error();

  ScatteredData data;
  data.given = count;
  data.diagonal = 2 * safe_norm(half_extents(points));
  if (!std::isfinite(data.diagonal) || (data.diagonal > 0 && !std::isfinite(1 / data.diagonal)))
    return Error(HB_ERROR_POINTS_DEGENERATE, {"The extent of the points, ", data.diagonal, ", is beyond double precision."},
                 {"Rescale the points to ordinary numbers."});
  data.twin_of.resize(count);
  std::iota(data.twin_of.begin(), data.twin_of.end(), 0u);
  if (coincident == Coincident::merge)
    if (auto twins = find_twins(places ? *places : Matrix(points), values, else_allow, data.twin_of); !twins) return twins.error();

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
