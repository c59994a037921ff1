// The caller's kernels: functions in JavaScript, known by a number and called through one imported function, hb_host_kernel.
//
// Rejected: the function table, which cannot grow from outside in a standalone module; passing tables of distances out and of
// values in, which every feature would have to support.
#pragma once

#include <cstdint>

#include "core/kernels/kernel.hpp"

namespace handlebody {

/** The host's kernel number `id`. Whether it is definite is unknown: the caller decides on the tail. Natively, unless the
 * program defines hb_host_kernel, every value is NaN: there a CustomKernel is passed to the core itself. */
CustomKernel host_kernel(uint32_t id);

}  // namespace handlebody
