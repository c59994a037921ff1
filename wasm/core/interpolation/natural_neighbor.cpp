#include "core/interpolation/natural_neighbor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace handlebody {
namespace {

constexpr double at_point = 1e-300;  // squared distance of x at a point, above where squares lose digits
constexpr double no_slope = 1e-24;   // squared distance up to which a point leaves no gradient

}  // namespace

Result<NaturalNeighbor> NaturalNeighbor::create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                                OutsideHull outside) {
  if (points.cols() != 2)
    return Error(HB_ERROR_INVALID_SHAPE,
                 {"Natural neighbor interpolation works in the plane, not in ", points.cols(), " dimensions."},
                 {"Give points of 2 coordinates, or use simplexLinear() or rbf(), which take any dimension."});
  auto data = check_data(points, values, Coincident::merge);
  if (!data) return data.error();
  if (auto compared = compare_axes(*data); !compared) return compared.error();
  return NaturalNeighbor(std::move(*data), outside);
}

NaturalNeighbor::NaturalNeighbor(ScatteredData data, OutsideHull outside)
    : Interpolant(std::move(data)),
      outside_(outside),
      per_diagonal_(data_.diagonal > 0 ? 1 / data_.diagonal : 1),
      hull_(data_.points),
      offsets_(data_.points.rows(), 2),
      squares_(data_.points.rows()),
      heap_(data_.points.rows()),
      cell_(data_.points.rows() + 8),
      part_(2 * data_.points.rows() + 8) {
  double rounding = 0;
  for (Index axis = 0; axis < 2; ++axis) {
    low_[axis] = high_[axis] = data_.points(0, axis);
    for (Index i = 1; i < data_.points.rows(); ++i) {
      low_[axis] = std::min(low_[axis], data_.points(i, axis));
      high_[axis] = std::max(high_[axis], data_.points(i, axis));
    }
    const double largest = std::max(std::abs(low_[axis]), std::abs(high_[axis]));
    rounding = std::max(rounding, 8 * std::numeric_limits<double>::epsilon() * (largest * per_diagonal_));
  }
  // Points on a straight boundary are off it by their rounding ρ. Where they are s apart, this affects cells wider than s²/ρ.
  blur_ = 2 * NearestInHull::tolerance + rounding;
  far_ = std::clamp(1e-3 / rounding, 1e3, 1e10);
}

void NaturalNeighbor::weigh(const double* query, double* w, double* slopes) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Index n = data_.points.rows();
  bool boxed = true;
  for (Index axis = 0; axis < 2; ++axis) boxed = boxed && low_[axis] <= query[axis] && query[axis] <= high_[axis];
  Place place = boxed ? surround(query) : Place::open;
  double away = 0, foot[2];
  Index i = 0, j = 0;
  bool corner = false;
  if (place == Place::open) {
    away = hull_(query, foot, w);
    if (away > 0 && outside_ == OutsideHull::nan) {
      std::fill(w, w + n, none);
      if (slopes) std::fill(slopes, slopes + 2 * n, none);
      return;
    }
    // The foot is a corner of the hull or between the ends of an edge. If x is a little inside, a third weight is negligible.
    own_ = i = std::max_element(w, w + n) - w;
    corner = w[i] == 1;
    w[i] = 0;
    j = std::max_element(w, w + n) - w;
    if (corner)
      place = Place::at_point;
    else
      measure(foot);
  }

  std::fill(w, w + n, 0.0);
  if (slopes) std::fill(slopes, slopes + 2 * n, 0.0);
  if (place == Place::at_point) {
    w[own_] = 1;
    if (slopes && !(corner && away > 0)) std::fill(slopes, slopes + 2 * n, none);
    return;
  }
  if (place == Place::open)
    share_edge(i, j, w, slopes);
  else
    take_areas(w, slopes);
  if (slopes && squares_[own_] < no_slope) std::fill(slopes, slopes + 2 * n, none);
}

void NaturalNeighbor::measure(const double* x) {
  for (Index i = 0; i < squares_.size(); ++i) {
    double* offset = &offsets_(i, 0);
    for (Index axis = 0; axis < 2; ++axis) offset[axis] = (point(i)[axis] - x[axis]) * per_diagonal_;
    squares_[i] = offset[0] * offset[0] + offset[1] * offset[1];
  }
}

/** Makes x's cell. It is open if it reaches the box. */
NaturalNeighbor::Place NaturalNeighbor::surround(const double* x) {
  measure(x);
  const Index n = squares_.size();
  for (Index i = 0; i < n; ++i) heap_[i] = static_cast<std::uint32_t>(i);
  for (Index at = n / 2; at-- > 0;) sift_down(at, n);
  own_ = heap_[0];
  if (squares_[own_] < at_point) return Place::at_point;

  // Nearest first, so that a line that is almost parallel to another never hides one that is nearer.
  cell_.start(far_);
  double reach = cell_.reach();
  for (Index left = n; left > 0; --left) {
    const Index i = pop(left);
    if (squares_[i] > 4 * reach) break;
    const double distance = std::sqrt(squares_[i]);
    cell_.cut(offsets_(i, 0) / distance, offsets_(i, 1) / distance, distance / 2, i);
    reach = cell_.reach();
  }
  for (Index k = 0; k < cell_.size(); ++k)
    if (cell_.side(k).owner == ConvexCell::box) return Place::open;
  return Place::enclosed;
}

