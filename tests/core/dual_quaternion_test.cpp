#include "core/skinning/dual_quaternion.hpp"

#include <Eigen/SVD>
#include <vector>

#include "core/skinning/linear_blend.hpp"
#include "skins.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

std::unique_ptr<Skin> make(const Matrix& positions, const Matrix& weights) {
  auto made = dual_quaternion_blend(shape_of(positions, weights));
  REQUIRE(made);
  return std::move(*made);
}

/** Kavan et al.'s formulas on Eigen's quaternions, about the origin; the plane is space with z = 0. */
Matrix textbook(const Matrix& positions, const Matrix& weights, const std::vector<Matrix>& transforms) {
  const Index n = positions.rows(), d = positions.cols(), h = weights.cols();
  std::vector<Eigen::Vector4d> real, dual;  // x, y, z, w
  for (const Matrix& t : transforms) {
    Matrix3 r = Matrix3::Identity();
    Vector3 shift = Vector3::Zero();
    r.topLeftCorner(d, d) = t.leftCols(d);
    shift.head(d) = t.col(d);
    const Eigen::Quaterniond q(r);
    real.push_back(q.coeffs());
    dual.push_back(0.5 * (Eigen::Quaterniond(0, shift[0], shift[1], shift[2]) * q).coeffs());
  }
  Matrix out(n, d);
  for (Index i = 0; i < n; ++i) {
    Index pivot = 0;
    weights.row(i).cwiseAbs().maxCoeff(&pivot);
    Eigen::Vector4d p = Eigen::Vector4d::Zero(), e = p;
    for (Index j = 0; j < h; ++j) {
      const double w = real[j].dot(real[pivot]) < 0 ? -weights(i, j) : weights(i, j);
      p += w * real[j];
      e += w * dual[j];
    }
    const double length = p.norm();
    const Eigen::Quaterniond q(Eigen::Vector4d(p / length)), eps(Eigen::Vector4d(e / length));
    Vector3 v = Vector3::Zero();
    v.head(d) = positions.row(i).transpose();
    const Vector3 moved = q * v + 2 * (eps * q.conjugate()).vec();
    out.row(i) = moved.head(d).transpose();
  }
  return out;
}

/** A bar along x with a square section; its middle has weights ½ ½. */
struct Bar {
  Matrix positions{9 * 4, 3}, weights{9 * 4, 2};

  Bar() {
    for (Index i = 0; i < 36; ++i) {
      const double x = static_cast<double>(i / 4) / 4 - 1;
      positions.row(i) << x, i % 2 ? 0.2 : -0.2, i / 2 % 2 ? 0.2 : -0.2;
      weights.row(i) << (1 - x) / 2, (1 + x) / 2;
    }
  }
  /** Distance of the middle's corners from the axis. */
  static double radius(const Matrix& moved) { return moved.middleRows(16, 4).rightCols(2).rowwise().norm().minCoeff(); }
};

Matrix twist(double angle) {
  return affine(Eigen::AngleAxisd(angle, Vector3::UnitX()).toRotationMatrix(), Vector::Zero(3));
}

}  // namespace

TEST_CASE("dual quaternion: Kavan's formulas in double to 2e-6 of the extent, antipodality included (seed 2009)") {
  std::mt19937 random(2009);
  for (const Index d : {2, 3})
    for (const Index h : {1, 2, 3, 9})
      for (int trial = 0; trial < 20; ++trial) {
        const Matrix positions = random_matrix(random, 23, d), weights = random_weights(random, 23, h);
        auto skin = make(positions, weights);
        std::vector<Matrix> transforms;
        for (Index j = 0; j < h; ++j) {
          transforms.push_back(random_rigid(random, d));
          set_transform(*skin, j, transforms.back());
        }
        // Blends of opposite turns are as ill-conditioned as they are short.
        CHECK(apart(deformed(*skin), textbook(positions, weights, transforms)) < (h == 9 ? 2e-5 : 2e-6));
      }
}

TEST_CASE("dual quaternion: identities leave every vertex exactly where it was (seed 2010)") {
  std::mt19937 random(2010);
  for (const Index d : {2, 3})
    for (const double far : {0.0, 1e4, 1e8}) {
      const Matrix positions = random_matrix(random, 30, d).array() + far;
      auto skin = make(positions, random_matrix(random, 30, 6));
      CHECK(deformed(*skin) == Matrix(positions.cast<float>().cast<double>()));
    }
}

