#include "core/numerics/symmetric_eigen.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace handlebody;

TEST_CASE("a symmetric matrix is its eigenvectors and eigenvalues, of either sign and double ones too (seed 12)") {
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  for (const Index n : {1, 2, 5, 64}) {
    MatrixXd q = MatrixXd::NullaryExpr(n, n, [&](Index, Index) { return normal(random); });
    MatrixXd a = q + MatrixXd(q.transpose());
    if (n == 5) a = 2 * MatrixXd::Identity(5, 5) - MatrixXd::Ones(5, 5);  // 2 four times, and −3
    const MatrixXd given = a;
    MatrixXd v;
    symmetric_eigen(a, v);
    CHECK((v * v.transpose() - MatrixXd::Identity(n, n)).norm() < 1e-12 * static_cast<double>(n));
    CHECK((v * a.diagonal().asDiagonal() * v.transpose() - given).norm() < 1e-12 * given.norm());
    if (n == 5) CHECK(a.diagonal().minCoeff() == doctest::Approx(-3));
  }
}
