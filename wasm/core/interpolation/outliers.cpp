#include "core/interpolation/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/interpolation/width_choice.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

/** The scores of the points that were kept. */
Vector score(Rbf& rbf, OutlierMethod method) {
  const ScatteredData& data = rbf.data();
  const Index n = data.points.rows(), m = data.values.cols();
  const Matrix coefficients = rbf.kernel_coefficients();
  const double sign = rbf.basis().kernel().sign();
  Vector squares = Vector::Zero(n), row(rbf.basis().size()), fitted(m);
  RadialBasis basis = rbf.basis();
  for (Index i = 0; i < n; ++i) {
    if (method == OutlierMethod::leave_one_out) {
      const double inverse = sign * basis.amplitude_of_scale() * rbf.cardinal()(i, i);  // in the caller's units, as c
      const double c = coefficients.row(data.kept[i]).norm();
      squares[i] = c * c / inverse;
    } else if (method == OutlierMethod::row_sum) {
      basis.values(&data.points(i, 0), row.data());
      for (Index j = 0; j < m; ++j) {
        double sum = 0;
        for (Index k = 0; k < n; ++k) sum += (k == i ? 0.5 : 1) * row[k] * coefficients(data.kept[k], j);
        squares[i] += sign * coefficients(data.kept[i], j) * sum / basis.amplitude_of_scale();
      }
    } else {
      rbf.evaluate(&data.points(i, 0), 1, fitted.data());
      squares[i] = (data.values.row(i).transpose() - fitted).squaredNorm();
    }
  }
  for (double& number : squares) number = number > 0 ? std::sqrt(number) : -std::sqrt(-number);  // a row's part can be negative
  return squares;
}

double median(const Vector& numbers) {
  const auto before = [&](std::uint32_t a, std::uint32_t b) { return numbers[a] != numbers[b] ? numbers[a] < numbers[b] : a < b; };
  const Indices order = sorted_indices(numbers.size(), before);
  const std::size_t half = order.size() / 2;
  return order.size() % 2 ? numbers[order[half]] : (numbers[order[half - 1]] + numbers[order[half]]) / 2;
}

Result<Rbf> fit(const ScatteredData& data, const std::vector<std::uint32_t>& in, RbfOptions& options) {
  Matrix points(std::ssize(in), data.points.cols()), values(points.rows(), data.values.cols());
  for (std::size_t k = 0; k < in.size(); ++k) {
    points.row(static_cast<Index>(k)) = data.points.row(in[k]);
    values.row(static_cast<Index>(k)) = data.values.row(in[k]);
  }
  return Rbf::create(points, values, options);
}

/** λ that makes the fit a compromise between neighbors. */
double automatic_smoothing(const Matrix& points, const RadialBasisOptions& basis) {
  const Kernel& kernel = basis.kernel;
  if (kernel.has_width()) return 0.5;  // of φ(0) = 1
  const double spacing = points.rows() > 1 ? metric_spacing(points, basis.metric) : 1;
  double lambda = 1;
  for (int e = kernel.homogeneity(); e > 0; --e) lambda *= spacing;
  return lambda;
}

}  // namespace

Result<OutlierReport> find_outliers(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                    const RbfOptions& given, const OutlierOptions& options) {
  if (!(options.threshold > 0) || !std::isfinite(options.threshold))
    return Error(HB_ERROR_INVALID_OPTION, {"The threshold ", options.threshold, " is not a positive finite number."},
                 {"Give it in robust standard deviations, such as 4."}, HB_CULPRIT_OPTION);
  if (given.centers.rows() || given.basis.normalized || given.weight_decay > 0)
    return Error(HB_ERROR_INVALID_OPTION,
                 {"Outliers are looked for with a kernel at each point, not normalized, without weight decay."},
                 {"Leave out centers, normalized and weightDecay."}, HB_CULPRIT_OPTION);
  RbfOptions rbf_options = given;
  const bool automatic = given.smoothing < 0;
  if (automatic) rbf_options.smoothing = 0;
  auto data =
      check_in_metric(points, values, rbf_options.basis.metric, rbf_options.smoothing > 0 ? Coincident::keep : Coincident::merge);
  if (!data) return data.error();
  if (automatic) rbf_options.smoothing = automatic_smoothing(data->points, rbf_options.basis);

  OutlierReport report;
  report.smoothing = rbf_options.smoothing;
  report.scores = Vector::Zero(data->given);
  std::vector<std::uint32_t> in(data->kept.size());
  for (std::size_t k = 0; k < in.size(); ++k) in[k] = static_cast<std::uint32_t>(k);
  const double spread = (values.colwise().maxCoeff() - values.colwise().minCoeff()).maxCoeff();
  for (bool first = true;; first = false) {
    auto rbf = fit(*data, in, rbf_options);
    if (!rbf) {
      if (first) return rbf.error();
      break;  // too few are left for the tail
    }
    if (first && rbf_options.width_choice != WidthChoice::given) {  // the width of all points serves throughout
      rbf_options.basis.kernel.width = rbf->basis().kernel().width;
      rbf_options.width_choice = WidthChoice::given;
    }
    const Vector scores = score(*rbf, options.method);
    if (first)
      for (std::size_t k = 0; k < in.size(); ++k) report.scores[data->kept[k]] = scores[static_cast<Index>(k)];
    if (in.size() < 4 || std::ssize(report.outliers) >= options.most) break;
    Index highest = 0;
    scores.maxCoeff(&highest);
    const double middle = median(scores);
    const double deviation = std::max(1.4826 * median((scores.array() - middle).abs()), 1e-9 * spread);
    const double height = (scores[highest] - middle) / deviation;
    if (!(height > options.threshold)) break;
    report.outliers.push_back(data->kept[in[highest]]);
    report.outlier_scores.push_back(height);
    in.erase(in.begin() + highest);
  }
  return report;
}

}  // namespace handlebody
