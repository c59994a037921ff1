#include "core/skinning/linear_blend.hpp"

#include <vector>

#include "oracle_lines.hpp"
#include "skins.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

constexpr LinearBlendForm forms[] = {LinearBlendForm::direct, LinearBlendForm::compiled};

std::unique_ptr<Skin> make(const Matrix& positions, const Matrix& weights, LinearBlendForm form) {
  auto made = linear_blend(shape_of(positions, weights), form);
  REQUIRE(made);
  return std::move(*made);
}

/** uᵢ = Σⱼ wᵢⱼ Tⱼ [vᵢ; 1], literally. */
Matrix textbook(const Matrix& positions, const Matrix& weights, const std::vector<Matrix>& transforms) {
  Matrix out = Matrix::Zero(positions.rows(), positions.cols());
  for (Index j = 0; j < weights.cols(); ++j) {
    const Matrix moved = transformed(transforms[j], positions);
    for (Index i = 0; i < out.rows(); ++i) out.row(i) += weights(i, j) * moved.row(i);
  }
  return out;
}

Matrix matrix(const std::string& line, const std::string& key, Index columns) {
  const auto numbers = oracle_numbers(line, key);
  return Eigen::Map<const Matrix>(numbers.data(), std::ssize(numbers) / columns, columns);
}

}  // namespace

TEST_CASE("linear blend: plain loops in double to 1e-6 of the extent, for any weights and any number of vertices (seed 2004)") {
  std::mt19937 random(2004);
  for (const Index d : {2, 3})
    for (const Index h : {1, 2, 5, 17})
      for (const Index n : {1, 3, 4, 6, 61})
        for (const bool unity : {true, false}) {
          const Matrix positions = random_matrix(random, n, d),
                       weights = unity ? random_weights(random, n, h, -0.3) : random_matrix(random, n, h);
          std::vector<Matrix> transforms;
          for (Index j = 0; j < h; ++j) transforms.push_back(random_matrix(random, d, d + 1));
          const Matrix expected = textbook(positions, weights, transforms);
          for (const auto form : forms) {
            auto skin = make(positions, weights, form);
            for (Index j = 0; j < h; ++j) set_transform(*skin, j, transforms[j]);
            CAPTURE(n);
            CAPTURE(h);
            CHECK(apart(deformed(*skin), expected) < 1e-6 * std::max(1.0, weights.cwiseAbs().rowwise().sum().maxCoeff()));
          }
        }
}

TEST_CASE("linear blend: libigl's lbs_matrix to 1e-6 of the extent") {
  int cases = 0;
  for (const auto& line : oracle_lines("linear_blend.json")) {
    const auto d = static_cast<Index>(oracle_numbers(line, "dimension").at(0)),
               h = static_cast<Index>(oracle_numbers(line, "handles").at(0));
    const Matrix positions = matrix(line, "positions", d), weights = matrix(line, "weights", h),
                 transforms = matrix(line, "transforms", d * (d + 1)), expected = matrix(line, "deformed", d);
    const double extent = (expected.colwise().maxCoeff() - expected.colwise().minCoeff()).norm();
    for (const auto form : forms) {
      auto skin = make(positions, weights, form);
      Eigen::Map<Matrix>(skin->transforms(), h, d * (d + 1)) = transforms;
      CHECK(apart(deformed(*skin), expected) < 1e-6 * extent);
    }
    ++cases;
  }
  CHECK(cases == 6);
}

TEST_CASE("linear blend: identities leave every vertex exactly where it was, near the origin and far from it (seed 2005)") {
  std::mt19937 random(2005);
  for (const Index d : {2, 3})
    for (const double far : {0.0, 1e4, 1e8}) {
      const Matrix positions = random_matrix(random, 30, d).array() + far, weights = random_weights(random, 30, 6, -0.5);
      for (const auto form : forms) {
        auto skin = make(positions, weights, form);
        CHECK(deformed(*skin) == Matrix(positions.cast<float>().cast<double>()));
      }
    }
}

