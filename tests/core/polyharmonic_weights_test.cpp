#include "core/skinning/polyharmonic_weights.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/mesh/cotangent_laplacian.hpp"
#include "oracle_lines.hpp"

using namespace handlebody;

namespace {

SimplexMesh oracle_mesh(const std::string& line) {
  const std::vector<double> positions = oracle_numbers(line, "positions"), simplices = oracle_numbers(line, "simplices");
  const auto d = static_cast<Index>(oracle_numbers(line, "dimension").at(0));
  const auto corners = static_cast<Index>(oracle_numbers(line, "corners").at(0));
  SimplexMesh mesh;
  mesh.positions = Eigen::Map<const Matrix>(positions.data(), std::ssize(positions) / d, d);
  mesh.simplices = Eigen::Map<const Matrix>(simplices.data(), std::ssize(simplices) / corners, corners).cast<std::uint32_t>();
  return mesh;
}

Indices whole(const std::vector<double>& from) {
  return {from.begin(), from.end()};
}

HeldVertices oracle_handles(const std::string& line) {
  HeldVertices held{whole(oracle_numbers(line, "vertices")), whole(oracle_numbers(line, "owners")), 0};
  held.handle_count = held.owners.back() + 1;
  return held;
}

PolyharmonicWeights made(const SimplexMesh& mesh, int order) {
  auto weights = PolyharmonicWeights::create(mesh, order, Mass::voronoi);
  REQUIRE(weights);
  return std::move(**weights);
}

/** A square of (cells + 1)² vertices, two triangles a cell, moved inside by up to a fifth of a cell. */
SimplexMesh square(Index cells, std::mt19937& random) {
  const Index side = cells + 1;
  SimplexMesh mesh;
  mesh.positions.resize(side * side, 2);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  for (Index i = 0; i < side; ++i) {
    for (Index j = 0; j < side; ++j) {
      const bool inner = i > 0 && j > 0 && i < cells && j < cells;
      mesh.positions(i * side + j, 0) = static_cast<double>(j) + (inner ? shift(random) : 0);
      mesh.positions(i * side + j, 1) = static_cast<double>(i) + (inner ? shift(random) : 0);
    }
  }
  mesh.simplices.resize(2 * cells * cells, 3);
  for (Index i = 0, t = 0; i < cells; ++i) {
    for (Index j = 0; j < cells; ++j) {
      const auto a = static_cast<std::uint32_t>(i * side + j), up = static_cast<std::uint32_t>(side);
      mesh.simplices.row(t++) << a, a + 1, a + 1 + up;
      mesh.simplices.row(t++) << a, a + 1 + up, a + up;
    }
  }
  return mesh;
}

}  // namespace

TEST_CASE("the operators are libigl's to 1e-10") {
  for (const std::string& line : oracle_lines("skinning_weights.json")) {
    const SimplexMesh mesh = oracle_mesh(line);
    REQUIRE(check_simplex_mesh(mesh));
    const SparseMatrix laplacian = cotangent_laplacian(mesh);
    const std::vector<double> rows = oracle_numbers(line, "rows"), columns = oracle_numbers(line, "columns"),
                              entries = oracle_numbers(line, "entries");
    const Matrix ours = laplacian;
    Matrix theirs = Matrix::Zero(ours.rows(), ours.cols());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      theirs(static_cast<Index>(rows[k]), static_cast<Index>(columns[k])) = entries[k];
      theirs(static_cast<Index>(columns[k]), static_cast<Index>(rows[k])) = entries[k];
    }
    CHECK((ours - theirs).cwiseAbs().maxCoeff() < 1e-10 * theirs.cwiseAbs().maxCoeff());
    CHECK((ours * Vector::Ones(ours.rows())).cwiseAbs().maxCoeff() < 1e-12 * theirs.cwiseAbs().maxCoeff());
    for (const Mass kind : {Mass::barycentric, Mass::voronoi}) {
      const std::vector<double> mass = oracle_numbers(line, kind == Mass::voronoi ? "voronoi" : "barycentric");
      const Vector own = mass_matrix(mesh, kind);
      for (std::size_t v = 0; v < mass.size(); ++v) CHECK(own[static_cast<Index>(v)] == doctest::Approx(mass[v]).epsilon(1e-10));
    }
  }
}

TEST_CASE("weights are libigl's: harmonic and biharmonic to 1e-7, triharmonic to 1e-5") {
  double worst[4] = {};
  for (const std::string& line : oracle_lines("skinning_weights.json")) {
    for (int order = 1; order <= 3; ++order) {
      PolyharmonicWeights weights = made(oracle_mesh(line), order);
      REQUIRE(weights.set_handles(oracle_handles(line)));
      CHECK(weights.factored());
      const std::vector<double> theirs = oracle_numbers(line, "weights" + std::to_string(order));
      REQUIRE(std::ssize(theirs) == weights.weights().size());
      const double error =
          (weights.weights() - Eigen::Map<const Matrix>(theirs.data(), weights.weights().rows(), weights.weights().cols()))
              .cwiseAbs()
              .maxCoeff();
      worst[order] = std::max(worst[order], error);
    }
  }
  MESSAGE("worst: harmonic " << worst[1] << ", biharmonic " << worst[2] << ", triharmonic " << worst[3]);
  CHECK(worst[1] < 1e-7);
  CHECK(worst[2] < 1e-7);
  CHECK(worst[3] < 1e-5);
}

