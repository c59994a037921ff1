#include "core/interpolation/moving_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/interpolation/polynomial.hpp"
#include "core/numerics/elementary.hpp"
#include "core/numerics/safe_norm.hpp"

namespace handlebody {
namespace {

constexpr double huge = 1e150;            // stands for infinity: quotients and products with weights stay numbers
constexpr double least_root = 1e-200;     // √w below this part of the largest counts as none
constexpr double largest_exponent = 250;  // of a singular √w over the second nearest point's: e²⁵⁰ is as good as infinite
constexpr double margin = 0.8;            // distance of the farthest point that widening includes, in h

double in_range(double length) {
  return std::min(std::max(length, 1 / huge), huge);
}

Result<Done> check_options(const MovingLeastSquaresOptions& options) {
  const auto wrong = [](std::initializer_list<Word> message, std::initializer_list<Word> remedy) {
    return Error(HB_ERROR_INVALID_OPTION, message, remedy, HB_CULPRIT_OPTION);
  };
  if (options.degree < 0 || options.degree > 2)
    return wrong({"The degree ", options.degree, " is not 0, 1 or 2."}, {"Use 0, 1 or 2."});
  if (!(options.power > 0) || !std::isfinite(options.power))
    return wrong({"The power ", options.power, " is not a positive finite number."}, {"Use 4, or 2 for broader weights."});
  if (!(options.epsilon >= 0) || !std::isfinite(options.epsilon))
    return wrong({"Epsilon is ", options.epsilon, ", which is not zero or a positive finite number."},
                 {"Use 0 to interpolate, or a small part of the points' spacing."});
  if (!(options.width >= 0) || !std::isfinite(options.width))
    return wrong({"The width ", options.width, " is not a positive finite number."},
                 {"Give it in units of the points: a few times their spacing."});
  return Done{};
}

}  // namespace

Result<MovingLeastSquares> MovingLeastSquares::create(const Eigen::Ref<const Matrix>& points,
                                                      const Eigen::Ref<const Matrix>& values,
                                                      const MovingLeastSquaresOptions& options) {
  if (auto checked = check_options(options); !checked) return checked.error();
  const bool singular = options.weight == MovingWeight::inverse_distance && options.epsilon == 0;
  auto data = check_data(points, values, singular ? Coincident::merge : Coincident::keep, nullptr, ", or give an epsilon above 0");
  if (!data) return data.error();
  const Index count = polynomial_count(options.degree, points.cols());
  if (static_cast<double>(data->points.rows()) * static_cast<double>(count) > 1 << 26)
    return Error(HB_ERROR_OUT_OF_MEMORY, {data->points.rows(), " points and ", count, " polynomials take more than 512 MiB."},
                 {"Use a lower degree or fewer points."});
  Matrix inner = data->points;
  for (Index i = 0; i < inner.rows(); ++i)
    for (Index axis = 0; axis < inner.cols(); ++axis)
      inner(i, axis) = (inner(i, axis) - data->points(0, axis)) / (data->diagonal > 0 ? data->diagonal : 1);
  PolynomialSpace space(inner, options.degree);
  return MovingLeastSquares(std::move(*data), options, std::move(space));
}

MovingLeastSquares::MovingLeastSquares(ScatteredData data, const MovingLeastSquaresOptions& options, PolynomialSpace space)
    : Interpolant(std::move(data)),
      options_(options),
      unit_(data_.diagonal > 0 ? data_.diagonal : 1),
      width_(options.width),
      epsilon_(options.epsilon > 0 ? in_range(options.epsilon / unit_) : 0),
      space_(std::move(space)),
      qr_(data_.points.rows(), space_.size()) {
  const Index n = data_.points.rows(), d = dimension(), count = space_.size();
  if (width_ == 0 && options.weight != MovingWeight::inverse_distance) {
    double sum = 0;
    Index apart = 0;
    for (const double distance : nearest_distances(data_.points)) {
      if (!(distance > 0 && std::isfinite(distance))) continue;
      sum += distance / unit_;
      ++apart;
    }
    width_ = (apart > 0 ? sum / static_cast<double>(apart) : 1) * (2 + options.degree) * unit_;
    if (options.weight == MovingWeight::wendland) width_ *= 2;
  }
  distances_.resize(n);
  rows_.resize(n);
  nearest_.resize(n);
  roots_.resize(n);
  solution_.resize(n);
  offset_.resize(d);
  turned_.resize(d);
  difference_.resize(d);
  direction_.resize(d);
  monomials_.resize(count);
  right_.resize(count);
  gradients_.resize(count, d);
}

double MovingLeastSquares::width() const {
  return options_.weight == MovingWeight::inverse_distance ? 0 : width_;
}

void MovingLeastSquares::weigh(const double* query, double* w, double* slopes) {
  const Index n = data_.points.rows(), d = dimension();
  const bool inverse = options_.weight == MovingWeight::inverse_distance;
  std::fill(w, w + n, 0.0);
  if (slopes) std::fill(slopes, slopes + n * d, 0.0);
  find_distances(query);
  const bool at_point = !set_direction(query, own_), singular = inverse && epsilon_ == 0 && at_point;
  if (slopes && inverse && at_point && data_.diagonal > 0 && (options_.power <= 1 || epsilon_ > 0)) {
    std::fill(slopes, slopes + n * d, std::numeric_limits<double>::quiet_NaN());
    slopes = nullptr;
  }
  if (singular) w[own_] = 1;
  if (singular && !slopes) return;

  // √W P with the origin at the nearest point, whose row is then (√w, 0, 0 …) and cannot swamp the others however large it is.
  reach_ = in_range(width_ / unit_);
  farthest_ = -1;
  if (options_.weight == MovingWeight::wendland) widen();
  set_roots();
  // Plain loops over plain memory, here and below: this file is compiled for size.
  double *const roots = roots_.data(), *const solution = solution_.data();
  std::uint32_t* const point_of = rows_.data();
  Index rows = 0;
  for (Index k = 0; k < n; ++k) {
    if (!(roots[k] > least_root)) continue;
    roots[rows] = roots[k];
    point_of[rows++] = static_cast<std::uint32_t>(k);
  }
  qr_.reset(rows);
  for (Index row = 0; row < rows; ++row) {
    set_monomials(point_of[row]);
    qr_.set_row(row, roots[row], monomials_.data());
  }
  int degree = -1;
  while (degree < options_.degree && qr_.extend(space_.count(degree + 1))) ++degree;

  // f(x) = p(x)ᵀa with a = (√W P)⁺ √W f, so ψ = √W (√W P)⁺ᵀ p(x).
  for (Index axis = 0; axis < d; ++axis) offset_[axis] = (query[axis] - data_.points(own_, axis)) / unit_;
  if (!singular) {
    space_.turn(offset_.data(), turned_.data());
    space_.values(turned_.data(), monomials_.data());
    qr_.solve_transposed(monomials_.data(), solution);
    for (Index row = 0; row < rows; ++row) w[point_of[row]] = roots[row] * solution[row];
  }
  if (slopes) set_slopes(query, w, slopes);
}

/** The weights' gradients. With Ψ = (√W P)⁺ √W, so that a = Ψf and ψ = Ψᵀp(x), and gᵢ = ψᵢ ∇ln wᵢ, the formula of the header reads
 *
 *   ∇ψₖ = gₖ + Ψₖᵀ (∇p(x) − Σᵢ gᵢ p(xᵢ)).
 *
 * Near a point its own g is as steep as p/r but almost cancels, so its slope is taken from Σₖ∇ψₖ = 0. */
void MovingLeastSquares::set_slopes(const double* query, const double* w, double* slopes) {
  const Index d = dimension(), count = qr_.rank(), rows = qr_.rows();
  const std::uint32_t* const point_of = rows_.data();
  const double *const roots = roots_.data(), *const distances = distances_.data(), *const monomials = monomials_.data();
  double *const gradients = gradients_.data(), *const direction = direction_.data(), *const stretch = offset_.data();
  double *const right = right_.data(), *const solution = solution_.data();

  space_.turn(offset_.data(), turned_.data());
  space_.gradients(turned_.data(), gradients);
  if (farthest_ < 0 || !set_direction(query, farthest_)) direction_.setZero();
  for (Index axis = 0; axis < d; ++axis) stretch[axis] = direction[axis] / margin;  // ∇h, where h follows a point
  for (Index row = 0; row < rows; ++row) {
    const Index k = point_of[row];
    if (!set_direction(query, k)) direction_.setZero();
    set_monomials(k);
    const double steep = w[k] * steepness(distances[k]), s = distances[k] / reach_;
    for (Index axis = 0; axis < d; ++axis) {
      const double g = steep * (direction[axis] - s * stretch[axis]);
      slopes[k * d + axis] = g;
      for (Index j = 0; j < count; ++j) gradients[j * d + axis] -= g * monomials[j];
    }
  }
  for (Index axis = 0; axis < d; ++axis) {
    for (Index j = 0; j < count; ++j) right[j] = gradients[j * d + axis];
    qr_.solve_transposed(right, solution);
    double others = 0;
    for (Index row = 0; row < rows; ++row) {
      const Index k = point_of[row];
      double& slope = slopes[k * d + axis];
      slope = (slope + roots[row] * solution[row]) / unit_;
      if (k != own_) others += slope;
    }
    slopes[own_ * d + axis] = -others;
  }
}

void MovingLeastSquares::find_distances(const double* query) {
  const Index n = data_.points.rows(), d = dimension();
  const double* point = data_.points.data();
  double* const distances = distances_.data();
  own_ = 0;
  double nearest = std::numeric_limits<double>::infinity(), second = nearest;
  for (Index k = 0; k < n; ++k, point += d) {
    const double r = std::min(safe_distance(query, point, d) / unit_, huge);
    distances[k] = r;
    if (r < nearest) {
      second = nearest;
      nearest = r;
      own_ = k;
    } else if (r < second) {
      second = r;
    }
  }
  second_ = n == 1 ? in_range(nearest) : second;
}

/** Compact support: h grows where too few points are well inside. */
void MovingLeastSquares::widen() {
  const std::size_t wanted = std::min(nearest_.size(), 2 * static_cast<std::size_t>(monomials_.size()));
  std::size_t inside = 0;
  for (const double r : distances_) inside += r <= margin * reach_;
  if (inside >= wanted) return;
  const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
    return distances_[a] != distances_[b] ? distances_[a] < distances_[b] : a < b;
  };
  std::iota(nearest_.begin(), nearest_.end(), 0u);
  std::uint32_t* const last = nearest_.data() + wanted - 1;
  nth_element(nearest_.data(), last, nearest_.data() + nearest_.size(), nearer);
  farthest_ = *last;
  reach_ = distances_[farthest_] / margin;
}

