#include "core/numerics/sort.hpp"

#include <algorithm>
#include <numeric>

namespace handlebody {

void sort(Numbers& numbers, Order order) {
  std::sort(numbers.data(), numbers.data() + numbers.size(), order);
}

Numbers sorted_indices(std::size_t count, Order order) {
  Numbers numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  sort(numbers, order);
  return numbers;
}

void split(std::uint32_t* first, std::uint32_t* middle, std::uint32_t* last, Order order) {
  std::nth_element(first, middle, last, order);
}

}  // namespace handlebody