TEST_CASE("linear blend: one affine motion of all handles is that motion, for any weights that sum to 1 (seed 2006)") {
  std::mt19937 random(2006);
  for (const Index d : {2, 3}) {
    const Matrix positions = random_matrix(random, 40, d), weights = random_weights(random, 40, 8, -0.2);
    for (const Matrix& t : {random_rigid(random, d), random_matrix(random, d, d + 1)})
      for (const auto form : forms) {
        auto skin = make(positions, weights, form);
        for (Index j = 0; j < 8; ++j) set_transform(*skin, j, t);
        CHECK(apart(deformed(*skin), transformed(t, positions)) < 1e-6 * weights.cwiseAbs().rowwise().sum().maxCoeff());
      }
  }
}

TEST_CASE("linear blend: moving, turning and scaling shape and handles alike moves the result (seed 2007)") {
  std::mt19937 random(2007);
  for (const Index d : {2, 3})
    for (const double size : {1e-3, 1.0, 1e4}) {
      const Matrix positions = random_matrix(random, 40, d), weights = random_weights(random, 40, 5);
      Matrix there = random_rigid(random, d), back(d, d + 1);
      there *= size;
      const MatrixXd inverse = there.leftCols(d).transpose() / (size * size);
      back << inverse, -inverse * there.col(d);
      for (const auto form : forms) {
        auto skin = make(positions, weights, form), moved = make(transformed(there, positions), weights, form);
        for (Index j = 0; j < 5; ++j) {
          const Matrix t = random_rigid(random, d);
          set_transform(*skin, j, t);
          set_transform(*moved, j, compose(there, compose(t, back)));
        }
        CHECK(apart(deformed(*moved), transformed(there, deformed(*skin))) < 3e-6 * size);
      }
    }
}

TEST_CASE("linear blend: far from the origin the shape keeps the detail that floats there can hold (seed 2008)") {
  std::mt19937 random(2008);
  const Matrix positions = random_matrix(random, 40, 3).array() + 1000, weights = random_weights(random, 40, 4);
  for (const auto form : forms) {
    auto skin = make(positions, weights, form);
    std::vector<Matrix> transforms;
    for (Index j = 0; j < 4; ++j) {  // turns about the shape's middle
      const MatrixXd r = random_rotation(random, 3);
      transforms.push_back(affine(r, Vector::Constant(3, 1000) - r * Vector::Constant(3, 1000)));
      set_transform(*skin, j, transforms.back());
    }
    CHECK(apart(deformed(*skin), textbook(positions, weights, transforms)) < 6.5e-5);  // rest and result are off by 3.05e-5 each
  }
}

TEST_CASE("linear blend: bad input is named") {
  const Matrix positions = Matrix::Random(5, 2), weights = Matrix::Constant(5, 3, 1.0 / 3);
  const auto failure = [](const Matrix& p, const Matrix& w) {
    auto made = linear_blend(shape_of(p, w));
    REQUIRE(!made);
    return made.error();
  };
  CHECK(failure(Matrix::Zero(5, 4), weights).code == HB_ERROR_INVALID_SHAPE);
  CHECK(failure(Matrix::Zero(0, 2), weights).code == HB_ERROR_INVALID_SHAPE);
  CHECK(failure(positions, Matrix::Zero(5, 0)).code == HB_ERROR_INVALID_SHAPE);
  for (const double bad : {static_cast<double>(NAN), static_cast<double>(INFINITY), 1e39}) {
    Matrix p = positions, w = weights;
    p(3, 1) = w(4, 2) = bad;
    const Error off_place = failure(p, weights), off_weight = failure(positions, w);
    CHECK(off_place.code == HB_ERROR_MESH_NOT_FINITE);
    CHECK(off_place.index == 3);
    CHECK(off_weight.code == HB_ERROR_VALUE_NOT_FINITE);
    CHECK(off_weight.index == 4);
    CHECK(off_weight.message.find("handle 2") != std::string::npos);
    auto skin = make(positions, weights, LinearBlendForm::direct);
    skin->transforms()[1 * 6 + 5] = bad;
    std::vector<float> out(10, 7);
    const auto done = skin->deform(out.data());
    REQUIRE(!done);
    CHECK(done.error().code == HB_ERROR_TARGET_NOT_FINITE);
    CHECK(done.error().culprit == HB_CULPRIT_HANDLE);
    CHECK(done.error().index == 1);
    CHECK(out == std::vector<float>(10, 7));
  }
  // Sizes are refused before anything is looked at or allocated.
  CHECK(linear_blend({nullptr, nullptr, Index{1} << 24, 3, 100}).error().code == HB_ERROR_OUT_OF_MEMORY);
}
