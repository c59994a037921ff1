#include "abi/interpolant.hpp"

#include <algorithm>
#include <cmath>

#include "abi/memory.hpp"
#include "core/interpolation/shepard.hpp"

using namespace handlebody;

namespace {

constexpr uint32_t largest_dimension = 64;

/** Checks `queries`, and that the answers, `columns` numbers for each, can be there. */
int32_t check_queries(const hb_interpolant& interpolant, const double* queries, uint32_t count, const double* out, Index columns) {
  const Index d = interpolant.method->dimension();
  if (const int32_t status = check_arrays(
          {{queries, "queries", count, static_cast<uint32_t>(d)}, {out, "results", count, static_cast<uint32_t>(columns)}}))
    return status;
  const Index numbers = static_cast<Index>(count) * d;
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

int32_t handlebody::check_dimension(uint32_t dimension) {
  if (dimension > 0 && dimension <= largest_dimension) return HB_OK;
  return fail({HB_ERROR_INVALID_SHAPE, {dimension, " dimensions are not supported."}, {"Use 1 to 64 dimensions."}});
}

int32_t handlebody::check_given(const GivenData& data, hb_interpolant** out) {
  if (!out) return fail({HB_ERROR_INVALID_SHAPE, {"The pointer to the result is NULL."}, {"Pass a valid pointer."}});
  if (const int32_t status = check_dimension(data.dimension)) return status;
  if (data.outputs == 0)
    return fail({HB_ERROR_INVALID_SHAPE, {"The points have no values."}, {"Give one or more values a point."}});
  return check_arrays({{data.points, "points", data.count, data.dimension}, {data.values, "values", data.count, data.outputs}});
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
  auto& method = *interpolant->method;
  if (const int32_t status = check_queries(*interpolant, queries, count, out, method.outputs())) return status;
  method.evaluate(queries, static_cast<Index>(count), out);
  return HB_OK;
}

int32_t hb_interpolant_gradient(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out) {
  handlebody::changing(interpolant);
  if (!interpolant->method->differentiable())
    return fail({HB_ERROR_INVALID_OPTION,
                 {"This method has no gradient: it has kinks."},
                 {"Use a smooth one, such as rbf() or movingLeastSquares()."}});
  auto& method = *interpolant->method;
  if (const int32_t status = check_queries(*interpolant, queries, count, out, method.outputs() * method.dimension())) return status;
  method.gradient(queries, static_cast<Index>(count), out);
  return HB_OK;
}

int32_t hb_interpolant_weights(hb_interpolant* interpolant, const double* queries, uint32_t count, double* out) {
  handlebody::changing(interpolant);
  auto& method = *interpolant->method;
  if (const int32_t status = check_queries(*interpolant, queries, count, out, method.size())) return status;
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
