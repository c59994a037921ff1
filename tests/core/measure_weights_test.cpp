#include "core/skinning/measure_weights.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "plane_meshes.hpp"

using namespace handlebody;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

WeightMeasures measured(const SimplexMesh& mesh, const HeldVertices& held, const Matrix& weights) {
  auto made = measure_weights(mesh, held, weights);
  REQUIRE(made);
  return *made;
}

/** Two unit squares side by side, four triangles: vertices 0 to 5 at (0,0) (1,0) (2,0) (0,1) (1,1) (2,1). */
SimplexMesh domino() {
  SimplexMesh mesh{Matrix(6, 2), Simplices(4, 3)};
  mesh.positions << 0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1;
  mesh.simplices << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4;
  return mesh;
}

/** A strip of squares along a path that goes right, up and left again: a hairpin. Vertex 2i is on its inner side, 2i + 1 on its
 * outer.
 */
SimplexMesh hairpin() {
  const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> rungs{
      {{0, 1}, {0, 0}},     {{1, 1}, {1, 0}},     {{2, 1}, {2, 0}},     {{3, 1}, {3, 0}},    {{3, 1.2}, {4, 1.1}},
      {{3, 1.4}, {3, 2.4}}, {{2, 1.4}, {2, 2.4}}, {{1, 1.4}, {1, 2.4}}, {{0, 1.4}, {0, 2.4}}};
  SimplexMesh mesh{Matrix(2 * std::ssize(rungs), 2), Simplices(2 * (std::ssize(rungs) - 1), 3)};
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    mesh.positions.row(static_cast<Index>(2 * i)) = rungs[i].first.transpose();
    mesh.positions.row(static_cast<Index>(2 * i + 1)) = rungs[i].second.transpose();
  }
  for (Index s = 0; s < mesh.simplices.rows() / 2; ++s) {
    const auto v = static_cast<std::uint32_t>(2 * s);
    mesh.simplices.row(2 * s) << v, v + 1, v + 3;
    mesh.simplices.row(2 * s + 1) << v, v + 3, v + 2;
  }
  return mesh;
}

/** Every pair of vertices' shortest path along edges (Floyd and Warshall). */
Matrix all_paths(const SimplexMesh& mesh) {
  const Index n = mesh.positions.rows();
  Matrix paths = Matrix::Constant(n, n, infinite);
  paths.diagonal().setZero();
  for (Index s = 0; s < mesh.simplices.rows(); ++s)
    for (Index k = 0; k < mesh.simplices.cols(); ++k)
      for (Index l = 0; l < mesh.simplices.cols(); ++l) {
        const std::uint32_t a = mesh.simplices(s, k), b = mesh.simplices(s, l);
        paths(a, b) = std::min(paths(a, b), (mesh.positions.row(a) - mesh.positions.row(b)).norm());
      }
  for (Index k = 0; k < n; ++k)
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) paths(i, j) = std::min(paths(i, j), paths(i, k) + paths(k, j));
  return paths;
}

}  // namespace

TEST_CASE("linear weights: no jump, their sum, their bounds and where they count, exactly") {
  const SimplexMesh mesh = domino();
  Matrix weights(6, 2);
  for (Index v = 0; v < 6; ++v) weights.row(v) << mesh.positions(v, 0) / 2, 5. / 6 - mesh.positions(v, 0) / 2;
  const WeightMeasures m = measured(mesh, {{0, 2}, {0, 1}, 2}, weights);
  CHECK(m.gradient_jump < 1e-15);
  CHECK(m.sum_error == doctest::Approx(1. / 6));
  CHECK(m.least == doctest::Approx(-1. / 6));
  CHECK(m.largest == 1);
  CHECK(m.support[0] == 1);
  CHECK(m.support[1] == doctest::Approx(0.75));  // its mean on the triangle 1 2 5 is 0
}

TEST_CASE("a kink is its jump over the steepest gradient") {
  // Gradients (0,0) left and (1,0) right of x = 1: one jump of 1 over a steepest gradient of 1; the second weight's slopes are 1
  // and 3.
  const SimplexMesh mesh = domino();
  Matrix weights(6, 1), steeper(6, 1);
  weights << 0, 0, 1, 0, 0, 1;
  steeper << 0, 1, 4, 0, 1, 4;
  CHECK(measured(mesh, {{0}, {0}, 1}, weights).gradient_jump == doctest::Approx(1));
  CHECK(measured(mesh, {{0}, {0}, 1}, steeper).gradient_jump == doctest::Approx(2. / 3));
  Matrix both(6, 2);
  both << steeper, weights;
  CHECK(measured(mesh, {{0, 2}, {0, 1}, 2}, both).gradient_jump == doctest::Approx(1));
}

