#include "abi/host_kernel.hpp"

#include <cmath>

#ifdef __wasm__
/** The host's kernel number `id` at s, or its derivative: the only function that the module imports from its host. */
extern "C" __attribute__((import_module("env"), import_name("hb_host_kernel"))) double hb_host_kernel(uint32_t id,
                                                                                                      uint32_t derivative,
                                                                                                      double s);
#else
/** Natively a program may be the host: tests/fuzz is. */
extern "C" __attribute__((weak)) double hb_host_kernel(uint32_t id, uint32_t derivative, double s);
#endif

namespace handlebody {

namespace {

double call_host(const void* context, double s, bool derivative) {
#ifndef __wasm__
  if (!hb_host_kernel) return std::nan("");
#endif
  return hb_host_kernel(static_cast<uint32_t>(reinterpret_cast<uintptr_t>(context)), derivative ? 1 : 0, s);
}

}  // namespace

CustomKernel host_kernel(uint32_t id) {
  return {call_host, reinterpret_cast<const void*>(static_cast<uintptr_t>(id)), -1};
}

}  // namespace handlebody
