#include "core/numerics/indices.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace handlebody;

namespace {

/** Numbers with many ties. */
std::vector<int> tied_numbers(std::mt19937& random, std::size_t count) {
  std::vector<int> numbers(count);
  for (int& number : numbers) number = static_cast<int>(random() % 20);
  return numbers;
}

/** The order by insertion: the simplest sort there is. */
template <typename Before>
Indices sorted_by_insertion(const Indices& indices, const Before& before) {
  Indices sorted;
  for (const std::uint32_t i : indices) {
    std::size_t at = sorted.size();
    while (at > 0 && before(i, sorted[at - 1])) --at;
    sorted.insert(sorted.begin() + static_cast<std::ptrdiff_t>(at), i);
  }
  return sorted;
}

}  // namespace

TEST_CASE("indices are sorted by any order that is total, repeated ones too (seed 11)") {
  std::mt19937 random(11);
  for (const std::size_t count : {0u, 1u, 2u, 15u, 16u, 17u, 300u}) {
    CAPTURE(count);
    const std::vector<int> numbers = tied_numbers(random, count);
    const auto rising = [&](std::uint32_t a, std::uint32_t b) {
      return numbers[a] != numbers[b] ? numbers[a] < numbers[b] : a < b;
    };
    const auto falling = [&](std::uint32_t a, std::uint32_t b) { return rising(b, a); };
    Indices given(count);
    for (std::uint32_t& index : given) index = static_cast<std::uint32_t>(random() % count);
    Indices sorted = given;
    sort(sorted, rising);
    CHECK(sorted == sorted_by_insertion(given, rising));
    sort(sorted, falling);
    CHECK(sorted == sorted_by_insertion(given, falling));
  }
}

TEST_CASE("sorted indices are all numbers from 0 on, once each (seed 12)") {
  std::mt19937 random(12);
  CHECK(sorted_indices(0, [](std::uint32_t, std::uint32_t) { return false; }).empty());
  CHECK(sorted_indices(5, [](std::uint32_t a, std::uint32_t b) { return a < b; }) == Indices{0, 1, 2, 3, 4});
  CHECK(sorted_indices(5, [](std::uint32_t a, std::uint32_t b) { return a > b; }) == Indices{4, 3, 2, 1, 0});
  const std::vector<int> numbers = tied_numbers(random, 200);
  const Indices order = sorted_indices(200, [&](std::uint32_t a, std::uint32_t b) { return numbers[a] < numbers[b]; });
  std::vector<int> times(200);
  for (std::size_t k = 0; k < order.size(); ++k) {
    ++times[order[k]];
    if (k > 0) CHECK(numbers[order[k - 1]] <= numbers[order[k]]);
  }
  CHECK(times == std::vector<int>(200, 1));
}

TEST_CASE("nth_element parts a stretch of a list and leaves the rest alone (seed 13)") {
  std::mt19937 random(13);
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<int> numbers = tied_numbers(random, 60);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      return numbers[a] != numbers[b] ? numbers[a] < numbers[b] : a < b;
    };
    Indices list(60);
    for (std::uint32_t i = 0; i < 60; ++i) list[i] = i;
    std::shuffle(list.begin(), list.end(), random);
    const Indices given = list;
    const std::size_t first = random() % 20, last = 40 + random() % 21, middle = first + random() % (last - first);
    nth_element(list.data() + first, list.data() + middle, list.data() + last, before);
    const Indices sorted = sorted_by_insertion(Indices(given.data() + first, given.data() + last), before);
    Indices front(list.data() + first, list.data() + middle), back(list.data() + middle, list.data() + last);
    CHECK(list[middle] == sorted[middle - first]);
    CHECK(sorted_by_insertion(front, before) == Indices(sorted.data(), sorted.data() + (middle - first)));
    CHECK(sorted_by_insertion(back, before) == Indices(sorted.data() + (middle - first), sorted.data() + sorted.size()));
    for (std::size_t k = 0; k < list.size(); ++k)
      if (k < first || k >= last) CHECK(list[k] == given[k]);
  }
}

TEST_CASE("no index comes after every index") {
  CHECK(no_index == std::uint32_t(-1));
  CHECK(sorted_indices(3, [](std::uint32_t a, std::uint32_t b) { return (a == 1 ? no_index : a) < (b == 1 ? no_index : b); }) ==
        Indices{0, 2, 1});
}

TEST_CASE("a number is in range below the count, and no_index never is") {
  CHECK(in_range(0, 1));
  CHECK(in_range(2, 3));
  CHECK_FALSE(in_range(3, 3));
  CHECK_FALSE(in_range(0, 0));
  CHECK_FALSE(in_range(no_index, 3));
  CHECK_FALSE(in_range(0x80000000, 0x7fffffff));
}
