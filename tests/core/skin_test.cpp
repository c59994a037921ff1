// What all skins share: transforms that begin as identities, and shapes and numbers that are refused.
#include "core/skinning/skin.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "skins.hpp"

using namespace handlebody;

namespace {

/** Every vertex goes with the last handle. */
class LastHandleSkin final : public Skin {
 public:
  explicit LastHandleSkin(const Matrix& rest) : Skin(rest.rows(), rest.cols(), 3), rest_(rest) {}

 private:
  void move(float* out) override {
    const Index d = dimension_, size = d * (d + 1);
    const Matrix t = Eigen::Map<const Matrix>(transforms_.data() + 2 * size, d, d + 1);
    Eigen::Map<MatrixF>(out, vertices_, d) = test::transformed(t, rest_).cast<float>();
  }

  Matrix rest_;
};

hb_status code_of(const WeightedShape& shape, double floats = 1) {
  const auto checked = check_shape(shape, floats);
  return checked ? HB_OK : checked.error().code;
}

}  // namespace

TEST_CASE("a new skin's transforms are identities, and deform() passes on what is written (seed 61)") {
  std::mt19937 random(61);
  for (const Index d : {2, 3}) {
    const Matrix rest = test::random_matrix(random, 20, d);
    LastHandleSkin skin(rest);
    for (Index handle = 0; handle < 3; ++handle) {
      const Matrix identity = Eigen::Map<const Matrix>(skin.transforms() + handle * d * (d + 1), d, d + 1);
      CHECK(identity == Matrix::Identity(d, d + 1));
    }
    const Matrix motion = test::random_rigid(random, d);
    test::set_transform(skin, 2, motion);
    CHECK(test::apart(test::deformed(skin), test::transformed(motion, rest)) < 1e-6);
  }
}

TEST_CASE("a transform that single precision cannot hold is refused by its handle, and nothing is written") {
  LastHandleSkin skin(Matrix::Ones(2, 2));
  for (const double bad : {std::nan(""), 1e39, -std::numeric_limits<double>::infinity()}) {
    skin.transforms()[6 + 4] = bad;  // number 4 of handle 1
    std::vector<float> out(4, 7);
    const auto done = skin.deform(out.data());
    REQUIRE(!done);
    CHECK(done.error().code == HB_ERROR_TARGET_NOT_FINITE);
    CHECK(done.error().culprit == HB_CULPRIT_HANDLE);
    CHECK(done.error().index == 1);
    CHECK(out == std::vector<float>(4, 7));
  }
  skin.transforms()[6 + 4] = 1;
  std::vector<float> out(4);
  CHECK(skin.deform(out.data()));
}

TEST_CASE("shapes are refused for their dimension, their counts, their memory and their numbers, by vertex") {
  Matrix positions = Matrix::Ones(3, 2), weights = Matrix::Ones(3, 4);
  const auto shape = [&] { return test::shape_of(positions, weights); };
  CHECK(code_of(shape()) == HB_OK);
  for (const Index dimension : {0, 1, 4}) {
    WeightedShape other = shape();
    other.dimension = dimension;
    CHECK(code_of(other) == HB_ERROR_INVALID_SHAPE);
  }
  WeightedShape empty = shape();
  empty.vertices = 0;
  CHECK(code_of(empty) == HB_ERROR_INVALID_SHAPE);
  empty = shape();
  empty.handles = 0;
  CHECK(code_of(empty) == HB_ERROR_INVALID_SHAPE);
  CHECK(code_of(shape(), 0x1p28) == HB_OK);
  CHECK(code_of(shape(), 0x1p28 + 64) == HB_ERROR_OUT_OF_MEMORY);
  CHECK(code_of(shape(), std::nan("")) == HB_ERROR_OUT_OF_MEMORY);

  positions(2, 1) = 1e300;
  auto checked = check_shape(shape(), 1);
  REQUIRE(!checked);
  CHECK(checked.error().code == HB_ERROR_MESH_NOT_FINITE);
  CHECK(checked.error().index == 2);
  positions(2, 1) = 1;
  weights(1, 3) = std::nan("");
  auto weighed = check_shape(shape(), 1);
  REQUIRE(!weighed);
  CHECK(weighed.error().code == HB_ERROR_VALUE_NOT_FINITE);
  CHECK(weighed.error().index == 1);
}

TEST_CASE("the box's center is the middle of its extremes, as a float") {
  const Matrix positions{{0, 10, -1}, {0.3, 30, -7}, {0.2, 11, -3}};
  double center[3];
  box_center(positions.data(), 3, 3, center);
  CHECK(center[0] == static_cast<double>(0.15f));
  CHECK(center[1] == 20);
  CHECK(center[2] == -4);
}
