#include "core/numerics/orthogonal_columns.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <random>

using namespace handlebody;

namespace {

Matrix3 normal_matrix(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Matrix3::NullaryExpr([&] { return normal(random); });
}

/** a·v = columns, v orthogonal, the columns perpendicular, the longest first. */
void check_columns(const Matrix3& a, const OrthogonalColumns& found) {
  const auto& [columns, v] = found;
  CHECK((v.transpose() * v - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((a * v - columns).norm() <= 1e-14 * a.norm());
  const Vector3 length = columns.colwise().norm().transpose();
  for (Index k = 0; k < 3; ++k) {
    const double product = length[k] * length[(k + 1) % 3];
    CHECK(std::abs(columns.col(k).dot(columns.col((k + 1) % 3))) <= 1e-14 * product);
    if (k > 0) CHECK(length[k] <= length[k - 1] * (1 + 1e-15));
  }
}

}  // namespace

TEST_CASE("orthogonal columns: singular values of any matrix, longest first; eigenvectors of a semidefinite one (seed 44)") {
  std::mt19937 random(44);
  for (int trial = 0; trial < 500; ++trial) {
    Matrix3 a = normal_matrix(random);
    if (trial % 3 == 1) a.col(2) = a.col(0) - 2 * a.col(1);
    const bool semidefinite = trial % 2 == 1;
    if (semidefinite) a = (a * a.transpose()).eval();
    const auto [columns, v] = orthogonal_columns(a);
    if (trial % 3 != 1) check_columns(a, {columns, v});  // of rank 2, the last column is rounding
    CHECK((v.transpose() * v - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-14);
    CHECK((a * v - columns).norm() < 1e-14 * a.norm());
    const Vector3 sigma = Eigen::JacobiSVD<Matrix3>(a).singularValues();
    CHECK((columns.colwise().norm().transpose() - sigma).norm() < 1e-14 * sigma[0]);
    if (semidefinite) CHECK((v * sigma.asDiagonal() * v.transpose() - a).norm() < 1e-13 * sigma[0]);
  }
}

TEST_CASE("orthogonal columns: small singular values keep their digits, where a scale apart is one of the columns (seed 45)") {
  std::mt19937 random(45);
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix3 b = normal_matrix(random);
    const Vector3 scales(1, 1e-9, 1e-18);
    const OrthogonalColumns found = orthogonal_columns(b * scales.asDiagonal());
    const Vector3 length = found.columns.colwise().norm().transpose();
    // Known without a decomposition: the product is |det|, and the first two are those of the first two columns, far from the
    // third.
    const double area = b.col(0).cross(b.col(1)).norm() * scales[1];
    CHECK(length[0] == doctest::Approx(b.col(0).norm()).epsilon(1e-12));
    CHECK(length[0] * length[1] == doctest::Approx(area).epsilon(1e-12));
    CHECK(length[2] == doctest::Approx(std::abs(b.determinant()) * scales[1] * scales[2] / area).epsilon(1e-12));
  }
}

TEST_CASE("orthogonal columns: what is perpendicular already is only sorted, and 0 stays 0") {
  Matrix3 a = Matrix3::Zero();
  a(0, 0) = 2, a(1, 1) = 5, a(2, 2) = -3;
  const OrthogonalColumns sorted = orthogonal_columns(a);
  check_columns(a, sorted);
  CHECK(sorted.columns.colwise().norm().transpose() == Vector3(5, 3, 2));
  CHECK(sorted.v.cwiseAbs().colwise().sum() == Eigen::RowVector3d::Ones());  // a permutation, but for signs
  const OrthogonalColumns zero = orthogonal_columns(Matrix3::Zero());
  CHECK(zero.columns == Matrix3::Zero());
  CHECK(zero.v == Matrix3::Identity());
}
