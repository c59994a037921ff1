#include "core/numerics/indices.hpp"

#include <algorithm>
#include <numeric>

namespace handlebody {

void sort(Indices& indices, Order order) {
  std::sort(indices.data(), indices.data() + indices.size(), order);
}

Indices sorted_indices(std::size_t count, Order order) {
  Indices indices(count);
  std::iota(indices.begin(), indices.end(), 0u);
  sort(indices, order);
  return indices;
}

void nth_element(std::uint32_t* first, std::uint32_t* middle, std::uint32_t* last, Order order) {
  std::nth_element(first, middle, last, order);
}

}  // namespace handlebody
