// The interior distances side by side: three in shapes whose geodesics are known, 64 voxels across, from five spacings on; all four
// behind their one interface.
#include "core/distance/interior_distance.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cell_surface.hpp"
#include "core/distance/fast_marching.hpp"
#include "core/distance/heat_distance.hpp"
#include "core/distance/mean_value_distance.hpp"
#include "known_geodesics.hpp"

using namespace handlebody;
using namespace handlebody::test;

namespace {

constexpr int resolution = 64;
constexpr double height = double{known_layers} / resolution;

/** Largest relative difference of d(a, b) and d(b, a) over pairs of voxels that are spread over the domain. */
template <typename Measure>
double asymmetry(const VoxelDomain& domain, const Measure& measure) {
  constexpr Index count = 12;
  std::vector<Index> voxels;
  for (Index k = 0; k < count; ++k) voxels.push_back((2 * k + 1) * domain.size() / (2 * count) + 3 * k);
  std::vector<std::vector<double>> from(count, std::vector<double>(static_cast<std::size_t>(domain.size())));
  for (std::size_t k = 0; k < count; ++k) measure(domain.center(voxels[k]), from[k].data());
  double largest = 0;
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double there = from[a][voxels[b]], back = from[b][voxels[a]];
      if ((domain.center(voxels[a]) - domain.center(voxels[b])).norm() < 5 * domain.grid().spacing) continue;
      largest = std::max(largest, 2 * std::abs(there - back) / (there + back));
    }
  }
  return largest;
}

struct Bounds {
  double mean, nine_tenths, far, largest, lowest, asymmetry;
};

template <typename Measure>
void check(const std::string& method, const KnownShape& shape, const VoxelDomain& domain, const Bounds& bounds,
           const Measure& measure) {
  const Accuracy a = accuracy(shape, domain, measure);
  const double skew = asymmetry(domain, measure);
  MESSAGE(shape.name << ", " << method << ": mean " << 100 * a.mean << "%, nine tenths " << 100 * a.nine_tenths << "%, far "
                     << 100 * a.far << "%, largest " << 100 * a.largest << "%, lowest " << 100 * a.lowest << "%, bias "
                     << 100 * a.bias << "%, asymmetry " << 100 * skew << "%");
  CHECK(a.mean <= bounds.mean);
  CHECK(a.nine_tenths <= bounds.nine_tenths);
  CHECK(a.far <= bounds.far);
  CHECK(a.largest <= bounds.largest);
  CHECK(a.lowest >= bounds.lowest);
  CHECK(skew <= bounds.asymmetry);
}

MadeMesh surface(const KnownShape& shape) {
  if (shape.name == "ring") return ring_surface(height, 96, 8, 5);
  return cell_surface({evenly(1, 32), evenly(1, 32), evenly(height, 4)}, [&](int i, int j, int) {
    return shape.inside({(i + .5) / 32, (j + .5) / 32});
  });
}

/** The distances of one method behind the interface, ready to measure. */
std::unique_ptr<InteriorDistance> ready_distance(DistanceMethod method, const VoxelDomain& domain, const MadeMesh& mesh) {
  auto made = make_interior_distance(method, domain, mesh.positions, mesh.triangles);
  REQUIRE(made);
  for (double part = 0; part < 1;) {
    const auto done = (*made)->step();
    REQUIRE(done);
    CHECK(*done >= part);
    part = *done;
  }
  return std::move(*made);
}

constexpr DistanceMethod all_methods[] = {DistanceMethod::fast_marching, DistanceMethod::euclidean, DistanceMethod::heat,
                                          DistanceMethod::mean_value};

}  // namespace

