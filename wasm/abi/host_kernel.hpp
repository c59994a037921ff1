// Kernels of the caller's: functions in JavaScript, known by a number.
#pragma once

#include <cstdint>

#include "core/kernels/kernel.hpp"

namespace handlebody {

/** The host's kernel number `id`; definite or not, the caller decides on the tail. Natively there is no host, and every value is
 * NaN: there a CustomKernel is handed to the core itself. */
CustomKernel host_kernel(uint32_t id);

}  // namespace handlebody
