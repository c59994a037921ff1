#include "core/irbf/sphere_tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "made_domains.hpp"

using namespace handlebody;
using test::domain_where;

namespace {

/** The depth of each voxel of the solid where `depth` is positive. */
template <typename Depth>
std::vector<double> depths(const VoxelDomain& domain, Depth depth) {
  std::vector<double> values;
  for (Index v = 0; v < domain.size(); ++v) values.push_back(depth(domain.center(v)));
  return values;
}

template <typename Depth>
void check_tree(const Grid& grid, Depth depth) {
  const VoxelDomain domain = domain_where(grid, [&](const Vector3& p) { return depth(p) > 0; });
  const std::vector<double> surface_distance = depths(domain, depth);
  const auto component = face_components(domain);
  const int parts = *std::max_element(component.begin(), component.end()) + 1;
  std::size_t last = 0;
  for (const int most : {1, 10, 40, 120}) {
    CAPTURE(most);
    SpherePackingOptions options;
    options.max_spheres = most;
    const auto spheres = sphere_tree(domain, surface_distance, options);
    CHECK(spheres.size() <= static_cast<std::size_t>(std::max(most, parts)));
    CHECK(spheres.size() >= last);
    last = spheres.size();
    std::vector<bool> served(parts);
    for (std::size_t s = 0; s < spheres.size(); ++s) {
      served[component[domain.nearest(spheres[s].center)]] = true;
      CHECK(spheres[s].radius == doctest::Approx(options.shrink * depth(spheres[s].center)));
      if (s > 0) CHECK(spheres[s].radius <= spheres[s - 1].radius + 1e-6);
      for (std::size_t t = 0; t < s; ++t) {
        CHECK((spheres[s].center - spheres[t].center).norm() >= spheres[s].radius + spheres[t].radius - 1e-9);
      }
    }
    CHECK(std::count(served.begin(), served.end(), true) == parts);
  }
}

double box_depth(const Vector3& p, const Vector3& low, const Vector3& high) {
  return (p - low).cwiseMin(high - p).minCoeff();
}

}  // namespace

TEST_CASE("an octree's spheres are inside, apart, largest first, no more than wanted, and every part has one") {
  check_tree(*make_grid({0, 0, 0}, {10, 2, 2}, 50), [](const Vector3& p) { return box_depth(p, {0, 0, 0}, {10, 2, 2}); });
  // A clam: two shells joined by a hinge; and three specks beside it.
  check_tree(*make_grid({-2, -1, -1}, {1, 1, 1}, 60), [](const Vector3& p) {
    const double ball = 1 - p.norm(), mouth = std::abs(p[1]) - .08;
    double depth = std::min(ball, std::max(mouth, -.6 - p[0]));
    for (const double z : {-.8, 0., .8}) depth = std::max(depth, .12 - (p - Vector3(-1.6, .3, z)).norm());
    return depth;
  });
}

TEST_CASE("a slab gets spheres spread over it, where a skeleton's are few") {
  const Grid grid = *make_grid({0, 0, 0}, {10, 10, 1}, 60);
  const auto depth = [](const Vector3& p) { return box_depth(p, {0, 0, 0}, {10, 10, 1}); };
  const VoxelDomain domain = domain_where(grid, [&](const Vector3& p) { return depth(p) > 0; });
  SpherePackingOptions options;
  options.max_spheres = 100;
  const auto spheres = sphere_tree(domain, depths(domain, depth), options);
  CHECK(spheres.size() > 30);
  double farthest = 0;
  for (Index v = 0; v < domain.size(); ++v) {
    double nearest = 100;
    for (const Sphere& s : spheres) nearest = std::min(nearest, (s.center - domain.center(v)).norm());
    farthest = std::max(farthest, nearest);
  }
  CHECK(farthest < 2.5);
}

TEST_CASE("an empty domain has no spheres, from an octree or spread") {
  const Grid grid = *make_grid({0, 0, 0}, {1, 1, 1}, 4);
  CHECK(sphere_tree(VoxelDomain(grid, {}), {}, {}).empty());
  CHECK(spread_spheres(VoxelDomain(grid, {}), 5).empty());
}

TEST_CASE(
    "a level of the octree is taken as it is: one sphere at first, more at every level, the finest where there is none deeper") {
  const Grid grid = *make_grid({0, 0, 0}, {10, 2, 2}, 40);
  const auto depth = [](const Vector3& p) { return box_depth(p, {0, 0, 0}, {10, 2, 2}); };
  const VoxelDomain domain = domain_where(grid, [&](const Vector3& p) { return depth(p) > 0; });
  const std::vector<double> surface_distance = depths(domain, depth);
  SpherePackingOptions options;
  options.max_spheres = 2000;
  std::size_t last = 0;
  for (int level = 1; level <= 6; ++level) {
    const auto spheres = sphere_tree(domain, surface_distance, options, level);
    CAPTURE(level);
    if (level == 1) CHECK(spheres.size() == 1);
    CHECK(spheres.size() >= last);
    if (level == 4) CHECK(spheres.size() > 4);
    last = spheres.size();
  }
  CHECK(sphere_tree(domain, surface_distance, options, 9).size() == last);
  options.max_spheres = 3;
  const auto few = sphere_tree(domain, surface_distance, options, 6);
  CHECK(few.size() == 3);
}
