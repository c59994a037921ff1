// Errors as values: the core is built without exceptions, so every fallible function returns a Result.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "core/numerics/status.h"

namespace handlebody {

/** What went wrong, whose fault it is, and what to do about it; shown to people as written. */
struct Error {
  hb_status code = HB_ERROR_INTERNAL;
  std::string message;
  std::string remedy;
  hb_culprit culprit = HB_CULPRIT_NONE;
  std::int64_t index = -1;
};

/** Either a value or an Error. Test it like a pointer, then read `*result` or `result.error()`. */
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}          // NOLINT(google-explicit-constructor): `return value;`
  Result(Error error) : state_(std::move(error)) {}      // NOLINT(google-explicit-constructor): `return Error{…};`

  explicit operator bool() const { return std::holds_alternative<T>(state_); }
  T& operator*() { return *std::get_if<T>(&state_); }
  const T& operator*() const { return *std::get_if<T>(&state_); }
  T* operator->() { return std::get_if<T>(&state_); }
  const T* operator->() const { return std::get_if<T>(&state_); }
  const Error& error() const { return *std::get_if<Error>(&state_); }

 private:
  std::variant<T, Error> state_;
};

/** The value of an operation that yields none. */
struct Done {};

}  // namespace handlebody
