#include "abi/support.hpp"

#include <algorithm>
#include <cstring>

namespace {

hb_error last_error{};

template <std::size_t N>
void copy_text(char (&target)[N], const std::string& text) {
  const std::size_t length = std::min(N - 1, text.size());
  std::memcpy(target, text.data(), length);
  target[length] = '\0';
}

}  // namespace

int32_t handlebody::fail(const Error& error) {
  last_error.code = error.code;
  last_error.culprit = error.culprit;
  last_error.index = static_cast<int32_t>(error.index);
  copy_text(last_error.message, error.message);
  copy_text(last_error.remedy, error.remedy);
  return error.code;
}

int32_t handlebody::check_arrays(std::initializer_list<GivenArray> arrays) {
  for (const auto& [data, name, rows, columns, bytes] : arrays) {
    const double numbers = static_cast<double>(rows) * columns;
    if (numbers >= 0x1p31 || numbers * static_cast<double>(bytes) >= 0x1p32)
      return fail({HB_ERROR_INVALID_SHAPE,
                   {"The array of ", name, " would hold ", rows, " × ", columns, " numbers, more than memory does."},
                   {"Pass the counts that the arrays have."}});
    if (!data && numbers > 0)
      return fail({HB_ERROR_INVALID_SHAPE, {"The pointer to the ", name, " is NULL."}, {"Pass a valid pointer."}});
  }
  return HB_OK;
}

extern "C" {

uint32_t hb_abi_version(void) {
  return 7;
}

const hb_error* hb_last_error(void) {
  return &last_error;
}
}
