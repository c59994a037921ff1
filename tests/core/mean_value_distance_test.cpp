#include "core/distance/mean_value_distance.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cell_surface.hpp"
#include "core/distance/fast_marching.hpp"
#include "known_geodesics.hpp"
#include "made_domains.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

MeanValueDistance ready(const MadeMesh& mesh, const VoxelDomain& domain) {
  auto made = MeanValueDistance::begin(mesh.positions, mesh.triangles, domain);
  REQUIRE(made);
  for (double part = 0; part < 1;) {
    const double done = made->step();
    CHECK(done >= part);
    part = done;
  }
  return std::move(*made);
}

std::int32_t voxel_at(const VoxelDomain& domain, const Vector3& p) {
  return domain.nearest(p);
}

/** A block that a slit, thinner than any voxel, cuts from x = 1 to near x = 0: two shells that a hinge joins, closed. */
MadeMesh clam(double gap) {
  return cell_surface({evenly(1, 20), evenly(.5, 10), {0, .1, .2 - gap / 2, .2 + gap / 2, .3, .4}},
                      [](int i, int, int k) { return k != 2 || i < 2; });
}

VoxelDomain block(int resolution) {
  const Grid grid = *make_grid({0, 0, 0}, {1, .5, .4}, resolution);
  return domain_where(grid, [](const Vector3& p) { return p.minCoeff() > 0 && p[0] < 1 && p[1] < .5 && p[2] < .4; });
}

Error failure(const Points& positions, const Triangles& triangles, const VoxelDomain& domain) {
  const auto made = MeanValueDistance::begin(positions, triangles, domain);
  REQUIRE(!made);
  return made.error();
}

}  // namespace

TEST_CASE("between points of the surface it is the distance along the surface, within 5% in the mean") {
  const MadeMesh sphere = octahedral_sphere(16);
  const VoxelDomain domain = domain_where(cube_grid(24), [](const Vector3& p) { return p.norm() < 1; });
  MeanValueDistance mean_value = ready(sphere, domain);
  std::vector<double> d(domain.size());
  const Vector3 source = sphere.positions.row(17);
  mean_value.measure(source, d.data());
  double mean = 0, count = 0;
  for (Index v = 0; v < domain.size(); ++v) {
    const Vector3 p = domain.center(v);
    if (p.norm() < .96 || (p - source).norm() < .5) continue;
    const double great_circle = std::acos(std::clamp(source.dot(p.normalized()), -1., 1.));
    mean += std::abs(d[v] / great_circle - 1), ++count;
  }
  mean /= count;
  MESSAGE("mean " << 100 * mean << "% over " << count << " voxels");
  REQUIRE(count > 200);
  CHECK(mean < .05);
}

TEST_CASE("a clam's closed lips stay apart, on a grid that cannot see the slit") {
  const VoxelDomain domain = block(40);
  MeanValueDistance mean_value = ready(clam(1e-4), domain);
  FastMarching marching(domain);
  std::vector<double> d(domain.size()), marched(d.size());
  for (const double x : {.5, .7, .95}) {
    const Vector3 lip(x, .25, .2 + .5e-4);  // on the upper one
    mean_value.measure(lip, d.data());
    marching.march(lip, marched.data());
    // Round the hinge at x = 0.1, from lip to lip, and to the lower shell's far side.
    for (const double below : {.19, .15, .11}) {
      const std::int32_t across = voxel_at(domain, {x, .25, below}), own = voxel_at(domain, {x, .25, .4 - below});
      MESSAGE("x " << x << ", " << below << ": across " << d[across] << ", own " << d[own] << ", through voxels "
                   << marched[across]);
      CHECK(d[across] > .7 * 2 * (x - .1));
      CHECK(d[across] < 1.3 * (2 * (x - .1) + .3));
      CHECK(d[across] > 2 * d[own]);
      CHECK(marched[across] < .15);
    }
  }
}

