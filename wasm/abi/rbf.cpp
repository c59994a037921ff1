#include "core/interpolation/rbf.hpp"

#include <algorithm>
#include <cmath>

#include "abi/host_kernel.hpp"
#include "abi/interpolant.hpp"
#include "abi/memory.hpp"
#include "core/interpolation/outliers.hpp"
#include "core/interpolation/polynomial.hpp"

using namespace handlebody;

namespace {

int32_t fail_not_rbf() {
  return fail({HB_ERROR_INVALID_OPTION, {"This interpolant is not a radial basis fit."}, {"Ask one that rbf() made."}});
}

/** Checks all that is counted, the options' arrays among it. */
int32_t check_given(const GivenData& data, const hb_rbf_options& options, hb_interpolant** out) {
  if (const int32_t status = check_given(data, out)) return status;
  return check_arrays({{options.centers, "centers", options.centers ? options.center_count : 0, data.dimension},
                       {options.widths, "widths", options.widths ? options.center_count : 0}});
}

/** The options as the core takes them; INVALID_OPTION for numbers without a meaning. */
Result<RbfOptions> read_options(const hb_rbf_options& from, uint32_t dimension) {
  if (from.kernel > static_cast<unsigned>(KernelKind::custom) || from.width_choice >= width_choice_count ||
      from.robust >= robust_method_count)
    return Error(HB_ERROR_INVALID_OPTION, {"The number of a kernel, a width choice or a robust method is unknown."},
                 {"Use those that the header lists."}, HB_CULPRIT_OPTION);
  RbfOptions options;
  const auto kind = static_cast<KernelKind>(from.kernel);
  options.basis.kernel = Kernel::of(kind, from.width, dimension, from.order);
  options.basis.kernel.support = from.support;
  if (kind == KernelKind::custom)  // whether it is definite is unknown: the caller decides on the tail
    options.basis.kernel.custom = host_kernel(from.host_kernel);
  options.basis.order = from.order;
  options.basis.degree = from.degree;
  options.basis.normalized = from.normalized != 0;
  options.smoothing = from.smoothing;
  options.weight_decay = from.weight_decay;
  options.width_choice = static_cast<WidthChoice>(from.width_choice);
  options.robust = static_cast<RobustMethod>(from.robust);
  if (from.centers)
    options.centers = Eigen::Map<const Matrix>(from.centers, static_cast<Index>(from.center_count), static_cast<Index>(dimension));
  if (from.widths) options.basis.widths = Eigen::Map<const Vector>(from.widths, static_cast<Index>(from.center_count));
  if (from.metric)
    options.basis.metric = Eigen::Map<const Matrix>(from.metric, static_cast<Index>(dimension), static_cast<Index>(dimension));
  return options;
}

/** Pairs of points closer than a thousandth of the mean spacing, in the metric of the fit. */
void list_near_pairs(const Rbf& rbf, double spacing, hb_rbf_report& report) {
  const ScatteredData& data = rbf.data();
  const Matrix inner = rbf.basis().to_inner(data.points);
  const double least = spacing * rbf.basis().scale() * 1e-3, limit = least * least;
  const Index d = inner.cols();
  const double* a = inner.data();
  constexpr uint32_t most = sizeof report.near_pairs / sizeof report.near_pairs[0] / 2;
  for (Index i = 0; i < data.points.rows(); ++i) {
    for (Index j = 0; j < i; ++j) {
      double squared = 0;
      for (Index axis = 0; axis < d; ++axis) squared += (a[i * d + axis] - a[j * d + axis]) * (a[i * d + axis] - a[j * d + axis]);
      if (!(squared < limit)) continue;
      if (report.near_count < most) {
        report.near_pairs[2 * report.near_count] = data.kept[j];
        report.near_pairs[2 * report.near_count + 1] = data.kept[i];
      }
      ++report.near_count;
    }
  }
}

}  // namespace

