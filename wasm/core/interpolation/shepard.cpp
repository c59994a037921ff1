#include "core/interpolation/shepard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace handlebody {

Result<Shepard> Shepard::create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                const ShepardOptions& options) {
  if (!(options.power > 0) || !std::isfinite(options.power))
    return Error(HB_ERROR_INVALID_OPTION, {"The power ", options.power, " is not a positive finite number."},
                 {"Use 2 for smooth flat spots at the points, 1 for cusps."}, HB_CULPRIT_OPTION);
  if (!(options.epsilon >= 0) || !std::isfinite(options.epsilon))
    return Error(HB_ERROR_INVALID_OPTION, {"Epsilon is ", options.epsilon, ", which is not zero or a positive finite number."},
                 {"Use 0 to interpolate, or a small part of the points' spacing."}, HB_CULPRIT_OPTION);
  auto data = check_data(points, values, options.epsilon > 0 ? Coincident::keep : Coincident::merge);
  if (!data) return data.error();
  return Shepard(std::move(*data), options);
}

void Shepard::weigh(const double* query, double* w, double* slopes) {
  const Index n = data_.points.rows(), d = dimension();
  const double p = options_.power;
  double nearest = std::numeric_limits<double>::infinity();
  Index own = 0;
  for (Index k = 0; k < n; ++k) {
    double squared = 0;
    for (Index axis = 0; axis < d; ++axis) {
      const double apart = query[axis] - data_.points(k, axis);
      squared += apart * apart;
    }
    w[k] = std::sqrt(squared) + options_.epsilon;
    if (w[k] < nearest) nearest = w[own = k];
  }
  if (slopes) std::fill(slopes, slopes + n * d, 0.0);
  if (!(nearest > 0)) {  // at a point, where the weights are its own and, for p > 1, flat
    std::fill(w, w + n, 0.0);
    w[own] = 1;
    if (slopes && p <= 1) std::fill(slopes, slopes + n * d, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  double sum = 0;
  if (slopes)  // ∇ ln wₖ = −p (x − xₖ) / (r (r + ε)), which the quotient below turns into the weight's own
    for (Index k = 0; k < n; ++k) {
      const double r = w[k] - options_.epsilon;
      for (Index axis = 0; r > 0 && axis < d; ++axis)
        slopes[k * d + axis] = -p * (query[axis] - data_.points(k, axis)) / (r * w[k]);
    }
  for (Index k = 0; k < n; ++k) sum += w[k] = std::exp(p * std::log(nearest / w[k]));  // relative to the nearest: no overflow
  for (Index k = 0; k < n; ++k) w[k] /= sum;
  if (!slopes) return;
  for (Index axis = 0; axis < d; ++axis) {  // ∇(wₖ/Σw) = wₖ/Σw · (∇ ln wₖ − Σⱼ wⱼ/Σw ∇ ln wⱼ)
    double mean = 0;
    for (Index k = 0; k < n; ++k) mean += w[k] * slopes[k * d + axis];
    for (Index k = 0; k < n; ++k) slopes[k * d + axis] = w[k] * (slopes[k * d + axis] - mean);
  }
}

}  // namespace handlebody
