#include "core/interpolation/rbf.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/interpolation/polynomial.hpp"
#include "core/interpolation/robust_fit.hpp"
#include "core/interpolation/width_choice.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {
namespace {

/** From this condition number on the report looks for a remedy. */
constexpr double ill_condition = 1e12;
/** A surface that misses its points by more than this part of the largest value is said to. */
constexpr double miss = 1e-6;
/** A kernel this narrow, in spacings, is said to be. */
constexpr double narrow = 0.3;
constexpr const char* or_smoothing = ", or give a smoothing above 0";

Error option_error(std::initializer_list<Word> message, std::initializer_list<Word> remedy) {
  return {HB_ERROR_INVALID_OPTION, message, remedy, HB_CULPRIT_OPTION};
}

Result<Done> check_options(const RbfOptions& options, Index points, Index dimension) {
  const Matrix& centers = options.centers;
  const auto valid = [](double lambda) { return lambda >= 0 && std::isfinite(lambda); };
  if (!valid(options.smoothing) || !valid(options.weight_decay))
    return option_error({"Smoothing or weight decay is not zero or a positive finite number."},
                        {"Leave them out, or use a small positive number."});
  if (options.smoothing > 0 && options.weight_decay > 0)
    return option_error({"Both smoothing and weight decay are asked for."}, {"Use one of the two."});
  if (options.robust != RobustMethod::none && centers.rows() == 0)
    return option_error({"A robust fit needs fewer centers than points: with a center at each it would pass through all of them."},
                        {"Give centers, or leave out robust and look for bad points with findOutliers()."});
  if (centers.rows() == 0) return Done{};
  if (options.smoothing > 0)
    return option_error({"Smoothing needs a center at each point; these are others."}, {"Use weightDecay instead of smoothing."});
  if (centers.cols() != dimension)
    return option_error({"The centers have ", centers.cols(), " coordinates, the points ", dimension, "."},
                        {"Give centers in the space of the points."});
  for (Index i = 0; i < centers.rows(); ++i)
    if (!centers.row(i).allFinite())
      return Error(HB_ERROR_POINT_NOT_FINITE, {"Center ", i, " is not finite."}, {"Remove NaN and infinite coordinates."},
                   HB_CULPRIT_CENTER, i);
  if (centers.rows() > points && options.weight_decay == 0)
    return Error(HB_ERROR_POINTS_TOO_FEW, {points, " points do not determine ", centers.rows(), " centers."},
                 {"Use at most ", points, " centers, or a weightDecay above 0."});
  return Done{};
}

/** Names the point and the center between which a caller's kernel gave no number. */
Error kernel_error(RadialBasis& basis, const Matrix& points) {
  Vector row(basis.size());
  for (Index i = 0; i < points.rows(); ++i) {
    basis.values(&points(i, 0), row.data());
    for (Index k = 0; k < basis.centers(); ++k)
      if (!std::isfinite(row[k]))
        return {HB_ERROR_KERNEL_FAILED,
                {"The kernel gives ", row[k], " between point ", i, " and center ", k, "."},
                {"Return a finite number for every distance from 0 on."},
                HB_CULPRIT_POINT,
                i};
  }
  return {HB_ERROR_KERNEL_FAILED, {"The kernel gives numbers that are too large."}, {"Scale it down."}};
}

}  // namespace

Result<ScatteredData> check_in_metric(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                      MatrixXd& metric, Coincident coincident) {
  const Index d = points.cols();
  if (metric.size() == 0) {
    auto data = check_data(points, values, coincident, nullptr, or_smoothing);
    if (!data) return data;
    auto measures = comparable_axes(data->points);
    if (!measures) return measures.error();
    if (measures->size() != 0) metric = measures->cwiseAbs2().asDiagonal();
    return data;
  }
  const auto root = metric_root(metric, d);
  if (!root) return root.error();
  Matrix places(points.rows(), d);
  for (Index i = 0; i < points.rows(); ++i)
    for (Index row = 0; row < d; ++row) {
      places(i, row) = 0;
      for (Index axis = row; axis < d; ++axis) places(i, row) += (*root)(row, axis) * points(i, axis);
    }
  return check_data(points, values, coincident, &places, or_smoothing);
}

Result<Done> check_size(double points, double centers, double polynomials) {
  const double size = centers + polynomials;
  const double bytes = 8 * size * std::max(size, points);
  if (bytes <= largest_matrix_bytes) return Done{};
  return Error(HB_ERROR_OUT_OF_MEMORY,
               {points, " points with ", centers, " centers make a dense matrix of ", bytes / largest_matrix_bytes,
                " GiB; 1 GiB is the most that is allocated."},
               {"Give fewer centers than points, use a part of the points, or a method without a matrix, such as shepard()."});
}

Rbf::Rbf(Rbf&&) noexcept = default;
Rbf& Rbf::operator=(Rbf&&) noexcept = default;
Rbf::~Rbf() = default;

