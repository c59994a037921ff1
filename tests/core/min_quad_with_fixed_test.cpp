#include "core/numerics/min_quad_with_fixed.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

using namespace handlebody;

namespace {

/** Symmetric, positive definite, a few entries a row. */
SparseMatrix random_definite(std::mt19937& random, int n) {
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Triplet> entries;
  Vector diagonal = Vector::Constant(n, 0.1);
  for (int k = 0; k < 2 * n; ++k) {
    const int i = static_cast<int>(random() % static_cast<unsigned>(n)), j = static_cast<int>(random() % static_cast<unsigned>(n));
    const double entry = value(random);
    if (i == j) continue;
    entries.emplace_back(i, j, entry);
    entries.emplace_back(j, i, entry);
    diagonal[i] += std::abs(entry);
    diagonal[j] += std::abs(entry);
  }
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, diagonal[i]);
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Indices some(std::mt19937& random, std::uint32_t n) {
  Indices chosen;
  for (std::uint32_t i = 0; i < n; ++i)
    if (random() % 3 > 0) chosen.push_back(i);
  return chosen;
}

std::unique_ptr<MinQuadWithFixed> made(const SparseMatrix& q, const Indices& free, Indices order = {}) {
  auto solver = MinQuadWithFixed::create(q, free, {.columns = 1, .order = std::move(order)});
  REQUIRE(solver);
  REQUIRE((*solver)->succeeded());
  return std::move(*solver);
}

}  // namespace

TEST_CASE("min_quad_with_fixed: the gradient vanishes at the free unknowns, and the fixed ones stay (seed 1103)") {
  std::mt19937 random(1103);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 5 + 5 * trial;
    const SparseMatrix q = random_definite(random, n);
    const Indices free = some(random, static_cast<std::uint32_t>(n));
    Indices backwards(free.size());
    for (std::size_t k = 0; k < free.size(); ++k) backwards[k] = static_cast<std::uint32_t>(free.size() - 1 - k);
    const auto solver = made(q, free), other = made(q, free, backwards);
    for (const Index columns : {1, 2, 9}) {
      const Matrix before = Matrix::Random(n, columns), f = Matrix::Random(n, columns);
      Matrix u = before, without = before, reordered = before;
      const double change = solver->solve(f, u);
      solver->solve(without);
      other->solve(f, reordered);
      CHECK(change == (u - before).cwiseAbs().maxCoeff());
      CHECK((u - reordered).cwiseAbs().maxCoeff() < 1e-12);
      const Matrix gradient = q * u - f, plain = q * without;
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
        if (std::binary_search(free.begin(), free.end(), i)) {
          CHECK(gradient.row(i).cwiseAbs().maxCoeff() < 1e-12);
          CHECK(plain.row(i).cwiseAbs().maxCoeff() < 1e-12);
        } else {
          CHECK(u.row(i) == before.row(i));
          CHECK(without.row(i) == before.row(i));
        }
      }
      // Neither what the free rows were nor forces on fixed ones matter.
      Matrix again = before, elsewhere = f;
      for (const std::uint32_t i : free) again.row(i).setConstant(3);
      for (Index i = 0; i < n; ++i)
        if (!std::binary_search(free.begin(), free.end(), static_cast<std::uint32_t>(i))) elsewhere.row(i).setConstant(1e9);
      solver->solve(elsewhere, again);
      CHECK(again == u);
    }
    // Vectors and columns of a matrix are changed in place, too.
    Matrix both = Matrix::Random(n, 2);
    Vector vector = both.col(0), force = Vector::Random(n);
    Matrix same = vector;
    solver->solve(force, vector);
    solver->solve(Matrix(force), same);
    CHECK(vector == same.col(0));
  }
}

TEST_CASE("min_quad_with_fixed: the rows of free unknowns are what selection matrices select (seed 1104)") {
  std::mt19937 random(1104);
  const SparseMatrix q = random_definite(random, 60);
  const Indices free = some(random, 60);
  SparseMatrix select(60, std::ssize(free));
  std::vector<Triplet> ones;
  for (std::size_t k = 0; k < free.size(); ++k)
    ones.emplace_back(static_cast<std::int32_t>(free[k]), static_cast<std::int32_t>(k), 1);
  select.setFromTriplets(ones.begin(), ones.end());
  const SparseMatrix by_products = select.transpose() * q * select;
  const FreeRows rows = free_rows(q, free);
  CHECK(Matrix(rows.among_free) == Matrix(by_products));
  CHECK(rows.among_free.isCompressed());
  CHECK(rows.to_fixed.isCompressed());
  Matrix rest = q;
  for (const std::uint32_t i : free) rest.col(i).setZero();
  CHECK(Matrix(rows.to_fixed) == Matrix(select.transpose() * rest));
}

TEST_CASE("min_quad_with_fixed: none free, all free, and what cannot be determined") {
  std::mt19937 random(1105);
  const SparseMatrix q = random_definite(random, 12);
  Matrix u = Matrix::Random(12, 2);
  const Matrix before = u, f = Matrix::Random(12, 2);
  CHECK(made(q, {})->solve(f, u) == 0);
  CHECK(u == before);
  made(q, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11})->solve(f, u);
  CHECK((u - Matrix(q).lu().solve(f)).cwiseAbs().maxCoeff() < 1e-12);
  // Differences alone, and nothing fixed: constants are free to move.
  std::vector<Triplet> entries{{0, 0, 1}, {1, 1, 1}, {0, 1, -1}, {1, 0, -1}};
  SparseMatrix difference(2, 2);
  difference.setFromTriplets(entries.begin(), entries.end());
  const auto loose = MinQuadWithFixed::create(difference, {0, 1}, {});
  REQUIRE(loose);
  CHECK(!(*loose)->succeeded());
  CHECK(made(difference, {1})->factor_cost() == 1);
}
