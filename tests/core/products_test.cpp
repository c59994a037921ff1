#include "core/numerics/products.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace handlebody;

TEST_CASE("products are those by definition, of parts of matrices and of nothing too (seed 51)") {
  std::mt19937 random(51);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto made = [&](Index rows, Index columns) {
    return MatrixXd(MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); }));
  };
  const auto by_definition = [](const MatrixXd& a, const MatrixXd& b) {
    MatrixXd out = MatrixXd::Zero(a.rows(), b.cols());
    for (Index i = 0; i < out.rows(); ++i)
      for (Index j = 0; j < out.cols(); ++j)
        for (Index k = 0; k < a.cols(); ++k) out(i, j) += a(i, k) * b(k, j);
    return out;
  };
  for (const Index n : {0, 1, 2, 5, 17, 40}) {
    CAPTURE(n);
    const MatrixXd a = made(n + 3, n), b = made(n, 6), c = made(n + 3, 4);
    CHECK((product(a, b) - by_definition(a, b)).lpNorm<Eigen::Infinity>() < 1e-13);
    CHECK((transposed_product(a, c) - by_definition(a.transpose(), c)).lpNorm<1>() < 1e-11);
    const Vector x = made(n, 1);
    Vector image = Vector::Constant(n + 3, 7);
    multiply(a, x, image);
    CHECK((image - by_definition(a, x)).lpNorm<Eigen::Infinity>() < 1e-13);
    multiply(a.topRows(n), x, image.head(n));
    CHECK((image - by_definition(a, x)).lpNorm<Eigen::Infinity>() < 1e-13);
  }
}