/** √w of every point, relative to the nearest; singular ones to the second nearest. */
void MovingLeastSquares::set_roots() {
  const Index n = distances_.size();
  const double* const r = distances_.data();
  double* const roots = roots_.data();
  const double nearest = r[own_], one_over_reach = 1 / reach_;
  if (options_.weight == MovingWeight::inverse_distance) {
    const double second = second_ + epsilon_, half = options_.power / 2;
    for (Index k = 0; k < n; ++k) roots[k] = r[k] + epsilon_;
    roots[own_] = second;
    inverse_powers(roots, n, second, half);
    roots[own_] = std::exp(std::min(half * std::log(second / (nearest + epsilon_)), largest_exponent));
  } else if (options_.weight == MovingWeight::gaussian) {
    for (Index k = 0; k < n; ++k) roots[k] = (r[k] - nearest) * one_over_reach * ((r[k] + nearest) * one_over_reach) / 2;
    decaying_exponentials(roots, n);
  } else {
    for (Index k = 0; k < n; ++k) {
      const double s = r[k] * one_over_reach;
      roots[k] = s < 1 ? (1 - s) * (1 - s) * std::sqrt(4 * s + 1) : 0;
    }
  }
}

/** d ln w / dr */
double MovingLeastSquares::steepness(double r) const {
  if (options_.weight == MovingWeight::inverse_distance) return -std::min(options_.power / (r + epsilon_), huge);
  if (options_.weight == MovingWeight::gaussian) return -std::min(2 * r / reach_ / reach_, huge);
  const double s = r / reach_;
  return -20 * s / ((1 - s) * (4 * s + 1)) / reach_;
}

/** p(xₖ), with the origin at the nearest point. */
void MovingLeastSquares::set_monomials(Index point) {
  const Index d = dimension();
  const double *const x = data_.points.data() + point * d, *const origin = data_.points.data() + own_ * d;
  const double one_over_unit = 1 / unit_;
  double* const difference = difference_.data();
  for (Index axis = 0; axis < d; ++axis) difference[axis] = (x[axis] - origin[axis]) * one_over_unit;
  space_.turn(difference, turned_.data());
  space_.values(turned_.data(), monomials_.data());
}

/** The unit vector from a point to the query, 0 from infinitely far; false where the query is the point. */
bool MovingLeastSquares::set_direction(const double* query, Index point) {
  const Index d = dimension();
  const double* const x = data_.points.data() + point * d;
  const double r = safe_distance(query, x, d);
  if (!(r > 0)) return false;
  double* const direction = direction_.data();
  for (Index axis = 0; axis < d; ++axis) direction[axis] = std::isfinite(r) ? (query[axis] - x[axis]) / r : 0;
  return true;
}

}  // namespace handlebody
