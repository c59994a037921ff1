// The memory section of handlebody.h. Under Emscripten all memory is handed out here, by emmalloc, with a note beside each block of
// the call that took it: C++ without exceptions cannot give back a half-made object, but what a call took can be, by these notes. A
// call for which memory runs out ends in a trap; hb_undo_call() then frees what it took. Where the call changes an older object,
// that may hold some of it by then: it is kept as long as the object is, which stays whole. Blocks of earlier calls that a call
// frees are kept until the next one, since an object may still hold them.
//
// Rejected: to ask for a call's peak before it begins. Fill-in of sparse factors, grids and what a robust fit repeats depend on the
// data: such a number is refused too early or comes too late, for each of forty calls. A note is 16 bytes a block and a few
// instructions.
#include "abi/memory.hpp"

#include "abi/handlebody.h"

#ifdef __EMSCRIPTEN__

#include <algorithm>
#include <cstddef>
#include <cstring>

extern "C" {
void* emmalloc_memalign(std::size_t alignment, std::size_t bytes);
void emmalloc_free(void* start);
std::size_t emmalloc_usable_size(void* start);
}

namespace {

constexpr std::size_t least_alignment = 16;
constexpr std::uint32_t callers_own = 0;

/** Stands right before the memory that it is about. */
struct Block {
  Block* newer;
  Block* older;
  std::uint32_t call;
  void* start;  // as emmalloc knows it
};
static_assert(sizeof(Block) <= least_alignment);

Block* newest = nullptr;   // of those that are held, the oldest calls' last
Block* dropped = nullptr;  // freed by a call that did not take them, by `older`
std::uint32_t present_call = 1;
std::uint32_t wanted = 0;  // bytes that could not be had
std::uint32_t keeper = 0;  // of what the present call took, should memory run out; 0: nobody
bool has_kept = false;
constexpr std::uint32_t nobody_known = 0xffffffff;  // keeps for good
constexpr std::uint32_t last_call = 0x7fffffff;     // keepers have higher numbers

std::uint32_t keeper_of(const void* owner) {
  return ~last_call | static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(owner) >> 4);
}

Block* block_of(void* memory) {
  return reinterpret_cast<Block*>(static_cast<char*>(memory) - sizeof(Block));
}

void link(Block* block) {
  block->newer = nullptr;
  block->older = newest;
  if (newest != nullptr) newest->newer = block;
  newest = block;
}

void unlink(Block* block) {
  if (block->older != nullptr) block->older->newer = block->newer;
  (block->newer != nullptr ? block->newer->older : newest) = block->older;
}

void* take(std::size_t bytes, std::size_t alignment, std::uint32_t call) {
  alignment = std::max(alignment, least_alignment);
  if (bytes > SIZE_MAX - alignment - 4096) return nullptr;  // emmalloc adds its own without looking
  void* start = emmalloc_memalign(alignment, bytes + alignment);
  if (start == nullptr) return nullptr;
  void* memory = static_cast<char*>(start) + alignment;
  Block* block = block_of(memory);
  block->call = call;
  block->start = start;
  link(block);
  return memory;
}

/** Ends the call: hb_undo_call() does the rest. */
void* take_or_end(std::size_t bytes, std::size_t alignment = least_alignment) {
  void* memory = take(bytes, alignment, present_call);
  if (memory != nullptr) return memory;
  wanted = static_cast<std::uint32_t>(std::max<std::size_t>(bytes, 1));
  __builtin_trap();
}

void give_back(void* memory) {
  if (memory == nullptr) return;
  Block* block = block_of(memory);
  unlink(block);
  if (block->call == present_call || block->call == callers_own) {
    emmalloc_free(block->start);
    return;
  }
  block->older = dropped;
  dropped = block;
}

}  // namespace

void handlebody::making() {
  keeper = 0;
}

void handlebody::changing(const void* owner) {
  keeper = keeper_of(owner);
}

void handlebody::gone(const void* owner) {
  if (!has_kept) return;
  const std::uint32_t kept = keeper_of(owner);
  for (Block *block = newest, *older = nullptr; block != nullptr; block = older) {
    older = block->older;
    if (block->call != kept) continue;
    unlink(block);
    emmalloc_free(block->start);
  }
}

extern "C" {

void* malloc(std::size_t bytes) {
  return take_or_end(bytes);
}

void free(void* memory) {
  give_back(memory);
}

void* calloc(std::size_t count, std::size_t bytes) {
  std::size_t all = 0;
  if (__builtin_mul_overflow(count, bytes, &all)) all = SIZE_MAX;
  return std::memset(take_or_end(all), 0, all);
}

void* realloc(void* memory, std::size_t bytes) {
  if (memory == nullptr) return take_or_end(bytes);
  const Block* block = block_of(memory);
  const std::size_t before = static_cast<char*>(memory) - static_cast<char*>(block->start);
  void* moved = take_or_end(bytes);
  std::memcpy(moved, memory, std::min(bytes, emmalloc_usable_size(block->start) - before));
  give_back(memory);
  return moved;
}

void* memalign(std::size_t alignment, std::size_t bytes) {
  return take_or_end(bytes, alignment);
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
  return take_or_end(bytes, alignment);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) {
  *memory = take_or_end(bytes, alignment);
  return 0;
}

void* hb_alloc(uint32_t bytes) {
  return take(bytes, least_alignment, callers_own);
}

void hb_release(void* memory) {
  give_back(memory);
}

void hb_begin_call(void) {
  while (dropped != nullptr) {
    Block* block = dropped;
    dropped = block->older;
    emmalloc_free(block->start);
  }
  present_call = present_call == last_call ? 1 : present_call + 1;
  keeper = nobody_known;
}

uint32_t hb_undo_call(void) {
  const std::uint32_t bytes = wanted;
  if (bytes == 0) return 0;
  wanted = 0;
  if (keeper == 0) {
    while (newest != nullptr && newest->call == present_call) give_back(newest + 1);
  } else {
    has_kept = true;
    for (Block* block = newest; block != nullptr && block->call == present_call; block = block->older) block->call = keeper;
  }
  while (dropped != nullptr) {
    Block* block = dropped;
    dropped = block->older;
    if (keeper != 0) block->call = keeper;
    link(block);
  }
  return bytes;
}
}

#else

#include <cstddef>
#include <cstdlib>

void handlebody::making() {}
void handlebody::changing(const void* /*owner*/) {}
void handlebody::gone(const void* /*owner*/) {}

extern "C" {

void* hb_alloc(uint32_t bytes) {
  // Aligned as under Emscripten. A size that cannot be rounded up is none that there is memory for.
  return bytes < 0xffffff00 ? std::aligned_alloc(16, (std::size_t{bytes} / 16 + 1) * 16) : nullptr;
}

void hb_release(void* memory) {
  std::free(memory);
}

void hb_begin_call(void) {}

uint32_t hb_undo_call(void) {
  return 0;
}
}

#endif
