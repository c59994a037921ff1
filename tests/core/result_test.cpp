#include "core/errors/result.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace handlebody;

namespace {

/** Half of an even number. */
Result<int> result_half(int number) {
  if (number % 2 != 0)
    return Error(HB_ERROR_INVALID_OPTION, {number, " is odd."}, {"Give ", number + 1, "."}, HB_CULPRIT_POINT, number);
  return number / 2;
}

/** Hands an error on, as a Result of another type. */
Result<std::string> result_half_in_words(int number) {
  auto half = result_half(number);
  if (!half) return half.error();
  return "half is " + std::to_string(*half);
}

}  // namespace

TEST_CASE("an error joins its words, and blames nobody unless told") {
  const Error plain(HB_ERROR_MESH_OPEN, {"Edge ", 3, " of ", 4.5, " is open."}, {"Close it."});
  CHECK(plain.code == HB_ERROR_MESH_OPEN);
  CHECK(plain.message == "Edge 3 of 4.5 is open.");
  CHECK(plain.remedy == "Close it.");
  CHECK(plain.culprit == HB_CULPRIT_NONE);
  CHECK(plain.index == -1);
}

TEST_CASE("a result is a value or an error, and an error travels through results of other types unchanged") {
  const auto good = result_half(6);
  REQUIRE(good);
  CHECK(*good == 3);
  const auto words = result_half_in_words(6);
  REQUIRE(words);
  CHECK(*words == "half is 3");
  CHECK(words->size() == 9);

  const auto bad = result_half_in_words(7);
  REQUIRE_FALSE(bad);
  CHECK(bad.error().code == HB_ERROR_INVALID_OPTION);
  CHECK(bad.error().message == "7 is odd.");
  CHECK(bad.error().remedy == "Give 8.");
  CHECK(bad.error().culprit == HB_CULPRIT_POINT);
  CHECK(bad.error().index == 7);
}

TEST_CASE("values that are false, zero or empty are values all the same") {
  CHECK(Result<bool>(false));
  CHECK(Result<int>(0));
  CHECK(Result<std::vector<int>>(std::vector<int>()));
  CHECK(Result<std::unique_ptr<int>>(nullptr));
  CHECK(Result<Done>(Done{}));
}

TEST_CASE("a value can be changed in place and moved out, and need not be copyable") {
  Result<std::unique_ptr<int>> made(std::make_unique<int>(5));
  REQUIRE(made);
  **made = 6;
  const std::unique_ptr<int> taken = std::move(*made);
  CHECK(*taken == 6);
  CHECK(*made == nullptr);

  Result<std::vector<int>> list(std::vector<int>{1, 2});
  list->push_back(3);
  CHECK(*list == std::vector<int>{1, 2, 3});
}

TEST_CASE("a result that is moved takes its error along") {
  auto bad = result_half(9);
  const Result<int> moved = std::move(bad);
  REQUIRE_FALSE(moved);
  CHECK(moved.error().message == "9 is odd.");
}
