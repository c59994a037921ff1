#include "core/kernels/tension_kernel.hpp"

#include <cmath>
#include <numbers>

#include "core/numerics/bessel_k.hpp"
#include "core/numerics/hyperbolic.hpp"

namespace handlebody {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double underflow = 746;  // of e^{−x}

// From this hr on the roots are so far apart that g_a − g_b does not cancel: g_b is at most e^{−2hr} g_a.
constexpr double apart = 0.5;

// Series in 2D end at this br, where K₀'s terms begin to cancel. Close roots then have ar > 1, as the quadrature requires.
constexpr double largest_for_series = 2;

/** g_k(r), the Green's function of −Δ + k². */
double green(int dimension, double k, double r) {
  if (dimension == 2) return bessel_k0(k * r) / (2 * pi);
  return std::exp(-k * r) / (dimension == 1 ? 2 * k : 4 * pi * r);
}

/** g_k′(r), k = 0 included. */
double green_slope(int dimension, double k, double r) {
  if (dimension == 2) return -(k > 0 ? k * bessel_k1(k * r) : 1 / r) / (2 * pi);
  return -std::exp(-k * r) * (dimension == 1 ? 0.5 : (1 / r + k) / (4 * pi * r));
}

Error option_error(std::initializer_list<Word> message, std::initializer_list<Word> remedy) {
  return {HB_ERROR_INVALID_OPTION, message, remedy, HB_CULPRIT_OPTION};
}

}  // namespace

Result<TensionKernel> TensionKernel::create(double alpha, double beta, double gamma, Index dimension) {
  if (dimension < 1 || dimension > 3)
    return Error(HB_ERROR_INVALID_SHAPE, {"Splines with tension are made in 1, 2 or 3 dimensions, not in ", dimension, "."},
                 {"Use rbf() in other dimensions, with the cubic kernel for instance."});
  const char* const names[] = {"alpha", "beta", "gamma"};
  const double weights[] = {alpha, beta, gamma};
  for (int i = 0; i < 3; ++i)
    if (!(weights[i] >= 0) || !std::isfinite(weights[i]))
      return option_error({"The weight ", names[i], " is ", weights[i], ", which is not zero or a positive finite number."},
                          {"Give the weights of curvature, slope and value as numbers from 0 up."});
  if (alpha == 0 && beta == 0)
    return option_error({"With alpha = 0 and beta = 0 nothing joins a point to its neighborhood."}, {"Give a positive alpha."});
  if (alpha == 0 && dimension > 1)
    return option_error({"With alpha = 0 every point can have a spike of its own at no cost, except in 1 dimension."},
                        {"Give a positive alpha; a small one makes steep but rounded peaks."});

  TensionKernel kernel;
  kernel.dimension_ = static_cast<int>(dimension);
  kernel.alpha_ = alpha;
  kernel.beta_ = beta;
  kernel.gamma_ = gamma;
  if (alpha == 0) {
    kernel.a_ = std::sqrt(gamma) / std::sqrt(beta);
  } else if (beta > 0 || gamma > 0) {
    const double sum = beta / alpha, ab = std::sqrt(gamma) / std::sqrt(alpha);  // a² + b², ab
    const double m = std::sqrt(sum / 4 + ab / 2);
    kernel.ab_ = ab;
    kernel.m_ = m;
    kernel.h2_ = sum / 4 - ab / 2;
    kernel.h_ = kernel.h2_ > 0 ? std::sqrt(kernel.h2_) : 0;
    kernel.b_ = kernel.h2_ < 0 ? std::sqrt(ab) : m + kernel.h_;
    kernel.a_ = ab / kernel.b_;  // m − h would cancel
    kernel.factor_ = 1 / (4 * alpha * m);
    if (gamma > 0) {  // ln(b/a)/(2mh): artanh and arctan are the same function of h²
      const double imaginary = kernel.h2_ < 0 ? std::sqrt(-kernel.h2_) : 0, part = 2 * kernel.h_ / kernel.a_;
      kernel.log_ratio_ = imaginary > 0 ? std::atan2(imaginary, m) / (imaginary * m) : log_one_plus_over(part) / (kernel.a_ * m);
    }
    // Every divisor must be in range, and so must the value at r = 0, which is the largest where there is no tail.
    const double scale = kernel.factor_ / (m * m);
    if (!(m * m * m > 0) || !(scale > 0) || !std::isfinite(scale) || !std::isfinite(m * m * m) || !std::isfinite(kernel.value(0)))
      return option_error(
          {"The weights alpha = ", alpha, ", beta = ", beta, " and gamma = ", gamma, " are out of all proportion to each other."},
          {"Set the smallest to 0, or rescale the points to ordinary numbers."});
  }
  return kernel;
}

Result<TensionKernel> TensionKernel::scaled(double scale, double factor) const {
  // ∫dx, ∇² and Δ² in the new units; δ changes as 1/∫dx.
  const double volume = dimension_ == 1 ? scale : dimension_ == 2 ? scale * scale : scale * scale * scale;
  const double squared = scale * scale, unit = 1 / (factor * volume);
  return create(alpha_ * (squared * squared * unit), beta_ * (squared * unit), gamma_ * unit, dimension_);
}

