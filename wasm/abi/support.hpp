// Shared by the files that implement handlebody.h: reading what callers count, and turning the core's Errors into status codes and
// the last-error struct.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>

#include "abi/handlebody.h"
#include "core/errors/result.hpp"

namespace handlebody {

/** Records `error` for hb_last_error() and returns its code. */
int32_t fail(const Error& error);

/** A caller's array: `rows` × `columns` numbers. */
struct GivenArray {
  template <typename T>
  GivenArray(const T* at, const char* what, uint32_t row_count, uint32_t column_count = 1)
      : data(at), name(what), rows(row_count), columns(column_count), bytes(sizeof(T)) {}

  const void* data;
  const char* name;
  uint32_t rows, columns;
  std::size_t bytes;
};

/** HB_OK, or INVALID_SHAPE for the first array that cannot be: one of 4 GiB or more, or of 2³¹ numbers, which an Index of 32 bits
 * does not count; one at NULL that is not empty. Whatever a caller counts goes through here before it is read or multiplied. */
int32_t check_arrays(std::initializer_list<GivenArray> arrays);

/** A caller's number as the core counts: the largest int32_t for what is larger, which is out of every option's range too. */
inline int32_t signed_count(uint32_t number) {
  return static_cast<int32_t>(std::min(number, 0x7fffffffu));
}

}  // namespace handlebody
