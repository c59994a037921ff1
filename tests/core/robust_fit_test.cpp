#include "core/interpolation/robust_fit.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "scattered.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

/** Places on a line with values 3 − 2x, a little noise on all of them, and some far off: `bad` of them, at odd places. */
struct Line {
  MatrixXd design;
  Matrix values;

  Line(std::mt19937& random, Index count, Index bad) : design(count, 2), values(count, 1) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (Index i = 0; i < count; ++i) {
      const double x = uniform(random);
      design.row(i) << 1, x;
      values(i, 0) = 3 - 2 * x + 1e-3 * uniform(random) + (i % 2 == 1 && i / 2 < bad ? 5 + uniform(random) : 0);
    }
  }

  static bool is_bad(Index i, Index bad) { return i % 2 == 1 && i / 2 < bad; }
};

Vector weighted_fit(const MatrixXd& design, const Matrix& values, const Vector& weights) {
  const Vector roots = weights.cwiseSqrt();
  return (roots.asDiagonal() * design).colPivHouseholderQr().solve(roots.asDiagonal() * values.col(0));
}

}  // namespace

TEST_CASE("least absolute misfits: as small a sum as that of the best line through two of the points (seed 81)") {
  std::mt19937 random(81);
  for (const Index bad : {0, 2, 5}) {
    CAPTURE(bad);
    const Line line(random, 21, bad);
    const Vector weights = least_absolute_weights(line.design, line.values);
    CHECK(weights.minCoeff() > 0);
    CHECK(weights.maxCoeff() <= 1);
    const auto sum_of = [&](const Vector& x) { return (line.design * x - line.values.col(0)).lpNorm<1>(); };
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < 21; ++i)
      for (Index j = 0; j < i; ++j)
        least = std::min(least, sum_of(line.design({i, j}, Eigen::all).fullPivLu().solve(Vector(line.values.col(0)({i, j})))));
    CHECK(sum_of(weighted_fit(line.design, line.values, weights)) <= 1.001 * least);
    for (Index i = 0; i < 21; ++i)
      if (Line::is_bad(i, bad)) CHECK(weights[i] < 1e-3);
  }
}

TEST_CASE("least median: all of the bad points and nearly none of the good ones are left out, up to two fifths of them (seed 82)") {
  std::mt19937 random(82);
  for (const Index bad : {0, 4, 12}) {
    CAPTURE(bad);
    const Line line(random, 30, bad);
    const Vector weights = least_median_weights(line.design, line.values);
    int kept = 0;
    for (Index i = 0; i < 30; ++i) {
      CHECK((weights[i] == 0 || weights[i] == 1));
      if (Line::is_bad(i, bad))
        CHECK(weights[i] == 0);
      else
        kept += weights[i] == 1;
    }
    CHECK(kept >= 30 - bad - 2);
    const Vector x = weighted_fit(line.design, line.values, weights);
    CHECK((x - Eigen::Vector2d(3, -2)).norm() < 1e-3);
    CHECK(least_median_weights(line.design, line.values) == weights);
  }
}

TEST_CASE("weights do not change with the unit or the origin of the values, nor when outputs are turned (seed 83)") {
  std::mt19937 random(83);
  const Line line(random, 25, 6);
  const Vector absolute = least_absolute_weights(line.design, line.values), median = least_median_weights(line.design, line.values);
  const Matrix scaled = 1024 * line.values, shifted = line.values.array() + 7;
  CHECK((least_absolute_weights(line.design, scaled) - absolute).lpNorm<Eigen::Infinity>() < 1e-6);
  CHECK((least_absolute_weights(line.design, shifted) - absolute).lpNorm<Eigen::Infinity>() < 1e-6);
  CHECK(least_median_weights(line.design, scaled) == median);
  CHECK(least_median_weights(line.design, shifted) == median);
  Matrix turned(25, 2);
  turned << 0.6 * line.values, 0.8 * line.values;
  // The least misfit that counts is a part of the widest output's spread, which is narrower now.
  CHECK((least_absolute_weights(line.design, turned) - absolute).lpNorm<Eigen::Infinity>() < 1e-2);
  CHECK(least_median_weights(line.design, turned) == median);
}

TEST_CASE("least absolute weights follow their points when these are renumbered (seed 84)") {
  std::mt19937 random(84);
  const Line line(random, 25, 6);
  std::vector<Index> order(25);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  const Vector weights = least_absolute_weights(line.design, line.values);
  const Vector moved = least_absolute_weights(line.design(order, Eigen::all), line.values(order, Eigen::all));
  CHECK((moved - weights(order)).lpNorm<Eigen::Infinity>() < 1e-6);
}

TEST_CASE("a model that its points do not determine believes all of them") {
  const MatrixXd design = MatrixXd::Zero(6, 2);
  Matrix values = Matrix::Ones(6, 1);
  values(5, 0) = 2;
  CHECK(least_absolute_weights(design, values) == Vector::Ones(6));
}