Result<Rbf> Rbf::create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values, const RbfOptions& given) {
  const auto count = static_cast<double>(points.rows());
  const auto center_count = static_cast<double>(given.centers.rows());
  const auto tail = static_cast<double>(polynomial_count(std::clamp(given.basis.degree, -1, 2), points.cols()));
  if (auto fits = check_size(count, center_count > 0 ? center_count : count, tail); !fits) return fits.error();
  if (auto valid = check_options(given, points.rows(), points.cols()); !valid) return valid.error();
  const bool interpolates = given.smoothing == 0 && given.weight_decay == 0 && given.centers.rows() == 0;
  RbfOptions options = given;
  auto data = check_in_metric(points, values, options.basis.metric, interpolates ? Coincident::merge : Coincident::keep);
  if (!data) return data.error();

  if (!options.basis.kernel.has_width()) options.width_choice = WidthChoice::given;
  if (options.width_choice == WidthChoice::spacing) options.basis.kernel.width = spacing_width(data->points, options.basis);
  if (options.width_choice == WidthChoice::leave_one_out) options.basis.kernel.width = leave_one_out_width(*data, options);
  options.width_choice = WidthChoice::given;

  if (interpolates && options.basis.widths.size() == data->given && data->given > data->points.rows()) {
    for (std::size_t k = 0; k < data->kept.size(); ++k)
      options.basis.widths[static_cast<Index>(k)] = options.basis.widths[data->kept[k]];
    options.basis.widths.conservativeResize(data->points.rows());
  }
  auto basis = RadialBasis::create(data->points, options.centers.rows() ? options.centers : data->points, options.basis);
  if (!basis) return basis.error();
  Rbf rbf(std::move(*data), std::move(*basis), options);
  if (!std::isfinite(rbf.fit_->norm())) return kernel_error(rbf.basis_, rbf.data_.points);
  if (!rbf.coefficients_.allFinite()) {
    constexpr hb_status code = HB_ERROR_SYSTEM_SINGULAR;
    constexpr const char* message = "The interpolation equations are singular in double precision.";
    const double smoothing = options.advised ? rbf.enough_smoothing() : 0;
    if (smoothing > 0) return Error(code, {message}, {"Use a smoothing of ", smoothing, " or more."});
    const double decay = options.advised ? rbf.enough_decay() : 0;
    if (decay > 0) return Error(code, {message}, {"Use a weightDecay of ", decay, " or more."});
    return Error(code, {message}, {"Use another kernel, or points that lie farther apart."});
  }
  return rbf;
}

Rbf::Rbf(ScatteredData data, RadialBasis basis, const RbfOptions& options)
    : Interpolant(std::move(data)),
      basis_(std::move(basis)),
      options_(options),
      row_(basis_.size()),
      gradients_(basis_.size(), basis_.dimension()),
      slope_(std::max(data_.points.rows(), data_.values.cols())) {
  const Matrix& points = data_.points;
  if (options_.centers.rows() == 0 && options_.weight_decay == 0) {
    fit_ = fit_interpolant(basis_, points, options_.smoothing);
  } else {
    const Matrix& centers = options_.centers.rows() ? options_.centers : points;
    if (options_.robust != RobustMethod::none) {
      const MatrixXd design = design_matrix(basis_, points, centers);
      row_weights_ = options_.robust == RobustMethod::least_median ? least_median_weights(design, data_.values)
                                                                   : least_absolute_weights(design, data_.values);
    }
    fit_ = fit_least_squares(basis_, points, centers, options_.weight_decay, row_weights_);
  }
  coefficients_ = fit_->coefficients(data_.values);
}

void Rbf::evaluate(const double* queries, Index count, double* out) {
  basis_.combine(coefficients_, queries, count, out);
}

void Rbf::gradient(const double* queries, Index count, double* out) {
  const Index d = dimension(), m = outputs();
  for (Index q = 0; q < count; ++q, queries += d, out += m * d) {
    basis_.gradients(queries, gradients_.data());
    multiply_gradients(coefficients_, out);
  }
}

/** Gradients (rows×d, row-major) of the functions with these coefficients, from those of the basis. */
void Rbf::multiply_gradients(const MatrixXd& coefficients, double* out) {
  const Index d = dimension(), rows = coefficients.rows();
  for (Index axis = 0; axis < d; ++axis) {
    multiply(coefficients, gradients_.col(axis), slope_.head(rows));
    for (Index j = 0; j < rows; ++j) out[j * d + axis] = slope_[j];
  }
}

const MatrixXd& Rbf::cardinal() {
  if (cardinal_.size() == 0) {
    const Index n = data_.points.rows();
    cardinal_ = fit_->coefficients(Matrix::Identity(n, n));
  }
  return cardinal_;
}

