#include "core/numerics/sparse_cholesky.hpp"

#include <doctest/doctest.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <random>
#include <string>
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

TEST_CASE("sparse Cholesky: solutions are those of Eigen's SimplicialLDLT, of any number of columns (seed 1102)") {
  std::mt19937 random(1102);
  std::uniform_real_distribution<double> value(-1, 1);
  for (const int n : {1, 2, 17, 150}) {
    std::vector<Triplet> entries;
    std::vector<double> sums(static_cast<std::size_t>(n), 0.1);
    for (int k = 0; k < 3 * n; ++k) {
      const int i = static_cast<int>(random() % static_cast<unsigned>(n)),
                j = static_cast<int>(random() % static_cast<unsigned>(n));
      const double entry = value(random);
      if (i == j) continue;
      entries.emplace_back(i, j, entry);
      entries.emplace_back(j, i, entry);
      sums[static_cast<std::size_t>(i)] += std::abs(entry);
      sums[static_cast<std::size_t>(j)] += std::abs(entry);
    }
    for (int i = 0; i < n; ++i) entries.emplace_back(i, i, sums[static_cast<std::size_t>(i)]);
    SparseMatrix a(n, n);
    a.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<SparseMatrix> theirs(a);
    REQUIRE(theirs.info() == Eigen::Success);
    for (const bool own_order : {false, true}) {
      Indices reversed(static_cast<std::size_t>(n));
      for (int i = 0; i < n; ++i) reversed[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(n - 1 - i);
      auto ours = own_order ? SparseCholesky::analyze(a, reversed) : SparseCholesky::analyze(a);
      REQUIRE(ours);
      REQUIRE((*ours)->factor(a));
      for (const Index columns : {1, 2, 3, 8, 11}) {
        const Matrix right = Matrix::Random(n, columns), expected = theirs.solve(right);
        Matrix x = right;
        (*ours)->solve(x.data(), columns);
        CHECK((x - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.cwiseAbs().maxCoeff());
      }
    }
  }
}

TEST_CASE("sparse Cholesky: a factor that is too large is refused with its size, an indefinite matrix when it is factored") {
  const SparseMatrix a = lattice(40, .1);
  const auto refused = SparseCholesky::analyze(a, minimum_degree_order(a), 1000);
  REQUIRE(!refused);
  CHECK(refused.error().code == HB_ERROR_OUT_OF_MEMORY);
  CHECK(refused.error().message.find("1600 equations") != std::string::npos);
  auto made = SparseCholesky::analyze(a);
  REQUIRE(made);
  CHECK((*made)->factor(a));
  CHECK(!(*made)->factor(lattice(40, -.1)));
}
