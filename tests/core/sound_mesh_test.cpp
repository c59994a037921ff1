#include "core/mesh/sound_mesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "core/mesh/kuhn_tetrahedra.hpp"
#include "core/skinning/polyharmonic_weights.hpp"
#include "made_meshes.hpp"
#include "plane_meshes.hpp"

using namespace handlebody;

namespace {

/** Triangles in the plane, the surface of a box, or cubes of six tetrahedra: sound meshes whose vertices are moved at random. */
SimplexMesh made_sound(std::mt19937& random, int kind) {
  if (kind == 0) return test::jittered_grid(random, 6, 4);
  std::uniform_real_distribution<double> jitter(-0.06, 0.06);
  if (kind == 1) {
    const test::MadeMesh box = test::made_box({2, 1, 1}, {5, 3, 3});
    SimplexMesh mesh{box.positions, box.triangles};
    for (Index i = 0; i < mesh.positions.size(); ++i) mesh.positions.data()[i] += jitter(random);
    return mesh;
  }
  const auto number = [](int i, int j, int k) { return static_cast<std::uint32_t>(i + 4 * (j + 3 * k)); };
  SimplexMesh mesh{Matrix(4 * 3 * 3, 3), Simplices(3 * 2 * 2 * 6, 4)};
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) mesh.positions.row(number(i, j, k)) << i + jitter(random), j + jitter(random), k + jitter(random);
  Index s = 0;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i)
        for (const auto& own : kuhn_tetrahedra) {
          for (Index c = 0; c < 4; ++c) {
            const int corner = own[static_cast<std::size_t>(c)];
            mesh.simplices(s, c) = number(i + (corner & 1), j + ((corner >> 1) & 1), k + (corner >> 2));
          }
          ++s;
        }
  return mesh;
}

/** A mesh with defects, and which vertex of the sound one each of its vertices is a copy of, or `no_index`. */
struct Defective {
  SimplexMesh mesh;
  Indices copy_of;
  std::uint32_t flat = 0, doubled = 0, unused = 0, only_flat = 0;
};

/** Every corner a vertex of its own by chance, in any order, moved by up to `noise`; flat and repeated simplices and vertices that
 * nothing uses in between. */
Defective spoil(std::mt19937& random, const SimplexMesh& sound, double noise) {
  const Index corners = sound.simplices.cols(), d = sound.positions.cols();
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Vector> points;
  Defective result;
  const auto add = [&](const Vector& point, std::uint32_t copied) {
    points.push_back(point);
    result.copy_of.push_back(copied);
    return static_cast<std::uint32_t>(points.size() - 1);
  };
  const auto copy = [&](std::uint32_t vertex) {
    Vector point = sound.positions.row(vertex).transpose();
    for (Index axis = 0; axis < d; ++axis) point[axis] += noise * unit(random);
    return add(point, vertex);
  };
  const auto unused = [&](double x) { add(Vector::Constant(d, x), no_index); };
  std::map<std::uint32_t, std::uint32_t> last;  // the copy that was made last
  std::vector<Indices> simplices;
  const auto corner = [&](std::uint32_t vertex) {
    if (!last.count(vertex) || random() % 3 == 0) last[vertex] = copy(vertex);
    return last[vertex];
  };
  for (Index s = 0; s < sound.simplices.rows(); ++s) {
    const auto take = [&] {
      Indices own;
      for (Index k = 0; k < corners; ++k) own.push_back(corner(sound.simplices(s, k)));
      return own;
    };
    simplices.push_back(take());
    const std::uint32_t a = sound.simplices(s, 0), b = sound.simplices(s, 1);
    if (random() % 4 == 0) {  // once more, turned round and with other copies
      Indices again = take();
      std::rotate(again.begin(), again.begin() + static_cast<std::ptrdiff_t>(random() % 3), again.end());
      if (random() % 2) std::swap(again[0], again[1]);
      simplices.push_back(again);
      ++result.doubled;
    }
    if (random() % 4 == 0) {  // a corner twice: by number, or by place
      Indices thin = take();
      thin[1] = random() % 2 ? thin[0] : copy(a);
      simplices.push_back(thin);
      ++result.flat;
    }
    if (random() % 6 == 0) {  // along an edge, with a vertex of its own there
      Indices thin = take();
      const double t = 0.5 + 0.4 * unit(random);
      thin[2] = add((1 - t) * sound.positions.row(a).transpose() + t * sound.positions.row(b).transpose(), no_index);
      if (corners == 4) thin[3] = thin[0];
      simplices.push_back(thin);
      ++result.flat;
      ++result.only_flat;
    }
    if (random() % 8 == 0) unused(1e3 * unit(random));
    if (random() % 16 == 0) unused(random() % 2 ? std::nan("") : 1e300 * unit(random));
  }
  result.mesh.positions.resize(std::ssize(points), d);
  for (std::size_t v = 0; v < points.size(); ++v) result.mesh.positions.row(static_cast<Index>(v)) = points[v].transpose();
  result.mesh.simplices.resize(std::ssize(simplices), corners);
  for (std::size_t s = 0; s < simplices.size(); ++s)
    for (Index k = 0; k < corners; ++k) result.mesh.simplices(static_cast<Index>(s), k) = simplices[s][static_cast<std::size_t>(k)];
  // Some copies were not taken after all.
  const std::vector<char> used = used_vertices(result.mesh);
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) continue;
    ++result.unused;
    result.copy_of[v] = no_index;
  }
  return result;
}

