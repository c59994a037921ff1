#include "core/irbf/sphere_packing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace handlebody;

namespace {

struct Solid {
  VoxelDomain domain;
  std::vector<double> surface_distance;
};

/** The solid where `depth`, the distance to the surface, is positive. */
template <typename Depth>
Solid solid(const Vector3& low, const Vector3& high, int resolution, Depth depth) {
  const Grid grid = *make_grid(low, high, resolution);
  std::vector<std::uint32_t> voxels;
  std::vector<double> distances;
  for (std::int64_t c = 0; c < grid.size(); ++c) {
    const double d = depth(grid.center(c));
    if (d <= 0) continue;
    voxels.push_back(static_cast<std::uint32_t>(c));
    distances.push_back(d);
  }
  return {VoxelDomain(grid, voxels), distances};
}

double box_depth(const Vector3& p, const Vector3& low, const Vector3& high) {
  return (p - low).cwiseMin(high - p).minCoeff();
}

Solid bar(int resolution) {
  const Vector3 low(0, 0, 0), high(10, 2, 2);
  return solid(low, high, resolution, [=](const Vector3& p) { return box_depth(p, low, high); });
}

bool same(const std::vector<Sphere>& a, const std::vector<Sphere>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Sphere& s, const Sphere& t) { return s.center == t.center && s.radius == t.radius; });
}

}  // namespace

TEST_CASE("spheres keep to the overlap, the least size and the most number, and come largest first") {
  const Solid body = bar(50);
  for (const double max_overlap : {-.5, 0., .1, .5}) {
    SpherePackingOptions options;
    options.max_overlap = max_overlap;
    options.max_spheres = 60;
    const auto spheres = pack_spheres(body.domain, body.surface_distance, options);
    CHECK(spheres.size() <= 60);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const Sphere& s = spheres[i];
      CHECK(s.radius == doctest::Approx(.9 * box_depth(s.center, {0, 0, 0}, {10, 2, 2})));
      CHECK(s.radius >= .5 * body.domain.grid().spacing);
      if (i > 0) CHECK(s.radius <= spheres[i - 1].radius + 1e-6);
      for (std::size_t j = 0; j < i; ++j) {
        const double gap = s.radius + spheres[j].radius - max_overlap * std::min(s.radius, spheres[j].radius);
        CHECK((s.center - spheres[j].center).norm() >= gap - 1e-12);
      }
    }
  }
}

TEST_CASE("a bar of 10 x 2 x 2 gets at least five spheres along its axis, at any resolution") {
  for (const int resolution : {20, 37, 40, 50, 64, 96}) {
    const Solid body = bar(resolution);
    const auto spheres = pack_spheres(body.domain, body.surface_distance, {});
    const double h = body.domain.grid().spacing;
    const auto on_axis = std::count_if(spheres.begin(), spheres.end(), [&](const Sphere& s) {
      return std::abs(s.center[1] - 1) <= h && std::abs(s.center[2] - 1) <= h && s.radius > .9 * (1 - h);
    });
    CHECK_MESSAGE(on_axis >= 5, "resolution " << resolution);
  }
}

TEST_CASE("every part gets a sphere, even where there is no room for it") {
  // A ball and a row of specks.
  const Solid body = solid({-1, -1, -1}, {4, 1, 1}, 60, [](const Vector3& p) {
    double depth = 1 - p.norm();
    for (double x = 1.5; x < 4; x += .5) depth = std::max(depth, .1 - (p - Vector3(x, 0, 0)).norm());
    return depth;
  });
  const auto component = face_components(body.domain);
  const int parts = *std::max_element(component.begin(), component.end()) + 1;
  REQUIRE(parts == 6);
  for (const int max_spheres : {1, 6, 8, 100}) {
    SpherePackingOptions options;
    options.max_spheres = max_spheres;
    options.min_radius = 2;
    const auto spheres = pack_spheres(body.domain, body.surface_distance, options);
    CHECK(spheres.size() <= static_cast<std::size_t>(std::max(max_spheres, parts)));
    std::vector<bool> served(parts);
    for (const Sphere& s : spheres) served[component[body.domain.nearest(s.center)]] = true;
    CHECK(std::count(served.begin(), served.end(), true) == parts);
  }
}

TEST_CASE("packing is deterministic and blind to rounding of the distances") {
  const Solid body = bar(40);
  const auto spheres = pack_spheres(body.domain, body.surface_distance, {});
  CHECK(same(spheres, pack_spheres(body.domain, body.surface_distance, {})));
  auto noisy = body.surface_distance;
  for (std::size_t v = 0; v < noisy.size(); ++v) noisy[v] += static_cast<double>(v * 7919 % 13) * 1e-15;
  const auto again = pack_spheres(body.domain, noisy, {});
  REQUIRE(again.size() == spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) CHECK(again[i].center == spheres[i].center);
}

TEST_CASE("an empty domain has no spheres") {
  const Grid grid = *make_grid({0, 0, 0}, {1, 1, 1}, 4);
  CHECK(pack_spheres(VoxelDomain(grid, {}), {}, {}).empty());
}
