// Memory by the byte, and the last error.
//
// behind: abi/memory.cpp abi/support.cpp
#include "target.hpp"

using namespace handlebody::fuzz;

FUZZ(bytes) {
  require(hb_abi_version() > 0, "the interface has a version");
  require(hb_last_error() == hb_last_error(), "there is one last error");
  void* blocks[8]{};
  for (unsigned times = bytes.from_to(1, 32); times > 0; --times) {
    if (bytes.one_of({false, true})) hb_begin_call();
    require(hb_undo_call() == 0, "nothing is undone where memory did not run out");
    void*& block = blocks[bytes.below(8)];
    hb_release(block);
    const std::uint32_t size = bytes.wildly() ? bytes.one_of({0u, 0xffffffffu, 0xfffffff0u}) : bytes.below(0x10000);
    block = hb_alloc(size);
    if (!block) continue;
    reached();
    require(reinterpret_cast<std::uintptr_t>(block) % 16 == 0, "memory is aligned to 16 bytes");
    std::memset(block, 1, std::min(size, 0x10000u));
  }
  for (void* block : blocks) hb_release(block);
}
