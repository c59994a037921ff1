#include "core/interpolation/nearest_in_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/safe_norm.hpp"

namespace handlebody {
namespace {

constexpr double farthest = 1e150;    // diagonals: its square is still finite
constexpr double rounding = 1e-15;    // of a length in diagonals, or of a height over the plane as a part of the distance
constexpr Index steps_per_axis = 50;  // a few are needed

double dot(const double* a, const double* b, Index d) {
  double sum = 0;
  for (Index axis = 0; axis < d; ++axis) sum += a[axis] * b[axis];
  return sum;
}

/** a += factor · b */
void add(double* a, double factor, const double* b, Index d) {
  for (Index axis = 0; axis < d; ++axis) a[axis] += factor * b[axis];
}

}  // namespace

NearestInHull::NearestInHull(const Matrix& points) : points_(points) {
  const Index n = points.rows(), d = points.cols();
  const Vector low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  center_ = low / 2 + high / 2;  // halves cannot overflow
  diagonal_ = 2 * safe_norm(high / 2 - low / 2);
  if (!(diagonal_ > 0)) diagonal_ = 1;
  for (Index i = 0; i < n; ++i)
    for (Index axis = 0; axis < d; ++axis) points_(i, axis) = (points(i, axis) - center_[axis]) / diagonal_;
  double largest = 0;
  for (Index axis = 0; axis < d; ++axis) largest = std::max({largest, std::abs(low[axis]), std::abs(high[axis])});
  spread_ = 4 * std::numeric_limits<double>::epsilon() * (largest / diagonal_);

  corral_.resize(d + 1);
  for (Vector* scratch : {&weights_, &wanted_}) scratch->setZero(d + 1);
  for (Vector* scratch : {&query_, &point_, &across_}) scratch->setZero(d);
  edges_.setZero(d + 1, d);
  factor_.setZero(d + 1, d + 1);
}

/** z = Σ weights · corners, after normalizing the weights to a sum of 1. */
void NearestInHull::combine() {
  const double sum = weights_.head(count_).sum();
  point_.setZero();
  for (Index k = 0; k < count_; ++k) {
    weights_[k] /= sum;
    add(point_.data(), weights_[k], corner(k), point_.size());
  }
}

/** Edges from number `from` on, by Gram–Schmidt, twice for the sake of orthogonality. False where the last adds nothing. */
bool NearestInHull::orthonormalize(Index from) {
  const Index d = point_.size();
  bool independent = true;
  for (Index k = std::max<Index>(from, 1); k < count_; ++k) {
    double* edge = &edges_(k, 0);
    for (Index axis = 0; axis < d; ++axis) edge[axis] = corner(k)[axis] - corner(0)[axis];
    for (Index j = 1; j < k; ++j) factor_(j, k) = 0;
    for (int pass = 0; pass < 2; ++pass) {
      for (Index j = 1; j < k; ++j) {
        const double along = dot(edge, &edges_(j, 0), d);
        factor_(j, k) += along;
        add(edge, -along, &edges_(j, 0), d);
      }
    }
    const double length = std::sqrt(dot(edge, edge, d));
    independent = length > rounding;
    factor_(k, k) = independent ? length : 1;
    for (Index axis = 0; axis < d; ++axis) edge[axis] = independent ? edge[axis] / length : 0;
  }
  return independent;
}

/** The weights, of any sign, of the point of the corral's span that is nearest to x, and the vector from it to x. Projecting twice
 * keeps that vector orthogonal to the span to its own last digit, however short it is, so that heights over the plane are accurate.
 */
void NearestInHull::minimize_in_span() {
  const Index d = query_.size();
  for (Index axis = 0; axis < d; ++axis) across_[axis] = query_[axis] - corner(0)[axis];
  wanted_.setZero();
  for (int pass = 0; pass < 2; ++pass) {
    for (Index k = 1; k < count_; ++k) {
      const double along = dot(across_.data(), &edges_(k, 0), d);
      wanted_[k] += along;
      add(across_.data(), -along, &edges_(k, 0), d);
    }
  }
  wanted_[0] = 1;
  for (Index k = count_ - 1; k > 0; --k) {
    for (Index j = k + 1; j < count_; ++j) wanted_[k] -= factor_(k, j) * wanted_[j];
    wanted_[k] /= factor_(k, k);
    wanted_[0] -= wanted_[k];
  }
}

void NearestInHull::leave(Index k) {
  --count_;
  for (Index j = k; j < count_; ++j) {
    corral_[j] = corral_[j + 1];
    weights_[j] = weights_[j + 1];
  }
  orthonormalize(k);
}

double NearestInHull::operator()(const double* query, double* nearest, double* weights) {
  const Index n = points_.rows(), d = points_.cols();
  for (Index axis = 0; axis < d; ++axis) query_[axis] = std::clamp((query[axis] - center_[axis]) / diagonal_, -farthest, farthest);

  // Start at the nearest of the points.
  double distance = std::numeric_limits<double>::infinity(), least = distance;
  count_ = 1;
  for (Index i = 0; i < n; ++i) {
    for (Index axis = 0; axis < d; ++axis) across_[axis] = query_[axis] - points_(i, axis);
    const double squared = dot(across_.data(), across_.data(), d);
    if (!(squared < distance)) continue;
    distance = squared;
    corral_[0] = static_cast<std::uint32_t>(i);
  }
  weights_[0] = 1;

  const Index most = steps_per_axis * (d + 1);
  for (Index step = 0, idle = 0;; ++step) {
    // Move toward the wanted point of the span, at most to where the first weight vanishes: its corner leaves.
    for (;;) {
      minimize_in_span();
      double way = 1;
      Index leaving = -1;
      for (Index k = 0; k < count_; ++k) {
        if (wanted_[k] > 0) continue;
        const double to_zero = weights_[k] > 0 && std::isfinite(wanted_[k]) ? weights_[k] / (weights_[k] - wanted_[k]) : 0;
        if (leaving >= 0 && to_zero >= way) continue;
        way = to_zero;
        leaving = k;
      }
      for (Index k = 0; k < count_; ++k)
        if (way > 0) weights_[k] += way * (wanted_[k] - weights_[k]);
      if (leaving < 0) break;
      leave(leaving);
    }
    distance = std::sqrt(dot(across_.data(), across_.data(), d));
    if (distance <= tolerance + spread_ || step == most || count_ > d) break;
    // A step can be too short for doubles, but not many in a row.
    idle = distance < least ? 0 : idle + 1;
    least = std::min(least, distance);
    if (idle > d + 1) break;

    // The point farthest in front of the plane enters.
    double highest = dot(across_.data(), corner(0), d) + rounding * distance;
    std::uint32_t entering = 0;
    bool found = false;
    for (Index i = 0; i < n; ++i) {
      const double height = dot(across_.data(), points_.data() + i * d, d);
      if (!(height > highest)) continue;
      highest = height;
      entering = static_cast<std::uint32_t>(i);
      found = true;
    }
    const auto end = corral_.begin() + count_;
    if (!found || std::find(corral_.begin(), end, entering) != end) break;
    *end = entering;
    weights_[count_++] = 0;
    if (orthonormalize(count_ - 1)) continue;
    --count_;
    break;
  }
  combine();

  if (weights) {
    std::fill(weights, weights + n, 0.0);
    for (Index k = 0; k < count_; ++k) weights[corral_[k]] = weights_[k];
  }
  const bool inside = distance <= tolerance + spread_;
  for (Index axis = 0; axis < d; ++axis) nearest[axis] = inside ? query[axis] : center_[axis] + diagonal_ * point_[axis];
  return inside ? 0 : distance * diagonal_;
}

}  // namespace handlebody
