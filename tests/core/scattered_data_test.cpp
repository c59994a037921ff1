#include "core/interpolation/scattered_data.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <random>

using namespace handlebody;

namespace {

Matrix random_grid_points(std::mt19937& random, Index count, Index dimension, int places) {
  return Matrix::NullaryExpr(count, dimension, [&] { return static_cast<double>(random() % static_cast<unsigned>(places)); });
}

/** A value that the place decides. */
Matrix values_of_places(const Matrix& points) {
  Matrix values(points.rows(), 2);
  for (Index i = 0; i < points.rows(); ++i) values.row(i) << points.row(i).sum(), points.row(i).squaredNorm();
  return values;
}

void check_data_refused(const Matrix& points, const Matrix& values, hb_status code, hb_culprit culprit, std::int64_t index,
                        Coincident coincident = Coincident::merge) {
  const auto data = check_data(points, values, coincident);
  REQUIRE_FALSE(data);
  CAPTURE(data.error().message);
  CHECK(data.error().code == code);
  CHECK(data.error().culprit == culprit);
  CHECK(data.error().index == index);
}

}  // namespace

TEST_CASE("points at one place are merged into the first, by comparing all (seeds 111 to 116)") {
  for (unsigned seed = 111; seed <= 116; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Matrix points = random_grid_points(random, 60, 1 + seed % 3, 5);
    const Matrix values = values_of_places(points);
    const auto data = check_data(points, values, Coincident::merge);
    REQUIRE(data);
    CHECK(data->given == 60);
    CHECK(data->diagonal == doctest::Approx(4 * std::sqrt(1. + seed % 3)));
    std::vector<std::uint32_t> kept;
    for (Index i = 0; i < 60; ++i) {
      Index first = 0;
      while (points.row(first) != points.row(i)) ++first;
      CHECK(data->twin_of[i] == first);
      if (first == i) kept.push_back(static_cast<std::uint32_t>(i));
    }
    CHECK(data->kept == kept);
    REQUIRE(data->points.rows() == std::ssize(kept));
    for (std::size_t k = 0; k < kept.size(); ++k) {
      CHECK(data->points.row(static_cast<Index>(k)) == points.row(kept[k]));
      CHECK(data->values.row(static_cast<Index>(k)) == values.row(kept[k]));
    }
  }
}

TEST_CASE("a billionth of the diagonal is one place, a little more is two, at any size") {
  for (const double size : {1e-200, 1.0, 1e200}) {
    CAPTURE(size);
    Matrix points(4, 2), values = Matrix::Ones(4, 1);
    points << 0, 0, 3, 4, 3, 4 + 4e-9, 3 - 6e-9, 4;  // a diagonal of 5: one place within 5e-9
    points *= size;
    const auto data = check_data(points, values, Coincident::merge);
    REQUIRE(data);
    CHECK(data->twin_of == std::vector<std::uint32_t>{0, 1, 1, 3});
    CHECK(data->diagonal == doctest::Approx(5 * size).epsilon(1e-8));
  }
}

TEST_CASE("twins of twins have one name: the first of the chain") {
  // Each within a billionth of the next, the ends beyond it.
  Matrix points(4, 1), values = Matrix::Ones(4, 1);
  points << 1, 0, 0.8e-9, 1.6e-9;
  const auto data = check_data(points, values, Coincident::merge);
  REQUIRE(data);
  CHECK(data->twin_of == std::vector<std::uint32_t>{0, 1, 1, 1});
  points << 1.6e-9, 0.8e-9, 0, 1;  // and the other way round
  const auto other = check_data(points, values, Coincident::merge);
  REQUIRE(other);
  CHECK(other->twin_of == std::vector<std::uint32_t>{0, 0, 0, 3});
}

