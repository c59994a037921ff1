// Radial basis fits with all their options, what is asked of them, and the search for outliers. Kernel 15 is the host's: sound, not
// a number, or one that calls the solver again.
//
// behind: abi/rbf.cpp abi/host_kernel.cpp core/interpolation/rbf.cpp core/interpolation/radial_basis.cpp core/interpolation/linear_fit.cpp core/interpolation/robust_fit.cpp core/interpolation/outliers.cpp core/interpolation/width_choice.cpp core/interpolation/polynomial.cpp
// behind: core/kernels/kernel.cpp core/kernels/clamped_plate.cpp core/numerics/graded_qr.cpp
#include "scattered.hpp"

using namespace handlebody::fuzz;

namespace {

/** What the host's kernels 1 to 4 do: the last calls a function of another object, which has to be allowed. */
Interpolant* other = nullptr;

hb_rbf_options choose(Bytes& bytes, const Scattered& data, std::vector<double>& centers, std::vector<double>& widths,
                      std::vector<double>& metric) {
  hb_rbf_options options{};
  options.width = bytes.positive();
  options.smoothing = bytes.byte() < 160 ? 0 : bytes.positive() * 1e-3;
  options.weight_decay = bytes.byte() < 220 ? 0 : bytes.positive() * 1e-3;
  options.support = bytes.positive();
  options.kernel = bytes.option(0, 15);
  options.host_kernel = bytes.option(0, 4);
  options.degree = static_cast<std::int32_t>(bytes.option(0, 3) - 1);
  options.order = static_cast<std::int32_t>(bytes.option(2, 4));
  options.normalized = bytes.byte() < 40;
  options.width_choice = bytes.option(0, bytes.byte() < 200 ? 0 : 2);
  options.center_count = data.count;
  if (bytes.byte() < 60) {
    options.robust = bytes.option(0, 2);
    // The least median takes 3,000 fits, and at each of some thirty widths where one is sought: few unknowns, to stay below a
    // second.
    if (options.robust == 2) options.degree = std::min(options.degree, 1);
    const std::uint32_t most = options.robust != 2 ? 50 : options.width_choice == 2 ? 4 : 16;
    options.center_count = bytes.from_to(1, std::min(data.count, most));
    centers = bytes.numbers(options.center_count * data.dimension);
    if (bytes.flip()) std::copy_n(data.points.begin(), centers.size(), centers.begin());
    options.centers = centers.data();
  }
  if (bytes.byte() < 40) {
    for (std::uint32_t i = 0; i < options.center_count; ++i) widths.push_back(bytes.positive());
    options.widths = widths.data();
  }
  options.center_count = bytes.count(options.center_count);
  if (bytes.byte() < 40) {
    const std::uint32_t d = data.dimension;
    metric.assign(d * d, 0);
    for (std::uint32_t i = 0; i < d; ++i)
      for (std::uint32_t j = 0; j <= i; ++j)
        metric[i * d + j] = metric[j * d + i] = i == j ? bytes.positive() + 1 : bytes.number() / 16;
    options.metric = metric.data();
  }
  return options;
}

void search(Bytes& bytes, const Scattered& data, const GivenPoints& given, const hb_rbf_options& options) {
  const std::uint32_t most = bytes.below(data.count + 1);
  std::vector<double> scores(data.count), heights(most + 1, 7);
  std::vector<std::uint32_t> outliers(most + 1, 7);
  hb_outlier_search how{bytes.positive(), bytes.option(0, 2), most, scores.data(), outliers.data(), heights.data(), 0, 0};
  if (!worked(hb_find_outliers(given.points, given.values, given.count, given.dimension, given.outputs, &options, &how))) return;
  reached();
  require(how.outlier_count <= most && outliers.back() == 7 && heights.back() == 7,
          "no more outliers are found than were asked for");
  for (std::uint32_t k = 0; k < how.outlier_count; ++k) require(outliers[k] < data.count, "an outlier is one of the points");
}

}  // namespace

extern "C" double hb_host_kernel(std::uint32_t number, std::uint32_t derivative, double s) {
  switch (number) {
    case 1:
      return derivative ? 0 : std::nan("");
    case 2:
      return s < 2 ? 1e308 * s : -1e308;
    case 3: {
      double at[8]{s, s}, out[8]{};
      if (other && other->get()) hb_interpolant_evaluate(other->get(), at, 1, out);
      return derivative ? -2 * s * std::exp(-s * s) : std::exp(-s * s) + 0 * out[0];
    }
    default:
      return derivative ? -2 * s * std::exp(-s * s) : std::exp(-s * s);
  }
}

FUZZ(bytes) {
  const Scattered data(bytes, 0);
  const GivenPoints given = data.view(bytes);
  std::vector<double> centers, widths, metric;
  hb_rbf_options options = choose(bytes, data, centers, widths, metric);
  worked(hb_rbf_check_size(given.count, given.dimension, options.center_count, options.degree));
  Interpolant helper;
  helper.make([&](hb_interpolant** out) {
    constexpr double two[]{0, 1, 2, 3};
    return hb_shepard_create(two, two, 2, 1, 1, 2, 0, out);
  });
  other = &helper;
  if (bytes.byte() < 30) {
    if (bytes.byte() < 80) options.smoothing = -1;
    search(bytes, data, given, options);
    other = nullptr;
    return;
  }
  Interpolant made;
  if (made.make([&](hb_interpolant** out) {
        return hb_rbf_create(given.points, given.values, given.count, given.dimension, given.outputs, &options, out);
      })) {
    reached();
    ask(bytes, data, made.get());
    hb_rbf_report report{};
    require(worked(hb_rbf_get_report(made.get(), &report)), "every fit has a report");
    std::vector<double> coefficients(std::size_t{report.center_count} * data.outputs + 1, 7), rows(data.count + 1, 7),
        errors(std::size_t{data.count} * data.outputs + 1, 7);
    worked(hb_rbf_coefficients(made.get(), coefficients.data()));
    worked(hb_rbf_leave_one_out(made.get(), errors.data()));
    worked(hb_rbf_row_weights(made.get(), rows.data()));
    require(coefficients.back() == 7 && rows.back() == 7 && errors.back() == 7, "nothing is written beyond the results");
  }
  other = nullptr;
}
