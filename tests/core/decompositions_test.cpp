// Against reconstruction of the factored matrix and against closed forms, on either side of the sizes from which Eigen works in
// blocks.
#include "core/numerics/decompositions.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace handlebody;

namespace {

constexpr Index sizes[] = {1, 2, 3, 5, 16, 17, 33, 150};
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

MatrixXd random_matrix(std::mt19937& random, Index rows, Index columns) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

/** Symmetric, with eigenvalues of at least 1. */
MatrixXd definite_matrix(std::mt19937& random, Index size) {
  const MatrixXd root = random_matrix(random, size, size);
  return root.transpose() * root + MatrixXd::Identity(size, size);
}

MatrixXd hilbert(Index size) {
  return MatrixXd::NullaryExpr(size, size, [](Index i, Index j) { return 1 / static_cast<double>(i + j + 1); });
}

double largest(const MatrixXd& a) {
  return a.size() == 0 ? 0 : a.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace

TEST_CASE("Cholesky's factor gives the matrix again, from its lower triangle alone, and solves with it (seed 61)") {
  std::mt19937 random(61);
  for (const Index n : sizes) {
    CAPTURE(n);
    const MatrixXd a = definite_matrix(random, n), b = random_matrix(random, n, 4);
    MatrixXd lower = a;
    lower.triangularView<Eigen::StrictlyUpper>().setConstant(not_a_number);
    const Cholesky cholesky(lower);
    REQUIRE(cholesky.succeeded());
    CHECK(cholesky.rows() == n);
    const MatrixXd l = cholesky.factor().triangularView<Eigen::Lower>();
    CHECK(largest(l * l.transpose() - a) < 1e-13 * largest(a));
    MatrixXd x = b;
    cholesky.solve_in_place(x);
    CHECK(largest(a * x - b) < 1e-11);
    Vector one = b.col(2);
    cholesky.solve_in_place(one);
    CHECK(largest(one - x.col(2)) < 1e-12);
  }
}

TEST_CASE("Cholesky refuses what is indefinite, singular or not a number, wherever in its lower triangle (seed 62)") {
  std::mt19937 random(62);
  for (const Index n : sizes) {
    CAPTURE(n);
    const MatrixXd a = definite_matrix(random, n);
    for (const Index k : {Index{0}, n / 2, n - 1}) {
      MatrixXd indefinite = a;
      indefinite(k, k) = -1;
      CHECK(!Cholesky(indefinite).succeeded());
      for (const double bad : {not_a_number, infinity, -infinity}) {
        MatrixXd broken = a;
        broken(n - 1, k) = bad;
        CHECK(!Cholesky(broken).succeeded());
      }
    }
  }
  CHECK(!Cholesky(MatrixXd::Zero(3, 3)).succeeded());
  CHECK(!Cholesky(MatrixXd::Ones(4, 4)).succeeded());
}

TEST_CASE("LU solves, with zeros on the diagonal too, and a singular matrix shows in what it gives (seed 63)") {
  std::mt19937 random(63);
  for (const Index n : sizes) {
    CAPTURE(n);
    MatrixXd a = random_matrix(random, n, n);
    if (n > 1) a.diagonal().setZero();
    const MatrixXd b = random_matrix(random, n, 3);
    const Lu lu(a);
    CHECK(lu.rows() == n);
    const MatrixXd x = lu.solve(b);
    const double allowed = 1e-13 * static_cast<double>(n) * std::max(1.0, largest(x));
    CHECK(largest(a * x - b) < allowed);
    CHECK(largest(a * lu.solve(b.col(1)) - b.col(1)) < allowed);
  }
  const Lu zero(MatrixXd::Zero(2, 2));
  CHECK(!zero.solve(Vector::Ones(2)).allFinite());
  CHECK(zero.rcond() == 0);
}

TEST_CASE("condition numbers: n of the diagonal 1 … n, Hilbert's in closed form, and none of a singular matrix") {
  // ‖H₅‖₁ = 137/60 and ‖H₅⁻¹‖₁ = 413280.
  constexpr double of_hilbert = 137.0 / 60 * 413280;
  CHECK(1 / Lu(hilbert(5)).rcond() == doctest::Approx(of_hilbert).epsilon(1e-9));
  CHECK(1 / Cholesky(hilbert(5)).rcond() == doctest::Approx(of_hilbert).epsilon(1e-9));
  for (const Index n : sizes) {
    CAPTURE(n);
    const MatrixXd diagonal = Vector::LinSpaced(n, 1, static_cast<double>(n)).asDiagonal();
    CHECK(1 / Cholesky(diagonal).rcond() == doctest::Approx(n));
    CHECK(1 / Lu(diagonal).rcond() == doctest::Approx(n));
    CHECK(1 / Qr(diagonal).rcond() == doctest::Approx(n));
  }
  MatrixXd singular = MatrixXd::Identity(3, 3);
  singular(2, 2) = 0;
  CHECK(!(Lu(singular).rcond() > 0));
  CHECK(!(Qr(singular).rcond() > 0));
}

TEST_CASE("the norm of an inverse from solutions with it is that of the inverse, or a little less (seed 64)") {
  struct Given final : Inverse {
    MatrixXd inverse;
    Index rows() const override { return inverse.rows(); }
    void apply(Vector& x) const override { x = Vector(inverse * x); }
  };
  std::mt19937 random(64);
  Given given;
  for (const Index n : sizes) {
    CAPTURE(n);
    given.inverse = definite_matrix(random, n).inverse();
    const double exact = one_norm(given.inverse), estimate = inverse_norm_estimate(given);
    CHECK(estimate <= exact * (1 + 1e-12));
    CHECK(estimate >= exact / 3);
  }
  given.inverse = hilbert(4);
  CHECK(inverse_norm_estimate(given) == doctest::Approx(25.0 / 12));  // of the matrix itself: 1 + ½ + ⅓ + ¼
}

TEST_CASE("the one-norm is the largest column's, 0 of nothing, and NaN where any number is") {
  MatrixXd a(2, 3);
  a << 1, -2, 3, -4, 5, -1;
  CHECK(one_norm(a) == 7);
  CHECK(one_norm(MatrixXd(4, 0)) == 0);
  for (const Index column : {0, 1, 2}) {
    MatrixXd broken = a;
    broken(1, column) = not_a_number;
    CHECK(std::isnan(one_norm(broken)));
  }
  a(0, 1) = -infinity;
  CHECK(one_norm(a) == infinity);
}

TEST_CASE("QR gives the matrix again, its Q is orthogonal, and it solves least squares (seed 65)") {
  std::mt19937 random(65);
  for (const Index n : sizes) {
    for (const Index more : {0, 1, 40}) {
      const Index m = n + more;
      CAPTURE(n);
      CAPTURE(m);
      const MatrixXd a = random_matrix(random, m, n), b = random_matrix(random, m, 3);
      const Qr qr(a);
      CHECK(qr.rows() == m);
      CHECK(qr.columns() == n);
      CHECK(qr.r().isUpperTriangular(0));
      MatrixXd again = MatrixXd::Zero(m, n);
      again.topRows(n) = qr.r();
      qr.apply(again);
      CHECK(largest(again - a) < 1e-13 * static_cast<double>(m));
      MatrixXd q = MatrixXd::Identity(m, m);
      qr.apply(q);
      CHECK(largest(q.transpose() * q - MatrixXd::Identity(m, m)) < 1e-13 * static_cast<double>(m));
      MatrixXd back = b;
      qr.apply_transposed(back);
      CHECK(largest(back - q.transpose() * b) < 1e-13 * static_cast<double>(m));

      const MatrixXd x = qr.solve(b);
      CHECK(largest(a.transpose() * (a * x - b)) < 1e-11 * std::max(1.0, largest(x)));
      MatrixXd y = b.topRows(n);
      qr.solve_r(y);
      CHECK(largest(qr.r() * y - b.topRows(n)) < 1e-12 * std::max(1.0, largest(y)));
      y = b.topRows(n);
      qr.solve_r_transposed(y);
      CHECK(largest(qr.r().transpose() * y - b.topRows(n)) < 1e-12 * std::max(1.0, largest(y)));
    }
  }
}

TEST_CASE("QR's two-sided product is QᵀAQ, from A's lower triangle alone (seed 66)") {
  std::mt19937 random(66);
  for (const Index n : sizes) {
    for (const Index columns : {Index{0}, Index{1}, n / 2, n}) {
      CAPTURE(n);
      CAPTURE(columns);
      const Qr qr(random_matrix(random, n, columns));
      const MatrixXd root = random_matrix(random, n, n), a = root + root.transpose();
      MatrixXd q = MatrixXd::Identity(n, n), lower = a;
      qr.apply(q);
      lower.triangularView<Eigen::StrictlyUpper>().setConstant(not_a_number);
      qr.conjugate(lower);
      const MatrixXd expected = q.transpose() * a * q, got = lower.selfadjointView<Eigen::Lower>();
      CHECK(largest(got - expected) < 1e-13 * static_cast<double>(n));
    }
  }
}

TEST_CASE("the span of columns: an orthonormal basis, and as many sizes above zero as there are dimensions (seed 67)") {
  std::mt19937 random(67);
  for (const Index dimensions : {0, 1, 3, 5}) {
    const MatrixXd factor = random_matrix(random, 12, dimensions), a = factor * random_matrix(random, dimensions, 5);
    const ColumnSpan span = column_span(a);
    CAPTURE(dimensions);
    REQUIRE(span.sizes.size() == 5);
    for (Index k = 0; k < 5; ++k) CHECK((span.sizes[k] > 1e-12) == (k < dimensions));
    for (Index k = 1; k < dimensions; ++k) CHECK(span.sizes[k] <= span.sizes[k - 1] * (1 + 1e-12));
    const MatrixXd basis = span.basis.leftCols(dimensions);
    CHECK(largest(basis.transpose() * basis - MatrixXd::Identity(dimensions, dimensions)) < 1e-14);
    CHECK(largest(a - basis * (basis.transpose() * a)) < 1e-13);
  }
  const ColumnSpan wide = column_span(random_matrix(random, 2, 6));
  CHECK(wide.basis.cols() == 2);
  CHECK(wide.sizes.size() == 2);
  CHECK(column_span(MatrixXd(3, 0)).sizes.size() == 0);
}

TEST_CASE("eigenvalues of a path's Laplacian are 2 − 2 cos(kπ/n), and V diag(λ) Vᵀ is the matrix (seed 68)") {
  std::mt19937 random(68);
  for (const Index n : sizes) {
    CAPTURE(n);
    MatrixXd path = MatrixXd::Zero(n, n);
    for (Index i = 0; i + 1 < n; ++i) {
      path(i, i) += 1;
      path(i + 1, i + 1) += 1;
      path(i + 1, i) = -1;
    }
    const auto [values, vectors] = symmetric_eigen(path);
    constexpr double pi = 3.14159265358979324;
    for (Index k = 0; k < n; ++k)
      CHECK(values[k] == doctest::Approx(2 - 2 * std::cos(static_cast<double>(k) * pi / static_cast<double>(n))).epsilon(1e-12));
    const MatrixXd a = definite_matrix(random, n);
    const SymmetricEigen eigen = symmetric_eigen(a);
    CHECK(largest(eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - a) < 1e-12 * largest(a));
    CHECK(largest(eigen.vectors.transpose() * eigen.vectors - MatrixXd::Identity(n, n)) < 1e-12);
  }
}