SoundMesh made(const SimplexMesh& mesh, const SoundMeshOptions& options = {}) {
  auto result = sound_mesh(mesh, options);
  REQUIRE(result);
  return std::move(*result);
}

/** Simplices as sets of corners. */
std::multiset<Indices> corner_sets(const Simplices& simplices, const Indices& number) {
  std::multiset<Indices> sets;
  for (Index s = 0; s < simplices.rows(); ++s) {
    Indices own;
    for (Index k = 0; k < simplices.cols(); ++k) own.push_back(number[simplices(s, k)]);
    std::sort(own.begin(), own.end());
    sets.insert(own);
  }
  return sets;
}

/** Checks that `result` is the mesh `sound` again; returns its vertices' numbers there. */
Indices check_restored(const SimplexMesh& sound, const Defective& given, const SoundMesh& result) {
  CHECK(result.flat.count == given.flat);
  CHECK(result.doubled.size() == given.doubled);
  CHECK(result.unused.count == given.unused);
  CHECK(result.flat_vertices.size() == given.only_flat);
  Indices number(result.first.size(), no_index), whole;
  for (std::uint32_t v = 0; v < given.copy_of.size(); ++v) {
    const std::uint32_t copied = given.copy_of[v], own = result.vertex_of[v];
    CHECK(result.place_of[v] <= v);
    if (copied == no_index) continue;
    CHECK(result.place_of[v] == result.first[own]);
    if (number[own] == no_index) number[own] = copied;
    CHECK(number[own] == copied);
  }
  for (std::uint32_t v = 0; v < sound.positions.rows(); ++v) whole.push_back(v);
  CHECK(corner_sets(result.mesh.simplices, number) == corner_sets(sound.simplices, whole));
  return number;
}

}  // namespace

TEST_CASE("a sound mesh stays as it is, to the last bit (seeds 300 to 302)") {
  for (unsigned seed = 300; seed < 303; ++seed) {
    std::mt19937 random(seed);
    SimplexMesh mesh = made_sound(random, static_cast<int>(seed % 3));
    // A vertex that nothing uses stays, too, where it is not at the place of another.
    mesh.positions.conservativeResize(mesh.positions.rows() + 1, Eigen::NoChange);
    mesh.positions.bottomRows(1).setConstant(77);
    for (const bool weld : {true, false}) {
      const SoundMesh result = made(mesh, {weld, true});
      CHECK(result.mesh.positions == mesh.positions);
      CHECK(result.mesh.simplices == mesh.simplices);
      CHECK(result.flat.count + result.doubled.size() == 0);
      CHECK(result.flat_vertices.empty());
      CHECK(result.unused.count == 1);
      CHECK(result.unused.first == mesh.positions.rows() - 1);
      for (std::uint32_t v = 0; v < mesh.positions.rows(); ++v) CHECK(result.vertex_of[v] == v);
    }
  }
}

