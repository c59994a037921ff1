#include "core/posespace/pose_space.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "abi/handlebody.h"

using namespace handlebody;

namespace {

constexpr unsigned seed = 19800101;

// Expressions on Russell's plane (valence, arousal): approximate readings of his Fig. 4 (1980); the last six placed by others.
const Matrix& expressions() {
  static const Matrix places = [] {
    Matrix m(22, 2);
    m << .16, .89, .62, .76, .83, .53, .77, .19, .59, -.26, .56, -.31, .69, -.45, .28, -.67, .04, -.63, -.66, -.63, -.65, -.27,
        -.70, -.08, -.55, .41, -.65, .51, -.52, .58, -.34, .64, 0, 0, -.65, .35, -.55, .12, .725, .338, .639, -.481, .686, -.412;
    return m;
  }();
  return places;
}

Matrix random_places(std::mt19937& random, Index count, Index dimension) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(count, dimension, [&] { return uniform(random); });
}

PoseSpace make(const Matrix& places, const PoseSpaceOptions& options = {}) {
  auto space = PoseSpace::create(places, options);
  REQUIRE(space);
  return std::move(*space);
}

Vector weights_at(PoseSpace& space, const Vector& query) {
  Vector out(space.size());
  REQUIRE(space.weights(query, out));
  return out;
}

const PoseSpaceOptions normalized{PoseSpaceMethod::normalized, KernelKind::inverse_multiquadric, 0, -1};
const std::vector<PoseSpaceOptions> both_defaults{{}, normalized};

/** Inside the convex hull: to the left of every edge that has all points on its left. */
bool inside_hull(const Matrix& places, const Eigen::Vector2d& q) {
  for (Index a = 0; a < places.rows(); ++a)
    for (Index b = 0; b < places.rows(); ++b) {
      if (a == b) continue;
      const auto side = [&](double x, double y) {
        return (places(b, 0) - places(a, 0)) * (y - places(a, 1)) - (places(b, 1) - places(a, 1)) * (x - places(a, 0));
      };
      bool edge = true;
      for (Index c = 0; c < places.rows() && edge; ++c) edge = side(places(c, 0), places(c, 1)) >= -1e-12;
      if (edge && side(q.x(), q.y()) < 0) return false;
    }
  return true;
}

Error error_of(const Matrix& places, const PoseSpaceOptions& options = {}) {
  auto space = PoseSpace::create(places, options);
  if (space) return {HB_OK, {}, {}};
  CHECK(!space.error().message.empty());
  CHECK(!space.error().remedy.empty());
  return space.error();
}

}  // namespace

TEST_CASE("default weights stay tame on Russell's plane: hull within -0.6 and 1.3, pad within -1 and 1.6 (seed 19800101)") {
  std::mt19937 random(seed);
  for (int round = 0; round < 24; ++round) {
    std::vector<Index> chosen(22);
    std::iota(chosen.begin(), chosen.end(), 0);
    std::shuffle(chosen.begin(), chosen.end(), random);
    chosen.resize(round == 0 ? 22 : 16 + round % 6);
    const Matrix places = expressions()(chosen, Eigen::all);
    for (const auto& options : both_defaults) {
      PoseSpace space = make(places, options);
      double low = 0, high = 0, pad_low = 0, pad_high = 0;
      for (int i = -20; i <= 20; ++i)
        for (int j = -20; j <= 20; ++j) {
          const Eigen::Vector2d q(i / 20., j / 20.);
          const Vector w = weights_at(space, q);
          pad_low = std::min(pad_low, w.minCoeff());
          pad_high = std::max(pad_high, w.maxCoeff());
          if (!inside_hull(places, q)) continue;
          low = std::min(low, w.minCoeff());
          high = std::max(high, w.maxCoeff());
        }
      CHECK(low > -0.6);
      CHECK(high < 1.3);
      CHECK(pad_low > -1);
      CHECK(pad_high < 1.6);
    }
  }
}

TEST_CASE("weights are cardinal and sum to 1 to 1e-9, in the hull, far away and beyond all bounds (seed 19800101)") {
  std::mt19937 random(seed);
  for (const Index dimension : {1, 2, 3, 8}) {
    const Matrix places = random_places(random, 20, dimension);
    for (const auto& options : both_defaults) {
      PoseSpace space = make(places, options);
      for (Index i = 0; i < places.rows(); ++i) {
        const Vector error = weights_at(space, places.row(i).transpose()) - Vector::Unit(places.rows(), i);
        CHECK(error.lpNorm<Eigen::Infinity>() < 1e-9);
      }
      for (const double far : {0.3, 1.0, 10.0, 1e3, 1e6, 1e300}) {
        const Vector w = weights_at(space, far * random_places(random, 1, dimension).row(0).transpose());
        CHECK(std::abs(w.sum() - 1) < 1e-9);
        CHECK(w.lpNorm<Eigen::Infinity>() < 4);
      }
      CHECK(weights_at(space, Vector::Constant(dimension, std::numeric_limits<double>::max())).allFinite());
    }
  }
}

