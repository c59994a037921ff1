#include "core/skinning/quadratic_deformation.hpp"

#include "core/mesh/mass_matrix.hpp"
#include "plane_meshes.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

constexpr QuadraticEnergy energies[] = {QuadraticEnergy::dirichlet, QuadraticEnergy::laplacian, QuadraticEnergy::conformal};

std::unique_ptr<HeldDeformation> make(const SimplexMesh& mesh, const HeldVertices& held, QuadraticEnergy energy) {
  auto made = quadratic_deformation(mesh, held, energy);
  REQUIRE(made);
  return std::move(*made);
}

/** ½ ∫(Δu)², Δu from the flow of ∇u out of each vertex's cell: Σ area J ∇φ. */
double laplacian_energy(const SimplexMesh& mesh, const Matrix& moved) {
  const Vector mass = mass_matrix(mesh, Mass::voronoi);
  Matrix flow = Matrix::Zero(moved.rows(), 2);
  for (Index t = 0; t < mesh.simplices.rows(); ++t)
    for (Index k = 0; k < 3; ++k) {
      double area = 0;
      Matrix hat = Matrix::Zero(moved.rows(), 2);
      hat(mesh.simplices(t, k), 0) = 1;
      const Eigen::RowVector2d slope = gradient_on(mesh, hat, t, area).row(0);
      const Eigen::Matrix2d j = gradient_on(mesh, moved, t, area) - Eigen::Matrix2d::Identity();
      flow.row(mesh.simplices(t, k)) += area * slope * j.transpose();
    }
  double sum = 0;
  for (Index v = 0; v < moved.rows(); ++v) sum += flow.row(v).squaredNorm() / mass[v] / 2;
  return sum;
}

double energy_of(QuadraticEnergy energy, const SimplexMesh& mesh, const Matrix& moved) {
  if (energy == QuadraticEnergy::dirichlet) return dirichlet_energy(mesh, moved);
  return energy == QuadraticEnergy::laplacian ? laplacian_energy(mesh, moved) : conformal_energy(mesh, moved);
}

/** Two corners and a bone in the middle of a 6 × 4 grid. */
const HeldVertices three_handles{{0, 34, 16, 17, 18}, {0, 1, 2, 2, 2}, 3};

}  // namespace

TEST_CASE("quadratic deformations: at rest nothing moves, and the energy is 0 (seed 2016)") {
  std::mt19937 random(2016);
  const SimplexMesh mesh = jittered_grid(random, 6, 4);
  for (const auto energy : energies) {
    auto skin = make(mesh, three_handles, energy);
    CHECK(deformed(*skin) == Matrix(mesh.positions.cast<float>().cast<double>()));
    CHECK(skin->report().energy == 0);
    CHECK(skin->report().flips == 0);
    // And again after a frame elsewhere.
    set_transform(*skin, 1, turn(1, {2, 1}));
    CHECK(apart(deformed(*skin), mesh.positions) > 0.1);
    set_transform(*skin, 1, turn(0, {2, 1}));
    CHECK(deformed(*skin) == Matrix(mesh.positions.cast<float>().cast<double>()));
  }
}

TEST_CASE("quadratic deformations: handles hold their vertices, and a point handle those around it (seed 2017)") {
  std::mt19937 random(2017);
  const SimplexMesh mesh = jittered_grid(random, 6, 4);
  for (const auto energy : energies) {
    auto skin = make(mesh, three_handles, energy);
    const Matrix t0 = random_rigid(random, 2), t2 = random_rigid(random, 2);
    set_transform(*skin, 0, t0);
    set_transform(*skin, 2, t2);
    const Matrix moved = deformed(*skin), by0 = transformed(t0, mesh.positions), by2 = transformed(t2, mesh.positions);
    for (const Index v : {0, 1, 7}) CHECK(apart(moved.row(v), by0.row(v)) < 1e-6);
    for (const Index v : {16, 17, 18}) CHECK(apart(moved.row(v), by2.row(v)) < 1e-6);
    CHECK(apart(moved.row(9), by2.row(9)) > 1e-3);  // around the bone nothing is held
  }
}