TEST_CASE(
    "split vertices, flat and repeated simplices, unused vertices: what is left is the mesh without them (seeds 310 to 333)") {
  for (unsigned seed = 310; seed < 334; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const SimplexMesh sound = made_sound(random, static_cast<int>(seed % 3));
    const Defective given = spoil(random, sound, seed % 2 ? 0 : 1e-8);
    REQUIRE(std::min({given.flat, given.doubled, given.unused, given.only_flat}) > 0);
    const SoundMesh result = made(given.mesh);
    const Indices number = check_restored(sound, given, result);

    // Where flat vertices go is where they are.
    for (const FlatVertex& flat : result.flat_vertices) {
      Vector place = Vector::Zero(sound.positions.cols());
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(flat.parts[k] >= 0);
        sum += flat.parts[k];
        place += flat.parts[k] * result.mesh.positions.row(flat.corners[k]).transpose();
      }
      CHECK(sum == doctest::Approx(1).epsilon(1e-12));
      CHECK((place.transpose() - given.mesh.positions.row(flat.vertex)).norm() < 1e-6);
      const auto largest = std::max_element(flat.parts.begin(), flat.parts.end()) - flat.parts.begin();
      CHECK(result.vertex_of[flat.vertex] == flat.corners[static_cast<std::size_t>(largest)]);
    }

    // And so are its weights.
    if (seed % 2 == 0) continue;
    const HeldVertices ends{{0, static_cast<std::uint32_t>(sound.positions.rows() - 1)}, {0, 1}, 2};
    HeldVertices held = ends;
    for (std::uint32_t& vertex : held.vertices)
      vertex = static_cast<std::uint32_t>(std::find(number.begin(), number.end(), vertex) - number.begin());
    for (int order = 1; order <= 2; ++order) {
      auto expected = PolyharmonicWeights::create(sound, order, Mass::voronoi);
      auto weights = PolyharmonicWeights::create(result.mesh, order, Mass::voronoi);
      REQUIRE(expected);
      REQUIRE(weights);
      REQUIRE((*expected)->set_handles(ends));
      REQUIRE((*weights)->set_handles(held));
      double worst = 0;
      for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] != no_index)
          worst = std::max(
              worst,
              ((*weights)->weights().row(static_cast<Index>(v)) - (*expected)->weights().row(number[v])).cwiseAbs().maxCoeff());
      CHECK(worst < 1e-9);
    }
  }
}

TEST_CASE("the order of vertices and simplices does not matter (seeds 340 to 359)") {
  for (unsigned seed = 340; seed < 360; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const SimplexMesh sound = made_sound(random, static_cast<int>(seed % 3));
    Defective given = spoil(random, sound, seed % 2 ? 0 : 1e-8);
    Indices order(given.copy_of.size()), position(order.size());
    for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
    std::shuffle(order.begin(), order.end(), random);
    Defective other = given;
    for (std::uint32_t v = 0; v < order.size(); ++v) {
      position[order[v]] = v;
      other.mesh.positions.row(v) = given.mesh.positions.row(order[v]);
      other.copy_of[v] = given.copy_of[order[v]];
    }
    for (Index s = 0; s < given.mesh.simplices.rows(); ++s)
      for (Index k = 0; k < given.mesh.simplices.cols(); ++k)
        other.mesh.simplices(given.mesh.simplices.rows() - 1 - s, k) = position[given.mesh.simplices(s, k)];
    check_restored(sound, other, made(other.mesh));
  }
}

TEST_CASE("by number alone, split vertices stay apart") {
  std::mt19937 random(4);
  const SimplexMesh sound = made_sound(random, 1);
  SimplexMesh soup{Matrix(sound.simplices.size(), 3), Simplices(sound.simplices.rows() + 2, 3)};
  for (Index i = 0; i < sound.simplices.size(); ++i) {
    soup.positions.row(i) = sound.positions.row(sound.simplices.data()[i]);
    soup.simplices.data()[i] = static_cast<std::uint32_t>(i);
  }
  soup.simplices.bottomRows(2) << 0, 0, 1, 2, 1, 0;
  CHECK(std::ssize(made(soup).first) == sound.positions.rows());
  const SoundMesh apart = made(soup, {false, false});
  CHECK(apart.mesh.positions == soup.positions);
  CHECK(apart.mesh.simplices.rows() == sound.simplices.rows());
  CHECK(apart.flat.count == 1);
  CHECK(apart.doubled == Indices{static_cast<std::uint32_t>(soup.simplices.rows() - 1)});
}

