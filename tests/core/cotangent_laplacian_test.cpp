#include "core/mesh/cotangent_laplacian.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>

using namespace handlebody;

namespace {

MatrixXd dense_laplacian(const SimplexMesh& mesh) {
  return MatrixXd(cotangent_laplacian(mesh));
}

/** ∫ |∇f|² by its definition: the gradient in each simplex from its values at the corners, within the simplex's own space. */
double dirichlet_integral(const SimplexMesh& mesh, const Vector& f) {
  const Index d = mesh.simplices.cols() - 1;
  double sum = 0;
  for (Index s = 0; s < mesh.simplices.rows(); ++s) {
    MatrixXd edges(d, mesh.positions.cols());
    Vector rise(d);
    for (Index k = 0; k < d; ++k) {
      edges.row(k) = mesh.positions.row(mesh.simplices(s, k + 1)) - mesh.positions.row(mesh.simplices(s, 0));
      rise[k] = f[mesh.simplices(s, k + 1)] - f[mesh.simplices(s, 0)];
    }
    const MatrixXd gram = edges * edges.transpose();
    const double volume = std::sqrt(gram.determinant()) / (d == 2 ? 2 : 6);
    sum += volume * rise.dot(gram.inverse() * rise);
  }
  return sum;
}

/** A strip of simplices, each made of vertices that follow each other. */
SimplexMesh random_strip(std::mt19937& random, Index dimension, Index corners) {
  std::normal_distribution<double> normal;
  SimplexMesh mesh{Matrix::NullaryExpr(12, dimension, [&] { return normal(random); }), Simplices(13 - corners, corners)};
  for (Index s = 0; s < mesh.simplices.rows(); ++s)
    for (Index k = 0; k < corners; ++k) mesh.simplices(s, k) = static_cast<std::uint32_t>(s + k);
  return mesh;
}

constexpr std::pair<Index, Index> laplacian_kinds[] = {{2, 3}, {3, 3}, {3, 4}};  // dimension, corners

}  // namespace

TEST_CASE("Laplacian of one triangle: half the cotangents of the angles across, negative") {
  SimplexMesh mesh{Matrix(3, 2), Simplices(1, 3)};
  // 30°, 60° and 90°, in this order of the corners.
  mesh.positions << 0, 0, std::sqrt(3.0), 1, std::sqrt(3.0), 0;
  mesh.simplices << 0, 1, 2;
  const MatrixXd c = dense_laplacian(mesh);
  CHECK(c(0, 1) == doctest::Approx(0).scale(1));               // cot 90°
  CHECK(c(0, 2) == doctest::Approx(-1 / std::sqrt(3.0) / 2));  // cot 60°
  CHECK(c(1, 2) == doctest::Approx(-std::sqrt(3.0) / 2));      // cot 30°
  CHECK(c(2, 2) == doctest::Approx((1 / std::sqrt(3.0) + std::sqrt(3.0)) / 2));
}

TEST_CASE("Laplacian of a square grid: the five-point stencil") {
  SimplexMesh mesh{Matrix(9, 2), Simplices(8, 3)};
  for (Index v = 0; v < 9; ++v) mesh.positions.row(v) << static_cast<double>(v % 3), static_cast<double>(v / 3);
  mesh.simplices << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 7, 3, 7, 6, 4, 5, 8, 4, 8, 7;
  Vector middle(9);
  middle << 0, -1, 0, -1, 4, -1, 0, -1, 0;
  CHECK((dense_laplacian(mesh).col(4) - middle).norm() < 1e-14);
}

TEST_CASE("fᵀCf is ∫|∇f|²: triangles in the plane and in space, tetrahedra (seed 61)") {
  std::mt19937 random(61);
  std::normal_distribution<double> normal;
  for (const auto& [dimension, corners] : laplacian_kinds) {
    for (int trial = 0; trial < 10; ++trial) {
      const SimplexMesh mesh = random_strip(random, dimension, corners);
      const MatrixXd c = dense_laplacian(mesh);
      const Vector f = Vector::NullaryExpr(12, [&] { return normal(random); });
      CHECK(f.dot(c * f) == doctest::Approx(dirichlet_integral(mesh, f)).epsilon(1e-8));
    }
  }
}

TEST_CASE("the Laplacian is symmetric to the last bit, semidefinite, and constants have none (seed 62)") {
  std::mt19937 random(62);
  std::normal_distribution<double> normal;
  for (const auto& [dimension, corners] : laplacian_kinds) {
    const SimplexMesh mesh = random_strip(random, dimension, corners);
    const MatrixXd c = dense_laplacian(mesh);
    CHECK(c == c.transpose());
    CHECK((c * Vector::Ones(12)).cwiseAbs().maxCoeff() <= 1e-14 * c.cwiseAbs().maxCoeff());
    for (int trial = 0; trial < 50; ++trial) {
      const Vector f = Vector::NullaryExpr(12, [&] { return normal(random); });
      CHECK(f.dot(c * f) >= 0);
    }
  }
}

TEST_CASE("a rigid motion or another order of corners changes nothing; size counts on tetrahedra only (seed 63)") {
  std::mt19937 random(63);
  for (const auto& [dimension, corners] : laplacian_kinds) {
    const SimplexMesh mesh = random_strip(random, dimension, corners);
    const MatrixXd c = dense_laplacian(mesh);
    SimplexMesh moved = mesh;
    const double angle = 0.7;
    MatrixXd turn = MatrixXd::Identity(dimension, dimension);
    turn.topLeftCorner(2, 2) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    moved.positions = ((2 * mesh.positions * turn.transpose()).array() + 3).matrix().eval();
    for (Index s = 0; s < moved.simplices.rows(); ++s) moved.simplices.row(s) = mesh.simplices.row(s).reverse().eval();
    CHECK((dense_laplacian(moved) - (corners == 4 ? 2 : 1) * c).norm() < 1e-11 * c.norm());
  }
}

TEST_CASE("vertices in no simplex have empty rows") {
  SimplexMesh mesh{Matrix(4, 2), Simplices(1, 3)};
  mesh.positions << 0, 0, 5, 5, 1, 0, 0, 1;
  mesh.simplices << 0, 2, 3;
  const MatrixXd c = dense_laplacian(mesh);
  CHECK(c.row(1).norm() == 0);
  CHECK(c.col(1).norm() == 0);
  CHECK(c(0, 0) == doctest::Approx(1));
}
