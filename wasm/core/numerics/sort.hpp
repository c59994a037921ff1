// One sort for all lists of numbers, whatever their order: std::sort and std::nth_element are 2 kB of code for every comparison.
#pragma once

#include <cstdint>
#include <vector>

namespace handlebody {

using Numbers = std::vector<std::uint32_t>;

/** Refers to a strict order "u before v" of numbers; must not outlive it. */
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

void sort(Numbers& numbers, Order order);

/** 0, 1, …, count − 1 in order. */
Numbers sorted_indices(std::size_t count, Order order);

/** Partitions [first, last): the numbers that come first in order go to [first, middle). */
void split(std::uint32_t* first, std::uint32_t* middle, std::uint32_t* last, Order order);

}  // namespace handlebody
