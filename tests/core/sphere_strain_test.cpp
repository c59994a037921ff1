#include "core/irbf/sphere_strain.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <random>

using namespace handlebody;

TEST_CASE("a strain is the rotation, the cofactor matrix in its frame and the growth of volume (seeds 181 to 200)") {
  for (unsigned seed = 181; seed <= 200; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Matrix3 f = Matrix3::NullaryExpr([&] { return normal(random); });
    if (seed % 3 == 0) f.col(0) *= -1;  // some turn inside out
    const Strain strain = strain_of(f);
    CHECK(strain.turn.determinant() == doctest::Approx(1).epsilon(1e-12));
    const Matrix3 cofactor = f.determinant() * f.inverse().transpose();
    CHECK((strain.turn * strain.cofactor - cofactor).norm() < 1e-11 * (1 + cofactor.norm()));
    CHECK(std::abs(strain.growth - (f.determinant() - 1)) < 1e-12 * (1 + std::abs(f.determinant())));
    if (f.determinant() > 0) {
      const Matrix3 stretch = strain.turn.transpose() * f;
      CHECK((stretch - stretch.transpose()).norm() < 1e-11);
    }
  }
}

TEST_CASE("a rotation is no strain, to the last bit for the identity; nothing at all has no volume") {
  const Strain none = strain_of(Matrix3::Identity());
  CHECK(none.turn == Matrix3::Identity());
  CHECK(none.cofactor == Matrix3::Identity());
  CHECK(none.growth == 0);
  CHECK(strain_of(Matrix3::Zero()).growth == -1);
}
