#include "core/numerics/sparse.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace handlebody;

namespace {

SparseMatrix random_matrix(std::mt19937& random, std::int32_t rows, std::int32_t columns, int count) {
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Triplet> entries;
  for (int k = 0; k < count; ++k)
    entries.emplace_back(static_cast<std::int32_t>(random() % static_cast<unsigned>(rows)),
                         static_cast<std::int32_t>(random() % static_cast<unsigned>(columns)), value(random));
  SparseMatrix matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

TEST_CASE("sparse: triplets of one place add up in their order; rows are compressed and ascend; zeros stay") {
  const std::vector<Triplet> entries{{1, 2, 1e16}, {0, 3, 5}, {1, 0, 4}, {1, 2, 1}, {1, 2, -1e16}, {2, 1, 2}, {2, 1, -2}};
  SparseMatrix matrix(3, 4);
  matrix.setFromTriplets(entries.begin(), entries.end());
  CHECK(matrix.isCompressed());
  CHECK(matrix.nonZeros() == 4);
  CHECK(matrix.coeff(1, 2) == 0);  // 1e16 + 1 rounds to 1e16: another order would leave 1
  CHECK(matrix.outerIndexPtr()[1] == 1);
  CHECK(matrix.outerIndexPtr()[2] == 3);
  CHECK(matrix.outerIndexPtr()[3] == 4);
  CHECK(matrix.innerIndexPtr()[1] == 0);
  CHECK(matrix.innerIndexPtr()[2] == 2);
}

TEST_CASE("sparse: products are those of dense matrices, with ascending rows (seed 1101)") {
  std::mt19937 random(1101);
  for (int trial = 0; trial < 10; ++trial) {
    const SparseMatrix a = random_matrix(random, 30, 20, 90), b = random_matrix(random, 20, 25, 60);
    const Matrix x = Matrix::Random(20, 3), dense_a = a, dense_b = b;
    const Vector d = Vector::Random(20);
    Matrix image = Matrix::Ones(30, 3);
    image.noalias() = a * x;
    CHECK((image - dense_a * x).cwiseAbs().maxCoeff() < 1e-14);
    CHECK((a * x.col(1) - dense_a * x.col(1)).cwiseAbs().maxCoeff() < 1e-14);
    const SparseMatrix product = a * d.asDiagonal() * b;
    CHECK((Matrix(product) - dense_a * d.asDiagonal() * dense_b).cwiseAbs().maxCoeff() < 1e-14);
    for (Index row = 0; row < product.rows(); ++row) {
      Index last = -1;
      for (SparseMatrix::InnerIterator entry(product, row); entry; ++entry) {
        CHECK(entry.col() > last);
        last = entry.col();
      }
    }
  }
}
