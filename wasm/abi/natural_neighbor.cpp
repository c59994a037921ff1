#include "core/interpolation/natural_neighbor.hpp"

#include "abi/interpolant.hpp"
#include "abi/memory.hpp"

using namespace handlebody;

extern "C" int32_t hb_natural_neighbor_create(const double* points, const double* values, uint32_t count, uint32_t dimension,
                                              uint32_t outputs, uint32_t outside, hb_interpolant** out) {
  making();
  const GivenData data{points, values, count, dimension, outputs};
  if (const int32_t status = check_given(data, out)) return status;
  if (outside > 1)
    return fail({HB_ERROR_INVALID_OPTION,
                 {"There is no way ", outside, " to answer outside the hull."},
                 {"Use 0 for the nearest point of the hull or 1 for NaN."},
                 HB_CULPRIT_OPTION});
  return deliver(NaturalNeighbor::create(data.point_rows(), data.value_rows(), static_cast<OutsideHull>(outside)), out);
}
