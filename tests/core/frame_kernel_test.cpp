#include "core/irbf/frame_kernel.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace handlebody;

namespace {

struct Case {
  PointsF positions;
  MatrixF matrix;
  Matrix3 linear;
  Vector3 translation;
  Matrix coefficients;
};

Case random_case(Index vertices, Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Case c;
  c.positions = PointsF::NullaryExpr(vertices, 3, [&] { return static_cast<float>(0.5 * normal(random)); });
  c.matrix = MatrixF::NullaryExpr(vertices, columns, [&] { return static_cast<float>(std::exp(normal(random))); });
  for (Index v = 0; v < vertices; ++v) c.matrix.row(v) /= c.matrix.row(v).sum();
  c.linear = Matrix3::NullaryExpr([&] { return normal(random); });
  c.translation = Vector3::NullaryExpr([&] { return normal(random); });
  c.coefficients = Matrix::NullaryExpr(columns, 3, [&] { return normal(random); });
  return c;
}

/** The largest error of the displacement, against doubles. */
double error(const Case& c, FramePrecision precision) {
  const FrameKernel kernel(c.positions, c.matrix, precision);
  FrameKernel::Scratch scratch = kernel.scratch();
  PointsF displacement(c.positions.rows(), 3);
  kernel.apply(c.linear, c.translation, c.coefficients, scratch, displacement);
  Points expected = c.positions.cast<double>() * c.linear.transpose() + c.matrix.cast<double>() * c.coefficients;
  expected.rowwise() += c.translation.transpose();
  return (displacement.cast<double>() - expected).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("both precisions agree with doubles, whatever the number of vertices and columns (seeds 1 to 9)") {
  unsigned seed = 0;
  for (const Index vertices : {1, 7, 8, 250}) {
    for (const Index columns : {1, 2, 33, 204}) {
      const Case c = random_case(vertices, columns, seed++ % 9 + 1);
      CAPTURE(vertices);
      CAPTURE(columns);
      CHECK(error(c, FramePrecision::floating) < 4e-6);
      // Codes keep 12 bits of the coefficients, of size 3 here, and rows weigh them to 1.
      CHECK(error(c, FramePrecision::fixed) < 3.0 / 4096);
    }
  }
}

TEST_CASE("sums do not overflow where all codes and coefficients are as large as can be") {
  for (const Index columns : {32, 64, 400}) {
    Case c = random_case(16, columns, 1);
    // One row of ones among zeros: its codes are 32767 all along, and coefficients of one size and sign add up.
    c.matrix.setZero();
    c.matrix.row(3).setOnes();
    for (const double sign : {1.0, -1.0}) {
      c.coefficients.setConstant(sign * 100);
      CHECK(error(c, FramePrecision::fixed) < 1e-3 * 100 * static_cast<double>(columns));
    }
    for (Index k = 0; k < columns; ++k) c.matrix(5, k) = k % 2 ? -1.f : 1.f, c.coefficients.row(k).setConstant(k % 2 ? -100 : 100);
    CHECK(error(c, FramePrecision::fixed) < 1e-3 * 100 * static_cast<double>(columns));
  }
}

TEST_CASE("nothing is displaced by no coefficients, and constant columns keep all their digits") {
  Case c = random_case(40, 10, 5);
  c.linear.setZero();
  c.translation.setZero();
  c.coefficients.setZero();
  CHECK(error(c, FramePrecision::fixed) == 0);
  c = random_case(40, 10, 6);
  c.matrix.setConstant(0.1f);
  CHECK(error(c, FramePrecision::fixed) < 4e-6);
  c.matrix.resize(40, 0);
  c.coefficients.resize(0, 3);
  CHECK(error(c, FramePrecision::fixed) < 4e-6);
}

TEST_CASE("one outlier among the coefficients costs only its own columns' digits (seed 7)") {
  Case c = random_case(100, 320, 7);
  const double before = error(c, FramePrecision::fixed);
  c.coefficients(5, 0) = 1000;
  c.matrix.col(5).setConstant(c.matrix(0, 5));  // itself a translation, so that what it does to others is all that is seen
  const double after = error(c, FramePrecision::fixed);
  MESSAGE("error " << before << ", with an outlier " << after);
  CHECK(after < 0.05);
}
