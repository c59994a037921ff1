#include "core/interpolation/moving_least_squares.hpp"

#include "abi/interpolant.hpp"
#include "abi/memory.hpp"

using namespace handlebody;

extern "C" {

int32_t hb_moving_least_squares_create(const double* points, const double* values, uint32_t count, uint32_t dimension,
                                       uint32_t outputs, const hb_moving_least_squares_options* options, double* used_width,
                                       hb_interpolant** out) {
  handlebody::making();
  const auto [power, epsilon, width, degree, weight] = *options;
  const GivenData data{points, values, count, dimension, outputs};
  if (const int32_t status = check_given(data, out)) return status;
  if (weight >= moving_weight_count)
    return fail({HB_ERROR_INVALID_OPTION,
                 {"There is no weight ", weight, "."},
                 {"Use 0 (inverse distance), 1 (Gaussian) or 2 (Wendland)."},
                 HB_CULPRIT_OPTION});
  auto made = MovingLeastSquares::create(data.point_rows(), data.value_rows(),
                                         {degree, static_cast<MovingWeight>(weight), power, epsilon, width});
  if (made && used_width) *used_width = made->width();
  return deliver(std::move(made), out);
}
}
