#include "core/interpolation/simplex_linear.hpp"

#include "abi/interpolant.hpp"
#include "abi/memory.hpp"

using namespace handlebody;

extern "C" {

int32_t hb_simplex_linear_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs,
                                 uint32_t outside, hb_interpolant** out) {
  handlebody::making();
  const GivenData data{points, values, count, dimension, outputs};
  if (const int32_t status = check_given(data, out)) return status;
  if (outside > 1)
    return fail(
        {HB_ERROR_INVALID_OPTION, {"There is no rule ", outside, " for queries outside."}, {"Use 0 or 1."}, HB_CULPRIT_OPTION});
  return deliver(SimplexLinear::create(data.point_rows(), data.value_rows(), static_cast<OutsideHull>(outside)), out);
}
}
