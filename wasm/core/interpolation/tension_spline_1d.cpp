#include "core/interpolation/tension_spline_1d.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/hyperbolic.hpp"

namespace handlebody {
namespace {

// With ω = bH and x = ω/2, a spline on [0, 1] with zeros at both ends is a symmetric part with slopes ±1 and an antisymmetric one,
//
//   σ(t) = (cosh x − cosh xy)/(ω sinh x),   a(t) = (sinh xy − y sinh x)/(2 (x cosh x − sinh x)),   y = 2t − 1.
//
// Short or slack intervals (x < 1) use series in x²; long ones multiply everything by e^{−x}: no overflow, and cubics as ω → 0.
constexpr double slack = 1e-8;  // of ω: below, σ is a parabola to rounding

struct Curvature {
  double p, q;
};

Curvature curvature(double omega) {
  const double x = omega / 2;
  double symmetric = 0, antisymmetric = 0;  // −H f″ at the left end of σ and a
  if (x < 1) {
    const auto [cosh, sinhc, rest] = hyperbolic(x * x);
    symmetric = 2 * cosh / sinhc;
    antisymmetric = 2 * sinhc / rest;
  } else {
    const double decayed = std::exp(-omega), tanh = (1 - decayed) / (1 + decayed);
    symmetric = omega / tanh;
    antisymmetric = omega * tanh / (1 - 2 * tanh / omega);
  }
  return {(antisymmetric + symmetric) / 2, (antisymmetric - symmetric) / 2};
}

/** σ or σ′. */
double even_part(double omega, double t, double rest_of_t, bool derivative) {
  if (omega < slack) return derivative ? rest_of_t - t : t * rest_of_t;
  const double u = omega * t, v = omega * rest_of_t, whole = exp_less_one(-omega);
  if (!derivative) return -exp_less_one(-u) * exp_less_one(-v) / (omega * whole);
  return u < v ? std::exp(-u) * exp_less_one(u - v) / whole : -std::exp(-v) * exp_less_one(v - u) / whole;
}

/** a or a′. */
double odd_part(double omega, double t, double rest_of_t, bool derivative) {
  const double x = omega / 2, y = t - rest_of_t;
  if (x < 1) {  // Σ x²ᵏ⁻² (y²ᵏ⁺¹ − y)/(2k+1)!, of which y³ − y is a factor; its derivative likewise
    double sum = 0, geometric = 0, power = 1, term = 1;
    for (int k = 1; k <= 9; ++k) {
      geometric += power;  // 1 + y² + … + y²ᵏ⁻²
      power *= y * y;
      term /= 2 * k * (2 * k + 1);
      sum += term * (derivative ? (2 * k + 1) * power - 1 : geometric);
      term *= x * x;
    }
    const double rest = hyperbolic(x * x).rest;
    return derivative ? sum / rest : -2 * y * t * rest_of_t * sum / rest;  // y² − 1 = −4 t (1 − t)
  }
  const double left = std::exp(-omega * t), right = std::exp(-omega * rest_of_t), decayed = std::exp(-omega);
  const double below = x * (1 + decayed) - (1 - decayed);
  return derivative ? (x * (right + left) - (1 - decayed)) / below : (right - left - y * (1 - decayed)) / (2 * below);
}

}  // namespace

Result<TensionSpline1d> TensionSpline1d::create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                                const TensionSpline1dOptions& options) {
  if (points.cols() != 1)
    return Error(HB_ERROR_INVALID_SHAPE,
                 {"Zero slope at the ends needs points on a line; these have ", points.cols(), " coordinates."},
                 {"Use natural ends, or 1 dimension."});
  const double stiffness = std::sqrt(options.beta / options.alpha);
  if (!(options.alpha > 0) || !(options.beta >= 0) || !std::isfinite(options.alpha) || !std::isfinite(stiffness))
    return Error(HB_ERROR_INVALID_OPTION,
                 {"The weights alpha = ", options.alpha, " and beta = ", options.beta,
                  " are not a positive and a non-negative finite number of the same order."},
                 {"Use alpha = 1, and beta = 0 for a cubic spline or more for less overshoot."}, HB_CULPRIT_OPTION);
  auto data = check_data(points, values, Coincident::merge);
  if (!data) return data.error();
  return TensionSpline1d(std::move(*data), stiffness);
}

