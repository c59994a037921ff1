#include "core/interpolation/delaunay_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handlebody {
namespace {

constexpr double outside = 1e-12;      // distance beyond a facet
constexpr double rounding = 1e-15;     // of a power
constexpr double slack = 1e-2;         // part of a tie that a pivot may spend on a larger divisor
constexpr double poor = 1e-3;          // a divisor that loses digits
constexpr Index pivots_a_factor = 32;  // then the inverse is made anew
constexpr Index pivots_a_point = 20;   // the bound on a walk

}  // namespace

DelaunayCell::DelaunayCell(const Matrix& points)
    : points_(points),
      place_(Vector::Zero(points.cols())),
      costs_(points.rows()),
      basis_(points.cols() + 1, no_index),
      former_(basis_),
      starts_(static_cast<std::size_t>(points.rows()) * basis_.size(), no_index),
      inverse_(points.cols() + 1, points.cols() + 1),
      column_(points.cols() + 1),
      plane_(points.cols() + 1),
      powers_(points.rows()),
      rates_(points.rows()) {
  members_.reserve(points.rows());
  // The first simplex: unit vectors, unrestricted and without cost, leave one by one, and all points stay above the plane.
  measure(place_.data());
  inverse_.setIdentity();
  for (Index row = 0; row <= points.cols(); ++row) enter(row, 0);
  root_ = basis_;
  spanned_ = std::find(root_.begin(), root_.end(), no_index) == root_.end();
}

/** Moves x to `place`. Returns the point nearest to it. */
Index DelaunayCell::measure(const double* place) {
  const Index d = points_.cols();
  for (Index axis = 0; axis < d; ++axis) place_[axis] = place[axis];
  Index nearest = 0;
  for (Index i = 0; i < points_.rows(); ++i) {
    double squared = 0;
    for (Index axis = 0; axis < d; ++axis) {
      const double apart = points_(i, axis) - place_[axis];
      squared += apart * apart;
    }
    costs_[i] = squared;
    if (squared < costs_[nearest]) nearest = i;
  }
  return nearest;
}

/** An affine function at a point: coefficients · (1, p − x). */
double DelaunayCell::affine(const double* coefficients, Index point) const {
  double sum = coefficients[0];
  for (Index axis = 0; axis < points_.cols(); ++axis) sum += coefficients[axis + 1] * (points_(point, axis) - place_[axis]);
  return sum;
}

/** How steep barycentric coordinate `row` is: one over the height of the simplex. */
double DelaunayCell::steepness(Index row) const {
  double squared = 0;
  for (Index k = 1; k < inverse_.cols(); ++k) squared += inverse_(row, k) * inverse_(row, k);
  return std::sqrt(squared);
}

/** Puts a point into the basis: one Gauss–Jordan step makes column_, which holds its barycentric coordinates, a unit vector. */
void DelaunayCell::pivot(Index row, std::uint32_t point) {
  basis_[row] = point;
  age_ = std::abs(column_[row]) < poor ? pivots_a_factor : age_ + 1;
  inverse_.row(row) /= column_[row];
  for (Index k = 0; k < inverse_.rows(); ++k)
    if (k != row) inverse_.row(k) -= column_[k] * inverse_.row(row);
}

/** The inverse of the basis, whose points may be reordered. */
void DelaunayCell::factor() {
  former_ = basis_;
  std::fill(basis_.begin(), basis_.end(), no_index);
  inverse_.setIdentity();
  for (const std::uint32_t point : former_) {
    Index best = -1;
    for (Index k = 0; k < inverse_.rows(); ++k) {
      column_[k] = affine(&inverse_(k, 0), point);
      if (basis_[k] == no_index && (best < 0 || std::abs(column_[k]) > std::abs(column_[best]))) best = k;
    }
    pivot(best, point);
  }
  age_ = 0;
}

