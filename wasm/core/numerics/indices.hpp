// Lists of indices, into vertices, points or rows, and one sort for every order: std::sort and std::nth_element take 2 kB of code
// each for every comparison that instantiates them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace handlebody {

using Indices = std::vector<std::uint32_t>;

/** Stands where there is no index: a vertex that nothing holds, a voxel that is not inside. */
inline constexpr std::uint32_t no_index = 0xffffffff;

/** Whether `number` < `count`. Compared without a sign: an Index has 32 bits on wasm32, where a number from 2³¹ on would turn
 * negative and pass for small. */
constexpr bool in_range(std::uint32_t number, std::ptrdiff_t count) {
  return number < static_cast<std::size_t>(count);
}

/** A reference to a strict order "u before v" of indices, which must outlive it. */
class Order {
 public:
  template <typename Before>
  Order(const Before& before)  // NOLINT(google-explicit-constructor): a lambda in place
      : before_(&before),
        call_([](const void* b, std::uint32_t u, std::uint32_t v) { return (*static_cast<const Before*>(b))(u, v); }) {}

  bool operator()(std::uint32_t u, std::uint32_t v) const { return call_(before_, u, v); }

 private:
  const void* before_;
  bool (*call_)(const void*, std::uint32_t, std::uint32_t);
};

void sort(Indices& indices, Order order);

/** 0, 1, …, count − 1 in order. */
Indices sorted_indices(std::size_t count, Order order);

/** Partitions [first, last) as std::nth_element does: the indices that come first in order go to [first, middle). */
void nth_element(std::uint32_t* first, std::uint32_t* middle, std::uint32_t* last, Order order);

}  // namespace handlebody
