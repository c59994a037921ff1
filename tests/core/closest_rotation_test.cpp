// The rotation nearest to a covariance, against Eigen's two-sided Jacobi SVD.
#include "core/numerics/closest_rotation.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <random>

using namespace handlebody;

namespace {

Matrix3 random_matrix(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Matrix3::NullaryExpr([&] { return normal(random); });
}

Matrix3 random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
}

Matrix3 oracle(const Matrix3& h) {
  const Eigen::JacobiSVD<Matrix3> svd(h, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 u = svd.matrixU();
  if (u.determinant() * svd.matrixV().determinant() < 0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

void check_rotation(const Matrix3& r) {
  CHECK((r.transpose() * r - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(r.determinant() > 0);
}

}  // namespace

TEST_CASE("closest rotation: Eigen's SVD to 1e-12 wherever the answer is determined, reflections included (seed 41)") {
  std::mt19937 random(41);
  double worst = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const double size = std::pow(10.0, trial % 200 - 100);
    const Matrix3 h = size * random_matrix(random);
    const Vector3 sigma = Eigen::JacobiSVD<Matrix3>(h).singularValues();
    // The answer turns by 1/(σ₂ ± σ₃) of what H changes by.
    const double gap = (sigma[1] + (h.determinant() / (size * size * size) < 0 ? -sigma[2] : sigma[2])) / sigma[0];
    if (gap < 0.02) continue;
    const Matrix3 r = closest_rotation(h);
    check_rotation(r);
    worst = std::max(worst, (r - oracle(h)).cwiseAbs().maxCoeff());
  }
  CHECK(worst < 1e-12);
}

TEST_CASE("closest rotation: the greatest trace at rank 3, 2, 1 and 0, for equal singular values and for reflections (seed 42)") {
  std::mt19937 random(42);
  const double tiny = 1e-9;
  const Vector3 spectra[] = {{3, 2, 1},
                             {3, 2, 0},
                             {3, 0, 0},
                             {0, 0, 0},
                             {1, 1, 1},
                             {1, 1, 0},
                             {2, 1, 1},
                             {2, 2, 1},
                             {1, tiny, 0},
                             {1, tiny, tiny},
                             {1, tiny, tiny * tiny},
                             {1, 1, tiny},
                             {3, 2, -1},
                             {1, 1, -1},
                             {2, 1, -1},
                             {1, tiny, -tiny}};
  for (const Vector3& spectrum : spectra) {
    for (int trial = 0; trial < 200; ++trial) {
      const Matrix3 h = random_rotation(random) * spectrum.asDiagonal() * random_rotation(random).transpose();
      const Matrix3 r = closest_rotation(h);
      check_rotation(r);
      CHECK((r.transpose() * h).trace() == doctest::Approx(spectrum.sum()).epsilon(1e-12));
    }
  }
  CHECK(closest_rotation(Matrix3::Zero()) == Matrix3::Identity());
  Matrix3 one = Matrix3::Zero();
  for (Index i = 0; i < 3; ++i) {
    for (Index j = 0; j < 3; ++j) {
      one(i, j) = 1;  // exact zeros everywhere else
      check_rotation(closest_rotation(one));
      CHECK(closest_rotation(one)(i, j) == doctest::Approx(1));
      one(i, j) = 0;
    }
  }
}

TEST_CASE("closest rotation: a rotation is its own, whatever the scale (seed 43)") {
  std::mt19937 random(43);
  for (const double scale : {1e-150, 1.0, 1e150}) {
    for (int trial = 0; trial < 200; ++trial) {
      const Matrix3 r = random_rotation(random);
      CHECK((closest_rotation(scale * r) - r).cwiseAbs().maxCoeff() < 1e-14);
    }
  }
}