TEST_CASE("dual quaternion: one rigid motion of all handles is that motion, whatever the weights (seed 2011)") {
  std::mt19937 random(2011);
  for (const Index d : {2, 3})
    for (int trial = 0; trial < 20; ++trial) {
      const Matrix positions = random_matrix(random, 40, d), t = random_rigid(random, d);
      auto skin = make(positions, random_weights(random, 40, 8, -0.05) * (trial + 1));
      for (Index j = 0; j < 8; ++j) set_transform(*skin, j, t);
      CHECK(apart(deformed(*skin), transformed(t, positions)) < 2e-6);
    }
}

TEST_CASE("dual quaternion: every vertex stays at the distances that the rigid blend keeps, and scale is left out (seed 2012)") {
  std::mt19937 random(2012);
  for (const Index d : {2, 3}) {
    // Vertices with equal weights move as one rigid body.
    const Matrix positions = random_matrix(random, 20, d), row = random_weights(random, 1, 4);
    auto skin = make(positions, row.replicate(20, 1));
    for (Index j = 0; j < 4; ++j) {
      Matrix t = random_rigid(random, d);
      t.leftCols(d) *= 1 + static_cast<double>(j);  // scale
      set_transform(*skin, j, t);
    }
    const Matrix moved = deformed(*skin);
    for (Index i = 1; i < 20; ++i) {
      const double rest = (positions.row(i) - positions.row(0)).norm();
      CHECK((moved.row(i) - moved.row(0)).norm() == doctest::Approx(rest).epsilon(1e-5));
    }
  }
}

TEST_CASE("dual quaternion: of an affine transform the closest rotation, which keeps the handle's region in place (seed 2013)") {
  std::mt19937 random(2013);
  for (const Index d : {2, 3})
    for (int trial = 0; trial < 20; ++trial) {
      const Matrix positions = random_matrix(random, 30, d), t = random_matrix(random, d, d + 1);
      auto skin = make(positions, Matrix::Ones(30, 1));
      set_transform(*skin, 0, t);
      const Matrix moved = deformed(*skin);
      const MatrixXd a = t.leftCols(d);
      const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
      MatrixXd u = svd.matrixU();
      if (u.determinant() * svd.matrixV().determinant() < 0) u.col(d - 1) *= -1;
      const MatrixXd r = u * svd.matrixV().transpose();
      const Vector g = positions.colwise().mean().transpose(), image = a * g + t.col(d);
      CHECK(apart(moved, transformed(affine(r, image - r * g), positions)) < 1e-4);  // nearly reflected ones turn quickly
    }
}

TEST_CASE("dual quaternion: moving and turning shape and handles alike moves the result (seed 2014)") {
  std::mt19937 random(2014);
  for (const Index d : {2, 3})
    for (int trial = 0; trial < 10; ++trial) {
      const Matrix positions = random_matrix(random, 40, d), weights = random_weights(random, 40, 3);
      const Matrix there = random_rigid(random, d);
      const MatrixXd inverse = there.leftCols(d).transpose();
      const Matrix back = affine(inverse, -inverse * there.col(d));
      auto skin = make(positions, weights), moved = make(transformed(there, positions), weights);
      for (Index j = 0; j < 3; ++j) {
        Matrix t = random_rigid(random, d);
        t.leftCols(d) *= 1.3;
        set_transform(*skin, j, t);
        set_transform(*moved, j, compose(there, compose(t, back)));
      }
      CHECK(apart(deformed(*moved), transformed(there, deformed(*skin))) < 1e-5);
    }
}

TEST_CASE(
    "candy wrapper: twisted by 180 degrees, the middle of a bar has no radius under linear blending and all of it under dual "
    "quaternions") {
  const Bar bar;
  auto linear = std::move(*linear_blend(shape_of(bar.positions, bar.weights)));
  auto dual = make(bar.positions, bar.weights);
  const double rest = Bar::radius(bar.positions);
  for (const double degrees : {0.0, 60.0, 120.0, 179.0, 180.0}) {
    const double angle = degrees / 180 * EIGEN_PI;
    set_transform(*linear, 1, twist(angle));
    set_transform(*dual, 1, twist(angle));
    CHECK(Bar::radius(deformed(*linear)) == doctest::Approx(rest * std::cos(angle / 2)).epsilon(1e-6));
    CHECK(Bar::radius(deformed(*dual)) == doctest::Approx(rest).epsilon(1e-6));
  }
}

