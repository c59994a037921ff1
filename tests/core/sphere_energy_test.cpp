#include "core/irbf/sphere_energy.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "made_body.hpp"

using namespace handlebody;

namespace {

/** A bar of three spheres, with a narrow basis of six centers. */
struct EnergeticBar {
  Body body = test::made_bar_body(6);
  Basis basis{body, Kernel::of(KernelKind::inverse_multiquadric, 1, 3)};

  SphereEnergy energy(double exponent) const {
    auto made = make_sphere_energy(body, basis, exponent);
    REQUIRE(made);
    return std::move(*made);
  }
};

}  // namespace

TEST_CASE("three edges a sphere along the axes, of its diameter times √w, w = ‖e‖^α") {
  const EnergeticBar bar;
  for (const double exponent : {0.0, 1.0, 3.0, -2.0}) {
    const SphereEnergy energy = bar.energy(exponent);
    REQUIRE(energy.edges.rows() == 9);
    REQUIRE(energy.edge_scale.size() == 9);
    for (Index row = 0; row < 9; ++row) {
      const double length = 2 * bar.body.spheres[row / 3].radius, root = std::pow(length, exponent / 2);
      CHECK((energy.edges.row(row) - root * length * Eigen::RowVector3d::Unit(row % 3)).norm() < 1e-13 * root * length);
      CHECK(energy.edge_scale[row] == doctest::Approx(1 / root).epsilon(1e-13));
    }
  }
}

TEST_CASE("the rows are √w [e 0 Δφ]: an affine map turns the edges, a translation moves none, equal coefficients do nothing") {
  const EnergeticBar bar;
  const SphereEnergy energy = bar.energy(1);
  REQUIRE(energy.rows.rows() == 9);
  REQUIRE(energy.rows.cols() == 4 + 6);
  CHECK(energy.rows.leftCols(3) == energy.edges);
  CHECK(energy.rows.col(3).norm() == 0);
  CHECK(energy.rows.rightCols(6).rowwise().sum().norm() < 1e-13);  // the basis sums to 1 at both ends

  InteriorSamples samples;
  for (const Sphere& sphere : bar.body.spheres)
    for (Index axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0})
        samples.add(bar.body.domain, sphere.center + side * sphere.radius * Vector3::Unit(axis));
  Matrix phi(18, 6);
  REQUIRE(bar.basis.evaluate<double>(samples, phi));
  for (Index row = 0; row < 9; ++row) {
    const double root = std::sqrt(2 * bar.body.spheres[row / 3].radius);
    CHECK((energy.rows.row(row).tail(6) - root * (phi.row(2 * row + 1) - phi.row(2 * row))).norm() < 1e-14);
  }
  CHECK(energy.rows.rightCols(6).norm() > 1e-3);
}

TEST_CASE("the chosen λ is a part of the curvatures of all coefficients, and follows the weights") {
  const EnergeticBar bar;
  for (const double exponent : {0.0, 1.0, 2.0}) {
    const SphereEnergy energy = bar.energy(exponent);
    double curvature = 0;
    for (Index c = 4; c < 10; ++c) curvature += energy.rows.col(c).squaredNorm();
    CHECK(automatic_smoothness(energy) == doctest::Approx(3e-4 * curvature).epsilon(1e-12));
  }
  // With α = 2 and spheres of one size, it is (2r)² that of α = 0.
  EnergeticBar equal;
  for (Sphere& sphere : equal.body.spheres) sphere.radius = 0.07;
  CHECK(automatic_smoothness(equal.energy(2)) ==
        doctest::Approx(0.14 * 0.14 * automatic_smoothness(equal.energy(0))).epsilon(1e-12));
}

TEST_CASE("a kernel that fails at a sphere's end is named") {
  const EnergeticBar bar;
  Kernel kernel;
  kernel.kind = KernelKind::custom;
  kernel.custom.function = [](const void*, double, bool) { return std::nan(""); };
  const auto made = make_sphere_energy(bar.body, Basis(bar.body, kernel), 1);
  REQUIRE_FALSE(made);
  CHECK(made.error().code == HB_ERROR_KERNEL_FAILED);
}

