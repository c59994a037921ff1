#include "core/numerics/sparse_cholesky.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace handlebody;

namespace {

/** Differences on a square lattice, and `own` on the diagonal. */
SparseMatrix lattice(std::uint32_t side, double own) {
  SparseEntries entries(side * side);
  for (std::uint32_t v = 0; v < side * side; ++v) {
    entries.put(v, v, own);
    for (const std::uint32_t step : {1U, side}) {
      const std::uint32_t u = v + step;
      if (u >= side * side || (step == 1 && u % side == 0)) continue;
      entries.put(v, v, 1);
      entries.put(u, u, 1);
      entries.put(v, u, -1);
      entries.put(u, v, -1);
    }
  }
  return entries.matrix();
}

}  // namespace

TEST_CASE("a factor made in parts is the same to the last bit, and a failed one does not spoil the next") {
  const SparseMatrix a = lattice(30, .01), indefinite = lattice(30, -.01);
  auto whole = SparseCholesky::analyze(a), parts = SparseCholesky::analyze(a);
  REQUIRE(whole);
  REQUIRE(parts);
  REQUIRE((*whole)->factor(a));
  for (int round = 0; round < 2; ++round) {
    int calls = 0;
    double part = 0;
    while (part >= 0 && part < 1) {
      const double next = (*parts)->factor_part(indefinite, 1000);
      CHECK((next < 0 || next > part));
      part = next;
    }
    CHECK(part < 0);
    for (part = 0; part < 1; ++calls) {
      const double next = (*parts)->factor_part(a, 1000);
      REQUIRE(next > part);
      part = next;
    }
    CHECK(calls > 10);
    std::vector<double> x(900), y;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<double>(i % 17);
    const std::vector<double> right = x;
    y = x;
    (*whole)->solve(x.data());
    (*parts)->solve(y.data());
    CHECK(x == y);
    for (Index i = 0; i < 900; ++i) CHECK(a.row_times(i, x.data()) == doctest::Approx(right[i]));
  }
}
