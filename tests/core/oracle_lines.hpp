// Reads the vectors of tests/oracles: one case a line, numbers and lists of numbers by name. They are our own files: no more of
// JSON is needed.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace handlebody {

inline std::vector<std::string> oracle_lines(const std::string& name) {
  std::ifstream file(HANDLEBODY_TEST_DATA "/" + name);
  REQUIRE(file.good());
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    if (line.size() > 2) lines.push_back(line);
  return lines;
}

/** The numbers of `"key": 1.5` or `"key": [1, 2, 3]`; none where the key is missing. */
inline std::vector<double> oracle_numbers(const std::string& line, const std::string& key) {
  std::vector<double> found;
  const std::size_t start = line.find('"' + key + "\": ");
  if (start == std::string::npos) return found;
  const char* at = line.c_str() + start + key.size() + 4;
  const bool list = *at == '[';
  if (list) ++at;
  for (char* end = nullptr; *at != ']'; at = end + std::strspn(end, ", ")) {
    found.push_back(std::strtod(at, &end));
    if (!list || end == at) break;
  }
  return found;
}

}  // namespace handlebody
