#include "core/distance/interior_samples.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/distance/fast_marching.hpp"
#include "made_domains.hpp"

using namespace handlebody;
using test::cube_grid;
using test::domain_where;
using test::random_direction;

namespace {

/** The distances of some points from `center`, read from its field. */
std::vector<double> read(const VoxelDomain& domain, const std::vector<double>& field, const Vector3& center,
                         const std::vector<Vector3>& points) {
  InteriorSamples samples;
  for (const Vector3& point : points) samples.add(domain, point);
  std::vector<double> ratios, distances;
  samples.distance_ratios(
      center, [&](std::uint32_t v) { return field[v]; }, ratios);
  for (Index i = 0; i < samples.size(); ++i) distances.push_back(samples.distance(ratios, center, i));
  return distances;
}

}  // namespace

TEST_CASE("in a convex domain the cone at the center is exact wherever the field is (seed 10)") {
  const VoxelDomain domain = domain_where(cube_grid(20), [](const Vector3& p) { return p.norm() < 1; });
  std::mt19937 random(10);
  for (const Vector3& center : {Vector3(.03, -.02, .01), Vector3(0, .6, .8), domain.center(domain.size() / 2)}) {
    std::vector<double> field;
    for (Index v = 0; v < domain.size(); ++v) field.push_back((domain.center(v) - center).norm());
    std::vector<Vector3> points;
    for (int n = 0; n < 200; ++n) points.push_back(center * .999 + .1 * n / 200. * random_direction(random));
    const std::vector<double> distances = read(domain, field, center, points);
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(distances[i] == doctest::Approx((points[i] - center).norm()));
  }
}

TEST_CASE("a marched field read next to its center is exact, and nowhere below the Euclidean distance (seed 11)") {
  const VoxelDomain domain = domain_where(cube_grid(24), [](const Vector3& p) { return std::abs(p[0]) > .3 || p[2] > .3; });
  const Vector3 center(-.6, .1, -1);
  std::vector<double> field(domain.size());
  FastMarching(domain).march(center, field.data());
  const double h = domain.grid().spacing;
  std::mt19937 random(11);
  std::vector<Vector3> near, far;
  for (int n = 0; n < 300; ++n) {
    near.push_back(center + h * random_direction(random));
    far.push_back(center + 2 * random_direction(random));
  }
  for (const double distance : read(domain, field, center, near)) CHECK(distance == doctest::Approx(h));
  const std::vector<double> distances = read(domain, field, center, far);
  for (std::size_t i = 0; i < far.size(); ++i) CHECK(distances[i] >= (far[i] - center).norm());
}
