#include "core/distance/stencil.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "made_domains.hpp"

using namespace handlebody;
using test::cube_grid;
using test::domain_where;
using test::random_direction;

namespace {

template <typename Function>
double read(const VoxelDomain& domain, const Stencil& stencil, Function function) {
  double sum = 0;
  for (std::size_t i = 0; i < stencil.voxels.size(); ++i) sum += stencil.weights[i] * function(domain.center(stencil.voxels[i]));
  return sum;
}

double linear(const Vector3& p) {
  return 2 + Vector3(.3, -1, .7).dot(p);
}

/** Checks weights and linear reproduction; returns Σ|w|. */
double check_linear(const VoxelDomain& domain, const Vector3& p) {
  const Stencil stencil = make_stencil(domain, p);
  REQUIRE(stencil.voxels.size() == stencil.weights.size());
  double sum = 0, magnitude = 0;
  for (const double w : stencil.weights) sum += w, magnitude += std::abs(w);
  CHECK(sum == doctest::Approx(1).epsilon(1e-11));
  CHECK(read(domain, stencil, linear) == doctest::Approx(linear(p)).epsilon(1e-10));
  return magnitude;
}

}  // namespace

TEST_CASE("deep inside, the stencil is trilinear") {
  const VoxelDomain domain = domain_where(cube_grid(20), [](const Vector3& p) { return p.norm() < 1; });
  const Stencil stencil = make_stencil(domain, {.113, -.221, .04});
  CHECK(stencil.voxels.size() == 8);
  const auto trilinear = [](const Vector3& p) { return (1 + p[0]) * (2 - p[1]) * (3 + p[2]); };
  CHECK(read(domain, stencil, trilinear) == doctest::Approx(trilinear({.113, -.221, .04})));
}

TEST_CASE("linear functions are reproduced in a ball and on its surface, with bounded weights (seed 5)") {
  const VoxelDomain domain = domain_where(cube_grid(20), [](const Vector3& p) { return p.norm() < 1; });
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  double largest = 0;
  for (int n = 0; n < 1000; ++n) {
    largest = std::max(largest, check_linear(domain, std::cbrt(uniform(random)) * random_direction(random)));
    largest = std::max(largest, check_linear(domain, random_direction(random)));
  }
  CHECK(largest <= 3 + 1e-9);
}

TEST_CASE("linear functions are reproduced on the faces and edges of a box (seed 6)") {
  const VoxelDomain domain = domain_where(cube_grid(20), [](const Vector3& p) { return p.cwiseAbs().maxCoeff() < .88; });
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(-.8, .8);
  for (int n = 0; n < 500; ++n) {
    Vector3 p(uniform(random), uniform(random), uniform(random));
    p[n % 3] = n % 2 ? .88 : -.88;
    check_linear(domain, p);
    p[(n + 1) % 3] = .88;
    check_linear(domain, p);
  }
}

TEST_CASE("every point has a stencil that sums to 1 with bounded weights, however thin the part and far the point (seed 7)") {
  std::mt19937 random(7);
  for (const double radius : {.04, .06, .1}) {  // a rod of 1, 4 or 12 voxels' section
    const VoxelDomain domain = domain_where(cube_grid(21), [&](const Vector3& p) { return std::hypot(p[1], p[2]) < radius; });
    REQUIRE(domain.size() > 0);
    for (int n = 0; n < 500; ++n) {
      const Vector3 p = (n % 2 ? .12 : 2.) * random_direction(random);
      const Stencil stencil = make_stencil(domain, p);
      REQUIRE(!stencil.voxels.empty());
      double sum = 0, magnitude = 0;
      for (const double w : stencil.weights) sum += w, magnitude += std::abs(w);
      CHECK(sum == doctest::Approx(1).epsilon(1e-11));
      CHECK(magnitude <= 3 + 1e-9);
    }
  }
  CHECK(make_stencil(VoxelDomain(cube_grid(8), {}), {0, 0, 0}).voxels.empty());
}

TEST_CASE("parallel slabs one or two voxels apart never read each other (seed 8)") {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-.9, .9);
  const Grid grid = cube_grid(24);
  const double h = grid.spacing;
  for (const int gap : {1, 2}) {
    // Voxel centers lie at odd multiples of h/2; the slabs' faces reach nearly to the middle of the gap.
    const double top = -.5 * h, bottom = top + (gap + 1) * h;
    const VoxelDomain domain = domain_where(grid, [&](const Vector3& p) { return p[2] < top + .1 * h || p[2] > bottom - .1 * h; });
    for (int n = 0; n < 1000; ++n) {
      const bool below = n % 2;
      const double face = below ? top + .45 * (gap + 1) * h : bottom - .45 * (gap + 1) * h;
      const Vector3 p(uniform(random), uniform(random), face);
      for (const std::int32_t v : make_stencil(domain, p).voxels) CHECK((domain.center(v)[2] < 0) == below);
    }
  }
}

TEST_CASE("a stencil's reading is continuous along a path on the surface (seed 9)") {
  const VoxelDomain domain = domain_where(cube_grid(34), [](const Vector3& p) { return p.norm() < 1; });
  const double h = domain.grid().spacing;
  std::mt19937 random(9);
  const auto curved = [](const Vector3& p) { return (p - Vector3(.1, .2, .3)).squaredNorm(); };
  double jump = 0, error = 0;
  for (int path = 0; path < 50; ++path) {
    const Vector3 a = random_direction(random), b = a.unitOrthogonal();
    double before = 0;
    for (int step = 0; step < 400; ++step) {
      const double angle = .01 * h * step;
      const Vector3 p = std::cos(angle) * a + std::sin(angle) * b;
      const double now = read(domain, make_stencil(domain, p), curved) - curved(p);
      if (step > 0) jump = std::max(jump, std::abs(now - before));
      error = std::max(error, std::abs(now));
      before = now;
    }
  }
  MESSAGE("largest jump over 0.01 h: " << jump / (h * h) << " h², largest error " << error / (h * h) << " h²");
  CHECK(jump < .05 * h * h);  // the error of a linear fit is of order h²; a jump is a small part of it
  CHECK(error < 3 * h * h);
}