TEST_CASE("quadratic deformations: no change of free vertices lowers an energy written independently (seed 2018)") {
  std::mt19937 random(2018);
  for (int trial = 0; trial < 3; ++trial) {
    const SimplexMesh mesh = jittered_grid(random, 6, 4);
    for (const auto energy : energies) {
      auto skin = make(mesh, three_handles, energy);
      for (Index j = 0; j < 3; ++j) set_transform(*skin, j, turn(0.3 * static_cast<double>(j), {0.1, 0.2}, 1.1));
      const Matrix moved = deformed(*skin);
      const double least = energy_of(energy, mesh, moved);
      CHECK(skin->report().energy == doctest::Approx(least).epsilon(1e-5));  // single precision on one side
      for (const Index v : {2, 9, 10, 12, 20, 22, 25}) {
        for (Index axis = 0; axis < 2; ++axis) {
          Matrix left = moved, right = moved;
          left(v, axis) -= 1e-2;
          right(v, axis) += 1e-2;
          const double below = energy_of(energy, mesh, left), above = energy_of(energy, mesh, right);
          CHECK(std::abs(above - below) < 2e-4 * (above + below - 2 * least));  // a quadratic's differences are exact
          CHECK(above + below > 2 * least);
        }
      }
    }
  }
}

TEST_CASE("conformal: a rotation and scale that handles share is reproduced exactly, with no energy (seed 2019)") {
  std::mt19937 random(2019);
  for (int trial = 0; trial < 10; ++trial) {
    const SimplexMesh mesh = jittered_grid(random, 6, 4);
    auto skin = make(mesh, {{8, 26}, {0, 1}, 2}, QuadraticEnergy::conformal);
    const Matrix t = turn(static_cast<double>(trial), {0.3, -1}, 0.4 + 0.2 * trial);
    set_transform(*skin, 0, t);
    set_transform(*skin, 1, t);
    CHECK(apart(deformed(*skin), transformed(t, mesh.positions)) < 3e-6);
    CHECK(std::abs(skin->report().energy) < 1e-13);
    CHECK(skin->report().flips == 0);
  }
  // Two held vertices alone determine a similarity: handles whose rings are shared hold nothing else.
  SimplexMesh pair{Matrix(4, 2), Simplices(2, 3)};
  pair.positions << 0, 0, 1, 0, 1, 1, 0, 1;
  pair.simplices << 0, 1, 2, 2, 3, 0;
  auto skin = make(pair, {{0, 2}, {0, 1}, 2}, QuadraticEnergy::conformal);
  set_transform(*skin, 1, affine(MatrixXd::Identity(2, 2), Eigen::Vector2d(1, 1)));
  Matrix expected = 2 * pair.positions;
  CHECK(apart(deformed(*skin), expected) < 1e-6);
}

TEST_CASE("a translation is reproduced by all, Dirichlet and Laplacian keep coordinates apart (seed 2020)") {
  std::mt19937 random(2020);
  const SimplexMesh mesh = jittered_grid(random, 6, 4);
  for (const auto energy : energies) {
    auto skin = make(mesh, three_handles, energy);
    for (Index j = 0; j < 3; ++j) set_transform(*skin, j, affine(MatrixXd::Identity(2, 2), Eigen::Vector2d(0.5, -2)));
    CHECK(apart(deformed(*skin).rowwise() - Eigen::RowVector2d(0.5, -2), mesh.positions) < 1e-6);
    CHECK(std::abs(skin->report().energy) < 1e-12);
    set_transform(*skin, 0, affine(MatrixXd::Identity(2, 2), Eigen::Vector2d(1.5, -2)));
    const double sideways = apart(deformed(*skin).col(1).array() + 2, mesh.positions.col(1));
    if (energy == QuadraticEnergy::conformal) CHECK(sideways > 1e-3);
    if (energy != QuadraticEnergy::conformal) CHECK(sideways < 1e-6);
  }
}

TEST_CASE(
    "quadratic deformations: turning, scaling and moving all turns, scales and moves the result; triangles may be clockwise (seed "
    "2021)") {
  std::mt19937 random(2021);
  const SimplexMesh mesh = jittered_grid(random, 6, 4);
  SimplexMesh there = mesh, clockwise = mesh;
  const Matrix motion = turn(0.8, {3, -2}, 50), back = turn(-0.8, {3, -2}, 0.02);
  there.positions = transformed(motion, mesh.positions);
  clockwise.simplices.col(1).swap(clockwise.simplices.col(2));
  for (const auto energy : energies) {
    auto skin = make(mesh, three_handles, energy), moved = make(there, three_handles, energy),
         turned = make(clockwise, three_handles, energy);
    for (Index j = 0; j < 3; ++j) {
      const Matrix t = random_rigid(random, 2);
      set_transform(*skin, j, t);
      set_transform(*turned, j, t);
      set_transform(*moved, j, compose(motion, compose(t, back)));
    }
    const Matrix result = deformed(*skin);
    CHECK(apart(deformed(*moved), transformed(motion, result)) < 1e-4);
    CHECK(apart(deformed(*turned), result) < 1e-6);
    const double scale = energy == QuadraticEnergy::laplacian ? 1 : 2500;
    CHECK(moved->report().energy == doctest::Approx(scale * skin->report().energy));
    CHECK(turned->report().energy == doctest::Approx(skin->report().energy));
    CHECK(turned->report().flips == skin->report().flips);
  }
}