double TensionKernel::value(double r) const {
  if (alpha_ == 0) return gamma_ > 0 ? std::exp(-a_ * r) / (2 * beta_ * a_) : -r / (2 * beta_);
  if (m_ == 0) {
    if (dimension_ == 1) return r * r * r / (12 * alpha_);
    if (dimension_ == 2) return r > 0 ? r * r * std::log(r) / (8 * pi * alpha_) : 0;
    return -r / (8 * pi * alpha_);
  }
  if (h_ * r >= apart) {
    if (gamma_ > 0) return factor_ / h_ * (green(dimension_, a_, r) - green(dimension_, b_, r));
    const double br = b_ * r;
    if (dimension_ == 2) return -factor_ / (2 * pi * m_) * (std::log(br / 2) + euler_gamma + bessel_k0(br));
    return -factor_ * (br + exp_less_one(-br)) / (dimension_ == 1 ? 4 * m_ * m_ : 4 * pi * m_ * r);
  }
  const double mr = m_ * r;
  if (mr > underflow) return 0;
  if (dimension_ == 2) return b_ * r <= largest_for_series ? series(r).value : quadrature(r).value;
  const auto [cosh, sinhc, rest] = hyperbolic(h2_ * r * r);
  const double damped = factor_ * std::exp(-mr);
  if (gamma_ > 0) return dimension_ == 1 ? damped * (cosh + mr * sinhc) / ab_ : damped * sinhc / (2 * pi);
  return -damped * (mr * rest + sinhc) *
         (dimension_ == 1 ? r * r / 2 : mr / (2 * pi));  // m = h, from e^{−2x} = e⁻ˣ(cosh x − sinh x)
}

double TensionKernel::slope(double r) const {
  if (alpha_ == 0) return -std::exp(-a_ * r) / (2 * beta_);
  if (m_ == 0) {
    if (dimension_ == 1) return r * r / (4 * alpha_);
    if (dimension_ == 2) return r > 0 ? r * (2 * std::log(r) + 1) / (8 * pi * alpha_) : 0;
    return -1 / (8 * pi * alpha_);
  }
  if (h_ * r >= apart) return factor_ / h_ * (green_slope(dimension_, a_, r) - green_slope(dimension_, b_, r));
  const double mr = m_ * r;
  if (mr > underflow) return 0;
  if (dimension_ == 2) return b_ * r <= largest_for_series ? series(r).slope : quadrature(r).slope;
  const auto [cosh, sinhc, rest] = hyperbolic(h2_ * r * r);
  const double damped = factor_ * std::exp(-mr);
  return dimension_ == 1 ? -damped * r * sinhc : damped * (h2_ * r * rest - m_ * sinhc) / (2 * pi);
}

TensionKernel::Jet TensionKernel::series(double r) const {
  // The divided difference of K₀(2√x) = Σ xᵏ/k!² (ψₖ − ½ ln x), ψₖ = Hₖ − γ, between x_a = (ar/2)² and x_b = (br/2)², by
  //   [xᵏ ½ln x] = eₖ ln(br/2) + x_aᵏ [½ln x],   eₖ = [xᵏ] = (x_bᵏ − x_aᵏ)/(x_b − x_a),   eₖ₊₁ = x_b eₖ + x_aᵏ,
  // or, for a complex pair, with the mean ½(x_aᵏ + x_bᵏ) = Re xᵏ for x_aᵏ, Re x for x_b, and ½(ln x_a + ln x_b) for ln x_b.
  if (!(r > 0)) return {factor_ * m_ * log_ratio_ / pi, 0};
  const double quarter = r * r / 4;
  const bool pair = h2_ < 0;
  const double x = quarter * (pair ? m_ * m_ + h2_ : a_ * a_), y = pair ? x : quarter * b_ * b_;
  const double imaginary2 = pair ? -4 * m_ * m_ * h2_ * quarter * quarter : 0;  // (Im x)²
  const double log_half = std::log(b_ * r / 2);
  double power = 1, e = 0, psi = -euler_gamma, over_factorials = 1;
  Jet sum{log_ratio_ / 2, 0};
  for (int k = 1; k <= 14; ++k) {
    const double next = x * power - imaginary2 * e;
    e = y * e + power;
    power = next;
    psi += 1.0 / k;
    over_factorials /= k * k;
    const double term = over_factorials * (power * log_ratio_ / 2 + quarter * e * (log_half - psi));
    sum.value += term;
    sum.slope += (2 * k * term + over_factorials * quarter * e) / r;
  }
  const double scale = 2 * m_ * factor_ / pi;  // 1/(2πα)
  return {scale * sum.value, scale * sum.slope};
}

TensionKernel::Jet TensionKernel::quadrature(double r) const {
  // The divided differences of K₀(kr) and of kr K₁(kr) in bessel_k.hpp's form, e^{−z} times an integral of A^{∓½} with A = 2z + u².
  // Between A and B, those of a pair of nodes,
  //   mean A^{−½} = S/P,  [A^{−½}] = −1/(PS),  mean A^{½} = S,  [A^{½}] = 1/S,     P = √(AB), S = (√A + √B)/2
  // are real for a complex pair too, and exact for equal roots.
  double mean = 0, difference = 0, slope_mean = 0, slope_difference = 0;
  for (int j = 0; j < GaussianRule::nodes; ++j) {
    const double weight = gaussian_rule.weight[j], u2 = gaussian_rule.square[j];
    const double p = std::sqrt(4 * ab_ * r * r + 4 * m_ * r * u2 + u2 * u2);
    const double s2 = m_ * r + (u2 + p) / 2, s = std::sqrt(s2), part = weight / (p * s);
    mean += part * s2;
    difference += part;
    slope_mean += u2 * weight * s;
    slope_difference += u2 * part * p;
  }
  const auto [cosh, sinhc, rest] = hyperbolic(h2_ * r * r);
  const double scale = factor_ * std::exp(-m_ * r) / pi;
  return {scale * r * (sinhc * mean + cosh * difference), scale * (cosh * slope_difference - sinhc * slope_mean)};
}

}  // namespace handlebody