TEST_CASE("handles that come, go and move by updates give the weights of a new factorization (seed 2100)") {
  std::mt19937 random(2100);
  const SimplexMesh mesh = square(24, random);
  std::uniform_int_distribution<std::uint32_t> any(0, static_cast<std::uint32_t>(mesh.positions.rows()) - 1);
  for (int order = 1; order <= 3; ++order) {
    PolyharmonicWeights weights = made(mesh, order);
    HeldVertices held{{0, 24, 600, 624, 312, 313}, {0, 1, 2, 3, 4, 4}, 5};
    REQUIRE(weights.set_handles(held));
    double worst = 0;
    int updates = 0;
    for (int step = 0; step < 12; ++step) {
      switch (step % 4) {
        case 0:  // one more
          held.vertices.push_back(any(random));
          held.owners.push_back(static_cast<std::uint32_t>(held.handle_count++));
          break;
        case 1:  // one moves
          held.vertices[1] = any(random);
          break;
        case 2:  // the bone grows at the end, and loses its beginning
          held.vertices[4] = any(random);
          break;
        default:  // the first goes
          held.vertices.erase(held.vertices.begin());
          held.owners.erase(held.owners.begin());
          for (std::uint32_t& owner : held.owners) --owner;
          --held.handle_count;
          held.vertices.insert(held.vertices.begin(), any(random));
          held.owners.insert(held.owners.begin(), 0);
          for (std::size_t k = 1; k < held.owners.size(); ++k) ++held.owners[k];
          ++held.handle_count;
      }
      const Result<Done> done = weights.set_handles(held);
      if (!done && done.error().code == HB_ERROR_HANDLE_CONFLICT) break;
      REQUIRE(done);
      updates += !weights.factored();
      PolyharmonicWeights anew = made(mesh, order);
      REQUIRE(anew.set_handles(held));
      worst = std::max(worst, (weights.weights() - anew.weights()).cwiseAbs().maxCoeff());
    }
    CHECK(updates > 4);
    MESSAGE("order " << order << ": " << updates << " updates, worst " << worst);
    CHECK(worst < (order == 3 ? 1e-5 : 1e-8));
  }
}

TEST_CASE("needles and caps, however thin, leave the weights nearly what they are without them (seeds 2110 to 2133)") {
  for (unsigned seed = 2110; seed < 2134; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const SimplexMesh plain = square(8, random);
    const Index n = plain.positions.rows();
    std::uniform_real_distribution<double> unit(0, 1);
    const double thin = std::pow(10, -3 - 10 * unit(random)), along = seed % 2 ? 0.5 : 1 - thin;
    // The inner edge from a to b of two triangles gets a vertex beside it, at the middle (a cap) or beside b (a needle).
    const auto cell = static_cast<std::uint32_t>(1 + random() % 6 + 9 * (1 + random() % 6));
    const std::uint32_t a = cell, b = cell + 10, c = cell + 9, added = static_cast<std::uint32_t>(n);
    SimplexMesh mesh{Matrix(n + 1, 2), Simplices(plain.simplices.rows() + 2, 3)};
    const Eigen::RowVector2d edge = plain.positions.row(b) - plain.positions.row(a);
    mesh.positions.topRows(n) = plain.positions;
    mesh.positions.row(n) = plain.positions.row(a) + along * edge + thin * Eigen::RowVector2d(-edge[1], edge[0]);
    Index s = 0;
    for (Index t = 0; t < plain.simplices.rows(); ++t) {
      const Eigen::RowVector3i own = plain.simplices.row(t).cast<int>();
      const bool divided = (own.array() == static_cast<int>(a)).any() && (own.array() == static_cast<int>(b)).any() &&
                           (own.array() == static_cast<int>(c)).any();
      if (divided) {
        mesh.simplices.row(s++) << a, added, c;
        mesh.simplices.row(s++) << added, b, c;
        mesh.simplices.row(s++) << a, b, added;
      } else {
        mesh.simplices.row(s++) = plain.simplices.row(t);
      }
    }
    REQUIRE(check_volumes(mesh));
    const HeldVertices held{{0, 8, 80}, {0, 1, 2}, 3};
    for (int order = 1; order <= 3; ++order) {
      CAPTURE(order);
      PolyharmonicWeights expected = made(plain, order), weights = made(mesh, order);
      REQUIRE(expected.set_handles(held));
      REQUIRE(weights.set_handles(held));
      CHECK(weights.weights().allFinite());
      CHECK((weights.weights().topRows(n) - expected.weights()).cwiseAbs().maxCoeff() < 5e-3);
      CHECK((weights.weights().rowwise().sum().array() - 1).abs().maxCoeff() < (order == 3 ? 1e-3 : 1e-5));
    }
  }
}

