#include "core/skinning/skin.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <random>
#include <utility>

#include "core/skinning/linear_blend.hpp"
#include "skins.hpp"

using namespace handlebody;

namespace {

constexpr double unfit_numbers[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e39};

/** Two vertices in space under two handles, each vertex a handle's own. */
std::unique_ptr<Skin> skin_of_two() {
  Matrix positions(2, 3), weights = Matrix::Identity(2, 2);
  positions << 1, 2, 3, -4, 5, 6;
  auto skin = linear_blend(test::shape_of(positions, weights));
  REQUIRE(skin);
  return std::move(*skin);
}

void check_shape_refused(const WeightedShape& shape, double floats, hb_status code, std::int64_t vertex = -1) {
  const auto checked = check_shape(shape, floats);
  REQUIRE_FALSE(checked);
  CAPTURE(checked.error().message);
  CHECK(checked.error().code == code);
  CHECK(checked.error().culprit == (vertex < 0 ? HB_CULPRIT_NONE : HB_CULPRIT_VERTEX));
  CHECK(checked.error().index == vertex);
  CHECK(!checked.error().remedy.empty());
}

}  // namespace

TEST_CASE("a skin knows its sizes, and its transforms are identities at first, d × (d + 1) row-major, in the plane and in space") {
  for (const Index d : {2, 3}) {
    const Matrix positions = Matrix::Ones(4, d), weights = Matrix::Constant(4, 3, 1.0 / 3);
    auto skin = linear_blend(test::shape_of(positions, weights));
    REQUIRE(skin);
    CHECK((*skin)->vertices() == 4);
    CHECK((*skin)->dimension() == d);
    CHECK((*skin)->handles() == 3);
    const Eigen::Map<const Matrix> transforms((*skin)->transforms(), 3 * d, d + 1);
    for (Index handle = 0; handle < 3; ++handle) CHECK(transforms.middleRows(handle * d, d) == Matrix::Identity(d, d + 1));
  }
}

TEST_CASE("a transform takes [v; 1] to its image, and what is written in place counts at once") {
  const auto skin = skin_of_two();
  Eigen::Map<Matrix> second(skin->transforms() + 12, 3, 4);
  second << 0, -1, 0, 10,  //
      1, 0, 0, 20,         //
      0, 0, 2, 30;
  Matrix expected(2, 3);
  expected << 1, 2, 3, 5, 16, 42;
  CHECK(test::apart(test::deformed(*skin), expected) < 1e-5);
  second = Matrix::Identity(3, 4);
  expected.row(1) << -4, 5, 6;
  CHECK(test::deformed(*skin) == expected);
}

TEST_CASE("a transform that single precision cannot hold is named by its handle, and nothing is written") {
  const auto skin = skin_of_two();
  for (const double bad : unfit_numbers)
    for (const Index number : {0, 11, 12, 23}) {
      CAPTURE(number);
      const double before = std::exchange(skin->transforms()[number], bad);
      MatrixF out = MatrixF::Constant(2, 3, 7);
      const auto done = skin->deform(out.data());
      REQUIRE_FALSE(done);
      CHECK(done.error().code == HB_ERROR_TARGET_NOT_FINITE);
      CHECK(done.error().culprit == HB_CULPRIT_HANDLE);
      CHECK(done.error().index == number / 12);
      CHECK(out == MatrixF::Constant(2, 3, 7));
      skin->transforms()[number] = before;
    }
  CHECK(test::deformed(*skin).allFinite());  // and the skin is as good as before
}

TEST_CASE("shapes that cannot be blended are named, with the vertex that is to blame") {
  Matrix positions = Matrix::Ones(5, 3), weights = Matrix::Constant(5, 2, 0.5);
  const auto shape = [&] { return test::shape_of(positions, weights); };
  CHECK(check_shape(shape(), 0x1p28));
  check_shape_refused(shape(), 0x1p28 + 64, HB_ERROR_OUT_OF_MEMORY);
  check_shape_refused(shape(), std::numeric_limits<double>::quiet_NaN(), HB_ERROR_OUT_OF_MEMORY);
  for (const Index d : {0, 1, 4}) {
    WeightedShape wrong = shape();
    wrong.dimension = d;
    check_shape_refused(wrong, 1, HB_ERROR_INVALID_SHAPE);
  }
  WeightedShape none = shape();
  none.vertices = 0;
  check_shape_refused(none, 1, HB_ERROR_INVALID_SHAPE);
  none = shape();
  none.handles = 0;
  check_shape_refused(none, 1, HB_ERROR_INVALID_SHAPE);
  for (const double bad : unfit_numbers) {
    positions(4, 1) = bad;
    check_shape_refused(shape(), 1, HB_ERROR_MESH_NOT_FINITE, 4);
    positions(4, 1) = 1, weights(3, 1) = bad;
    check_shape_refused(shape(), 1, HB_ERROR_VALUE_NOT_FINITE, 3);
    weights(3, 1) = 0.5;
  }
}

TEST_CASE("the middle of the box, as floats hold it, whatever the order of the vertices (seed 181)") {
  std::mt19937 random(181);
  for (const Index d : {2, 3}) {
    const Matrix positions = test::random_matrix(random, 20, d), reversed = positions.colwise().reverse();
    double center[3], again[3];
    box_center(positions.data(), 20, d, center);
    box_center(reversed.data(), 20, d, again);
    for (Index axis = 0; axis < d; ++axis) {
      const double middle = (positions.col(axis).minCoeff() + positions.col(axis).maxCoeff()) / 2;
      CHECK(std::abs(center[axis] - middle) < 1e-7);
      CHECK(center[axis] == static_cast<double>(static_cast<float>(center[axis])));
      CHECK(again[axis] == center[axis]);
    }
  }
}