TEST_CASE("twelve points a sphere have the edges and the affine part of six, and nothing beside them for what is linear") {
  const EnergeticBar bar;
  for (const double exponent : {-1.0, 0.0, 2.0}) {
    const SphereEnergy six = bar.energy(exponent);
    CHECK(six.beside.rows() == 0);
    const auto twelve = make_sphere_energy(bar.body, bar.basis, exponent, SphereStructure::icosahedron);
    REQUIRE(twelve);
    CHECK((twelve->edges - six.edges).norm() < 1e-13 * six.edges.norm());
    CHECK((twelve->edge_scale - six.edge_scale).norm() < 1e-13 * six.edge_scale.norm());
    REQUIRE(twelve->beside.rows() == 36);
    CHECK(twelve->beside.leftCols<4>().norm() == 0);
    CHECK(twelve->beside.rightCols(6).norm() > 1e-3 * twelve->rows.rightCols(6).norm());
    CHECK(twelve->beside.rightCols(6).rowwise().sum().norm() < 1e-13);
  }
}

TEST_CASE("the rows of an ellipsoid and what is beside them have the sum of squares of all its edges") {
  EnergeticBar bar;
  bar.body.spheres = {{Vector3(0.05, 0.01, 0), 0.06, Vector3(0.2, 0.05, 0.02)}};
  const double exponent = 1.5;
  const auto energy = make_sphere_energy(bar.body, bar.basis, exponent);
  REQUIRE(energy);
  const StructureEdges made = structure_edges(bar.body.spheres[0], SphereStructure::icosahedron);
  InteriorSamples samples;
  for (const Vector3& point : made.points) samples.add(bar.body.domain, point);
  Matrix phi(33, 6);
  REQUIRE(bar.basis.evaluate<double>(samples, phi));
  MatrixXd all(32, 10);
  for (Index i = 0; i < 32; ++i) {
    const auto& [from, to, scale] = made.edges[i];
    const Vector3 edge = scale * (made.points[to] - made.points[from]);
    const double root = std::sqrt(made.share * std::pow(0.12, exponent));
    all.row(i) << root * edge.transpose(), 0, root * scale * (phi.row(Index(to)) - phi.row(Index(from)));
  }
  const MatrixXd expected = all.transpose() * all;
  const MatrixXd parts = energy->rows.transpose() * energy->rows + energy->beside.transpose() * energy->beside;
  CHECK((parts - expected).norm() < 1e-12 * expected.norm());
  // Its edges are perpendicular, the first along it.
  const Matrix3 gram = energy->edges * energy->edges.transpose();
  CHECK((gram - gram.diagonal().asDiagonal().toDenseMatrix()).norm() < 1e-13 * gram.norm());
  CHECK(gram(0, 0) > gram(1, 1));
  for (Index i = 0; i < 3; ++i)
    CHECK(energy->edge_scale[i] * energy->edges.row(i).norm() == doctest::Approx(2 * half_axes(bar.body.spheres[0]).col(i).norm()));

  double across = 0;
  for (Index i = 0; i < 3; ++i) across += gram(1, 1) / gram(i, i) * energy->rows.row(i).tail(6).squaredNorm();
  CHECK(automatic_smoothness(*energy) == doctest::Approx(3e-4 * across).epsilon(1e-9));
}

TEST_CASE("a sphere whose square is no number any more has edges that are") {
  EnergeticBar bar;
  for (const double radius : {1e-150, 1e-200, 1e-300}) {
    bar.body.spheres[1].radius = radius;
    for (const SphereStructure structure : {SphereStructure::octahedron, SphereStructure::icosahedron}) {
      const auto energy = make_sphere_energy(bar.body, bar.basis, 2, structure);
      REQUIRE(energy);
      CHECK(energy->edges.allFinite());
      CHECK(energy->rows.allFinite());
      CHECK(energy->beside.allFinite());
      CHECK(std::isfinite(automatic_smoothness(*energy)));
    }
  }
}