TEST_CASE("degree 1 reproduces places (seed 19800101)") {
  std::mt19937 random(seed);
  for (const KernelKind kernel : {KernelKind::multiquadric, KernelKind::thin_plate, KernelKind::linear}) {
    PoseSpace space = make(expressions(), {PoseSpaceMethod::cardinal, kernel, 0, 1});
    for (int i = 0; i < 50; ++i) {
      const Vector q = 3 * random_places(random, 1, 2).row(0).transpose();
      CHECK((expressions().transpose() * weights_at(space, q) - q).norm() < 1e-9);
    }
  }
}

TEST_CASE("weights do not change when the space is moved, turned and scaled, and follow the order of examples (seed 19800101)") {
  std::mt19937 random(seed);
  const double angle = 0.7, scale = 37;
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const Eigen::RowVector2d move(-500, 900);
  std::vector<Index> order(22);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  for (auto options : both_defaults) {
    for (const double width : {0.0, 0.2}) {
      options.width = width;
      PoseSpace space = make(expressions(), options);
      PoseSpace permuted = make(expressions()(order, Eigen::all), options);
      options.width = width * scale;
      PoseSpace moved = make((scale * expressions() * turn.transpose()).rowwise() + move, options);
      for (int i = 0; i < 30; ++i) {
        const Vector q = 1.5 * random_places(random, 1, 2).row(0).transpose();
        const Vector w = weights_at(space, q);
        CHECK((weights_at(moved, scale * turn * q + move.transpose()) - w).lpNorm<Eigen::Infinity>() < 1e-9);
        CHECK((weights_at(permuted, q) - w(order)).lpNorm<Eigen::Infinity>() < 1e-9);
      }
    }
  }
}

TEST_CASE("default weights are smooth: a thousandth of a step halves the error of the slope, examples included (C1)") {
  for (const auto& options : both_defaults) {
    PoseSpace space = make(expressions(), options);
    const Eigen::Vector2d direction(std::cos(1.0), std::sin(1.0));
    for (Index i = 0; i < expressions().rows(); ++i) {
      const Vector at = expressions().row(i).transpose();
      const auto kink = [&](double h) {  // jump of the slope across the example
        return ((weights_at(space, at + h * direction) - 2 * weights_at(space, at) + weights_at(space, at - h * direction)) / h)
            .norm();
      };
      CHECK(kink(1e-4) < 0.55 * kink(2e-4) + 1e-6);
    }
  }
}

TEST_CASE("one example has weight 1 everywhere, two split 1 between them, close ones stay apart") {
  for (const auto& options :
       {PoseSpaceOptions{}, normalized, PoseSpaceOptions{PoseSpaceMethod::cardinal, KernelKind::thin_plate, 0, 1}}) {
    PoseSpace one = make(Matrix::Constant(1, 3, 5), options);
    CHECK(weights_at(one, Eigen::Vector3d(5, 5, 5))[0] == 1);
    CHECK(weights_at(one, Eigen::Vector3d(-1e9, 7, 0))[0] == doctest::Approx(1).epsilon(1e-12));
  }
  Matrix pair(2, 2);
  pair << 0, 0, 1, 0;
  for (const auto& options : both_defaults) {
    PoseSpace two = make(pair, options);
    CHECK(weights_at(two, Eigen::Vector2d(0.5, 3))[0] == doctest::Approx(0.5));
  }
  Matrix close(3, 2);
  close << 0, 0, 1e-6, 0, 1, 1;
  for (const auto& options : both_defaults) {
    PoseSpace space = make(close, options);
    CHECK((weights_at(space, Eigen::Vector2d(1e-6, 0)) - Vector::Unit(3, 1)).norm() < 1e-6);
  }
}