TEST_CASE("fast marching, heat and mean value against known geodesics") {
  const Bounds marching_bounds[3] = {
      {.01, .006, .006, .02, -.02, .02}, {.01, .006, .01, .02, -.02, .02}, {.02, .035, .055, .07, -.02, .02}};
  const Bounds heat_bounds[3] = {
      {.001, .001, .006, .03, -.001, .02}, {.002, .008, .03, .06, -.02, .03}, {.018, .055, .11, .11, -.02, .06}};
  // Mean value measures along the surface: these boards, an eighth thick, are crossed by way of the rim. What lies under the source
  // on the other side is therefore several times too far; from half a unit on the way round counts less. No way along the surface
  // is shorter than the one inside, but where 96 chords stand for a ring.
  const Bounds mean_value_bounds[3] = {
      {.15, .3, .5, 5, -1e-3, 1e-6}, {.1, .18, .2, 3, -1e-3, 1e-6}, {.07, .13, .12, 1, -.06, 1e-6}};
  const std::vector<KnownShape> shapes = known_shapes();
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    const VoxelDomain domain = shapes[s].domain(resolution);
    FastMarching marching(domain);
    check("fast marching", shapes[s], domain, marching_bounds[s],
          [&](const Vector3& source, double* d) { marching.march(source, d); });

    HeatDistance heat(domain);
    for (double part = 0; part < 1;) {
      const auto done = heat.step();
      REQUIRE(done);
      part = *done;
    }
    check("heat", shapes[s], domain, heat_bounds[s], [&](const Vector3& source, double* d) { heat.measure(source, d); });

    const MadeMesh mesh = surface(shapes[s]);
    auto mean_value = MeanValueDistance::begin(mesh.positions, mesh.triangles, domain);
    REQUIRE(mean_value);
    while (mean_value->step() < 1) {
    }
    check("mean value", shapes[s], domain, mean_value_bounds[s],
          [&](const Vector3& source, double* d) { mean_value->measure(source, d); });
  }
}

TEST_CASE("behind the interface each method is its own: Euclidean exactly, the others as their classes measure") {
  static_assert(std::size(all_methods) == distance_method_count);
  const KnownShape shape = known_shapes().front();
  const VoxelDomain domain = shape.domain(20);
  const MadeMesh mesh = surface(shape);
  const Vector3 source = domain.center(domain.size() / 3);
  const auto size = static_cast<std::size_t>(domain.size());
  std::vector<double> found[distance_method_count], own(size);
  for (const DistanceMethod method : all_methods) {
    auto& distances = found[static_cast<unsigned>(method)];
    distances.assign(size, -1);
    const auto measured = ready_distance(method, domain, mesh);
    measured->measure(source, distances.data());
    const std::vector<double> once = distances;
    measured->measure(domain.center(0), own.data());
    measured->measure(source, distances.data());
    CHECK(distances == once);  // whatever was measured between
    double least = 1;          // of Euclidean distances: fast marching is a little below them, the others never
    for (std::size_t v = 0; v < size; ++v) {
      const double straight = (domain.center(static_cast<Index>(v)) - source).norm();
      if (straight > 0) least = std::min(least, distances[v] / straight);
    }
    CHECK(least >= (method == DistanceMethod::fast_marching ? 0.97 : 1 - 1e-12));
  }
  for (std::size_t v = 0; v < size; ++v) CHECK(found[1][v] == (domain.center(static_cast<Index>(v)) - source).norm());

  FastMarching(domain).march(source, own.data());
  CHECK(found[0] == own);
  HeatDistance heat(domain);
  while (*heat.step() < 1) {
  }
  heat.measure(source, own.data());
  CHECK(found[2] == own);
  auto mean_value = MeanValueDistance::begin(mesh.positions, mesh.triangles, domain);
  REQUIRE(mean_value);
  while (mean_value->step() < 1) {
  }
  mean_value->measure(source, own.data());
  CHECK(found[3] == own);
}

TEST_CASE("behind the interface what cannot be reached is infinitely far, but not by a straight line") {
  const Grid grid{{0, 0, 0}, 1, {9, 4, 4}};
  std::vector<std::uint32_t> voxels;
  for (std::int64_t c = 0; c < grid.size(); ++c)
    if (grid.cell(c)[0] != 4) voxels.push_back(static_cast<std::uint32_t>(c));
  const VoxelDomain domain(grid, voxels);
  std::vector<double> distances(static_cast<std::size_t>(domain.size()));
  for (const DistanceMethod method : {DistanceMethod::fast_marching, DistanceMethod::heat, DistanceMethod::euclidean}) {
    ready_distance(method, domain, {})->measure({1, 1, 1}, distances.data());
    for (Index v = 0; v < domain.size(); ++v)
      CHECK(std::isfinite(distances[v]) == (method == DistanceMethod::euclidean || domain.center(v).x() < 4));
  }
}

TEST_CASE("behind the interface only mean value distances look at the surface, and name what is wrong with it") {
  const KnownShape shape = known_shapes().front();
  const VoxelDomain domain = shape.domain(12);
  MadeMesh open = surface(shape);
  open.triangles.conservativeResize(open.triangles.rows() - 1, 3);
  for (const DistanceMethod method : all_methods) {
    const auto made = make_interior_distance(method, domain, open.positions, open.triangles);
    CHECK(static_cast<bool>(made) == (method != DistanceMethod::mean_value));
    if (!made) CHECK(made.error().code == HB_ERROR_MESH_OPEN);
  }
}
