#include "core/numerics/sparse_cholesky.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace handlebody;

namespace {

/** Differences on a square lattice, and `own` on the diagonal. */
SparseMatrix lattice(std::uint32_t side, double own) {
  std::vector<Triplet> entries;
  for (std::uint32_t v = 0; v < side * side; ++v) {
    entries.emplace_back(v, v, own);
    for (const std::uint32_t step : {1U, side}) {
      const std::uint32_t u = v + step;
      if (u >= side * side || (step == 1 && u % side == 0)) continue;
      entries.emplace_back(v, v, 1);
      entries.emplace_back(u, u, 1);
      entries.emplace_back(v, u, -1);
      entries.emplace_back(u, v, -1);
    }
  }
  SparseMatrix matrix(side * side, side * side);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
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
    Vector right(900);
    for (Index i = 0; i < 900; ++i) right[i] = static_cast<double>(i % 17);
    Vector x = right, y = right;
    (*whole)->solve(x.data());
    (*parts)->solve(y.data());
    CHECK(x == y);
    const Vector image = a * x;
    for (Index i = 0; i < 900; ++i) CHECK(image[i] == doctest::Approx(right[i]));
  }
}
