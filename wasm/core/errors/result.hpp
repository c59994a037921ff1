// Errors as values: the core is built without exceptions, so every fallible function returns a Result.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/errors/status.h"
#include "core/errors/text.hpp"

namespace handlebody {

/** What went wrong, whose fault it is, and what to do about it; shown to people as written. Constructors and destructor are out of
 *  line, because sixty places use them. */
struct Error {
  Error(hb_status code, std::initializer_list<Word> message, std::initializer_list<Word> remedy,
        hb_culprit culprit = HB_CULPRIT_NONE, std::int64_t index = -1);
  Error(const Error&);
  Error& operator=(const Error&) = delete;
  ~Error();

  hb_status code;
  std::string message;
  std::string remedy;
  hb_culprit culprit;
  std::int64_t index;
};

/** Either a value or an Error. Test it like a pointer, then read `*result` or `result.error()`. */
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}  // NOLINT(google-explicit-constructor): `return value;`
  Result(const Error& error)
      : error_(std::make_unique<const Error>(error)) {}  // NOLINT(google-explicit-constructor): `return Error(…);`

  explicit operator bool() const { return value_.has_value(); }
  T& operator*() { return *value_; }
  const T& operator*() const { return *value_; }
  T* operator->() { return &*value_; }
  const T* operator->() const { return &*value_; }
  const Error& error() const { return *error_; }

 private:
  std::optional<T> value_;
  std::unique_ptr<const Error> error_;
};

/** The value of an operation that yields none. */
struct Done {};

}  // namespace handlebody