TEST_CASE("it is symmetric, never below Euclidean, and twice the same bits") {
  const VoxelDomain domain = extruded(24, inside_l);
  const MadeMesh mesh =
      cell_surface({evenly(1, 16), evenly(1, 16), evenly(8. / 24, 5)}, [](int i, int j, int) { return i < 7 || j < 7; });
  MeanValueDistance mean_value = ready(mesh, domain), again = ready(mesh, domain);
  std::vector<double> from_a(domain.size()), from_b(from_a.size()), repeated(from_a.size());
  const Index n = domain.size();
  for (const auto& [a, b] : {std::pair(n - 1, n / 9), std::pair(n / 20, n / 2)}) {
    mean_value.measure(domain.center(a), from_a.data());
    mean_value.measure(domain.center(b), from_b.data());
    CHECK(from_a[b] == doctest::Approx(from_b[a]));
    for (Index v = 0; v < n; ++v) {
      CHECK(from_a[v] >= (domain.center(v) - domain.center(a)).norm());
      CHECK(std::isfinite(from_a[v]));
    }
    again.measure(domain.center(a), repeated.data());
    CHECK(repeated == from_a);
  }
}

TEST_CASE("split vertices, triangles without area and a surface turned inside out make no difference") {
  const VoxelDomain domain = extruded(16, inside_box);
  const MadeMesh mesh = cell_surface({evenly(1, 8), evenly(1, 8), evenly(.5, 4)}, [](int, int, int) { return true; });
  // Every triangle with corners of its own, a needle, a vertex that nothing uses, and the other side out.
  MadeMesh split;
  const Index m = mesh.triangles.rows();
  split.positions.resize(3 * m + 1, 3);
  split.triangles.resize(m + 1, 3);
  for (Index t = 0; t < m; ++t) {
    for (int k = 0; k < 3; ++k) split.positions.row(3 * t + k) = mesh.positions.row(mesh.triangles(t, k));
    split.triangles.row(t) << static_cast<std::uint32_t>(3 * t), static_cast<std::uint32_t>(3 * t + 2),
        static_cast<std::uint32_t>(3 * t + 1);
  }
  split.positions.row(3 * m) = Vector3(.5, .5, .2);
  split.triangles.row(m) << 0, 1, 1;
  MeanValueDistance plain = ready(mesh, domain), other = ready(split, domain);
  std::vector<double> a(domain.size()), b(a.size());
  for (const Vector3& source : {Vector3(0, .3, .1), Vector3(.8, .9, .5)}) {
    plain.measure(source, a.data());
    other.measure(source, b.data());
    // Landmarks may be others where vertices are equally far.
    for (std::size_t v = 0; v < a.size(); ++v) CHECK(b[v] == doctest::Approx(a[v]).epsilon(.1));
  }
}

TEST_CASE("open surfaces, several parts and too much memory are named") {
  const VoxelDomain domain = extruded(16, inside_box);
  const MadeMesh box = cell_surface({evenly(1, 4), evenly(1, 4), evenly(.5, 2)}, [](int, int, int) { return true; });
  const Triangles open = box.triangles.topRows(box.triangles.rows() - 1);
  const Error hole = failure(box.positions, open, domain);
  CHECK(hole.code == HB_ERROR_MESH_OPEN);
  CHECK(hole.culprit == HB_CULPRIT_TRIANGLE);
  CHECK(hole.index >= 0);
  CHECK(hole.index < open.rows());

  Triangles turned = box.triangles;
  std::swap(turned(5, 0), turned(5, 1));
  CHECK(failure(box.positions, turned, domain).code == HB_ERROR_MESH_OPEN);

  const MadeMesh two = cell_surface({evenly(1, 5), evenly(1, 4), evenly(.5, 2)}, [](int i, int, int) { return i != 2; });
  const Error parts = failure(two.positions, two.triangles, domain);
  CHECK(parts.code == HB_ERROR_MESH_NOT_CONNECTED);
  CHECK(parts.culprit == HB_CULPRIT_TRIANGLE);
  CHECK(parts.message.find("triangle") != std::string::npos);

  Triangles needles(2, 3);
  needles << 0, 0, 1, 2, 3, 3;
  CHECK(failure(box.positions, needles, domain).code == HB_ERROR_MESH_NO_TRIANGLES);

  const Points many = Points::Zero(3'500'000, 3);
  CHECK(failure(many, box.triangles, domain).code == HB_ERROR_OUT_OF_MEMORY);
}