TEST_CASE("antipodality: the shorter way around, and the same for both quaternions of a rotation") {
  const Bar bar;
  for (const double degrees : {10.0, 100.0, 170.0, 190.0, 260.0, 350.0, 370.0, 530.0, 550.0, 710.0}) {
    auto skin = make(bar.positions, bar.weights);
    set_transform(*skin, 1, twist(degrees / 180 * EIGEN_PI));
    // The middle turns by half of the turn's representative in (−180°, 180°].
    const double shortest = std::remainder(degrees, 360.0) / 2;
    const Matrix expected = transformed(twist(shortest / 180 * EIGEN_PI), bar.positions);
    CHECK(apart(deformed(*skin).middleRows(16, 4), expected.middleRows(16, 4)) < 1e-6);
  }
  // Signs count between all handles, not only neighbors: turns of 0°, 120° and 240°, blended at equal weights but for the pivot.
  Matrix positions(3, 2), weights(3, 3);
  positions << 1, 0, 1, 0, 1, 0;
  weights << 0.4, 0.3, 0.3, 0.3, 0.4, 0.3, 0.3, 0.3, 0.4;
  auto skin = make(positions, weights);
  for (Index j = 0; j < 3; ++j)
    set_transform(*skin, j,
                  affine(Eigen::Rotation2Dd(2.0943951023931953 * static_cast<double>(j)).toRotationMatrix(), Vector::Zero(2)));
  const Matrix moved = deformed(*skin);
  for (Index i = 0; i < 3; ++i) {  // each vertex goes with its pivot, between the other two
    const double angle = 2.0943951023931953 * static_cast<double>(i);
    CHECK(moved(i, 0) == doctest::Approx(std::cos(angle)).epsilon(1e-5));
    CHECK(std::abs(moved(i, 1) - std::sin(angle)) < 1e-5);
  }
}

TEST_CASE("in the plane a joint turned by 180 degrees keeps its vertices at their distance (seed 2015)") {
  std::mt19937 random(2015);
  const Matrix positions = random_matrix(random, 50, 2), weights = random_weights(random, 50, 2);
  auto skin = make(positions, weights);
  set_transform(*skin, 1, affine(Eigen::Rotation2Dd(EIGEN_PI).toRotationMatrix(), Vector::Zero(2)));
  const Matrix moved = deformed(*skin);
  for (Index i = 0; i < 50; ++i) CHECK(moved.row(i).norm() == doctest::Approx(positions.row(i).norm()).epsilon(1e-5));
}

TEST_CASE("dual quaternion: canceled blends follow the pivot; transforms without a rotation keep none; bad input is named") {
  Matrix positions(1, 2), weights(1, 2);
  positions << 1, 0;
  weights << 1, -1;
  auto skin = make(positions, weights);
  for (Index j = 0; j < 2; ++j) set_transform(*skin, j, affine(MatrixXd::Identity(2, 2), Vector::Constant(2, 3)));
  CHECK(apart(deformed(*skin), Eigen::RowVector2d(4, 3)) < 1e-6);

  for (const Index d : {2, 3}) {
    auto flat = make(Matrix::Ones(1, d), Matrix::Ones(1, 1));
    set_transform(*flat, 0, Matrix::Zero(d, d + 1));  // its region goes to the origin
    CHECK(apart(deformed(*flat), Matrix::Zero(1, d)) < 1e-6);
  }

  Matrix none = Matrix::Ones(4, 2);
  none.row(2).setZero();
  const Matrix somewhere = Matrix::Random(4, 3);
  const auto made = dual_quaternion_blend(shape_of(somewhere, none));
  REQUIRE(!made);
  CHECK(made.error().code == HB_ERROR_WEIGHTS_MISSING);
  CHECK(made.error().index == 2);
  CHECK(dual_quaternion_blend({none.data(), none.data(), 4, 1, 2}).error().code == HB_ERROR_INVALID_SHAPE);
  skin->transforms()[7] = NAN;
  float out[2];
  CHECK(skin->deform(out).error().index == 1);
}