TEST_CASE("bad input: every code, and the culprit") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(error_of(Matrix(0, 2)).code == HB_ERROR_EXAMPLES_TOO_FEW);

  Matrix bad = expressions();
  bad(7, 0) = nan;
  CHECK(error_of(bad).code == HB_ERROR_EXAMPLE_NOT_FINITE);
  CHECK(error_of(bad).index == 7);

  Matrix twins = expressions();
  twins.row(9) = twins.row(4).array() + 1e-12;
  const Error duplicate = error_of(twins);
  CHECK(duplicate.code == HB_ERROR_EXAMPLE_DUPLICATE);
  CHECK(duplicate.culprit == HB_CULPRIT_EXAMPLE);
  CHECK(duplicate.index == 9);
  CHECK(duplicate.message.find("example 4.") != std::string::npos);
  CHECK(error_of(Matrix::Zero(2, 2)).code == HB_ERROR_EXAMPLE_DUPLICATE);

  Matrix line(3, 2);
  line << 0, 0, 1, 2, 2, 4;
  CHECK(error_of(line, {PoseSpaceMethod::cardinal, KernelKind::thin_plate, 0, 1}).code == HB_OK);
  CHECK(error_of(line).code == HB_OK);
  CHECK(error_of(line.topRows(2), {PoseSpaceMethod::cardinal, KernelKind::thin_plate, 0, 1}).code == HB_OK);

  CHECK(error_of(line, {PoseSpaceMethod::cardinal, KernelKind::gaussian, 0, -1}).code == HB_ERROR_INVALID_OPTION);
  CHECK(error_of(line, {PoseSpaceMethod::cardinal, KernelKind::gaussian, -1, 0}).code == HB_ERROR_INVALID_OPTION);
  CHECK(error_of(line, {PoseSpaceMethod::cardinal, KernelKind::gaussian, nan, 0}).code == HB_ERROR_INVALID_OPTION);
  CHECK(error_of(line, {PoseSpaceMethod::normalized, KernelKind::linear, 0, -1}).code == HB_ERROR_INVALID_OPTION);

  // Far-apart numbers whose extent overflows, and numbers so small that its inverse does.
  CHECK(error_of(std::numeric_limits<double>::max() * (2 * expressions())).code != HB_OK);
  CHECK(error_of(5e-324 * Matrix::Identity(2, 2)).code != HB_OK);

  PoseSpace space = make(expressions());
  Vector out = Vector::Constant(22, 7);
  auto done = space.weights(Eigen::Vector2d(0, nan), out);
  REQUIRE(!done);
  CHECK(done.error().code == HB_ERROR_QUERY_NOT_FINITE);
  CHECK(out.minCoeff() == 7);
}

TEST_CASE("C interface: bad sizes and pointers are refused before anything is allocated") {
  const double places[] = {0, 0, 1, 0, 0, 1};
  hb_pose_space* space = nullptr;
  const auto create = [&](const double* at, uint32_t count, uint32_t dimension, uint32_t method, uint32_t kernel) {
    return hb_pose_space_create(at, count, dimension, method, kernel, 0, 0, &space);
  };
  CHECK(create(places, 0, 2, 0, 4) == HB_ERROR_EXAMPLES_TOO_FEW);
  CHECK(create(places, 4097, 2, 0, 4) == HB_ERROR_OUT_OF_MEMORY);
  CHECK(create(places, 0xffffffff, 0xffffffff, 0, 4) == HB_ERROR_OUT_OF_MEMORY);
  CHECK(create(places, 3, 0, 0, 4) == HB_ERROR_INVALID_SHAPE);
  CHECK(create(places, 3, 65, 0, 4) == HB_ERROR_INVALID_SHAPE);
  CHECK(create(nullptr, 3, 2, 0, 4) == HB_ERROR_INVALID_SHAPE);
  CHECK(create(places, 3, 2, 2, 4) == HB_ERROR_INVALID_OPTION);
  CHECK(create(places, 3, 2, 0, 7) == HB_ERROR_INVALID_OPTION);
  CHECK(hb_last_error()->code == HB_ERROR_INVALID_OPTION);
  CHECK(hb_pose_space_create(places, 3, 2, 0, 4, 0, 0, nullptr) == HB_ERROR_INVALID_SHAPE);
  CHECK(space == nullptr);

  REQUIRE(create(places, 3, 2, 0, 4) == HB_OK);
  const double query[] = {1, 0};
  double weights[3];
  CHECK(hb_pose_space_weights(space, query, weights) == HB_OK);
  CHECK(weights[1] == doctest::Approx(1));
  CHECK(hb_pose_space_weights(space, nullptr, weights) == HB_ERROR_INVALID_SHAPE);
  CHECK(hb_pose_space_weights(space, query, nullptr) == HB_ERROR_INVALID_SHAPE);
  CHECK(hb_pose_space_weights(nullptr, query, weights) == HB_ERROR_INVALID_SHAPE);
  hb_pose_space_free(space);
  hb_pose_space_free(nullptr);
}