extern "C" {

int32_t hb_rbf_check_size(uint32_t count, uint32_t dimension, uint32_t center_count, int32_t degree) {
  if (const int32_t status = check_dimension(dimension)) return status;
  const auto tail = polynomial_count(std::clamp(degree, -1, 2), static_cast<Index>(dimension));
  auto fits = check_size(count, center_count ? center_count : count, static_cast<double>(tail));
  return fits ? HB_OK : fail(fits.error());
}

int32_t hb_rbf_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs,
                      const hb_rbf_options* options, hb_interpolant** out) {
  handlebody::making();
  const GivenData data{points, values, count, dimension, outputs};
  if (const int32_t status = check_given(data, *options, out)) return status;
  auto read = read_options(*options, dimension);
  if (!read) return fail(read.error());
  return deliver(Rbf::create(data.point_rows(), data.value_rows(), *read), out);
}

int32_t hb_rbf_get_report(hb_interpolant* interpolant, hb_rbf_report* out) {
  handlebody::changing(interpolant);
  if (!interpolant->rbf) return fail_not_rbf();
  Rbf& rbf = *interpolant->rbf;
  const RbfReport from = rbf.report();
  hb_rbf_report report{};
  report.condition = from.condition;
  report.residual = from.residual;
  report.spacing = from.spacing;
  report.least_width = from.least_width;
  report.largest_width = from.largest_width;
  report.suggested_width = from.suggested_width;
  report.suggested_smoothing = from.suggested_smoothing;
  report.suggested_decay = from.suggested_decay;
  report.center_count = static_cast<uint32_t>(rbf.kernel_coefficients().rows());
  list_near_pairs(rbf, from.spacing, report);
  *out = report;
  return HB_OK;
}

int32_t hb_rbf_coefficients(hb_interpolant* interpolant, double* out) {
  handlebody::changing(interpolant);
  if (!interpolant->rbf) return fail_not_rbf();
  const Matrix coefficients = interpolant->rbf->kernel_coefficients();
  std::copy(coefficients.data(), coefficients.data() + coefficients.size(), out);
  return HB_OK;
}

int32_t hb_rbf_leave_one_out(hb_interpolant* interpolant, double* out) {
  handlebody::changing(interpolant);
  if (!interpolant->rbf) return fail_not_rbf();
  const auto errors = interpolant->rbf->leave_one_out();
  if (!errors) return fail(errors.error());
  std::copy(errors->data(), errors->data() + errors->size(), out);
  return HB_OK;
}

int32_t hb_rbf_row_weights(hb_interpolant* interpolant, double* out) {
  handlebody::changing(interpolant);
  if (!interpolant->rbf) return fail_not_rbf();
  const Vector weights = interpolant->rbf->row_weights();
  std::copy(weights.data(), weights.data() + weights.size(), out);
  return HB_OK;
}

int32_t hb_find_outliers(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs,
                         const hb_rbf_options* options, hb_outlier_search* search) {
  handlebody::making();
  const GivenData data{points, values, count, dimension, outputs};
  hb_interpolant* none = nullptr;
  if (const int32_t status = check_given(data, *options, &none)) return status;
  if (search->method >= outlier_method_count)
    return fail({HB_ERROR_INVALID_OPTION, {"The method is unknown."}, {"Use 0, 1 or 2."}, HB_CULPRIT_OPTION});
  auto read = read_options(*options, dimension);
  if (!read) return fail(read.error());
  const OutlierOptions how{static_cast<OutlierMethod>(search->method), search->threshold, signed_count(search->most)};
  const auto report = find_outliers(data.point_rows(), data.value_rows(), *read, how);
  if (!report) return fail(report.error());
  std::copy(report->scores.data(), report->scores.data() + report->scores.size(), search->scores);
  std::copy(report->outliers.begin(), report->outliers.end(), search->outliers);
  std::copy(report->outlier_scores.begin(), report->outlier_scores.end(), search->heights);
  search->outlier_count = static_cast<uint32_t>(report->outliers.size());
  search->smoothing = report->smoothing;
  return HB_OK;
}
}