TEST_CASE("in space, turned anywhere, surfaces and solids have the same gradients (seed 5)") {
  std::mt19937 random(5);
  SimplexMesh solid{Matrix(5, 3), Simplices(2, 4)};
  solid.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1;
  solid.simplices << 0, 1, 2, 3, 1, 2, 3, 4;
  Matrix linear(5, 1), bump(5, 1);
  linear << 1, 2, 3, 4, 7;
  bump << 1, 2, 3, 4, 9;
  const double jump = measured(solid, {{0}, {0}, 1}, bump).gradient_jump;
  // The bump adds 2 to the hat of vertex 4, whose gradient is (½, ½, ½): 2 · √3/2 over |(1, 2, 3) + (1, 1, 1)|.
  CHECK(jump == doctest::Approx(std::sqrt(3.) / std::sqrt(4. + 9 + 16)));
  SimplexMesh flat = domino();
  Matrix kink(6, 1);
  kink << 0, 1, 4, 0, 1, 4;
  for (int round = 0; round < 10; ++round) {
    const Matrix3 turn = test::random_rotation(random, 3);
    SimplexMesh turned = solid, sheet = flat;
    turned.positions = solid.positions * turn.transpose();
    sheet.positions = flat.positions * turn.leftCols<2>().transpose();
    CHECK(measured(turned, {{0}, {0}, 1}, linear).gradient_jump < 1e-12);
    CHECK(measured(turned, {{0}, {0}, 1}, bump).gradient_jump == doctest::Approx(jump));
    CHECK(measured(sheet, {{0}, {0}, 1}, kink).gradient_jump == doctest::Approx(2. / 3));
  }
}

TEST_CASE("far and leaked weights by every pair's shortest path (seed 12)") {
  std::mt19937 random(12);
  for (int round = 0; round < 20; ++round) {
    const SimplexMesh mesh = round % 2 ? hairpin() : test::jittered_grid(random, 6, 4);
    const Index n = mesh.positions.rows();
    std::uniform_int_distribution<std::uint32_t> vertex(0, static_cast<std::uint32_t>(n) - 1);
    // Three handles, the first of two vertices; they may share one.
    const HeldVertices held{{vertex(random), vertex(random), vertex(random), vertex(random)}, {0, 1, 2, 0}, 3};
    const Matrix weights = test::random_matrix(random, n, 3);
    const Matrix paths = all_paths(mesh);
    double far = 0, leaked = std::nan("");
    for (Index v = 0; v < n; ++v) {
      Vector3 inside = Vector3::Constant(infinite), straight = inside;
      for (std::size_t k = 0; k < 4; ++k) {
        inside[held.owners[k]] = std::min(inside[held.owners[k]], paths(v, held.vertices[k]));
        straight[held.owners[k]] =
            std::min(straight[held.owners[k]], (mesh.positions.row(v) - mesh.positions.row(held.vertices[k])).norm());
      }
      for (Index j = 0; j < 3; ++j)
        if (inside[j] > 2 * inside.minCoeff()) far = std::max(far, std::abs(weights(v, j)));
      Index direct = 0;
      straight.minCoeff(&direct);
      if (inside[direct] > 1.5 * straight[direct] && inside[direct] > inside.minCoeff())
        leaked = std::fmax(leaked, std::abs(weights(v, direct)));
    }
    const WeightMeasures m = measured(mesh, held, weights);
    CHECK(m.far_weight == far);
    CHECK((m.leaked_weight == leaked || (std::isnan(m.leaked_weight) && std::isnan(leaked))));
  }
}

TEST_CASE("a hairpin leaks from limb to limb, and a convex shape has nowhere to") {
  const SimplexMesh pin = hairpin();
  const Index n = pin.positions.rows();
  // One handle at the lower tip, one at the bend: the inner upper tip is straight above the first, 0.4 away.
  const HeldVertices held{{0, 8}, {0, 1}, 2};
  Matrix weights = Matrix::Zero(n, 2);
  weights.col(1).setOnes();
  CHECK(measured(pin, held, weights).leaked_weight == 0);
  weights(16, 0) = 0.625;
  CHECK(measured(pin, held, weights).leaked_weight == 0.625);
  CHECK(std::isnan(measured(domino(), {{0, 5}, {0, 1}, 2}, Matrix::Constant(6, 2, 0.5)).leaked_weight));
}

