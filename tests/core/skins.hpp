// What the tests of skinning share: random shapes, weights and transforms, and the definitions taken literally, in double.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "core/skinning/skin.hpp"

namespace handlebody::test {

inline Matrix random_matrix(std::mt19937& random, Index rows, Index columns) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

/** Rows of numbers from `low` to 1, divided by their sum. */
inline Matrix random_weights(std::mt19937& random, Index rows, Index columns, double low = 0) {
  std::uniform_real_distribution<double> uniform(low, 1);
  Matrix w = Matrix::NullaryExpr(rows, columns, [&] { return uniform(random); });
  for (Index i = 0; i < rows; ++i) w.row(i) /= w.row(i).sum();
  return w;
}

/** A rotation of d×d by a random angle (about a random axis). */
inline MatrixXd random_rotation(std::mt19937& random, Index d) {
  std::normal_distribution<double> normal;
  if (d == 2) return Eigen::Rotation2Dd(4 * normal(random)).toRotationMatrix();
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
}

/** [a | t]. */
inline Matrix affine(const MatrixXd& a, const Vector& t) {
  Matrix out(a.rows(), a.cols() + 1);
  out << a, t;
  return out;
}

inline Matrix random_rigid(std::mt19937& random, Index d) {
  return affine(random_rotation(random, d), random_matrix(random, d, 1));
}

/** a ∘ b. */
inline Matrix compose(const Matrix& a, const Matrix& b) {
  const Index d = a.rows();
  return affine(MatrixXd(a.leftCols(d)) * b.leftCols(d), MatrixXd(a.leftCols(d)) * b.col(d) + a.col(d));
}

inline WeightedShape shape_of(const Matrix& positions, const Matrix& weights) {
  return {positions.data(), weights.data(), positions.rows(), positions.cols(), weights.cols()};
}

inline void set_transform(Skin& skin, Index handle, const Matrix& t) {
  Eigen::Map<Matrix>(skin.transforms() + handle * t.size(), t.rows(), t.cols()) = t;
}

inline Matrix deformed(Skin& skin) {
  MatrixF out(skin.vertices(), skin.dimension());
  REQUIRE(skin.deform(out.data()));
  return out.cast<double>();
}

inline Matrix transformed(const Matrix& t, const Matrix& positions) {
  const Index d = t.rows();
  Matrix out(positions.rows(), d);
  for (Index i = 0; i < positions.rows(); ++i)
    out.row(i) = (MatrixXd(t.leftCols(d)) * positions.row(i).transpose() + t.col(d)).transpose();
  return out;
}

inline double apart(const Matrix& a, const Matrix& b) {
  const double most = (a - b).cwiseAbs().maxCoeff();
  return std::isfinite(most) && a.allFinite() ? most : INFINITY;
}

}  // namespace handlebody::test
