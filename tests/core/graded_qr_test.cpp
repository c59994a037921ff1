#include "core/numerics/graded_qr.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>

#include "scattered.hpp"

using namespace handlebody;

namespace {

void fill(GradedQr& qr, const Matrix& a, const Vector& scale) {
  qr.reset(a.rows());
  for (Index i = 0; i < a.rows(); ++i) qr.set_row(i, scale[i], &a(i, 0));
}

}  // namespace

TEST_CASE("graded QR: the shortest solution of A'x = b, in one block or several (seed 1998)") {
  std::mt19937 random(1998);
  GradedQr qr(30, 6);
  for (const Index rows : {6, 13, 30}) {
    const Matrix a = test::random_points(random, rows, 6), b = test::random_points(random, 1, 6);
    Vector x(rows);
    fill(qr, a, Vector::Ones(rows));
    for (const Index end : {1, 3, 6}) CHECK(qr.extend(end));
    qr.solve_transposed(b.data(), x.data());
    CHECK((a.transpose() * x - b.transpose()).norm() < 1e-13);
    // The shortest lies in the span of the columns: nothing perpendicular to them is left.
    const Matrix gram = a.transpose() * a;
    Vector along = a.transpose() * x;
    MatrixXd inverse = gram.inverse();
    CHECK((a * (inverse * along) - x).norm() < 1e-10);
    const Vector eigen = MatrixXd(a.transpose()).completeOrthogonalDecomposition().solve(Vector(b.transpose()));
    CHECK((eigen - x).norm() < 1e-12 * std::max(1.0, x.norm()));
  }
}

TEST_CASE("graded QR: rows a hundred orders of magnitude apart keep all their digits (seed 1998)") {
  std::mt19937 random(1998);
  const Matrix a = test::random_points(random, 9, 3), b = test::random_points(random, 1, 3);
  GradedQr qr(9, 3);
  for (int shuffle = 0; shuffle < 20; ++shuffle) {
    Vector scale(9);
    for (Index i = 0; i < 9; ++i) scale[i] = std::exp(-60.0 * static_cast<double>((i * (shuffle % 8 + 1)) % 9));
    fill(qr, a, scale);
    REQUIRE(qr.extend(3));
    Vector x(9);
    qr.solve_transposed(b.data(), x.data());
    // To a part in e^120 the three largest rows decide alone: their 3×3 system is solved exactly.
    Index largest[3];
    Vector rest = scale;
    for (Index& row : largest) {
      rest.maxCoeff(&row);
      rest[row] = 0;
    }
    Eigen::Matrix3d top;
    for (int i = 0; i < 3; ++i) top.row(i) = a.row(largest[i]);
    const Eigen::Vector3d expected = top.transpose().inverse() * b.transpose();
    for (int i = 0; i < 3; ++i)
      CHECK(std::abs(x[largest[i]] * scale[largest[i]] - expected[i]) < 1e-13 * expected.norm() * top.inverse().norm());
  }
}

TEST_CASE("graded QR: dependent columns are refused at any grading, and the former ones stay usable (seed 1998)") {
  std::mt19937 random(1998);
  Matrix a = test::random_points(random, 12, 4);
  a.col(3) = 2 * a.col(0) - 0.3 * a.col(1);
  for (const double decay : {0.0, 3.0, 30.0}) {
    Vector scale(12);
    for (Index i = 0; i < 12; ++i) scale[i] = std::exp(-decay * static_cast<double>(i));
    GradedQr qr(12, 4);
    fill(qr, a, scale);
    CHECK(qr.extend(2));
    CHECK_FALSE(qr.extend(4));
    CHECK(qr.rank() == 2);
    const double b[] = {1, -2};
    Vector x(12);
    qr.solve_transposed(b, x.data());
    const Vector y = x.cwiseProduct(scale);
    CHECK(std::abs(a.col(0).dot(y) - 1) < 1e-12);
    CHECK(std::abs(a.col(1).dot(y) + 2) < 1e-12);
  }
  GradedQr few(12, 4);
  fill(few, a.topRows(1), Vector::Ones(1));
  CHECK(few.extend(1));
  CHECK_FALSE(few.extend(2));
}