TEST_CASE("what is parted by more than rounding stays apart, however far its other parts and unused vertices are") {
  // Two squares of a side of 1, a slit of `gap` apart, and a far triangle, or a far vertex.
  const auto places = [](double gap, bool far_part) {
    SimplexMesh mesh{Matrix(11, 3), Simplices(far_part ? 5 : 4, 3)};
    mesh.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,            //
        1 + gap, 0, 0, 2 + gap, 0, 0, 2 + gap, 1, 0, 1 + gap, 1, 0,  //
        1e9, 0, 0, 1e9 + 1, 0, 0, 1e9, 1, 0;
    mesh.simplices.topRows(4) << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7;
    if (far_part) mesh.simplices.row(4) << 8, 9, 10;
    return made(mesh).first.size();
  };
  CHECK(places(0, false) == 9);
  CHECK(places(1e-7, false) == 9);
  CHECK(places(1e-5, false) == 11);  // more than a millionth of the diagonal
  CHECK(places(5e-4, true) == 9);    // less than that, and than a thousandth of the edges
  CHECK(places(2e-3, true) == 11);   // more than a thousandth of the edges
}

TEST_CASE("what only rounding gives a height is flat where it hangs on others, and stays where it joins them or is all there is") {
  // A square of two triangles, with a vertex beside its diagonal.
  SimplexMesh mesh{Matrix(5, 3), Simplices(3, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 1e-7;
  mesh.simplices << 0, 1, 2, 0, 2, 3, 0, 2, 4;
  const SoundMesh hangs = made(mesh);
  CHECK(hangs.flat.count == 1);
  CHECK(hangs.flat.first == 2);
  REQUIRE(hangs.flat_vertices.size() == 1);
  for (const double part : hangs.flat_vertices[0].parts) CHECK((part < 1e-6 || std::abs(part - 0.5) < 1e-6));
  mesh.positions(4, 2) = 1e-5;  // more than a millionth of the diagonal
  CHECK(made(mesh).flat.count == 0);
  mesh.positions(4, 2) = 1e-7;
  mesh.simplices.conservativeResize(4, 3);
  mesh.simplices.bottomRows(3) << 0, 2, 4, 0, 4, 3, 4, 2, 3;
  CHECK(made(mesh).flat.count == 0);
  mesh.positions.col(1) *= 1e-7;
  mesh.positions.col(2).setZero();
  mesh.simplices.conservativeResize(2, 3);
  mesh.simplices << 0, 1, 2, 0, 2, 3;
  CHECK(made(mesh, {false, true}).mesh.simplices == mesh.simplices);
}

TEST_CASE("strictly read, what would be left out is refused, and where nothing is left it always is") {
  SimplexMesh mesh{Matrix(5, 2), Simplices(3, 3)};
  mesh.positions << 0, 0, 1, 0, 1, 1, 0, 1, 0.5, 0;
  mesh.simplices << 0, 1, 2, 2, 1, 0, 0, 4, 1;
  const auto refused = [](const SimplexMesh& given, bool strict, std::int64_t index) {
    const auto result = sound_mesh(given, {true, strict});
    REQUIRE_FALSE(result);
    CHECK(result.error().code == HB_ERROR_MESH_DEGENERATE);
    CHECK(result.error().culprit == HB_CULPRIT_TRIANGLE);
    CHECK(result.error().index == index);
  };
  CHECK(made(mesh).mesh.simplices.rows() == 1);
  refused(mesh, true, 1);
  mesh.simplices.row(1) << 0, 2, 3;
  refused(mesh, true, 2);
  mesh.simplices << 0, 4, 1, 0, 0, 1, 1, 4, 0;
  refused(mesh, false, 0);
  mesh.simplices(2, 1) = 5;
  CHECK(sound_mesh(mesh, {}).error().code == HB_ERROR_MESH_INDEX_OUT_OF_RANGE);
}