TensionSpline1d::TensionSpline1d(ScatteredData data, double stiffness) : Interpolant(std::move(data)), stiffness_(stiffness) {
  const std::size_t n = data_.kept.size();
  const double* places = data_.points.data();
  order_ = sorted_indices(n, [places](std::uint32_t a, std::uint32_t b) { return places[a] < places[b]; });
  x_.resize(n);
  for (std::size_t i = 0; i < n; ++i) x_[i] = places[order_[i]];
  pull_.assign(n, 0);
  over_.assign(n, 0);
  link_.assign(n, 0);
  z_.assign(n, 0);

  // The factors: Dᵢ = Mᵢᵢ − Mᵢ₋₁ᵢ²/Dᵢ₋₁.
  double diagonal = 0;  // of the interval before
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double length = x_[i + 1] - x_[i];
    const auto [p, q] = curvature(stiffness_ * length);
    pull_[i] = (p + q) / length / length;
    if (i > 0) over_[i] = 1 / (diagonal + p / length - (i > 1 ? link_[i] * link_[i] / over_[i - 1] : 0));
    diagonal = p / length;
    link_[i + 1] = q / length * over_[i];
  }

  const Index m = outputs();
  slopes_.resize(static_cast<Index>(n), m);
  for (Index j = 0; j < m; ++j) {
    const auto value = [&](std::size_t i) { return data_.values(order_[i], j); };
    z_[0] = 0;
    for (std::size_t i = 1; i < n; ++i) {
      const double rise = i + 1 < n ? pull_[i] * (value(i + 1) - value(i)) : 0;
      z_[i] = pull_[i - 1] * (value(i) - value(i - 1)) + rise;
    }
    solve(z_.data(), 0);
    for (std::size_t i = 0; i < n; ++i) slopes_(static_cast<Index>(i), j) = z_[i];
  }
}

/** M z = rhs in place, where rhs is 0 before `first`; 0 at both ends. */
void TensionSpline1d::solve(double* rhs, Index first) const {
  const auto n = std::ssize(x_);
  const double *over = over_.data(), *link = link_.data();
  for (Index i = first + 1; i < n; ++i) rhs[i] -= link[i] * rhs[i - 1];
  for (Index i = n - 1; i >= 0; --i) rhs[i] = over[i] * rhs[i] - (i + 1 < n ? link[i + 1] * rhs[i + 1] : 0);
}

/** The interval [xᵢ, xᵢ₊₁) that x is in, or −1 to the left and n − 1 to the right of all. */
Index TensionSpline1d::interval_of(double x) const {
  return std::upper_bound(x_.begin(), x_.end(), x) - x_.begin() - 1;
}

TensionSpline1d::Blend TensionSpline1d::blend(Index interval, double x, bool derivative) const {
  const double *ends = x_.data() + interval, length = ends[1] - ends[0];
  const double t = (x - ends[0]) / length, rest = (ends[1] - x) / length, omega = stiffness_ * length;
  const double even = even_part(omega, t, rest, derivative), odd = odd_part(omega, t, rest, derivative);
  // f = y₀ + t (y₁ − y₀) + H (½(d₀ − d₁) σ + ½(d₀ + d₁) a),  d = m − s
  const double scale = derivative ? 1 : length;
  return {derivative ? (1 - odd) / length : t - odd, scale * (odd + even) / 2, scale * (odd - even) / 2};
}

void TensionSpline1d::combine(const double* queries, Index count, double* out, bool derivative) const {
  const Index m = outputs(), last = std::ssize(x_) - 1;
  const auto row = [&](Index i) { return data_.values.data() + m * static_cast<Index>(order_[i]); };
  for (Index q = 0; q < count; ++q, out += m) {
    const Index i = interval_of(queries[q]);
    const double *left = row(std::max<Index>(i, 0)), *right = left, *slope = slopes_.data();
    Blend b{0, 0, 0};
    if (i >= 0 && i < last) {
      b = blend(i, queries[q], derivative);
      right = row(i + 1);
      slope += m * i;
    }
    for (Index j = 0; j < m; ++j) {
      out[j] = (derivative ? 0 : left[j]) + b.rise * (right[j] - left[j]);
      if (i >= 0 && i < last) out[j] += b.left * slope[j] + b.right * slope[m + j];
    }
  }
}

void TensionSpline1d::weigh(const double* query, double* w, double* slopes) {
  const auto n = std::ssize(x_);
  const Index i = interval_of(*query);
  std::fill(w, w + n, 0.0);
  if (slopes) std::fill(slopes, slopes + n, 0.0);
  const std::uint32_t* order = order_.data();
  if (i < 0 || i >= n - 1) {
    w[order[std::max<Index>(i, 0)]] = 1;
    return;
  }
  // The value is linear in the slopes M⁻¹B y, and M is symmetric: M z = (left, right) is solved once, then Bᵀz taken.
  for (const bool derivative : {false, true}) {
    double* to = derivative ? slopes : w;
    if (!to) return;
    const Blend b = blend(i, *query, derivative);
    std::fill(z_.begin(), z_.end(), 0.0);
    z_[i] = b.left;
    z_[static_cast<std::size_t>(i) + 1] = b.right;
    double* z = z_.data();
    solve(z, i);
    for (Index k = 0; k + 1 < n; ++k) {
      const double pulled = pull_[k] * (z[k] + z[k + 1]);
      to[order[k]] -= pulled;
      to[order[k + 1]] += pulled;
    }
    to[order[i]] += (derivative ? 0 : 1) - b.rise;
    to[order[i + 1]] += b.rise;
  }
}

}  // namespace handlebody
