#include "core/skinning/as_rigid_as_possible.hpp"

#include "oracle_lines.hpp"
#include "plane_meshes.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

std::unique_ptr<HeldDeformation> make(const SimplexMesh& mesh, const HeldVertices& held, std::uint32_t iterations) {
  auto made = as_rigid_as_possible(mesh, held);
  REQUIRE(made);
  (*made)->set_iterations(iterations);
  return std::move(*made);
}

const HeldVertices three_handles{{0, 34, 16, 17, 18}, {0, 1, 2, 2, 2}, 3};

}  // namespace

TEST_CASE("as rigid as possible: at rest nothing moves; rigid motions are reproduced with no energy (seed 2024)") {
  std::mt19937 random(2024);
  const SimplexMesh mesh = jittered_grid(random, 6, 4);
  auto skin = make(mesh, three_handles, 100);
  CHECK(deformed(*skin) == Matrix(mesh.positions.cast<float>().cast<double>()));
  CHECK(skin->report().energy == 0);
  CHECK(skin->report().iterations == 1);
  for (const double angle : {0.1, 0.5, 1.2}) {
    const Matrix t = turn(angle, {0.3, 5});
    for (Index j = 0; j < 3; ++j) set_transform(*skin, j, t);
    skin->set_iterations(1000);
    CHECK(apart(deformed(*skin), transformed(t, mesh.positions)) < 1e-5);
    CHECK(skin->report().energy < 1e-10);
    CHECK(skin->report().iterations < 1000);
  }
}

TEST_CASE("as rigid as possible: rounds never raise the energy, which is the sum of squared distances to rotations (seed 2025)") {
  std::mt19937 random(2025);
  for (int trial = 0; trial < 5; ++trial) {
    const SimplexMesh mesh = jittered_grid(random, 6, 4);
    auto skin = make(mesh, three_handles, 1);
    for (Index j = 0; j < 3; ++j) set_transform(*skin, j, turn(0.5 * static_cast<double>(j * trial), {0.4, 0.1}, 1 + 0.1 * trial));
    double before = INFINITY;
    for (int round = 0; round < 60; ++round) {  // warm starts: each goes on where the last stopped
      const Matrix moved = deformed(*skin);
      CHECK(skin->report().energy <= before * (1 + 1e-12) + 1e-20);
      before = skin->report().energy;
      if (round % 20 == 0) CHECK(rigid_energy(mesh, moved) == doctest::Approx(before).epsilon(1e-4));
    }
    auto at_once = make(mesh, three_handles, 60);
    std::copy(skin->transforms(), skin->transforms() + 18, at_once->transforms());
    CHECK(apart(deformed(*at_once), deformed(*skin)) < 1e-3);
  }
}

TEST_CASE("as rigid as possible: where rounds have ended no free vertex can lower the energy (seed 2026)") {
  std::mt19937 random(2026);
  const SimplexMesh mesh = jittered_grid(random, 6, 4);
  auto skin = make(mesh, three_handles, 20000);
  set_transform(*skin, 1, turn(0.7, {2, 1}));
  const Matrix moved = deformed(*skin);
  CHECK(skin->report().iterations < 20000);
  const double step = 1e-3, least = rigid_energy(mesh, moved);
  for (const Index v : {2, 9, 10, 12, 20, 22, 25})
    for (Index axis = 0; axis < 2; ++axis) {
      Matrix left = moved, right = moved;
      left(v, axis) -= step;
      right(v, axis) += step;
      const double below = rigid_energy(mesh, left), above = rigid_energy(mesh, right);
      CHECK(above + below > 2 * least);
      CHECK(std::abs(above - below) < 0.02 * (above + below - 2 * least));  // a hundredth of the step to the minimum
    }
}

TEST_CASE("as rigid as possible: libigl's to 1e-5 of the extent") {
  int cases = 0;
  for (const auto& line : oracle_lines("as_rigid_as_possible.json")) {
    const auto numbers = [&](const char* key) { return oracle_numbers(line, key); };
    const auto rows = [](const std::vector<double>& list, Index columns) {
      return Matrix(Eigen::Map<const Matrix>(list.data(), std::ssize(list) / columns, columns));
    };
    const auto vertices = numbers("vertices"), owners = numbers("owners"), transforms = numbers("transforms");
    const SimplexMesh mesh{rows(numbers("positions"), 2), rows(numbers("triangles"), 3).cast<std::uint32_t>()};
    auto skin = make(mesh, {{vertices.begin(), vertices.end()}, {owners.begin(), owners.end()}, 2}, 20000);
    std::copy(transforms.begin(), transforms.end(), skin->transforms());
    const Matrix expected = rows(numbers("deformed"), 2), moved = deformed(*skin);
    CHECK(apart(moved, expected) < 2e-5);
    CHECK(skin->report().energy == doctest::Approx(rigid_energy(mesh, expected)).epsilon(1e-6));
    ++cases;
  }
  CHECK(cases == 3);
}

TEST_CASE("as rigid as possible: moving and turning all moves and turns the result (seed 2027)") {
  std::mt19937 random(2027);
  const SimplexMesh mesh = jittered_grid(random, 6, 4);
  SimplexMesh there = mesh, clockwise = mesh;
  const Matrix motion = turn(0.8, {3, -2}, 50), back = turn(-0.8, {3, -2}, 0.02);
  there.positions = transformed(motion, mesh.positions);
  clockwise.simplices.col(1).swap(clockwise.simplices.col(2));
  auto skin = make(mesh, three_handles, 30), moved = make(there, three_handles, 30), turned = make(clockwise, three_handles, 30);
  for (Index j = 0; j < 3; ++j) {
    const Matrix t = turn(0.4 * static_cast<double>(j), {1, 0});
    set_transform(*skin, j, t);
    set_transform(*turned, j, t);
    set_transform(*moved, j, compose(motion, compose(t, back)));
  }
  const Matrix result = deformed(*skin);
  CHECK(apart(deformed(*moved), transformed(motion, result)) < 1e-4);
  CHECK(apart(deformed(*turned), result) < 1e-6);
  CHECK(moved->report().energy == doctest::Approx(2500 * skin->report().energy));
}

TEST_CASE(
    "as rigid as possible: a bent bar keeps its area to a tenth, unflipped; bad transforms leave the last frame (seed 2028)") {
  std::mt19937 random(2028);
  const SimplexMesh mesh = jittered_grid(random, 12, 4, 6, 1);
  auto skin = make(mesh, {{0, 26, 39, 52, 12, 38, 51, 64}, {0, 0, 0, 0, 1, 1, 1, 1}, 2}, 500);
  set_transform(*skin, 1, turn(1.2, {3, 0.5}));
  const Matrix moved = deformed(*skin);
  double sum = 0, rest = 0, area = 0;
  for (Index t = 0; t < mesh.simplices.rows(); ++t) {
    sum += gradient_on(mesh, moved, t, area).determinant() * area;
    rest += area;
  }
  CHECK(sum == doctest::Approx(rest).epsilon(0.1));
  CHECK(skin->report().flips == 0);
  const DeformationReport before = skin->report();
  skin->transforms()[3] = NAN;
  std::vector<float> out(2 * mesh.positions.rows(), 7);
  CHECK(skin->deform(out.data()).error().code == HB_ERROR_TARGET_NOT_FINITE);
  CHECK(out[0] == 7);
  CHECK(skin->report().energy == before.energy);
}
