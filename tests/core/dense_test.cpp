// Products and factorizations against Eigen's own, at sizes on either side of the unrolling by four and of the panels of LU.
#include "core/numerics/dense.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

using namespace handlebody;

namespace {

constexpr Index sizes[] = {1, 2, 3, 4, 5, 7, 8, 15, 16, 17, 31, 33, 50};

MatrixXd random_matrix(std::mt19937& random, Index rows, Index columns) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

}  // namespace

TEST_CASE("products are Eigen's to rounding (seed 51)") {
  std::mt19937 random(51);
  for (const Index n : sizes) {
    const MatrixXd a = random_matrix(random, n + 2, n), b = random_matrix(random, n, 6);
    CHECK((product(a, b) - a * b).cwiseAbs().maxCoeff() < 1e-13);
    const Columns3 x = b.leftCols<3>();
    Columns3 out(n + 2, 3);
    multiply(a, x, out);
    CHECK((out - a * x).cwiseAbs().maxCoeff() < 1e-13);
    const Vector y = b.col(3);
    Vector image(n + 2);
    multiply(a, y, image);
    CHECK((image - a * y).cwiseAbs().maxCoeff() < 1e-13);
    MatrixXd symmetric = random_matrix(random, n, n);
    const MatrixXd whole = symmetric.selfadjointView<Eigen::Lower>();
    symmetric.triangularView<Eigen::StrictlyUpper>().setConstant(std::numeric_limits<double>::quiet_NaN());  // never read
    Columns3 halved(n, 3);
    multiply_symmetric(symmetric, x, halved);
    CHECK((halved - whole * x).cwiseAbs().maxCoeff() < 1e-13);
    MatrixXd gram = MatrixXd::Identity(n, n);
    add_gram(a, gram);
    const MatrixXd expected = MatrixXd::Identity(n, n) + a.transpose() * a;
    CHECK((gram - expected).triangularView<Eigen::Lower>().toDenseMatrix().cwiseAbs().maxCoeff() < 1e-13);
  }
}

TEST_CASE("Cholesky solves from the right and refuses what is not positive definite (seed 52)") {
  std::mt19937 random(52);
  for (const Index n : sizes) {
    const MatrixXd root = random_matrix(random, 2 * n, n), b = random_matrix(random, 5, n);
    const MatrixXd a = root.transpose() * root + 0.1 * MatrixXd::Identity(n, n);
    MatrixXd factor = a.triangularView<Eigen::Lower>(), x = b;
    REQUIRE(factor_cholesky(factor));
    solve_cholesky(factor, x);
    CHECK((x * a - b).cwiseAbs().maxCoeff() < 1e-11);
    Vector one = b.row(2);
    solve_cholesky(factor, one);
    CHECK((a * one - b.row(2).transpose()).cwiseAbs().maxCoeff() < 1e-11);
    MatrixXd indefinite = a;
    indefinite(n - 1, n - 1) = -1;
    CHECK(!factor_cholesky(indefinite));
    indefinite(n - 1, n - 1) = std::numeric_limits<double>::quiet_NaN();
    CHECK(!factor_cholesky(indefinite));
  }
}

TEST_CASE("LU solves from the right as well as Eigen's does, zero pivots included (seed 53)") {
  std::mt19937 random(53);
  for (const Index n : sizes) {
    MatrixXd a = random_matrix(random, n, n);
    if (n > 1) a.diagonal().setZero();
    const MatrixXd b = random_matrix(random, 6, n);
    MatrixXd factor = a, x = b;
    std::vector<Index> pivots;
    factor_lu(factor, pivots);
    solve_lu(factor, pivots, x);
    const MatrixXd reference = a.transpose().partialPivLu().solve(b.transpose()).transpose();
    const double scale = a.cwiseAbs().maxCoeff() * reference.cwiseAbs().maxCoeff();
    CHECK((x * a - b).cwiseAbs().maxCoeff() < 1e-12 * std::max(1.0, scale));
  }
}
