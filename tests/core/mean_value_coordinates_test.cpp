#include "core/mesh/mean_value_coordinates.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "cell_surface.hpp"
#include "oracle_lines.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

MadeMesh l_surface() {
  return cell_surface({evenly(1, 6), evenly(1, 6), evenly(.5, 3)}, [](int i, int j, int) { return i < 2 || j < 2; });
}

Vector3 place(const MadeMesh& mesh, const Vector& weights) {
  return mesh.positions.transpose() * weights;
}

}  // namespace

TEST_CASE("mean value coordinates agree with Ju et al.'s formulas and with quadrature") {
  for (const std::string& line : oracle_lines("mean_value.json")) {
    const std::vector<double> p = oracle_numbers(line, "positions"), t = oracle_numbers(line, "triangles"),
                              x = oracle_numbers(line, "point");
    const Points positions = Eigen::Map<const Points>(p.data(), static_cast<Index>(p.size() / 3), 3);
    Triangles triangles(static_cast<Index>(t.size() / 3), 3);
    for (std::size_t k = 0; k < t.size(); ++k) triangles.data()[k] = static_cast<std::uint32_t>(t[k]);
    for (const bool one_side : {false, true}) {
      const std::vector<double> expected = oracle_numbers(line, one_side ? "one_side" : "weights");
      const Vector w = mean_value_coordinates(positions, triangles, {x[0], x[1], x[2]}, one_side);
      REQUIRE(std::ssize(expected) == w.size());
      for (Index v = 0; v < w.size(); ++v) CHECK(w[v] == doctest::Approx(expected[v]).epsilon(1e-8));
    }
  }
}

TEST_CASE("they sum to 1 and reproduce linear functions inside an L; one-sided ones are never negative (seed 31)") {
  const MadeMesh mesh = l_surface();
  std::mt19937 random(31);
  std::uniform_real_distribution<double> uniform(0, 1);
  double least = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3 p(uniform(random), uniform(random), .5 * uniform(random));
    if (p[0] > 1 / 3. && p[1] > 1 / 3.) continue;
    const Vector w = mean_value_coordinates(mesh.positions, mesh.triangles, p, false);
    CHECK(w.sum() == doctest::Approx(1));
    CHECK((place(mesh, w) - p).norm() < 1e-9);
    least = std::min(least, w.minCoeff());
    const Vector v = mean_value_coordinates(mesh.positions, mesh.triangles, p, true);
    CHECK(v.sum() == doctest::Approx(1));
    CHECK(v.minCoeff() >= 0);
    CHECK((place(mesh, v) - p).norm() < .05);  // what is lost to the sign
  }
  CHECK(least < 0);
}

TEST_CASE("one-sided coordinates are the same on a convex mesh") {
  const MadeMesh sphere = octahedral_sphere(5);
  for (const Vector3& p : {Vector3(0, 0, 0), Vector3(.3, -.2, .6), Vector3(.1, .1, -.8)}) {
    const Vector w = mean_value_coordinates(sphere.positions, sphere.triangles, p, false);
    CHECK((w - mean_value_coordinates(sphere.positions, sphere.triangles, p, true)).norm() < 1e-12);
    CHECK(w.minCoeff() >= 0);
  }
}

TEST_CASE("between surfaces that nearly touch plain coordinates cancel, one-sided ones do not (seed 13)") {
  // Two shells, a slit of 1/1000 between them, and a hinge.
  const MadeMesh clam = cell_surface({evenly(1, 10), evenly(.5, 5), {0, .1, .1995, .2005, .3, .4}},
                                     [](int i, int, int k) { return k != 2 || i < 1; });
  std::mt19937 random(13);
  std::uniform_real_distribution<double> uniform(0, 1);
  double plain = 0;
  for (int i = 0; i < 100; ++i) {
    const Vector3 p(.2 + .8 * uniform(random), .5 * uniform(random), .2005 + .1 * uniform(random));
    plain = std::max(plain, mean_value_coordinates(clam.positions, clam.triangles, p, false).cwiseAbs().sum());
    const Vector w = mean_value_coordinates(clam.positions, clam.triangles, p, true);
    CHECK(w.minCoeff() >= 0);
    double own = 0;  // the upper shell's
    for (Index v = 0; v < w.size(); ++v) own += clam.positions(v, 2) > .2 || clam.positions(v, 0) < .15 ? w[v] : 0;
    CHECK(own > .75);
  }
  MESSAGE("magnitudes of plain coordinates sum to " << plain);
  CHECK(plain > 3);
}

