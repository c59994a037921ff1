#include "core/mesh/polyharmonic_energy.hpp"

#include <cmath>
#include <string>

#include "core/mesh/cotangent_laplacian.hpp"
#include "core/mesh/mass_matrix.hpp"
#include "plane_meshes.hpp"

using namespace handlebody;
using namespace handlebody::test;

TEST_CASE("polyharmonic energies: (L M⁻¹)^(order − 1) L, symmetric, and 0 for constants (seed 1106)") {
  std::mt19937 random(1106);
  const SimplexMesh mesh = jittered_grid(random, 7, 5);
  const SparseMatrix laplacian = cotangent_laplacian(mesh);
  const Vector mass = mass_matrix(mesh, Mass::voronoi);
  MatrixXd expected = MatrixXd(laplacian);
  for (int order = 1; order <= 3; ++order) {
    const auto q = polyharmonic_energy(laplacian, mass, order);
    REQUIRE(q);
    const MatrixXd dense = MatrixXd(*q);
    const double largest = expected.cwiseAbs().maxCoeff();
    CHECK((dense - expected).cwiseAbs().maxCoeff() < 1e-13 * largest);
    CHECK((dense - dense.transpose()).cwiseAbs().maxCoeff() < 1e-14 * largest);
    CHECK((*q * Vector::Ones(q->rows())).cwiseAbs().maxCoeff() < 1e-12 * largest);
    for (Index row = 0; row < q->rows(); ++row)  // every entry has its mirror image, also where it is 0: Cholesky counts on that
      for (SparseMatrix::InnerIterator entry(*q, row); entry; ++entry) {
        bool mirrored = false;
        for (SparseMatrix::InnerIterator other(*q, entry.col()); other; ++other) mirrored = mirrored || other.col() == row;
        CHECK(mirrored);
      }
    expected = MatrixXd(laplacian) * mass.cwiseInverse().asDiagonal() * expected;
  }
}

TEST_CASE(
    "polyharmonic energies: a linear function has no Laplacian inside, so that ∫(Δf)² comes from the border only (seed 1107)") {
  std::mt19937 random(1107);
  const SimplexMesh mesh = jittered_grid(random, 8, 8);
  const auto q = polyharmonic_energy(cotangent_laplacian(mesh), mass_matrix(mesh, Mass::barycentric), 2);
  REQUIRE(q);
  const Vector forces = *q * mesh.positions.col(0);
  const Index center = 4 * 9 + 4;  // with two rings of vertices around it
  CHECK(std::abs(forces[center]) < 1e-10 * forces.cwiseAbs().maxCoeff());
}

TEST_CASE(
    "polyharmonic energies: a loose vertex stays alone; a vertex with too many neighbors is refused before anything is made") {
  SimplexMesh mesh{Matrix(4, 2), Simplices(1, 3)};
  mesh.positions << 0, 0, 1, 0, 0, 1, 5, 5;
  mesh.simplices << 0, 1, 2;
  const auto loose = polyharmonic_energy(cotangent_laplacian(mesh), mass_matrix(mesh, Mass::voronoi), 3);
  REQUIRE(loose);
  CHECK(Matrix(*loose).allFinite());
  CHECK(loose->outerIndexPtr()[4] == loose->outerIndexPtr()[3]);

  constexpr Index rim = 50000;
  SimplexMesh fan{Matrix(rim + 1, 2), Simplices(rim, 3)};
  fan.positions.row(0).setZero();
  for (Index k = 0; k < rim; ++k) {
    const double angle = 2 * M_PI * static_cast<double>(k) / rim;
    fan.positions.row(k + 1) << std::cos(angle), std::sin(angle);
    fan.simplices.row(k) << 0, static_cast<std::uint32_t>(k + 1), static_cast<std::uint32_t>((k + 1) % rim + 1);
  }
  const SparseMatrix laplacian = cotangent_laplacian(fan);
  const Vector mass = mass_matrix(fan, Mass::voronoi);
  CHECK(polyharmonic_energy(laplacian, mass, 1));
  const auto refused = polyharmonic_energy(laplacian, mass, 2);
  REQUIRE(!refused);
  CHECK(refused.error().code == HB_ERROR_OUT_OF_MEMORY);
  CHECK(refused.error().message.find("50001 vertices") != std::string::npos);
}
