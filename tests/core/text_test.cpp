// Indices in messages read as people write them.
#include "core/errors/text.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <utility>

using handlebody::join;

TEST_CASE("messages join words, integers in full and numbers to three significant digits") {
  CHECK(join({"Handle ", 12, " of ", std::size_t{4294967295u}, "."}) == "Handle 12 of 4294967295.");
  CHECK(join({-7, " ", std::numeric_limits<std::int64_t>::min()}) == "-7 -9223372036854775808");
  CHECK(join({}).empty());
  const std::pair<double, const char*> cases[] = {
      {0.0, "0"},           {1.0, "1"},     {-2.5, "-2.5"},        {0.5, "0.5"},           {0.001234, "0.00123"},
      {0.00996, "0.00996"}, {42.0, "42"},   {99.96, "100"},        {999.4, "999"},         {999.6, "1000"},
      {123456.0, "123000"}, {1e-7, "1e-7"}, {1.25e30, "1.25e+30"}, {-3.5e-12, "-3.5e-12"}, {5e-324, "4.94e-324"}};
  for (const auto& [number, text] : cases) CHECK(join({number}) == text);
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(join({infinity, " ", -infinity, " ", std::numeric_limits<double>::quiet_NaN()}) == "infinity -infinity NaN");
}
