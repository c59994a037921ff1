#include "abi/interpolant.hpp"

#include <algorithm>
#include <cmath>

#include "abi/memory.hpp"
#include "core/interpolation/shepard.hpp"

using namespace handlebody;

namespace {

constexpr uint32_t largest_dimension = 64;

int32_t check_queries(const hb_interpolant& interpolant, const double* queries, uint32_t count) {
  const Index d = interpolant.method->dimension(), numbers = static_cast<Index>(count) * d;
  for (Index i = 0; i < numbers; ++i)
    if (!std::isfinite(queries[i]))
      return fail({HB_ERROR_QUERY_NOT_FINITE,
                   {"Coordinate ", i % d, " of query ", i / d, " is ", queries[i], "."},
                   {"Ask at finite coordinates."},
                   HB_CULPRIT_QUERY,
                   i / d});
  return HB_OK;
}

}  // namespace

int32_t handlebody::check_given(const GivenData& data, hb_interpolant** out) {
  if (!out || (data.count > 0 && (!data.points || !data.values)))
    return fail({HB_ERROR_INVALID_SHAPE, {"A pointer to points, values or the result is NULL."}, {"Pass valid pointers."}});
  if (data.dimension == 0 || data.dimension > largest_dimension)
    return fail({HB_ERROR_INVALID_SHAPE, {data.dimension, " dimensions are not supported."}, {"Use 1 to 64 dimensions."}});
  if (data.outputs == 0)
    return fail({HB_ERROR_INVALID_SHAPE, {"The points have no values."}, {"Give one or more values a point."}});
  return HB_OK;
}

extern "C" {

int32_t hb_interpolant_twins(hb_interpolant* interpolant, uint32_t* twins) {
  handlebody::changing(interpolant);
  const auto& twin_of = interpolant->method->data().twin_of;
  std::copy(twin_of.begin(), twin_of.end(), twins);
  return HB_OK;
}

int32_t hb_interpolant_evaluate(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out) {
  handlebody::changing(interpolant);
  if (const int32_t status = check_queries(*interpolant, queries, count)) return status;
  interpolant->method->evaluate(queries, count, out);
  return HB_OK;
}

int32_t hb_interpolant_gradient(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out) {
  handlebody::changing(interpolant);
  if (!interpolant->method->differentiable())
    return fail({HB_ERROR_INVALID_OPTION,
                 {"This method has no gradient: it has kinks."},
                 {"Use a smooth one, such as rbf() or movingLeastSquares()."}});
  if (const int32_t status = check_queries(*interpolant, queries, count)) return status;
  interpolant->method->gradient(queries, count, out);
  return HB_OK;
}

int32_t hb_interpolant_weights(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out) {
  handlebody::changing(interpolant);
  if (const int32_t status = check_queries(*interpolant, queries, count)) return status;
  auto& method = *interpolant->method;
  for (uint32_t q = 0; q < count; ++q, queries += method.dimension(), out += method.size()) method.weights(queries, out);
  return HB_OK;
}

void hb_interpolant_free(hb_interpolant* interpolant) {
  delete interpolant;
  handlebody::gone(interpolant);
}

int32_t hb_shepard_create(const double* points, const double* values, uint32_t count, uint32_t dimension, uint32_t outputs,
                          double power, double epsilon, hb_interpolant** out) {
  handlebody::making();
  const GivenData data{points, values, count, dimension, outputs};
  if (const int32_t status = check_given(data, out)) return status;
  return deliver(Shepard::create(data.point_rows(), data.value_rows(), {power, epsilon}), out);
}
}
