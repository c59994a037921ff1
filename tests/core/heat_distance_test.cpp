#include "core/distance/heat_distance.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "known_geodesics.hpp"
#include "oracle_lines.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

HeatDistance ready(const VoxelDomain& domain) {
  HeatDistance heat(domain);
  for (double part = 0; part < 1;) {
    const auto done = heat.step();
    REQUIRE(done);
    CHECK(*done > part);
    part = *done;
  }
  return heat;
}

}  // namespace

TEST_CASE("heat in a box, around the corner of an L and around a ring") {
  const auto measured = [](const KnownShape& shape, int resolution) {
    const VoxelDomain domain = shape.domain(resolution);
    HeatDistance heat = ready(domain);
    return accuracy(shape, domain, [&](const Vector3& source, double* d) { heat.measure(source, d); });
  };
  const double mean[3] = {.001, .002, .018}, largest[3] = {.03, .06, .11};
  const std::vector<KnownShape> shapes = known_shapes();
  Accuracy a;
  for (std::size_t s = 0; s < 3; ++s) {
    a = measured(shapes[s], 64);
    MESSAGE(shapes[s].name << ": mean " << 100 * a.mean << "%, bias " << 100 * a.bias << "%, largest " << 100 * a.largest << "%");
    CHECK(a.mean <= mean[s]);
    CHECK(a.largest <= largest[s]);
  }
  const Accuracy fine = measured(shapes[2], 128);
  MESSAGE("ring at 128: mean " << 100 * fine.mean << "%, largest " << 100 * fine.largest << "%");
  CHECK(a.mean / fine.mean >= 1.6);
}

TEST_CASE("heat: near the source distances are Euclidean, elsewhere not below, and a source outside belongs to the nearest voxel") {
  const VoxelDomain domain = extruded(32, inside_l);
  const double h = domain.grid().spacing;
  HeatDistance heat = ready(domain);
  std::vector<double> d(domain.size());
  for (const Vector3& source : {domain.center(100), Vector3(.2, .3, 2 * h), Vector3(.3, -.6 * h, h), Vector3(-5 * h, .3, h)}) {
    heat.measure(source, d.data());
    for (Index v = 0; v < domain.size(); ++v) {
      const double straight = (domain.center(v) - source).norm();
      if (straight < 3 * h) CHECK(d[v] == doctest::Approx(straight));
      CHECK(std::isfinite(d[v]));
      CHECK(d[v] >= straight);
    }
  }
}

TEST_CASE("heat: a wall keeps the ball on its own side, and what is not connected is infinitely far") {
  const VoxelDomain domain = extruded(32, [](const Vector2& p) { return p[0] < .5 || p[0] > .54; });
  HeatDistance heat = ready(domain);
  std::vector<double> d(domain.size());
  for (int round = 0; round < 2; ++round) {  // the state is reused
    heat.measure({round ? .52 : .48, .5, .1}, d.data());
    const bool left = domain.center(domain.nearest({round ? .52 : .48, .5, .1}))[0] < .5;
    for (Index v = 0; v < domain.size(); ++v) CHECK(std::isinf(d[v]) == ((domain.center(v)[0] < .5) != left));
  }
}

TEST_CASE("heat: measuring twice gives the same bits, and an empty domain gives nothing") {
  const VoxelDomain domain = extruded(24, inside_l);
  HeatDistance heat = ready(domain);
  std::vector<double> first(domain.size()), second(domain.size());
  heat.measure({.1, .2, .05}, first.data());
  heat.measure({.9, .1, .1}, second.data());
  heat.measure({.1, .2, .05}, second.data());
  CHECK(first == second);
  const VoxelDomain empty(domain.grid(), {});
  ready(empty).measure({0, 0, 0}, nullptr);
}

