// What every target has: FUZZ(bytes) { … } is run for each input. It calls reached() where the input got past all checks, to the
// algorithm; how many did is said at the end.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "abi/handlebody.h"
#include "bytes.hpp"

namespace handlebody::fuzz {

struct Counts {
  unsigned long long executions = 0, reached = 0;
  bool now = false;
  ~Counts() { std::fprintf(stderr, "fuzz: %llu executions, %llu of them reached the algorithm\n", executions, reached); }
};
inline Counts counts;

inline void reached() {
  counts.now = true;
}

/** Ends the process where the contract of the header is broken. */
inline void require(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "The header's promise is broken: %s\n", promise);
  std::abort();
}

/** Whether a call succeeded. A failure has to have a code of the list, a sentence and a remedy. */
inline bool worked(std::int32_t status) {
  if (status == HB_OK) return true;
  const hb_error* const error = hb_last_error();
  require(error->code == status, "hb_last_error() has the code that was returned");
  require(status > HB_ERROR_INTERNAL && status < 100, "a status is one of the list, and not an internal error");
  require(memchr(error->message, 0, sizeof error->message) != nullptr && std::strlen(error->message) > 9,
          "an error has a sentence");
  require(memchr(error->remedy, 0, sizeof error->remedy) != nullptr && std::strlen(error->remedy) > 9, "an error has a remedy");
  return false;
}

/** Owns what a *_create function makes; NULL before and where it failed. */
template <auto release>
class Owned {
 public:
  Owned() = default;
  Owned(const Owned&) = delete;
  ~Owned() {
    hb_begin_call();
    release(object_);
  }

  /** Whether `create`, which is given the place for the object, worked. Where not, the place has to be as it was. */
  template <typename Create>
  bool make(const Create& create) {
    hb_begin_call();
    if (worked(create(&object_))) return require(object_ != nullptr, "a call that succeeds makes the object"), true;
    return require(object_ == nullptr, "a call that fails leaves the result as it was"), false;
  }
  auto* get() const { return object_; }

 private:
  template <typename T>
  static T argument(void (*)(T));
  decltype(argument(release)) object_ = nullptr;
};

using Interpolant = Owned<hb_interpolant_free>;

}  // namespace handlebody::fuzz

#define FUZZ(bytes)                                                                   \
  static void fuzz_one(handlebody::fuzz::Bytes& bytes);                               \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { \
    handlebody::fuzz::Bytes given(data, size);                                        \
    handlebody::fuzz::counts.now = false;                                             \
    fuzz_one(given);                                                                  \
    ++handlebody::fuzz::counts.executions;                                            \
    handlebody::fuzz::counts.reached += handlebody::fuzz::counts.now;                 \
    return 0;                                                                         \
  }                                                                                   \
  static void fuzz_one(handlebody::fuzz::Bytes& bytes)
