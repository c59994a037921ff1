// Farthest point sampling in a box, where interior distances are Euclidean ones, against brute force.
#include "core/irbf/center_sampling.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "made_meshes.hpp"

using namespace handlebody;
using test::made_box;
using test::MadeMesh;

namespace {

struct SampledBox {
  MadeMesh mesh = made_box({1, 0.6, 0.4}, {10, 6, 4});
  VoxelDomain domain;
  std::unique_ptr<InteriorDistance> distance;

  SampledBox() {
    mesh.positions.rowwise() -= Eigen::RowVector3d(0.5, 0.3, 0.2);
    const Grid grid = *make_grid({-0.5, -0.3, -0.2}, {0.5, 0.3, 0.2}, 20);
    std::vector<std::uint32_t> inside;
    for (std::int64_t v = 0; v < grid.size(); ++v)
      if ((grid.center(v).array().abs() < Eigen::Array3d(0.5, 0.3, 0.2)).all()) inside.push_back(static_cast<std::uint32_t>(v));
    domain = VoxelDomain(grid, inside);
    distance = std::move(*make_interior_distance(DistanceMethod::euclidean, domain, mesh.positions, mesh.triangles));
  }

  std::unique_ptr<CenterSampling> sample(Index count, std::vector<double> density = {}) {
    CenterSamplingOptions options;
    options.count = options.most = count;
    options.density = std::move(density);
    return sample({}, std::move(options));
  }

  std::unique_ptr<CenterSampling> sample(const std::vector<Sphere>& spheres, CenterSamplingOptions options) {
    auto sampling = std::make_unique<CenterSampling>(domain, mesh.positions, *distance, spheres, std::move(options));
    double progress = 0;
    while (progress < 1) {
      const double next = sampling->step();
      CHECK(next >= progress);
      progress = next;
    }
    return sampling;
  }

  double apart(std::uint32_t a, std::uint32_t b) const { return (mesh.positions.row(a) - mesh.positions.row(b)).norm(); }
};

}  // namespace

TEST_CASE("each center is the vertex farthest from those before it, and starts in a corner") {
  SampledBox box;
  const auto sampling = box.sample(40);
  const Indices& centers = sampling->centers();
  REQUIRE(centers.size() == 40);
  CHECK(box.mesh.positions.row(centers[0]).cwiseAbs().isApprox(Eigen::RowVector3d(0.5, 0.3, 0.2)));
  for (std::size_t k = 1; k < centers.size(); ++k) {
    double own = 1e9, farthest = 0;
    for (std::uint32_t v = 0; v < box.mesh.positions.rows(); ++v) {
      double nearest = 1e9;
      for (std::size_t before = 0; before < k; ++before) nearest = std::min(nearest, box.apart(v, centers[before]));
      farthest = std::max(farthest, nearest);
      if (v == centers[k]) own = nearest;
    }
    // Distances come from voxels, 0.05 apart, by interpolation of ratios to straight lines, which is exact here but for rounding to
    // codes.
    CHECK(own >= farthest * (1 - 1e-3));
  }
}

TEST_CASE("codes times the scale are the distances, to one code; the longest has the largest code") {
  SampledBox box;
  const auto sampling = box.sample(12);
  const Index voxels = box.domain.size();
  REQUIRE(std::ssize(sampling->distances()) == 12 * voxels);
  std::uint16_t largest = 0;
  for (Index c = 0; c < 12; ++c) {
    const Vector3 center = box.mesh.positions.row(sampling->centers()[c]);
    for (Index v = 0; v < voxels; ++v) {
      const std::uint16_t code = sampling->distances()[c * voxels + v];
      largest = std::max(largest, code);
      CHECK(std::abs(code * sampling->distance_scale() - (box.domain.center(v) - center).norm()) <=
            1.01 * sampling->distance_scale());
    }
  }
  CHECK(largest == 65535);
}

TEST_CASE("centers are denser where the density is") {
  SampledBox box;
  std::vector<double> density;
  for (Index v = 0; v < box.mesh.positions.rows(); ++v) density.push_back(box.mesh.positions(v, 0) > 0 ? 16 : 1);
  const auto count_right = [&](const CenterSampling& sampling) {
    return std::count_if(sampling.centers().begin(), sampling.centers().end(),
                         [&](std::uint32_t v) { return box.mesh.positions(v, 0) > 0; });
  };
  const auto even = count_right(*box.sample(60)), uneven = count_right(*box.sample(60, density));
  CHECK(even < 36);
  CHECK(uneven > 44);
}

TEST_CASE("every sphere gets as many centers within three radii as are wanted, where there are vertices and room for them") {
  SampledBox box;
  const std::vector<Sphere> spheres{{{0.3, 0.1, 0.05}, 0.13}, {{-0.4, -0.2, -0.1}, 0.09}, {{0, 0, 0}, 0.18}, {{0, 0, 0}, 0.01}};
  CenterSamplingOptions options;
  options.count = 6;
  options.most = 60;
  options.per_sphere = 4;
  const auto sampling = box.sample(spheres, options);
  const Indices& centers = sampling->centers();
  CHECK(centers.size() > 6);
  CHECK(centers.size() < 20);
  const auto near = [&](const Sphere& sphere) {
    return std::count_if(centers.begin(), centers.end(), [&](std::uint32_t v) {
      return (box.mesh.positions.row(v).transpose() - sphere.center).norm() <= 3 * sphere.radius;
    });
  };
  for (std::size_t s = 0; s < 3; ++s) CHECK(near(spheres[s]) >= 4);
  CHECK(near(spheres[3]) == 0);  // no vertex is there
  for (std::size_t a = 0; a < centers.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) CHECK(centers[a] != centers[b]);
  CHECK(std::ssize(sampling->distances()) == std::ssize(centers) * box.domain.size());

  options.most = 8;
  CHECK(box.sample(spheres, options)->centers().size() == 8);
}

TEST_CASE("fewer codes are taken where fewer are wanted") {
  SampledBox box;
  CenterSamplingOptions options;
  options.count = options.most = 5;
  options.most_code = 1023;
  const auto sampling = box.sample(std::vector<Sphere>(), options);
  CHECK(*std::max_element(sampling->distances().begin(), sampling->distances().end()) == 1023);
}

TEST_CASE("vertices far from every voxel are counted, and the farthest is named") {
  SampledBox box;
  box.mesh.positions.row(7) = Eigen::RowVector3d(3, 0, 0);
  box.mesh.positions.row(9) = Eigen::RowVector3d(2, 0, 0);
  const auto sampling = box.sample(3);
  CHECK(sampling->outside().count == 2);
  CHECK(sampling->outside().farthest == 7);
  CHECK(sampling->outside().distance == doctest::Approx(2.525).epsilon(0.02));
}
