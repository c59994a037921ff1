// Shared by the files that implement the scattered-interpolation section of handlebody.h.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "abi/support.hpp"
#include "core/interpolation/interpolant.hpp"
#include "core/interpolation/rbf.hpp"

struct hb_interpolant {
  std::unique_ptr<handlebody::Interpolant> method;
  handlebody::Rbf* rbf = nullptr;  // the method, where it is one
};

namespace handlebody {

/** The arrays of a *_create function. */
struct GivenData {
  const double *points, *values;
  uint32_t count, dimension, outputs;

  Eigen::Map<const Matrix> point_rows() const { return {points, static_cast<Index>(count), static_cast<Index>(dimension)}; }
  Eigen::Map<const Matrix> value_rows() const { return {values, static_cast<Index>(count), static_cast<Index>(outputs)}; }
};

/** HB_OK for 1 to 64 dimensions, or INVALID_SHAPE. */
int32_t check_dimension(uint32_t dimension);

/** HB_OK, or the error where no method accepts the counts and pointers. */
int32_t check_given(const GivenData& data, hb_interpolant** out);

/** Hands a made interpolant to the caller. */
template <typename Method>
int32_t deliver(Result<Method> made, hb_interpolant** out) {
  if (!made) return fail(made.error());
  auto method = std::make_unique<Method>(std::move(*made));
  Rbf* rbf = nullptr;
  if constexpr (std::is_same_v<Method, Rbf>) rbf = method.get();
  *out = new hb_interpolant{std::move(method), rbf};
  return HB_OK;
}

}  // namespace handlebody