TEST_CASE("parts, handles without a vertex and flat triangles do no harm") {
  SimplexMesh mesh{Matrix(8, 2), Simplices(3, 3)};
  mesh.positions << 0, 0, 1, 0, 0, 1, 5, 0, 6, 0, 5, 1, 7, 0, 9, 9;  // 4, 3 and 6 on one line; 7 in no triangle
  mesh.simplices << 0, 1, 2, 3, 4, 5, 3, 4, 6;
  Matrix weights = Matrix::Zero(8, 2);
  weights(3, 0) = -0.5;  // of the first handle, in the other part: infinitely far
  weights(6, 1) = 1e3;
  const WeightMeasures m = measured(mesh, {{0, 3}, {0, 1}, 2}, weights);
  CHECK(m.far_weight == 0.5);
  CHECK(std::isfinite(m.gradient_jump));
  CHECK(m.support[0] == doctest::Approx(0.5));
  CHECK(m.support[1] == 0);  // only at the flat triangle
  const WeightMeasures none = measured(mesh, {{}, {}, 2}, weights);
  CHECK(none.far_weight == 0);
  CHECK(std::isnan(none.leaked_weight));
}

TEST_CASE("the largest weights on the smallest triangles do not overflow") {
  // Squares of three sizes in two triangles each, of which the last are flat beside the others; weights go up and down around each.
  SimplexMesh mesh{Matrix(12, 2), Simplices(6, 3)};
  Matrix weights(12, 1);
  for (Index q = 0; q < 3; ++q) {
    const double side = std::array{1., 2e-60, 1e-80}[static_cast<std::size_t>(q)];
    const auto v = static_cast<std::uint32_t>(4 * q);
    Matrix square(4, 2);
    square << 0, 0, side, 0, side, side, 0, side;
    mesh.positions.middleRows<4>(4 * q) = square * Eigen::Rotation2Dd(0.3).toRotationMatrix();
    mesh.simplices.middleRows<2>(2 * q) << v, v + 1, v + 2, v, v + 2, v + 3;
    weights.middleRows<4>(4 * q) << 1e60, -1e60, 1e60, -1e60;
  }
  // Gradients (−2, 2)/side and (2, −2)/side times 1e60: their difference is twice as long as they are.
  CHECK(measured(mesh, {{0}, {0}, 1}, weights).gradient_jump == doctest::Approx(2));
}

TEST_CASE("refuses what is no mesh, no handle or no weight, and says which") {
  const SimplexMesh mesh = domino();
  const Matrix weights = Matrix::Constant(6, 2, 0.5);
  const auto code = [](const SimplexMesh& m, const HeldVertices& held, const Matrix& w) {
    auto made = measure_weights(m, held, w);
    REQUIRE_FALSE(made);
    return made.error().code;
  };
  const HeldVertices held{{0, 2}, {0, 1}, 2};
  CHECK(code(mesh, {{}, {}, 0}, Matrix(6, 0)) == HB_ERROR_HANDLES_MISSING);
  CHECK(code(mesh, {{0, 6}, {0, 1}, 2}, weights) == HB_ERROR_HANDLE_OUT_OF_RANGE);
  CHECK(code(mesh, {{0, 5}, {0, 2}, 2}, weights) == HB_ERROR_HANDLE_OUT_OF_RANGE);
  CHECK(code(mesh, held, weights.topRows(5)) == HB_ERROR_INVALID_SHAPE);
  CHECK(code(mesh, held, weights.leftCols(1)) == HB_ERROR_INVALID_SHAPE);
  for (const double bad : {std::nan(""), infinite, -infinite, 1e61, -1e308}) {
    Matrix wrong = weights;
    wrong(4, 1) = bad;
    auto made = measure_weights(mesh, held, wrong);
    REQUIRE_FALSE(made);
    CHECK(made.error().code == HB_ERROR_VALUE_NOT_FINITE);
    CHECK(made.error().index == 4);
  }
  SimplexMesh broken = mesh;
  broken.simplices(3, 1) = 6;
  CHECK(code(broken, held, weights) == HB_ERROR_MESH_INDEX_OUT_OF_RANGE);
  broken = mesh;
  broken.positions(2, 1) = infinite;
  CHECK(code(broken, held, weights) == HB_ERROR_MESH_NOT_FINITE);
}
