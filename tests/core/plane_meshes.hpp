// Meshes of the plane for tests of deformations, and the energies written again, triangle by triangle, from their definitions.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <random>
#include <vector>

#include "core/skinning/held_deformation.hpp"
#include "skins.hpp"

namespace handlebody::test {

/** A grid of columns × rows cells with jittered inner vertices, its triangles turned this way and that. */
inline SimplexMesh jittered_grid(std::mt19937& random, Index columns, Index rows, double width = 2, double height = 1) {
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  SimplexMesh mesh{Matrix((columns + 1) * (rows + 1), 2), Simplices(2 * columns * rows, 3)};
  Index v = 0, t = 0;
  for (Index j = 0; j <= rows; ++j)
    for (Index i = 0; i <= columns; ++i, ++v) {
      const bool inner = i > 0 && j > 0 && i < columns && j < rows;
      mesh.positions(v, 0) = width / static_cast<double>(columns) * (static_cast<double>(i) + (inner ? jitter(random) : 0));
      mesh.positions(v, 1) = height / static_cast<double>(rows) * (static_cast<double>(j) + (inner ? jitter(random) : 0));
    }
  for (Index j = 0; j < rows; ++j)
    for (Index i = 0; i < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (columns + 1) + i), b = a + 1, c = a + static_cast<std::uint32_t>(columns) + 1,
                 d = c + 1;
      if ((i + j) % 2) {
        mesh.simplices.row(t++) << a, b, d;
        mesh.simplices.row(t++) << a, d, c;
      } else {
        mesh.simplices.row(t++) << a, b, c;
        mesh.simplices.row(t++) << c, b, d;
      }
    }
  return mesh;
}

/** Gradient of the map of rest positions to `moved` on a triangle, and its rest area. */
inline Eigen::Matrix2d gradient_on(const SimplexMesh& mesh, const Matrix& moved, Index t, double& area) {
  Eigen::Matrix2d rest, now;
  for (Index k = 0; k < 2; ++k) {
    rest.col(k) = (mesh.positions.row(mesh.simplices(t, k + 1)) - mesh.positions.row(mesh.simplices(t, 0))).transpose();
    now.col(k) = (moved.row(mesh.simplices(t, k + 1)) - moved.row(mesh.simplices(t, 0))).transpose();
  }
  area = std::abs(rest.determinant()) / 2;
  return now * rest.inverse();
}

inline double dirichlet_energy(const SimplexMesh& mesh, const Matrix& moved) {
  double sum = 0, area = 0;
  for (Index t = 0; t < mesh.simplices.rows(); ++t) {
    const Eigen::Matrix2d j = gradient_on(mesh, moved, t, area);
    sum += area * (j - Eigen::Matrix2d::Identity()).squaredNorm() / 2;
  }
  return sum;
}

/** Squared distances to the nearest similarities, which are [a −b; b a]. */
inline double conformal_energy(const SimplexMesh& mesh, const Matrix& moved) {
  double sum = 0, area = 0;
  for (Index t = 0; t < mesh.simplices.rows(); ++t) {
    const Eigen::Matrix2d j = gradient_on(mesh, moved, t, area);
    const double a = (j(0, 0) + j(1, 1)) / 2, b = (j(1, 0) - j(0, 1)) / 2;
    Eigen::Matrix2d similarity;
    similarity << a, -b, b, a;
    sum += area * (j - similarity).squaredNorm();
  }
  return sum;
}

/** Squared distances to the nearest rotations, by Eigen's SVD. */
inline double rigid_energy(const SimplexMesh& mesh, const Matrix& moved) {
  double sum = 0, area = 0;
  for (Index t = 0; t < mesh.simplices.rows(); ++t) {
    const Eigen::Matrix2d j = gradient_on(mesh, moved, t, area);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(j, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix2d u = svd.matrixU();
    if (u.determinant() * svd.matrixV().determinant() < 0) u.col(1) *= -1;
    sum += area * (j - u * svd.matrixV().transpose()).squaredNorm() / 2;
  }
  return sum;
}

inline Matrix turn(double angle, const Eigen::Vector2d& about, double scale = 1) {
  const Eigen::Matrix2d a = scale * Eigen::Rotation2Dd(angle).toRotationMatrix();
  return affine(a, about - a * about);
}

}  // namespace handlebody::test