TEST_CASE("heat: the distance from a to b is that from b to a within 3%") {
  const VoxelDomain domain = extruded(48, inside_l);
  HeatDistance heat = ready(domain);
  std::vector<double> from_a(domain.size()), from_b(domain.size());
  const Index n = domain.size();
  for (const auto& [a, b] :
       {std::pair(n - 1, n / 9), std::pair(n - 7, n / 5), std::pair(n / 20, n / 2), std::pair(n / 40, n - 20)}) {
    heat.measure(domain.center(a), from_a.data());
    heat.measure(domain.center(b), from_b.data());
    CHECK(from_a[b] == doctest::Approx(from_b[a]).epsilon(.03));
  }
}

TEST_CASE("heat reaches the end of a corridor that is one voxel wide and 3000 long, where a double would be cold at 250") {
  // Back and forth in 30 rows of 100, two apart.
  const Grid grid{Vector3::Zero(), 1, {100, 60, 1}};
  std::vector<std::uint32_t> voxels;
  for (int j = 0; j < 59; ++j) {
    for (int i = 0; i < 100; ++i) {
      if (j % 2 == 0 || i == (j % 4 == 1 ? 99 : 0)) voxels.push_back(static_cast<std::uint32_t>(grid.linear(i, j, 0)));
    }
  }
  const VoxelDomain domain(grid, voxels);
  HeatDistance heat = ready(domain);
  std::vector<double> d(domain.size());
  heat.measure({0, 0, 0}, d.data());
  for (int j = 0; j < 59; j += 2) {
    for (int i = 0; i < 100; i += 9) {
      // The way through the voxel centers takes each turn by two right angles; the shortest way cuts them.
      const double steps = (j / 2) * 101. + (j % 4 == 0 ? i : 99 - i);
      const double measured = d[domain.number(i, j, 0)];
      CHECK(measured <= steps * 1.001 + 1e-9);
      CHECK(measured >= .97 * steps - 1e-9);
    }
  }
}

TEST_CASE("heat refuses a domain whose factors would not fit, before it allocates them") {
  const Grid grid = *make_grid({0, 0, 0}, {1, 1, 1}, 60);
  std::vector<std::uint32_t> voxels(grid.size());
  for (std::size_t v = 0; v < voxels.size(); ++v) voxels[v] = static_cast<std::uint32_t>(v);
  const VoxelDomain domain(grid, std::move(voxels));
  HeatDistance heat(domain);
  REQUIRE(heat.step());
  const auto done = heat.step();
  REQUIRE(!done);
  CHECK(done.error().code == HB_ERROR_OUT_OF_MEMORY);
  CHECK(done.error().remedy.find("resolution") != std::string::npos);
}

TEST_CASE("heat is what SciPy makes of the same equations, and near scikit-fmm's fast marching") {
  for (const std::string& line : oracle_lines("heat_distance.json")) {
    const std::vector<double> size = oracle_numbers(line, "size"), s = oracle_numbers(line, "source"),
                              expected = oracle_numbers(line, "heat"), marched = oracle_numbers(line, "marched");
    const double corner = oracle_numbers(line, "bend")[0];
    const Grid grid{Vector3::Zero(), 1, {static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])}};
    std::vector<std::uint32_t> voxels;
    for (std::int64_t c = 0; c < grid.size(); ++c) {
      const auto [i, j, k] = grid.cell(c);
      if (i < corner || j < corner) voxels.push_back(static_cast<std::uint32_t>(c));
    }
    const VoxelDomain domain(grid, voxels);
    HeatDistance heat = ready(domain);
    std::vector<double> d(voxels.size());
    heat.measure({s[0], s[1], s[2]}, d.data());
    REQUIRE(expected.size() == d.size());
    double difference = 0, fast = 0, count = 0;
    for (std::size_t v = 0; v < d.size(); ++v) {
      difference = std::max(difference, std::abs(d[v] - expected[v]));
      if (marched[v] < 0) continue;
      fast += std::abs(d[v] - marched[v]), ++count;
    }
    MESSAGE("largest difference from SciPy " << difference << ", mean from scikit-fmm " << fast / count << " spacings");
    CHECK(difference < 1e-8);  // the file has nine digits
    CHECK(count > 800);
    CHECK(fast / count < .5);  // whose own start is off by up to 0.45
  }
}
