#include "core/interpolation/tension_spline.hpp"

#include "abi/interpolant.hpp"
#include "abi/memory.hpp"
#include "core/interpolation/tension_spline_1d.hpp"

using namespace handlebody;

extern "C" int32_t hb_tension_spline_create(const double* points, const double* values, uint32_t count, uint32_t dimension,
                                            uint32_t outputs, const hb_tension_spline_options* options, hb_interpolant** out) {
  making();
  const auto [alpha, beta, gamma, smoothing, ends] = *options;
  const GivenData data{points, values, count, dimension, outputs};
  if (const int32_t status = check_given(data, out)) return status;
  if (ends == 0) return deliver(tension_spline(data.point_rows(), data.value_rows(), {alpha, beta, gamma, smoothing}), out);
  if (ends > 1) return fail({HB_ERROR_INVALID_OPTION, {"The kind of ends is unknown."}, {"Use 0 or 1."}, HB_CULPRIT_OPTION});
  if (gamma != 0 || smoothing != 0)
    return fail({HB_ERROR_INVALID_OPTION,
                 {"Zero slope at the ends goes without gamma and smoothing; they are ", gamma, " and ", smoothing, "."},
                 {"Set both to 0, or use natural ends."},
                 HB_CULPRIT_OPTION});
  return deliver(TensionSpline1d::create(data.point_rows(), data.value_rows(), {alpha, beta}), out);
}
