#include "core/distance/filled_shell.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace handlebody;

namespace {

const Grid shell_grid{{0, 0, 0}, 1, {20, 20, 20}};

template <typename Where>
std::vector<std::uint32_t> cells_where(const Grid& grid, const Where& where) {
  std::vector<std::uint32_t> cells;
  for (std::int64_t c = 0; c < grid.size(); ++c) {
    const auto [i, j, k] = grid.cell(c);
    if (where(i, j, k)) cells.push_back(static_cast<std::uint32_t>(c));
  }
  return cells;
}

/** Distance of a cell from the middle of the grid of 20³. */
double from_middle(int i, int j, int k) {
  return std::hypot(i - 9.5, std::hypot(j - 9.5, k - 9.5));
}

}  // namespace

TEST_CASE("a shell of voxels with small holes is filled, one with a missing side is not") {
  const auto shell = [&](int hole) {
    return cells_where(shell_grid, [&](int i, int j, int k) {
      const bool within = std::min({i, j, k}) >= 3 && std::max({i, j, k}) <= 16;
      const bool deep = std::min({i, j, k}) > 3 && std::max({i, j, k}) < 16;
      const bool open = k == 16 && std::abs(i - 9) <= hole && std::abs(j - 9) <= hole;
      return within && !deep && !open;
    });
  };
  CHECK(filled_shell(shell_grid, shell(-1)).size() == 14 * 14 * 14);
  CHECK(filled_shell(shell_grid, shell(1)).size() == 14 * 14 * 14);
  CHECK(filled_shell(shell_grid, shell(9)).empty());
  CHECK(filled_shell(shell_grid, {}).empty());
}

TEST_CASE(
    "a shell without gaps gives exactly what it encloses, itself included, ascending, in whatever order and how often it is given "
    "(seed 81)") {
  const auto shell = cells_where(shell_grid, [](int i, int j, int k) { return std::abs(from_middle(i, j, k) - 7) < 0.9; });
  const auto ball = cells_where(shell_grid, [](int i, int j, int k) { return from_middle(i, j, k) < 7.9; });
  CHECK(filled_shell(shell_grid, shell) == ball);
  std::vector<std::uint32_t> shuffled = shell;
  shuffled.insert(shuffled.end(), shell.begin(), shell.begin() + 50);
  std::mt19937 random(81);
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  CHECK(filled_shell(shell_grid, shuffled) == ball);
}

TEST_CASE("what is filled already stays, up to the border of the grid") {
  const auto all = cells_where(shell_grid, [](int, int, int) { return true; });
  CHECK(filled_shell(shell_grid, all) == all);
  const auto border = cells_where(shell_grid, [](int i, int j, int k) {
    return std::min({i, j, k}) == 0 || std::max({i, j, k}) == 19;
  });
  CHECK(filled_shell(shell_grid, border) == all);
}

TEST_CASE("a sheet encloses nothing, and the crease of a folded one too little") {
  CHECK(filled_shell(shell_grid, cells_where(shell_grid, [](int, int, int k) { return k == 9; })).empty());
  const auto fold = cells_where(shell_grid, [](int i, int, int k) { return k == 9 || (k == 11 && i < 3) || (k == 10 && i == 0); });
  CHECK(filled_shell(shell_grid, fold).empty());
}

TEST_CASE("a shell with random gaps is filled: about its ball, and the same turned, mirrored and moved (seeds 82 to 85)") {
  for (unsigned seed = 82; seed <= 85; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto shell = cells_where(
        shell_grid, [&](int i, int j, int k) { return std::abs(from_middle(i, j, k) - 6) < 0.9 && random() % 100 < 40; });
    const auto filled = filled_shell(shell_grid, shell);
    const double volume = 4.18879 * 6.5 * 6.5 * 6.5;
    CHECK(static_cast<double>(filled.size()) > 0.85 * volume);
    CHECK(static_cast<double>(filled.size()) < 1.25 * volume);
    CHECK(std::includes(filled.begin(), filled.end(), shell.begin(), shell.end()));

    // Axes in another order, one of them mirrored, in a grid of other sizes.
    const Grid other{{0, 0, 0}, 1, {24, 21, 20}};
    const auto moved = [&](const std::vector<std::uint32_t>& cells) {
      std::vector<std::uint32_t> to;
      for (const std::uint32_t c : cells) {
        const auto [i, j, k] = shell_grid.cell(c);
        to.push_back(static_cast<std::uint32_t>(other.linear(k + 3, 20 - i, j)));
      }
      std::sort(to.begin(), to.end());
      return to;
    };
    CHECK(filled_shell(other, moved(shell)) == moved(filled));
  }
}