/** Sibson's weights, of a cell that is enclosed. */
void NaturalNeighbor::take_areas(double* w, double* slopes) {
  const Index m = cell_.size();
  double area = 0, slope[2] = {0, 0};
  for (Index k = 0; k < m; ++k) {
    const auto& side = cell_.side(k);
    const Index i = side.owner;
    part_.copy(cell_);
    for (Index step = 1; step < m; ++step) {  // adjacent neighbors first: they leave little for the others to cut
      const Index j = cell_.side((k + (step % 2 ? (step + 1) / 2 : m - step / 2)) % m).owner;
      // |y − pᵢ| ≤ |y − pⱼ|, or e·y ≤ e·(pᵢ + pⱼ)/2 with e = pⱼ − pᵢ.
      const double ex = (point(j)[0] - point(i)[0]) * per_diagonal_, ey = (point(j)[1] - point(i)[1]) * per_diagonal_;
      const double twice = ex * (offsets_(i, 0) + offsets_(j, 0)) + ey * (offsets_(i, 1) + offsets_(j, 1));
      const double length = std::sqrt(ex * ex + ey * ey);
      // Adjacent neighbors share a vertex of the cell, equally far from both, which is on this line. Near the hull's boundary it is
      // so far away that this line is parallel to their sides but for rounding, which would decide how they share the cell's area.
      part_.cut(ex / length, ey / length, twice / 2 / length, j, i);
    }
    area += w[i] = part_.area();
    if (!slopes) continue;
    const double *from = cell_.before(k).vertex, *to = side.vertex;
    const double x = to[0] - from[0], y = to[1] - from[1];
    const double factor = std::sqrt(x * x + y * y) / (4 * side.offset);  // ℓ / 2|pᵢ − x|
    for (Index axis = 0; axis < 2; ++axis) slope[axis] += slopes[2 * i + axis] = factor * (from[axis] + to[axis]);
  }
  for (Index k = 0; k < m; ++k) {
    const Index i = cell_.side(k).owner;
    w[i] /= area;
    for (Index axis = 0; slopes && axis < 2; ++axis)
      slopes[2 * i + axis] = (slopes[2 * i + axis] - w[i] * slope[axis]) / area * per_diagonal_;
  }
}

/** Linear weights of the two points around x on the boundary between i and j. There may be other points between these, where
 *  boundaries have more points than corners. */
void NaturalNeighbor::share_edge(Index i, Index j, double* w, double* slopes) {
  const double *from = &offsets_(i, 0), *to = &offsets_(j, 0);
  double ex = to[0] - from[0], ey = to[1] - from[1];
  const double length = std::sqrt(ex * ex + ey * ey);
  ex /= length;
  ey /= length;
  double behind = ex * from[0] + ey * from[1], ahead = ex * to[0] + ey * to[1];
  for (Index a = 0; a < squares_.size(); ++a) {
    const double *p = &offsets_(a, 0), place = ex * p[0] + ey * p[1];
    if (std::abs(ex * (p[1] - from[1]) - ey * (p[0] - from[0])) > blur_) continue;
    if (place <= 0 && place > behind) {
      behind = place;
      i = a;
    } else if (place > 0 && place < ahead) {
      ahead = place;
      j = a;
    }
  }
  const double width = ahead - behind;
  const bool between = width > 0;  // or rounding put x beyond the last of points on a line
  w[j] = between ? std::clamp(-behind / width, 0.0, 1.0) : 0;
  w[i] = 1 - w[j];
  own_ = w[i] > w[j] ? i : j;
  if (!slopes || !between) return;
  const double e[2] = {ex, ey};
  for (Index axis = 0; axis < 2; ++axis) slopes[2 * i + axis] = -(slopes[2 * j + axis] = e[axis] / width * per_diagonal_);
}

void NaturalNeighbor::sift_down(Index at, Index size) {
  std::uint32_t* heap = heap_.data();
  const std::uint32_t moved = heap[at];
  for (Index child = 2 * at + 1; child < size; child = 2 * at + 1) {
    if (child + 1 < size && squares_[heap[child + 1]] < squares_[heap[child]]) ++child;
    if (!(squares_[heap[child]] < squares_[moved])) break;
    heap[at] = heap[child];
    at = child;
  }
  heap[at] = moved;
}

/** Takes the nearest of the first `size` points of the heap. */
Index NaturalNeighbor::pop(Index size) {
  const Index nearest = heap_[0];
  heap_[0] = heap_[size - 1];
  sift_down(0, size - 1);
  return nearest;
}

}  // namespace handlebody
