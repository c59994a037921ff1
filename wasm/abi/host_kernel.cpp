#include "abi/host_kernel.hpp"

#include <cmath>

#ifdef __wasm__
/** The host's kernel number `id` at s, or its derivative: the only function that the module imports from its host. */
extern "C" __attribute__((import_module("env"), import_name("hb_host_kernel"))) double hb_host_kernel(uint32_t id,
                                                                                                      uint32_t derivative,
                                                                                                      double s);
#endif

namespace handlebody {

namespace {

double call_host([[maybe_unused]] const void* context, [[maybe_unused]] double s, [[maybe_unused]] bool derivative) {
#ifdef __wasm__
  return hb_host_kernel(static_cast<uint32_t>(reinterpret_cast<uintptr_t>(context)), derivative ? 1 : 0, s);
#else
  return std::nan("");
#endif
}

}  // namespace

CustomKernel host_kernel(uint32_t id) {
  return {call_host, reinterpret_cast<const void*>(static_cast<uintptr_t>(id)), -1};
}

}  // namespace handlebody
