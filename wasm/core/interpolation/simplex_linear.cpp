#include "core/interpolation/simplex_linear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/decompositions.hpp"

namespace handlebody {
namespace {

constexpr double farthest = 1e150;  // diagonals: coordinates beyond are clamped, as NearestInHull does

/** Splits `offset` into its coordinates along orthonormal `axes` and, left in place, what is off their span. */
void project(const Matrix& axes, Vector& offset, double* coordinates) {
  for (Index j = 0; j < axes.rows(); ++j) {
    coordinates[j] = axes.row(j).dot(offset);
    offset -= coordinates[j] * axes.row(j).transpose();
  }
}

/** Orthonormal axes (rows) of the span of the rows of `offsets`, but for directions in which they are shorter than `tolerance`. */
Matrix span_axes(const Matrix& offsets, double tolerance) {
  const auto [basis, sizes] = column_span(offsets.transpose());
  return basis.leftCols((sizes.array() > tolerance).count()).transpose();
}

/** The row nearest to the mean of all, which are divided by `scale` before they are squared. */
Index nearest_to_mean(const Matrix& points, double scale) {
  const Index n = points.rows();
  Vector mean = Vector::Zero(points.cols());
  for (Index i = 0; i < n; ++i) mean += points.row(i).transpose() / static_cast<double>(n);
  Index nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < n; ++i) {
    const double squared = ((points.row(i).transpose() - mean) / scale).squaredNorm();
    if (squared < least) least = squared, nearest = i;
  }
  return nearest;
}

}  // namespace

/** Where the points are, how large and what they span; the points in that frame. */
struct SimplexLinear::Frame {
  Vector center;
  double scale = 1, radius = 0, rounding = 0;
  Matrix axes, points;

  explicit Frame(const ScatteredData& data) : center(data.points.cols()), points(data.points) {
    const Index n = points.rows(), d = points.cols();
    if (data.diagonal > 0) scale = data.diagonal;
    // One of the points, since a rounded mean may lie beside the line or plane through all: n points would span n dimensions.
    const Index middle = nearest_to_mean(data.points, scale);
    for (Index axis = 0; axis < d; ++axis) center[axis] = data.points(middle, axis);
    for (Index i = 0; i < n; ++i) points.row(i) = (points.row(i) - center.transpose()) / scale;
    for (const double coordinate : Eigen::Map<const Vector>(data.points.data(), data.points.size()))
      rounding = std::max(rounding, std::abs(coordinate));
    rounding *= 4 * std::numeric_limits<double>::epsilon() / scale;
    axes = span_axes(points, coincidence);
    if (axes.rows() < d) {
      const Matrix around = points;
      points.resize(n, axes.rows());
      Vector offset(d);
      for (Index i = 0; i < n; ++i) {
        offset = around.row(i).transpose();
        project(axes, offset, points.data() + i * axes.rows());
      }
    } else {
      axes.resize(0, d);  // the coordinates as they are
    }
    for (Index i = 0; i < n; ++i) radius = std::max(radius, points.row(i).squaredNorm());
    radius = std::sqrt(radius);
  }
};

Result<SimplexLinear> SimplexLinear::create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                            OutsideHull outside) {
  auto data = check_data(points, values, Coincident::merge);
  if (!data) return data.error();
  if (auto compared = compare_axes(*data); !compared) return compared.error();
  Frame frame(*data);
  return SimplexLinear(std::move(*data), outside, std::move(frame));
}

SimplexLinear::SimplexLinear(ScatteredData data, OutsideHull outside, Frame frame)
    : Interpolant(std::move(data)),
      outside_(outside),
      center_(std::move(frame.center)),
      scale_(frame.scale),
      axes_(std::move(frame.axes)),
      points_(std::move(frame.points)),
      radius_(frame.radius),
      rounding_(frame.rounding),
      cell_(points_),
      least_norm_(points_.rows(), points_.cols()),
      hull_(points_),
      offset_(center_.size()),
      place_(points_.cols()) {}

/** Fills w with the weights of the cell at place_. False, and w as it was, where no cell contains it. */
bool SimplexLinear::weigh_cell(double* w) {
  if (!cell_.find(place_.data())) return false;
  const Indices& members = cell_.members();
  const auto count = std::ssize(members);
  for (Index m = 0; m < count; ++m)
    for (Index axis = 0; axis < place_.size(); ++axis) least_norm_.point(m)[axis] = points_(members[m], axis) - place_[axis];
  if (!least_norm_.solve(count)) return false;
  std::fill(w, w + points_.rows(), 0.0);
  for (Index m = 0; m < count; ++m) w[members[m]] = least_norm_.weight(m);
  return true;
}

void SimplexLinear::weigh(const double* query, double* w, double* slopes) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Index n = points_.rows(), d = dimension();
  if (slopes) std::fill(slopes, slopes + n * d, nan);
  for (Index axis = 0; axis < d; ++axis) offset_[axis] = std::clamp((query[axis] - center_[axis]) / scale_, -farthest, farthest);
  if (place_.size() == d) {
    place_ = offset_;
  } else {
    project(axes_, offset_, place_.data());
    const double allowed = n > 1 ? 2 * coincidence + rounding_ : 0;
    if (outside_ == OutsideHull::nan && offset_.squaredNorm() > allowed * allowed) {
      std::fill(w, w + n, nan);
      return;
    }
  }
  // Walks are for places among the points: from far away these cannot be told apart.
  if (place_.squaredNorm() <= radius_ * radius_ && weigh_cell(w)) return;
  if (hull_(place_.data(), place_.data(), w) > rounding_ && outside_ == OutsideHull::nan) {
    std::fill(w, w + n, nan);
    return;
  }
  weigh_cell(w);  // shares evenly among the corners of a face; where rounding makes it fail, the hull's weights remain
}

}  // namespace handlebody
