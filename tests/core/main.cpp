#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#ifdef __wasm__
#include <cmath>
#include <cstdint>

/** There is no host, as there is none natively: see host_kernel.hpp. */
extern "C" double hb_host_kernel(std::uint32_t, std::uint32_t, double) {
  return std::nan("");
}
#endif