TEST_CASE("points that all coincide: one of them is kept, and has no extent") {
  const auto data = check_data(Matrix::Constant(3, 2, 7), Matrix::Constant(3, 1, 2), Coincident::merge);
  REQUIRE(data);
  CHECK(data->kept == std::vector<std::uint32_t>{0});
  CHECK(data->diagonal == 0);
}

TEST_CASE("a smoothing fit keeps points at one place, whatever their values") {
  Matrix points(3, 1), values(3, 1);
  points << 1, 1, 2;
  values << 3, 4, 5;
  const auto data = check_data(points, values, Coincident::keep);
  REQUIRE(data);
  CHECK(data->kept == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(data->twin_of == data->kept);
  CHECK(data->values == values);
}

TEST_CASE("data that cannot be are named, with the point that is to blame") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  Matrix points(4, 2), values(4, 2);
  points << 0, 0, 1, 0, 0, 1, 1, 0;
  values << 1, 2, 3, 4, 5, 6, 3, 4;
  CHECK(check_data(points, values, Coincident::merge));

  check_data_refused(Matrix(0, 2), Matrix(0, 1), HB_ERROR_POINTS_TOO_FEW, HB_CULPRIT_NONE, -1);
  check_data_refused(Matrix(3, 0), Matrix::Zero(3, 1), HB_ERROR_POINTS_TOO_FEW, HB_CULPRIT_NONE, -1);
  check_data_refused(points, Matrix(4, 0), HB_ERROR_POINTS_TOO_FEW, HB_CULPRIT_NONE, -1);
  for (const double bad : {nan, infinity, -infinity}) {
    Matrix p = points, v = values;
    p(2, 1) = bad;
    check_data_refused(p, v, HB_ERROR_POINT_NOT_FINITE, HB_CULPRIT_POINT, 2);
    v(1, 0) = bad;
    check_data_refused(points, v, HB_ERROR_VALUE_NOT_FINITE, HB_CULPRIT_POINT, 1, Coincident::keep);
  }
  values(3, 1) = 5;  // the fourth point is the second's place
  check_data_refused(points, values, HB_ERROR_POINT_DUPLICATE, HB_CULPRIT_POINT, 3);
  CHECK(check_data(points, values, Coincident::keep));
  check_data_refused(1.5e308 * points, values, HB_ERROR_POINTS_DEGENERATE, HB_CULPRIT_NONE, -1);
  check_data_refused(1e-310 * points, values, HB_ERROR_POINTS_DEGENERATE, HB_CULPRIT_NONE, -1);
}

TEST_CASE("distances to nearest neighbors, by comparing all, at any size and in any order (seed 117)") {
  std::mt19937 random(117);
  std::normal_distribution<double> normal;
  for (const Index dimension : {1, 2, 5})
    for (const double size : {1e-200, 1.0, 1e200}) {
      const Matrix points = Matrix::NullaryExpr(30, dimension, [&] { return normal(random); });
      const Vector nearest = nearest_distances(size * points);
      std::vector<Index> order(30);
      std::iota(order.begin(), order.end(), Index{0});
      std::shuffle(order.begin(), order.end(), random);
      Matrix shuffled(30, dimension);
      for (Index i = 0; i < 30; ++i) shuffled.row(i) = size * points.row(order[i]);
      const Vector again = nearest_distances(shuffled);
      for (Index i = 0; i < 30; ++i) {
        double least = HUGE_VAL;
        for (Index j = 0; j < 30; ++j)
          if (j != i) least = std::min(least, (points.row(i) - points.row(j)).norm());
        CHECK(nearest[i] == doctest::Approx(size * least).epsilon(1e-12));
      }
      for (Index i = 0; i < 30; ++i) CHECK(again[i] == doctest::Approx(nearest[order[i]]).epsilon(1e-12));
    }
  CHECK(nearest_distances(Matrix::Zero(1, 2))[0] == std::numeric_limits<double>::infinity());
  CHECK(nearest_distances(Matrix::Zero(3, 2)) == Vector::Zero(3));
}
