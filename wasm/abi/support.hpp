// Shared by the files that implement handlebody.h: turning the core's Errors into status codes and the last-error struct.
#pragma once

#include "abi/handlebody.h"
#include "core/errors/result.hpp"

namespace handlebody {

/** Records `error` for hb_last_error() and returns its code. */
int32_t fail(const Error& error);

}  // namespace handlebody