TEST_CASE("flips are counted: a handle pushed through its neighbors (seed 2022)") {
  std::mt19937 random(2022);
  const SimplexMesh mesh = jittered_grid(random, 6, 4);
  auto skin = make(mesh, {{0, 34}, {0, 1}, 2}, QuadraticEnergy::laplacian);
  set_transform(*skin, 1, affine(MatrixXd::Identity(2, 2), Eigen::Vector2d(-4, 0)));
  const Matrix moved = deformed(*skin);
  std::uint32_t expected = 0;
  double area = 0;
  for (Index t = 0; t < mesh.simplices.rows(); ++t) expected += gradient_on(mesh, moved, t, area).determinant() > 0 ? 0 : 1;
  CHECK(expected > 5);
  CHECK(skin->report().flips == expected);
}

TEST_CASE("islands without a handle go with the nearest one; shared rings stay free; bad input is named (seed 2023)") {
  std::mt19937 random(2023);
  const SimplexMesh one = jittered_grid(random, 3, 2);
  SimplexMesh two{Matrix(25, 2), Simplices(24, 3)};
  two.positions << one.positions, one.positions.rowwise() + Eigen::RowVector2d(5, 0), Eigen::RowVector2d(9, 9);
  two.simplices << one.simplices, one.simplices.array() + 12;
  for (const auto energy : energies) {
    auto skin = make(two, {{0, 3}, {0, 1}, 2}, energy);
    const Matrix t = random_rigid(random, 2);
    set_transform(*skin, 1, t);
    CHECK(apart(deformed(*skin).bottomRows(13), transformed(t, two.positions).bottomRows(13)) < 1e-5);
  }
  // Neighbors 1 and 2 of the bottom edge: what is around both is free.
  auto skin = make(one, {{1, 2}, {0, 1}, 2}, QuadraticEnergy::dirichlet);
  set_transform(*skin, 0, turn(0.5, {0, 0}));
  const Matrix free = deformed(*skin), held = transformed(turn(0.5, {0, 0}), one.positions);
  CHECK(apart(free.row(5), held.row(5)) < 1e-6);
  CHECK(apart(free.row(6), held.row(6)) > 1e-3);

  const auto failure = [](const SimplexMesh& mesh, const HeldVertices& held) {
    auto made = quadratic_deformation(mesh, held, QuadraticEnergy::conformal);
    REQUIRE(!made);
    return made.error();
  };
  CHECK(failure(one, {{0, 3, 0}, {0, 1, 1}, 2}).code == HB_ERROR_HANDLE_CONFLICT);
  CHECK(failure(one, {{}, {}, 0}).code == HB_ERROR_HANDLES_MISSING);
  CHECK(failure(one, {{99}, {0}, 1}).code == HB_ERROR_HANDLE_OUT_OF_RANGE);
  CHECK(failure({Matrix::Random(12, 3), one.simplices}, {{0}, {0}, 1}).code == HB_ERROR_INVALID_SHAPE);
  SimplexMesh flat = one;
  flat.positions.row(5) = flat.positions.row(6);
  CHECK(failure(flat, {{0}, {0}, 1}).code == HB_ERROR_MESH_DEGENERATE);
  // Two triangles on one vertex: conformal cannot tell how the second turns.
  SimplexMesh hinge{Matrix(5, 2), Simplices(2, 3)};
  hinge.positions << 0, 0, 1, 0, 1, 1, -1, 0, -1, -1;
  hinge.simplices << 0, 1, 2, 0, 3, 4;
  CHECK(failure(hinge, {{1}, {0}, 1}).code == HB_ERROR_SYSTEM_SINGULAR);
  CHECK(quadratic_deformation(hinge, {{1}, {0}, 1}, QuadraticEnergy::dirichlet));
}