/** Lays the plane through the lifted points of the basis, and measures all powers. */
void DelaunayCell::raise_plane() {
  plane_.setZero();
  for (Index k = 0; k < inverse_.rows(); ++k) {
    const std::uint32_t point = basis_[k];
    if (point != no_index) plane_ += costs_[point] * inverse_.row(k).transpose();
  }
  double squared_radius = plane_[0];  // the center is half the slope away from x
  for (Index k = 1; k < plane_.size(); ++k) squared_radius += plane_[k] * plane_[k] / 4;
  tie_ = cospherical * std::min(squared_radius, 1.0) + rounding;
  for (Index i = 0; i < points_.rows(); ++i) powers_[i] = std::max(costs_[i] - affine(plane_.data(), i), 0.0);
}

/** Turns the plane about all points of the basis but that of `row`, toward the points beyond the facet (direction −1), before it
 * (1) or on the side of the farthest (0), until it meets one, which replaces that of `row`. False where there are none. */
bool DelaunayCell::enter(Index row, double direction) {
  const Index n = points_.rows();
  raise_plane();
  double farthest = 0;
  for (Index i = 0; i < n; ++i) {
    rates_[i] = affine(&inverse_(row, 0), i);
    if (std::abs(rates_[i]) > std::abs(farthest)) farthest = rates_[i];
  }
  for (const std::uint32_t point : basis_)
    if (point != no_index) rates_[point] = 0;
  if (direction == 0) direction = farthest < 0 ? -1 : 1;

  // Harris's ratio test: among those met first, or within the slack of a tie, the one with the largest divisor.
  const double least = outside / 2 * steepness(row), spare = slack * tie_;
  double limit = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < n; ++i)
    if (const double rate = direction * rates_[i]; rate > least) limit = std::min(limit, (powers_[i] + spare) / rate);
  Index entering = -1;
  for (Index i = 0; i < n; ++i) {
    const double rate = direction * rates_[i];
    if (!(rate > least) || powers_[i] / rate > limit) continue;  // as a quotient, so that no rounding shuts out all of them
    if (entering < 0 || (!bland() && rate > direction * rates_[entering])) entering = i;
  }
  if (entering < 0) return false;

  idle_ = powers_[entering] > spare ? 0 : idle_ + 1;
  for (Index k = 0; k < inverse_.rows(); ++k) column_[k] = affine(&inverse_(k, 0), entering);
  pivot(row, static_cast<std::uint32_t>(entering));
  return true;
}

/** Whether the plane has not risen for long. From then on the first point wins all ties (Bland's rule), and pivots cannot cycle. */
bool DelaunayCell::bland() const {
  return idle_ > 2 * points_.cols() + 8;
}

/** Crosses facets until x is in the simplex. */
bool DelaunayCell::walk() {
  const Index most = pivots_a_point * (points_.rows() + points_.cols());
  idle_ = 0;
  factor();
  for (Index pivots = 0; pivots < most; ++pivots) {
    Index leaving = -1;
    for (Index k = 0; k < inverse_.rows(); ++k) {
      if (!(inverse_(k, 0) < -outside * steepness(k))) continue;
      if (leaving < 0 || (bland() ? basis_[k] < basis_[leaving] : inverse_(k, 0) < inverse_(leaving, 0))) leaving = k;
    }
    const bool crossed = leaving >= 0 && enter(leaving, -1);
    if (!crossed && age_ == 0) return leaving < 0;
    if (!crossed || age_ >= pivots_a_factor) factor();  // a final answer needs a fresh inverse
  }
  return false;
}

bool DelaunayCell::find(const double* place) {
  const Index nearest = measure(place);
  if (costs_[nearest] == 0) {
    members_.assign(1, static_cast<std::uint32_t>(nearest));
    return true;
  }
  if (!spanned_) return false;
  std::uint32_t* start = &starts_[static_cast<std::size_t>(nearest) * basis_.size()];
  if (*start == no_index) {
    measure(points_.data() + nearest * points_.cols());
    basis_ = root_;
    walk();  // wherever it ends is an empty simplex
    std::copy(basis_.begin(), basis_.end(), start);
    measure(place);
  }
  std::copy(start, start + basis_.size(), basis_.begin());
  if (!walk()) return false;

  raise_plane();
  for (const std::uint32_t point : basis_) powers_[point] = 0;
  members_.clear();
  for (Index i = 0; i < costs_.size(); ++i)
    if (powers_[i] <= tie_) members_.push_back(static_cast<std::uint32_t>(i));
  return true;
}

}  // namespace handlebody