TEST_CASE("on a corner, an edge and a triangle they are those of the triangle, and near them nearly so") {
  const MadeMesh mesh = l_surface();
  const Vector3 a = mesh.positions.row(mesh.triangles(7, 0)), b = mesh.positions.row(mesh.triangles(7, 1)),
                c = mesh.positions.row(mesh.triangles(7, 2));
  const Vector3 inward = -(b - a).cross(c - a).normalized();
  for (const Vector3& weights : {Vector3(1, 0, 0), Vector3(.25, .75, 0), Vector3(0, .5, .5), Vector3(.2, .3, .5)}) {
    const Vector3 p = weights[0] * a + weights[1] * b + weights[2] * c;
    for (const double depth : {0., 1e-14, 1e-9, 1e-5}) {
      for (const bool one_side : {false, true}) {
        const Vector w = mean_value_coordinates(mesh.positions, mesh.triangles, p + depth * inward, one_side);
        CHECK(w.allFinite());
        Vector expected = Vector::Zero(w.size());
        for (int k = 0; k < 3; ++k) expected[mesh.triangles(7, k)] = weights[k];
        CHECK((w - expected).cwiseAbs().maxCoeff() < 1e-6 + 50 * depth);
      }
    }
  }
}

TEST_CASE("in the plane of triangles, beside them, a point sees none of them, and near that plane hardly") {
  const MadeMesh mesh = l_surface();
  // The reentrant corner's two walls lie in the planes x = 1/3 and y = 1/3, which run on through the arms.
  const Vector3 on(1 / 3., .2, .21);
  const Vector w = mean_value_coordinates(mesh.positions, mesh.triangles, on, false);
  CHECK((place(mesh, w) - on).norm() < 1e-9);
  for (const double beside : {1e-13, 1e-11, 1e-8, -1e-13, -1e-10}) {
    const Vector near = mean_value_coordinates(mesh.positions, mesh.triangles, on + Vector3(beside, 0, 0), false);
    CHECK((near - w).norm() < 1e-6);
  }
}

TEST_CASE("a field carries functions inside as the coordinates do, and takes them over at vertices (seed 8)") {
  const MadeMesh ring = ring_surface(.125, 96, 8, 5);
  const Index n = ring.positions.rows();
  MatrixF values(n, 5);
  for (Index v = 0; v < n; ++v) {
    const Vector3 p = ring.positions.row(v);
    values.row(v) << 1, static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(std::sin(9 * p[0] + 20 * p[2])),
        static_cast<float>(std::cos(7 * p[1]));
  }
  MeanValueField field(ring.positions, ring.triangles, values);
  REQUIRE(field.columns() == 5);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<float> carried(5);
  double mean = 0, largest = 0, count = 0;
  for (int i = 0; i < 300; ++i) {
    const double angle = 6.28 * uniform(random), r = .3 + .2 * uniform(random);
    const Vector3 p(.5 + r * std::cos(angle), .5 + r * std::sin(angle), .125 * uniform(random));
    const Vector w = mean_value_coordinates(ring.positions, ring.triangles, p, true);
    field.evaluate(p, carried.data());
    CHECK(carried[0] == doctest::Approx(1).epsilon(1e-4));
    for (int f = 0; f < 5; ++f) {
      const double difference = std::abs(carried[f] - values.col(f).cast<double>().dot(w));
      mean += difference, ++count;
      largest = std::max(largest, difference);
    }
  }
  mean /= count;
  MESSAGE("mean difference " << mean << ", largest " << largest << " of values from -1 to 1");
  CHECK(mean < .002);
  CHECK(largest < .03);
  for (const Index v : {Index{0}, n / 2, n - 1}) {
    field.evaluate(ring.positions.row(v), carried.data());
    for (int f = 0; f < 5; ++f) CHECK(carried[f] == doctest::Approx(values(v, f)));
  }
  // From afar the ring as a whole shows neither side.
  for (const double away : {3., 30., 1e3, 1e9, 1e15}) {
    field.evaluate(away * Vector3(.6, -.64, .48), carried.data());
    CAPTURE(away);
    for (int f = 0; f < 5; ++f) {
      CHECK(carried[f] >= values.col(f).minCoeff());
      CHECK(carried[f] <= values.col(f).maxCoeff());
    }
  }
}