TEST_CASE("weights sum to 1, turn and grow with the mesh, and follow the order of handles (seed 2101)") {
  std::mt19937 random(2101);
  SimplexMesh mesh = square(12, random);
  const HeldVertices held{{14, 30, 100, 101, 102}, {0, 1, 2, 2, 2}, 3}, reversed{{14, 30, 100, 101, 102}, {2, 1, 0, 0, 0}, 3};
  for (int order = 1; order <= 3; ++order) {
    PolyharmonicWeights weights = made(mesh, order);
    REQUIRE(weights.set_handles(held));
    CHECK((weights.weights().rowwise().sum().array() - 1).abs().maxCoeff() < 1e-8);
    PolyharmonicWeights other = made(mesh, order);
    REQUIRE(other.set_handles(reversed));
    CHECK((weights.weights().rowwise().reverse() - other.weights()).cwiseAbs().maxCoeff() < 1e-12);
    SimplexMesh turned = mesh;
    turned.positions.col(0) = 1000 * (0.6 * mesh.positions.col(0) - 0.8 * mesh.positions.col(1)).array() + 7;
    turned.positions.col(1) = 1000 * (0.8 * mesh.positions.col(0) + 0.6 * mesh.positions.col(1)).array() - 3;
    PolyharmonicWeights moved = made(turned, order);
    REQUIRE(moved.set_handles(held));
    CHECK((weights.weights() - moved.weights()).cwiseAbs().maxCoeff() < 1e-8);
  }
}

TEST_CASE("parts without a handle go with the nearest one, as do vertices in no triangle") {
  SimplexMesh mesh;
  mesh.positions.resize(10, 2);
  mesh.positions << 0, 0, 1, 0, 1, 1, 0, 1,  // a square with handles at 0 and 1
      5, 0, 6, 0, 6, 1,                      // a triangle nearer to 1
      -1, 0, 9, 9, 0.2, 5;                   // loose vertices
  mesh.simplices.resize(3, 3);
  mesh.simplices << 0, 1, 2, 0, 2, 3, 4, 5, 6;
  PolyharmonicWeights weights = made(mesh, 2);
  REQUIRE(weights.set_handles({{0, 1}, {0, 1}, 2}));
  const std::vector<Island>& islands = weights.islands();
  REQUIRE(islands.size() == 4);
  CHECK(islands[0].first == 4);
  CHECK(islands[0].count == 3);
  CHECK(islands[0].handle == 1);
  CHECK(islands[1].handle == 0);
  for (Index v = 4; v < 7; ++v) CHECK(weights.weights()(v, 1) == doctest::Approx(1).epsilon(1e-12));
  CHECK(weights.weights()(7, 0) == 1);
}

TEST_CASE("handles that cannot be are named, and the former weights stay") {
  std::mt19937 random(1);
  PolyharmonicWeights weights = made(square(4, random), 2);
  REQUIRE(weights.set_handles({{0, 24}, {0, 1}, 2}));
  const Matrix before = weights.weights();
  const auto code = [&weights](const HeldVertices& held) { return weights.set_handles(held).error().code; };
  CHECK(code({{}, {}, 0}) == HB_ERROR_HANDLES_MISSING);
  CHECK(code({{3, 3}, {0, 1}, 2}) == HB_ERROR_HANDLE_CONFLICT);
  CHECK(code({{3, 25}, {0, 1}, 2}) == HB_ERROR_HANDLE_OUT_OF_RANGE);
  CHECK(code({{3}, {0}, 2}) == HB_ERROR_HANDLE_OUT_OF_RANGE);
  CHECK(code({{3}, {1}, 1}) == HB_ERROR_INVALID_OPTION);
  CHECK(weights.weights() == before);
  CHECK(weights.held().vertices == Indices{0, 24});
}

TEST_CASE("meshes that cannot be are named") {
  std::mt19937 random(2);
  const SimplexMesh good = square(3, random);
  const auto code = [](const SimplexMesh& mesh) { return PolyharmonicWeights::create(mesh, 2, Mass::voronoi).error().code; };
  SimplexMesh mesh = good;
  mesh.positions(5, 1) = std::nan("");
  CHECK(code(mesh) == HB_ERROR_MESH_NOT_FINITE);
  mesh = good;
  mesh.simplices(7, 2) = 16;
  CHECK(code(mesh) == HB_ERROR_MESH_INDEX_OUT_OF_RANGE);
  mesh = good;
  mesh.simplices(7, 2) = mesh.simplices(7, 1);
  CHECK(code(mesh) == HB_ERROR_MESH_DEGENERATE);
  mesh = good;
  mesh.positions.setZero();
  CHECK(code(mesh) == HB_ERROR_MESH_ZERO_EXTENT);
  mesh = good;
  mesh.positions *= 1e200;
  CHECK(code(mesh) == HB_ERROR_MESH_NOT_FINITE);
  mesh = good;
  mesh.simplices.resize(0, 3);
  CHECK(code(mesh) == HB_ERROR_MESH_NO_TRIANGLES);
  CHECK(PolyharmonicWeights::create(good, 4, Mass::voronoi).error().code == HB_ERROR_INVALID_OPTION);
}
