#include "core/interpolation/shepard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/elementary.hpp"
#include "core/numerics/safe_norm.hpp"

namespace handlebody {
namespace {

constexpr double huge = 1e300;  // stands for infinity: quotients and products with weights stay numbers

}  // namespace

Result<Shepard> Shepard::create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                const ShepardOptions& options) {
  if (!(options.power > 0) || !std::isfinite(options.power))
    return Error(HB_ERROR_INVALID_OPTION, {"The power ", options.power, " is not a positive finite number."},
                 {"Use 2 for smooth flat spots at the points, 1 for cusps."}, HB_CULPRIT_OPTION);
  if (!(options.epsilon >= 0) || !std::isfinite(options.epsilon))
    return Error(HB_ERROR_INVALID_OPTION, {"Epsilon is ", options.epsilon, ", which is not zero or a positive finite number."},
                 {"Use 0 to interpolate, or a small part of the points' spacing."}, HB_CULPRIT_OPTION);
  auto data = check_data(points, values, options.epsilon > 0 ? Coincident::keep : Coincident::merge, nullptr,
                         ", or give an epsilon above 0");
  if (!data) return data.error();
  return Shepard(std::move(*data), options);
}

void Shepard::weigh(const double* query, double* w, double* slopes) {
  const Index n = data_.points.rows(), d = dimension();
  const double p = options_.power, unit = data_.diagonal > 0 ? data_.diagonal : 1;  // of all lengths below
  const double* const points = data_.points.data();                                 // plain memory: this file is compiled for size
  double nearest = std::numeric_limits<double>::infinity();
  Index own = 0;
  for (Index k = 0; k < n; ++k) {
    w[k] = std::min((safe_distance(query, points + k * d, d) + options_.epsilon) / unit, huge);
    if (w[k] < nearest) nearest = w[own = k];
  }
  if (slopes) std::fill(slopes, slopes + n * d, 0.0);
  const bool at_point = safe_distance(query, points + own * d, d) == 0;
  if (slopes && data_.diagonal > 0 && at_point && (p <= 1 || nearest > 0)) {
    std::fill(slopes, slopes + n * d, std::numeric_limits<double>::quiet_NaN());
    slopes = nullptr;
  }
  if (!(nearest > 0)) {  // at a point, where the weights are its own and, for p > 1, flat
    std::fill(w, w + n, 0.0);
    w[own] = 1;
    return;
  }
  if (slopes)  // ∇ ln wₖ = −p/(r + ε) · (x − xₖ)/r
    for (Index k = 0; k < n; ++k) {
      const double* point = points + k * d;
      const double r = safe_distance(query, point, d), steepness = std::min(p / w[k], huge);
      for (Index axis = 0; r > 0 && std::isfinite(r) && axis < d; ++axis)
        slopes[k * d + axis] = -steepness * ((query[axis] - point[axis]) / r);
    }
  inverse_powers(w, n, nearest, p);  // relative to the nearest: no overflow
  double others = 0;
  for (Index k = 0; k < n; ++k)
    if (k != own) others += w[k];
  for (Index k = 0; k < n; ++k) w[k] /= 1 + others;
  others /= 1 + others;
  if (!slopes) return;
  // With wₖ for wₖ/Σw from here on, ∇wₖ = wₖ (∇ ln wₖ − Σⱼ wⱼ ∇ ln wⱼ). Near a point its own ∇ ln w is as steep as p/r but almost
  // cancels: 1 − w there is computed as the sum of the others.
  for (Index axis = 0; axis < d; ++axis) {
    double mean = 0;
    for (Index k = 0; k < n; ++k)
      if (k != own) mean += w[k] * slopes[k * d + axis];
    const double steep = slopes[own * d + axis];
    for (Index k = 0; k < n; ++k) {
      double& slope = slopes[k * d + axis];
      slope = w[k] * ((k == own ? others * steep : slope - w[own] * steep) - mean) / unit;
    }
  }
}

}  // namespace handlebody
