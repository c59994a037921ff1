#include "core/numerics/anderson.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace handlebody;

namespace {

/** x ← A x + b with a symmetric A of the given largest eigenvalue: converges slowly. */
struct LinearIteration {
  MatrixXd a;
  Vector b;

  LinearIteration(Index n, double largest, unsigned seed) : a(MatrixXd::Zero(n, n)), b(n) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    MatrixXd basis = MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    for (Index j = 0; j < n; ++j) {  // Gram-Schmidt
      for (Index k = 0; k < j; ++k) basis.col(j) -= basis.col(k).dot(basis.col(j)) * basis.col(k);
      basis.col(j).normalize();
      a += largest * static_cast<double>(j + 1) / static_cast<double>(n) * basis.col(j) * basis.col(j).transpose();
    }
    b = Vector::NullaryExpr(n, [&] { return normal(random); });
  }
  Vector operator()(const Vector& x) const { return a * x + b; }
};

/** Steps until the residual is a billionth of the first one. */
int steps(const LinearIteration& g, Index window) {
  Anderson anderson(g.b.size(), window);
  Vector x = Vector::Zero(g.b.size());
  const double first = g(x).norm();
  for (int step = 1; step < 10000; ++step) {
    const Vector image = g(x);
    if ((image - x).norm() < 1e-9 * first) return step;
    if (window > 0) {
      anderson.accelerate(x.data(), image.data(), x.data());
    } else {
      x = image;
    }
  }
  return 10000;
}

}  // namespace

TEST_CASE("on a linear iteration, n + 1 steps are as good as all (Walker & Ni 2011), seeds 1 to 5") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    const LinearIteration g(6, 0.99, seed);
    const int plain = steps(g, 0), accelerated = steps(g, 8);
    CHECK(plain > 1000);
    CHECK(accelerated <= 10);  // 7 in exact arithmetic
  }
}

TEST_CASE("a short window still beats the plain iteration by far (seed 3)") {
  const LinearIteration g(60, 0.999, 3);
  CHECK(steps(g, 5) * 10 < steps(g, 0));
}

TEST_CASE("the first step is plain, and so is the one after forgetting; a fixed point stays") {
  const LinearIteration g(5, 0.9, 4);
  Anderson anderson(5, 3);
  Vector x = Vector::Ones(5), next(5);
  for (int round = 0; round < 2; ++round) {
    const Vector image = g(x);
    anderson.accelerate(x.data(), image.data(), next.data());
    CHECK(next == image);
    const Vector second = g(next);
    anderson.accelerate(next.data(), second.data(), next.data());
    CHECK(next != second);
    anderson.forget();
  }
  for (int step = 0; step < 50; ++step) {
    const Vector image = g(x);
    anderson.accelerate(x.data(), image.data(), x.data());
  }
  CHECK((g(x) - x).norm() < 1e-12);
}
