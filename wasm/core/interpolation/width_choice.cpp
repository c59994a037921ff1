#include "core/interpolation/width_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

constexpr Index most_points = 256;
constexpr double largest_condition = 1e13;

/** Scale and metric of the points alone. Not where the metric is at fault: the real fit will say so. */
Result<RadialBasis> frame_of(const Matrix& points, const MatrixXd& metric) {
  RadialBasisOptions options;
  options.metric = metric;
  return RadialBasis::create(points, points.topRows(1), options);
}

/** At most 256 of the points, taken evenly from their order by coordinates: the same ones in whatever order they are given. */
ScatteredData thinned(const ScatteredData& data) {
  const Index n = data.points.rows();
  if (n <= most_points) return data;
  const Matrix& points = data.points;
  const Indices order = sorted_indices(n, [&](std::uint32_t a, std::uint32_t b) {
    for (Index axis = 0; axis < points.cols(); ++axis)
      if (points(a, axis) != points(b, axis)) return points(a, axis) < points(b, axis);
    return false;
  });
  ScatteredData some;
  some.points.resize(most_points, points.cols());
  some.values.resize(most_points, data.values.cols());
  for (Index i = 0; i < most_points; ++i) {
    const std::uint32_t from = order[i * n / most_points];
    some.points.row(i) = points.row(from);
    some.values.row(i) = data.values.row(from);
  }
  return some;
}

Result<Rbf> fit_with(const ScatteredData& data, RbfOptions options, double width) {
  options.width_choice = WidthChoice::given;
  options.advised = false;
  options.basis.kernel.width = width;
  return Rbf::create(data.points, data.values, options);
}

/** Sum of squared leave-one-out errors; infinite where the fit cannot be trusted. */
double leave_one_out_error(const ScatteredData& data, const RbfOptions& options, double width) {
  constexpr double useless = std::numeric_limits<double>::infinity();
  auto rbf = fit_with(data, options, width);
  if (!rbf || !(rbf->fit().condition() <= largest_condition)) return useless;
  const auto errors = rbf->leave_one_out();
  if (!errors) return useless;
  const double sum = errors->squaredNorm();
  return std::isfinite(sum) ? sum : useless;
}

}  // namespace

double metric_spacing(const Matrix& points, const MatrixXd& metric) {
  const auto frame = frame_of(points, metric);
  return frame && points.rows() > 1 ? nearest_distances(frame->to_inner(points)).mean() / frame->scale() : 0;
}

double spacing_width(const Matrix& points, const RadialBasisOptions& options) {
  if (options.kernel.kind == KernelKind::custom || points.rows() < 2) return 1;
  if (options.kernel.kind == KernelKind::clamped_plate) {
    const auto frame = frame_of(points, options.metric);
    if (!frame) return 1;
    const Matrix inner = frame->to_inner(points);
    const double radius = std::sqrt(inner.rowwise().squaredNorm().maxCoeff()) / frame->scale();
    return radius > 0 ? 1.5 * radius : 1;
  }
  double factor = 2;
  switch (options.kernel.kind) {
    case KernelKind::multiquadric:
      factor = 1;
      break;
    case KernelKind::wendland_c0:
    case KernelKind::wendland_c2:
    case KernelKind::wendland_c4:
    case KernelKind::buhmann:
      factor = 5;
      break;
    default:
      break;
  }
  const double spacing = metric_spacing(points, options.metric);
  return spacing > 0 ? factor * spacing : 1;
}

double leave_one_out_width(const ScatteredData& data, const RbfOptions& options) {
  const ScatteredData some = thinned(data);
  const double start = spacing_width(some.points, options.basis);
  if (some.points.rows() < 3) return start;
  const auto error_at = [&](double log_width) { return leave_one_out_error(some, options, start * std::exp(log_width)); };

  constexpr double step = 0.34657359027997264;  // ln √2
  double best = 0, least = error_at(0);
  for (int k = -6; k <= 8; ++k) {
    if (k == 0) continue;
    const double error = error_at(k * step);
    if (error < least) {
      least = error;
      best = k * step;
    }
  }
  if (!std::isfinite(least)) return start;
  constexpr double golden = 0.61803398874989485;
  double low = best - step, high = best + step;
  double inner_low = high - golden * (high - low), inner_high = low + golden * (high - low);
  double error_low = error_at(inner_low), error_high = error_at(inner_high);
  for (int round = 0; round < 8; ++round) {
    if (error_low <= error_high) {
      high = inner_high;
      inner_high = inner_low;
      error_high = error_low;
      error_low = error_at(inner_low = high - golden * (high - low));
    } else {
      low = inner_low;
      inner_low = inner_high;
      error_low = error_high;
      error_high = error_at(inner_high = low + golden * (high - low));
    }
  }
  const double refined = error_low <= error_high ? inner_low : inner_high;
  return start * std::exp(std::min(error_low, error_high) < least ? refined : best);
}

bool well_conditioned(const ScatteredData& data, const RbfOptions& options, double limit) {
  const ScatteredData some = thinned(data);
  RbfOptions few = options;
  if (few.basis.widths.size() > some.points.rows() && few.centers.rows() == 0)
    few.basis.widths = few.basis.widths.head(some.points.rows()).eval();
  const auto rbf = fit_with(some, few, options.basis.kernel.width);
  return rbf && rbf->fit().condition() <= limit;
}

double comfortable_width(const ScatteredData& data, const RbfOptions& options) {
  const ScatteredData some = thinned(data);
  const double width = options.basis.kernel.width;
  const auto comfortable = [&](double candidate) {
    const auto rbf = fit_with(some, options, candidate);
    return rbf && rbf->fit().condition() <= comfortable_condition;
  };
  double low = std::log(width) - 12, high = std::log(width);
  if (!comfortable(std::exp(low))) return 0;
  for (int round = 0; round < 12; ++round) {
    const double middle = (low + high) / 2;
    (comfortable(std::exp(middle)) ? low : high) = middle;
  }
  return std::exp(low);
}

}  // namespace handlebody
