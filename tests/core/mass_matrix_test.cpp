#include "core/mesh/mass_matrix.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

using namespace handlebody;

namespace {

SimplexMesh triangle_with(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  SimplexMesh mesh{Matrix(3, 2), Simplices(1, 3)};
  mesh.positions << a.transpose(), b.transpose(), c.transpose();
  mesh.simplices << 0, 1, 2;
  return mesh;
}

/** How much of the triangle is nearest to each corner, by counting the middles of 4·parts² small triangles. */
Vector counted_voronoi(const SimplexMesh& mesh, int parts) {
  Vector mass = Vector::Zero(3);
  const double each = simplex_volume(mesh, 0) / (parts * parts);
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j)
      for (const double third : {1.0 / 3, 2.0 / 3}) {
        if (third > .5 && i + j + 1 == parts) continue;  // the one that is turned round is not there
        const double u = (i + third) / parts, v = (j + third) / parts;
        const Eigen::RowVector2d point =
            (1 - u - v) * mesh.positions.row(0) + u * mesh.positions.row(1) + v * mesh.positions.row(2);
        Index nearest = 0;
        (mesh.positions.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
        mass[nearest] += each;
      }
  return mass;
}

}  // namespace

TEST_CASE("Voronoi masses of one triangle in closed form") {
  const double root3 = std::sqrt(3.0);
  const Vector equilateral = mass_matrix(triangle_with({0, 0}, {2, 0}, {1, root3}), Mass::voronoi);
  for (Index k = 0; k < 3; ++k) CHECK(equilateral[k] == doctest::Approx(root3 / 3));
  // Right angle at the first corner: its Voronoi region is the square between the middles of the legs.
  const Vector right = mass_matrix(triangle_with({0, 0}, {1, 0}, {0, 1}), Mass::voronoi);
  CHECK(right[0] == doctest::Approx(0.25));
  CHECK(right[1] == doctest::Approx(0.125));
  CHECK(right[2] == doctest::Approx(0.125));
  // Obtuse at the second corner: half to it, a quarter to the others (Meyer et al. 2003).
  const Vector obtuse = mass_matrix(triangle_with({-3, 1}, {0, 0}, {3, 1}), Mass::voronoi);
  CHECK(obtuse[0] == doctest::Approx(0.75));
  CHECK(obtuse[1] == doctest::Approx(1.5));
  CHECK(obtuse[2] == doctest::Approx(0.75));
}

TEST_CASE("in acute triangles a Voronoi mass is the area that is nearest to the corner, by counting (seed 51)") {
  std::mt19937 random(51);
  std::uniform_real_distribution<double> uniform(0, 1);
  int acute = 0;
  while (acute < 6) {
    const SimplexMesh mesh =
        triangle_with({uniform(random), uniform(random)}, {uniform(random), uniform(random)}, {uniform(random), uniform(random)});
    const double area = simplex_volume(mesh, 0);
    double least = 1;
    for (Index k = 0; k < 3; ++k)
      least = std::min(least, (mesh.positions.row((k + 1) % 3) - mesh.positions.row(k))
                                  .normalized()
                                  .dot((mesh.positions.row((k + 2) % 3) - mesh.positions.row(k)).normalized()));
    if (least < 0.05 || area < 0.05) continue;
    ++acute;
    CHECK((mass_matrix(mesh, Mass::voronoi) - counted_voronoi(mesh, 300)).cwiseAbs().maxCoeff() < 0.01 * area);
  }
}

TEST_CASE("barycentric masses are equal shares; tetrahedra have no others; the sum is the mesh's (seed 52)") {
  std::mt19937 random(52);
  std::normal_distribution<double> normal;
  for (const auto& [dimension, corners] : {std::pair<Index, Index>{2, 3}, {3, 3}, {3, 4}}) {
    // A fan of simplices about the first vertex, and a last vertex that is in none.
    SimplexMesh mesh{Matrix::NullaryExpr(10, dimension, [&] { return normal(random); }), Simplices(6, corners)};
    Vector shares = Vector::Zero(10);
    double total = 0;
    for (Index s = 0; s < 6; ++s) {
      mesh.simplices(s, 0) = 0;
      for (Index k = 1; k < corners; ++k) mesh.simplices(s, k) = static_cast<std::uint32_t>(s + k);
      const double volume = simplex_volume(mesh, s);
      total += volume;
      for (Index k = 0; k < corners; ++k) shares[mesh.simplices(s, k)] += volume / static_cast<double>(corners);
    }
    const Vector barycentric = mass_matrix(mesh, Mass::barycentric), voronoi = mass_matrix(mesh, Mass::voronoi);
    CHECK((barycentric - shares).norm() < 1e-14 * total);
    CHECK(voronoi.sum() == doctest::Approx(total).epsilon(1e-13));
    CHECK(voronoi.head(8).minCoeff() > 0);
    CHECK(voronoi[9] == 0);
    CHECK(barycentric[9] == 0);
    if (corners == 4) CHECK(voronoi == barycentric);
    if (corners == 3) CHECK((voronoi - barycentric).norm() > 0.01 * total);
  }
}

TEST_CASE("masses do not change with a rigid motion, and grow with the square of the size (seed 53)") {
  std::mt19937 random(53);
  std::normal_distribution<double> normal;
  SimplexMesh mesh{Matrix::NullaryExpr(12, 3, [&] { return normal(random); }), Simplices(10, 3)};
  for (Index s = 0; s < 10; ++s)
    for (Index k = 0; k < 3; ++k) mesh.simplices(s, k) = static_cast<std::uint32_t>(s + k);
  const Matrix3 turn =
      Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
  SimplexMesh moved = mesh;
  moved.positions = ((3 * mesh.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(4, 5, 6)).eval();
  for (const Mass kind : {Mass::voronoi, Mass::barycentric}) {
    const Vector once = mass_matrix(mesh, kind), again = mass_matrix(moved, kind);
    CHECK((again - 9 * once).norm() < 1e-12 * again.norm());
  }
}