void Rbf::weigh(const double* query, double* w, double* slopes) {
  basis_.values(query, row_.data());
  multiply(cardinal(), row_, Eigen::Map<Vector>(w, data_.points.rows()));
  if (!slopes) return;
  basis_.gradients(query, gradients_.data());
  multiply_gradients(cardinal_, slopes);
}

Matrix Rbf::kernel_coefficients() const {
  const bool own = options_.centers.rows() != 0;
  Matrix result = Matrix::Zero(own ? basis_.centers() : size(), outputs());
  for (Index i = 0; i < basis_.centers(); ++i)
    for (Index j = 0; j < outputs(); ++j) result(own ? i : data_.kept[i], j) = basis_.amplitude_of_scale() * coefficients_(j, i);
  return result;
}

Vector Rbf::row_weights() const {
  return row_weights_.size() ? row_weights_ : Vector::Ones(size());
}

Result<Matrix> Rbf::leave_one_out() {
  if (basis_.normalized())
    return option_error({"A normalized basis changes with every point, so leaving one out takes a new fit each."},
                        {"Use a kernel that is not normalized."});
  if (row_weights_.size())
    return option_error({"A robust fit is not linear in the data, so leaving a point out takes a new fit each."},
                        {"Leave out `robust`."});
  const Index n = data_.points.rows(), m = outputs();
  Matrix kept(n, m);
  const bool saddle = options_.centers.rows() == 0 && options_.weight_decay == 0;
  Vector w(n), fitted(m);
  for (Index i = 0; i < n; ++i) {
    if (saddle) {
      for (Index j = 0; j < m; ++j) kept(i, j) = coefficients_(j, i) / cardinal()(i, i);
      continue;
    }
    weigh(&data_.points(i, 0), w.data(), nullptr);
    evaluate(&data_.points(i, 0), 1, fitted.data());
    for (Index j = 0; j < m; ++j) kept(i, j) = (data_.values(i, j) - fitted[j]) / (1 - w[i]);
  }
  Matrix errors = Matrix::Zero(size(), m);
  for (Index i = 0; i < n; ++i) errors.row(data_.kept[i]) = kept.row(i);
  for (Index i = 0; i < size(); ++i) {
    const std::uint32_t twin = data_.twin_of[i];
    if (static_cast<Index>(twin) != i) errors.row(twin).setZero();
  }
  return errors;
}

Matrix Rbf::fitted() {
  if (const auto known = fit_->fitted(coefficients_)) return *known;
  Matrix values(data_.points.rows(), outputs());
  evaluate(data_.points.data(), values.rows(), values.data());
  return values;
}

RbfReport Rbf::report() {
  RbfReport report;
  const Index n = data_.points.rows();
  report.condition = fit_->condition();
  report.residual = (fitted() - data_.values).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  report.spacing = n > 1 ? nearest_distances(basis_.to_inner(data_.points)).mean() / basis_.scale() : 0;
  report.least_width = basis_.widths().minCoeff();
  report.largest_width = basis_.widths().maxCoeff();
  const bool one_width =
      basis_.kernel().has_width() && basis_.kernel().kind != KernelKind::clamped_plate && options_.basis.widths.size() == 0;
  if (report.condition <= ill_condition && report.residual <= miss * data_.values.cwiseAbs().maxCoeff()) {
    if (!one_width || !(report.least_width < narrow * report.spacing)) return report;
    RbfOptions wider = options_;
    wider.basis.kernel.width = 2 * report.spacing;
    report.suggested_width =
        well_conditioned(data_, wider, ill_condition / 1e3) ? 2 * report.spacing : comfortable_width(data_, wider);
    return report;
  }
  if (one_width) report.suggested_width = comfortable_width(data_, options_);
  report.suggested_smoothing = enough_smoothing();
  if (report.suggested_smoothing == 0) report.suggested_decay = enough_decay();
  return report;
}

/** The first of a few powers of ten from `start` on with which the fit is well conditioned; 0 where none is. */
double Rbf::enough(double start, double RbfOptions::*option) const {
  RbfOptions options = options_;
  if (!std::isfinite(start) || !(start > 0)) return 0;
  double power = std::ceil(std::log(start) / std::log(10.0) - 1e-9);
  for (int trial = 0; trial < 8; ++trial, ++power) {
    options.*option = std::exp(power * std::log(10.0));
    if (options.*option > options_.*option && well_conditioned(data_, options, ill_condition / 100)) return options.*option;
  }
  return 0;
}

double Rbf::enough_smoothing() const {
  // R + λI has a condition number of about ‖R‖/λ.
  if (options_.centers.rows() != 0 || options_.weight_decay != 0) return 0;
  return enough(fit_->norm() / comfortable_condition / basis_.amplitude_of_scale(), &RbfOptions::smoothing);
}

double Rbf::enough_decay() const {
  if (options_.smoothing != 0) return 0;
  const double root = fit_->norm() / comfortable_condition / basis_.amplitude_of_scale();
  return enough(root * root, &RbfOptions::weight_decay);
}

}  // namespace handlebody
