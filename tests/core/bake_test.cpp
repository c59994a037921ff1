#include "core/irbf/bake.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "made_meshes.hpp"

using namespace handlebody;
using test::made_box;
using test::MadeMesh;

namespace {

struct Baked {
  Body body;
  std::vector<BakeWarning> warnings;
  int code = HB_OK;

  const BakeWarning* find(hb_warning_code code_) const {
    for (const BakeWarning& warning : warnings) {
      if (warning.code == code_) return &warning;
    }
    return nullptr;
  }
  double volume() const {
    return static_cast<double>(body.domain.size()) * std::pow(body.domain.grid().spacing * body.normalization.diagonal, 3);
  }
};

Baked bake(const Points& positions, const Triangles& triangles, const BakeOptions& options) {
  Baked baked;
  auto begun = Bake::begin(positions, triangles, options);
  if (!begun) {
    baked.code = begun.error().code;
    return baked;
  }
  double progress = 0;
  while (progress < 1) {
    auto step = (*begun)->step();
    if (!step) {
      baked.code = step.error().code;
      return baked;
    }
    CHECK(*step >= progress);
    progress = *step;
  }
  baked.body = (*begun)->body(), baked.warnings = (*begun)->warnings();
  CHECK(check_body(baked.body));
  return baked;
}

BakeOptions small(int resolution = 24) {
  BakeOptions options;
  options.centers = 10, options.resolution = resolution, options.max_spheres = 20;
  return options;
}

MadeMesh joined(const std::vector<MadeMesh>& parts) {
  MadeMesh all;
  for (const MadeMesh& part : parts) {
    const Index n = all.positions.rows(), m = all.triangles.rows();
    all.positions.conservativeResize(n + part.positions.rows(), 3);
    all.positions.bottomRows(part.positions.rows()) = part.positions;
    all.triangles.conservativeResize(m + part.triangles.rows(), 3);
    all.triangles.bottomRows(part.triangles.rows()) = part.triangles.array() + static_cast<std::uint32_t>(n);
  }
  return all;
}

MadeMesh box(const Vector3& low, const Vector3& size, const std::array<int, 3>& cells) {
  MadeMesh mesh = made_box(size, cells);
  mesh.positions.rowwise() += low.transpose();
  return mesh;
}

/** Every triangle with corners of its own. */
MadeMesh soup(const MadeMesh& mesh) {
  MadeMesh loose;
  loose.positions.resize(3 * mesh.triangles.rows(), 3);
  loose.triangles.resize(mesh.triangles.rows(), 3);
  for (Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (Index c = 0; c < 3; ++c) {
      loose.positions.row(3 * t + c) = mesh.positions.row(mesh.triangles(t, c));
      loose.triangles(t, c) = static_cast<std::uint32_t>(3 * t + c);
    }
  }
  return loose;
}

/** Turns every triangle round with probability ½. */
void mix(Triangles& triangles, unsigned seed) {
  std::mt19937 random(seed);
  for (Index t = 0; t < triangles.rows(); ++t) {
    if (random() % 2) std::swap(triangles(t, 1), triangles(t, 2));
  }
}

/** A hollow block with one side left out. */
MadeMesh without_lid(const MadeMesh& mesh, double lid) {
  MadeMesh open = mesh;
  std::vector<std::uint32_t> kept;
  for (Index t = 0; t < mesh.triangles.rows(); ++t) {
    bool on_lid = true;
    for (Index c = 0; c < 3; ++c) on_lid &= mesh.positions(mesh.triangles(t, c), 1) == lid;
    if (!on_lid) kept.insert(kept.end(), mesh.triangles.row(t).data(), mesh.triangles.row(t).data() + 3);
  }
  open.triangles = Eigen::Map<const Triangles>(kept.data(), static_cast<Index>(kept.size() / 3), 3);
  return open;
}

MadeMesh sheet(int cells, double bend) {
  MadeMesh mesh;
  mesh.positions.resize((cells + 1) * (cells + 1), 3);
  std::vector<std::uint32_t> corners;
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i + (cells + 1) * j); };
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double x = double(i) / cells, z = double(j) / cells;
      mesh.positions.row(at(i, j)) << x, bend * std::sin(6 * x) * std::cos(5 * z), z;
      if (i < cells && j < cells) {
        corners.insert(corners.end(), {at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
      }
    }
  }
  mesh.triangles = Eigen::Map<const Triangles>(corners.data(), static_cast<Index>(corners.size() / 3), 3);
  return mesh;
}

const MadeMesh bar = made_box({4, 1, 1}, {12, 3, 3});

}  // namespace

TEST_CASE("a closed box fills as many voxels as it has volume, soup or not, however its triangles face") {
  for (const bool loose : {false, true}) {
    for (const unsigned seed : {0u, 5u}) {
      MadeMesh mesh = loose ? soup(bar) : bar;
      if (seed > 0) mix(mesh.triangles, seed);
      const Baked baked = bake(mesh.positions, mesh.triangles, small());
      CHECK(baked.volume() == doctest::Approx(4));
      CHECK((baked.find(HB_WARNING_ORIENTATION_MIXED) != nullptr) == (seed > 0));
      CHECK(baked.find(HB_WARNING_MESH_INSIDE_OUT) == nullptr);
      CHECK(baked.body.triangles == mesh.triangles);  // as given
    }
  }
}

TEST_CASE("an inside-out box bakes like the box, with a warning") {
  Triangles turned = bar.triangles;
  turned.col(1).swap(turned.col(2));
  const Baked baked = bake(bar.positions, turned, small()), straight = bake(bar.positions, bar.triangles, small());
  REQUIRE(baked.find(HB_WARNING_MESH_INSIDE_OUT));
  CHECK(baked.warnings.size() == 1);
  CHECK(straight.warnings.empty());
  CHECK(baked.body.domain.voxels() == straight.body.domain.voxels());
  CHECK(baked.body.distances == straight.body.distances);
}

TEST_CASE("closed parts that cross are one body, a cavity stays empty, and a loose triangle soup with gaps is filled") {
  const MadeMesh crossing = joined({box({0, 0, 0}, {4, 1, 1}, {8, 2, 2}), box({1.5, -1, .25}, {.5, 3, .5}, {2, 6, 2})});
  const Baked cross = bake(crossing.positions, crossing.triangles, small(48));
  CHECK(cross.volume() == doctest::Approx(4 + 2 * .25).epsilon(.02));
  const auto parts = face_components(cross.body.domain);
  CHECK(*std::max_element(parts.begin(), parts.end()) == 0);
  CHECK(cross.warnings.empty());

  MadeMesh hole = box({1, 1, 1}, {2, 2, 2}, {4, 4, 4});
  hole.triangles.col(1).swap(hole.triangles.col(2));
  const MadeMesh hollow = joined({box({0, 0, 0}, {4, 4, 4}, {4, 4, 4}), hole});
  CHECK(bake(hollow.positions, hollow.triangles, small(32)).volume() == doctest::Approx(64 - 8));

  // Corners moved apart by a hundredth, faces at random: neither edges nor winding numbers tell anything.
  MadeMesh torn = soup(made_box({2, 2, 2}, {6, 6, 6}));
  mix(torn.triangles, 3);
  std::mt19937 random(3);
  for (Index v = 0; v < torn.positions.rows(); ++v) {
    for (Index a = 0; a < 3; ++a) torn.positions(v, a) += .02 * (static_cast<double>(random()) / 4294967296. - .5);
  }
  const Baked filled = bake(torn.positions, torn.triangles, small(32));
  REQUIRE(filled.find(HB_WARNING_SURFACE_FILLED));
  CHECK(filled.volume() > 7);
  CHECK(filled.volume() < 10.5);  // the shell's own voxels count, half of each outside
}

TEST_CASE("a nearly closed cup has an inside; an open sheet has none, but for Euclidean distances") {
  const MadeMesh cup = without_lid(made_box({1, 3, 1}, {4, 12, 4}), 3);
  const Baked filled = bake(cup.positions, cup.triangles, small());
  REQUIRE(filled.code == HB_OK);
  CHECK(filled.volume() > 2.5);
  CHECK(filled.volume() <= 3.01);

  for (const double bend : {0., .1, .3}) {
    CAPTURE(bend);
    const MadeMesh flat = sheet(24, bend);
    BakeOptions options = small(48);
    CHECK(bake(flat.positions, flat.triangles, options).code == HB_ERROR_MESH_NO_INTERIOR);
    options.method = DistanceMethod::euclidean;
    const Baked open = bake(flat.positions, flat.triangles, options);
    REQUIRE(open.code == HB_OK);
    REQUIRE(open.find(HB_WARNING_SURFACE_OPEN));
    CHECK(open.body.spheres.size() == 20);
    // The spheres are spread: every vertex has one within a third of the sheet's side.
    for (Index v = 0; v < flat.positions.rows(); ++v) {
      double nearest = 1;
      const Vector3 p = open.body.normalization.to_solver(flat.positions.row(v).transpose());
      for (const Sphere& s : open.body.spheres) nearest = std::min(nearest, (s.center - p).norm());
      CHECK(nearest * open.body.normalization.diagonal < .34);
    }
  }
}

TEST_CASE("a grid too coarse for the gap between two legs says where, and a resolution that does") {
  // Two legs, 6 long, 0.1 apart where no voxel's center is, joined at the top.
  const MadeMesh legs = joined(
      {box({0, 0, 0}, {.9, 6, 1}, {2, 12, 2}), box({1, 0, 0}, {1.4, 6, 1}, {2, 12, 2}), box({0, 5.5, 0}, {2.4, 1, 1}, {4, 2, 2})});
  const Baked coarse = bake(legs.positions, legs.triangles, small(32));
  const BakeWarning* merged = coarse.find(HB_WARNING_LIMBS_MERGED);
  REQUIRE(merged);
  CHECK(merged->count > 50);
  REQUIRE(merged->place);
  CHECK(std::abs((*merged->place)[0] - .95) < .11);
  CHECK((*merged->place)[1] < 5);
  CHECK(merged->value > 65);
  CHECK(merged->value < 130);
  const Baked fine = bake(legs.positions, legs.triangles, small(static_cast<int>(merged->value)));
  CHECK(fine.find(HB_WARNING_LIMBS_MERGED) == nullptr);

  // Lips that touch: no resolution parts them.
  const MadeMesh lips = joined({box({0, 0, 0}, {4, 1, 2}, {8, 2, 4}), box({0, 1, 0}, {4, 1, 2}, {8, 2, 4})});
  const Baked clam = bake(lips.positions, lips.triangles, small(32));
  REQUIRE(clam.find(HB_WARNING_LIMBS_MERGED));
  CHECK(clam.find(HB_WARNING_LIMBS_MERGED)->value == 0);
}

TEST_CASE("a closed surface that crosses the grid's lines too often to keep them is voxelized by winding numbers") {
  // Ten plates, each a little smaller than the one around it, a voxel thick: 20 crossings of each of 262,144 lines along x.
  std::vector<MadeMesh> plates;
  for (int p = 0; p < 10; ++p) plates.push_back(box(Vector3(1e-6 * p, 0, 0), {1. / 512 - 2e-6 * p, 1, 1}, {1, 1, 1}));
  const MadeMesh mesh = joined(plates);
  const Baked baked = bake(mesh.positions, mesh.triangles, small(512));
  CHECK(baked.volume() == doctest::Approx(1. / 512));
}

TEST_CASE("a part without volume bakes, with a warning that says where; so do faces without area") {
  MadeMesh flag = sheet(4, 0);
  flag.positions.rowwise() += Eigen::RowVector3d(6, 2, 0);
  const MadeMesh mesh = joined({bar, flag});
  const Baked baked = bake(mesh.positions, mesh.triangles, small(48));
  REQUIRE(baked.code == HB_OK);
  const BakeWarning* outside = baked.find(HB_WARNING_PART_OUTSIDE);
  REQUIRE(outside);
  CHECK(outside->count == 25);
  CHECK(outside->vertex >= bar.positions.rows());
  CHECK((*outside->place - mesh.positions.row(outside->vertex).transpose()).norm() == 0);
  CHECK(outside->value == doctest::Approx(std::hypot(3, 1)).epsilon(.1));

  Triangles degenerate(bar.triangles.rows() + 3, 3);
  degenerate.topRows(bar.triangles.rows()) = bar.triangles;
  degenerate.bottomRows(3) << 0, 0, 1, 2, 2, 2, 0, 5, 0;
  const Baked tolerated = bake(bar.positions, degenerate, small());
  CHECK(tolerated.volume() == doctest::Approx(4));
  REQUIRE(tolerated.find(HB_WARNING_TRIANGLES_FLAT));
  CHECK(tolerated.find(HB_WARNING_TRIANGLES_FLAT)->count == 3);
  CHECK(tolerated.warnings.size() == 1);
}

TEST_CASE("a dense point cloud of a surface or a solid has the inside of the shape; a sparse one is refused") {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (const bool solid : {false, true}) {
    Points points(solid ? 30000 : 12000, 3);
    for (Index p = 0; p < points.rows(); ++p) {
      const Vector3 direction = Vector3(normal(random), normal(random), normal(random)).normalized();
      points.row(p) = direction * (solid ? std::cbrt(static_cast<double>(random()) / 4294967296.) : 1.);
    }
    BakeOptions options = small(24);
    options.cloud = true;
    const Baked baked = bake(points, Triangles(0, 3), options);
    REQUIRE(baked.code == HB_OK);
    CHECK(baked.body.triangles.rows() == 0);
    CHECK(baked.volume() > 4.1);  // of 4.19; half of the shell's voxels is outside
    CHECK(baked.volume() < 5.6);
    options.resolution = 200;
    CHECK(bake(points, Triangles(0, 3), options).code == HB_ERROR_CLOUD_TOO_SPARSE);
  }
}

TEST_CASE("a voxel volume is its own domain") {
  BakeOptions options = small();
  Grid grid{{.5, .5, .5}, 1, {4, 4, 4}};
  options.grid = grid;
  for (std::uint32_t c = 0; c < 64; ++c) {
    if (c % 4 < 3) options.voxels.push_back(c);
  }
  const MadeMesh surface = made_box({3, 4, 4}, {3, 4, 4});
  const Baked baked = bake(surface.positions, surface.triangles, options);
  REQUIRE(baked.code == HB_OK);
  CHECK(baked.body.domain.voxels() == options.voxels);
  CHECK(baked.volume() == doctest::Approx(48));
  options.voxels.push_back(64);
  CHECK(bake(surface.positions, surface.triangles, options).code == HB_ERROR_INVALID_SHAPE);
  options.voxels = {3, 3};
  CHECK(bake(surface.positions, surface.triangles, options).code == HB_ERROR_INVALID_SHAPE);
  options.voxels = {0, 1};
  for (const double away : {1e3, 1e9, 1e200, 1e300}) {  // a volume of something else, or in other units
    options.grid->origin[1] = -away;
    CHECK(bake(surface.positions, surface.triangles, options).code == HB_ERROR_INVALID_SHAPE);
  }
  options.grid->origin[1] = .5;
  options.voxels = {0};
  for (const double spacing : {1e-9, 1e-100, 1e-308, 1e300}) {
    options.grid->spacing = spacing;
    CHECK(bake(surface.positions, surface.triangles, options).code == HB_ERROR_INVALID_SHAPE);
  }
}

TEST_CASE("density draws centers: nine times as dense, a third as far apart") {
  const MadeMesh mesh = made_box({8, 1, 1}, {64, 8, 8});
  BakeOptions options = small(64);
  options.centers = 200;
  for (Index v = 0; v < mesh.positions.rows(); ++v) options.density.push_back(mesh.positions(v, 0) < 4 ? 9 : 1);
  const Baked baked = bake(mesh.positions, mesh.triangles, options);
  const auto dense = std::count_if(baked.body.centers.begin(), baked.body.centers.end(),
                                   [&](std::uint32_t v) { return mesh.positions(v, 0) < 4; });
  CHECK(dense > 200 * .83);  // of nine parts in ten, less what the dense half's border takes
  CHECK(dense < 200 * .95);
  options.density.pop_back();
  CHECK(bake(mesh.positions, mesh.triangles, options).code == HB_ERROR_INVALID_SHAPE);
  for (const double wrong : {0., -1., std::nan(""), 1e9}) {
    options.density.assign(mesh.positions.rows(), 1);
    options.density[7] = wrong;
    CHECK(bake(mesh.positions, mesh.triangles, options).code == HB_ERROR_INVALID_OPTION);
  }
}

TEST_CASE("codes give the distances back to one code, and no center is taken twice") {
  const Baked baked = bake(bar.positions, bar.triangles, small());
  auto made = make_interior_distance(DistanceMethod::fast_marching, baked.body.domain, bar.positions, bar.triangles);
  REQUIRE(made);
  auto& exact = *made;
  std::vector<double> field(baked.body.domain.size());
  double largest = 0;
  for (std::size_t c = 0; c < baked.body.centers.size(); ++c) {
    exact->measure(baked.body.center_position(static_cast<Index>(c)), field.data());
    for (std::size_t v = 0; v < field.size(); ++v) {
      const double code = baked.body.distance_scale * baked.body.distances[c * field.size() + v];
      largest = std::max(largest, std::abs(code - field[v]));
    }
  }
  CHECK(largest < 1.001 * baked.body.distance_scale);
  std::vector<std::uint32_t> centers = baked.body.centers;
  std::sort(centers.begin(), centers.end());
  CHECK(std::adjacent_find(centers.begin(), centers.end()) == centers.end());
}

TEST_CASE("four ways to measure distances: never below Euclidean, near each other in a bar") {
  BakeOptions options = small();
  options.method = DistanceMethod::euclidean;
  const Baked straight = bake(bar.positions, bar.triangles, options);
  for (const auto method : {DistanceMethod::fast_marching, DistanceMethod::heat, DistanceMethod::mean_value}) {
    CAPTURE(static_cast<unsigned>(method));
    options.method = method;
    const Baked baked = bake(bar.positions, bar.triangles, options);
    REQUIRE(baked.code == HB_OK);
    CHECK(baked.body.domain.voxels() == straight.body.domain.voxels());
    CHECK(baked.body.centers[0] == straight.body.centers[0]);
    const double voxels = static_cast<double>(baked.body.domain.size());
    double sum = 0, straight_sum = 0;
    for (std::size_t v = 0; v < static_cast<std::size_t>(voxels); ++v) {  // from the first center, a corner of the bar
      const double d = baked.body.distance_scale * baked.body.distances[v];
      const double e = straight.body.distance_scale * straight.body.distances[v];
      CHECK(d >= .97 * e);
      sum += d, straight_sum += e;
    }
    // A bar is convex: what goes through it is straight; what goes along its surface is longer by its girth.
    CHECK(sum / straight_sum < (method == DistanceMethod::mean_value ? 1.25 : 1.02));
  }
  options.method = DistanceMethod::mean_value;
  const MadeMesh two = joined({bar, box({5, 0, 0}, {1, 1, 1}, {2, 2, 2})});
  CHECK(bake(two.positions, two.triangles, options).code == HB_ERROR_MESH_NOT_CONNECTED);
  options.cloud = true;
  CHECK(bake(bar.positions, Triangles(0, 3), options).code == HB_ERROR_MESH_NO_TRIANGLES);
}

TEST_CASE("whatever the triangles, a bake ends in a body or an error (seeds 1 to 60)") {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.; };
    const Index n = 4 + random() % 60, m = 1 + random() % 120;
    Points positions(n, 3);
    const unsigned kind = random() % 5;
    for (Index v = 0; v < n; ++v) {
      positions.row(v) << uniform(), uniform(), kind == 1 ? 0 : kind == 2 ? 1e-6 * uniform() : uniform();
      if (kind == 3) positions.row(v) = (4 * positions.row(v)).array().round() / 4;  // coincident vertices, coplanar triangles
      if (kind == 4) positions.row(v) *= random() % 3 ? 1 : 1e3;
    }
    Triangles triangles(m, 3);
    for (Index t = 0; t < m; ++t) {
      for (Index c = 0; c < 3; ++c) triangles(t, c) = random() % static_cast<unsigned>(n);
    }
    BakeOptions options = small(8 + static_cast<int>(random() % 24));
    options.method = static_cast<DistanceMethod>(random() % distance_method_count);
    options.packing = random() % 2 ? SpherePacking::tree : SpherePacking::skeleton;
    options.cloud = random() % 4 == 0;
    const Baked baked = bake(positions, options.cloud ? Triangles(0, 3) : triangles, options);
    if (baked.code != HB_OK) {
      CHECK((baked.code == HB_ERROR_MESH_NO_INTERIOR || baked.code == HB_ERROR_CLOUD_TOO_SPARSE ||
             baked.code == HB_ERROR_MESH_ZERO_EXTENT || baked.code == HB_ERROR_MESH_NO_TRIANGLES ||
             baked.code == HB_ERROR_MESH_OPEN || baked.code == HB_ERROR_MESH_NOT_CONNECTED));
    }
  }
}

TEST_CASE("vertices that nothing uses leave no trace in a bake, wherever they are in the list (seeds 1 to 24)") {
  const MadeMesh body = box({0.3, -1, 2}, {3, 1, 1}, {6, 3, 3});
  const Baked plain = bake(body.positions, body.triangles, small());
  REQUIRE(plain.code == HB_OK);
  for (unsigned seed = 1; seed <= 24; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    const Index strays = 1 + random() % 40, vertices = body.positions.rows();
    std::vector<std::uint32_t> order;  // the body's vertices in their order, `vertices` for a stray
    for (Index v = 0; v < vertices; ++v) order.push_back(static_cast<std::uint32_t>(v));
    const std::size_t where = seed % 3 == 0 ? 0 : seed % 3 == 1 ? order.size() / 2 : order.size();
    order.insert(order.begin() + static_cast<std::ptrdiff_t>(where), strays, static_cast<std::uint32_t>(vertices));
    Points positions(std::ssize(order), 3);
    std::vector<std::uint32_t> number(static_cast<std::size_t>(vertices));
    const double far = std::pow(10., static_cast<double>(random() % 30));
    for (std::size_t v = 0; v < order.size(); ++v) {
      if (order[v] < vertices) {
        positions.row(static_cast<Index>(v)) = body.positions.row(order[v]);
        number[order[v]] = static_cast<std::uint32_t>(v);
      } else {
        positions.row(static_cast<Index>(v)) << far * (random() % 1000 / 500. - 1.0005), -far, far * (random() % 3);
      }
    }
    const Triangles triangles = body.triangles.unaryExpr([&](std::uint32_t v) { return number[v]; });
    const Baked baked = bake(positions, triangles, small());
    REQUIRE(baked.code == HB_OK);
    CHECK(baked.body.normalization.center == plain.body.normalization.center);
    CHECK(baked.body.normalization.diagonal == plain.body.normalization.diagonal);
    CHECK(baked.body.domain.grid().origin == plain.body.domain.grid().origin);
    CHECK(baked.body.domain.grid().dims == plain.body.domain.grid().dims);
    CHECK(baked.body.domain.voxels() == plain.body.domain.voxels());
    CHECK(baked.body.distances == plain.body.distances);
    CHECK(baked.body.distance_scale == plain.body.distance_scale);
    REQUIRE(baked.body.centers.size() == plain.body.centers.size());
    for (std::size_t c = 0; c < baked.body.centers.size(); ++c) CHECK(baked.body.centers[c] == number[plain.body.centers[c]]);
    REQUIRE(baked.body.spheres.size() == plain.body.spheres.size());
    for (std::size_t s = 0; s < baked.body.spheres.size(); ++s) CHECK(baked.body.spheres[s].center == plain.body.spheres[s].center);
    REQUIRE(baked.warnings.size() == 1);
    CHECK(baked.warnings[0].code == HB_WARNING_VERTICES_UNUSED);
    CHECK(baked.warnings[0].count == strays);
    CHECK(order[static_cast<std::size_t>(baked.warnings[0].vertex)] == vertices);
  }
}

TEST_CASE("a vertex in the place of one that counts is that one, split; what no float holds is refused by its number") {
  MadeMesh body = made_box({2, 1, 1}, {4, 2, 2});
  const Index vertices = body.positions.rows();
  body.positions.conservativeResize(vertices + 1, 3);
  body.positions.row(vertices) = body.positions.row(3);
  CHECK(bake(body.positions, body.triangles, small()).warnings.empty());
  body.positions.row(vertices).setConstant(1e39);
  auto begun = Bake::begin(body.positions, body.triangles, small());
  REQUIRE_FALSE(begun);
  CHECK(begun.error().code == HB_ERROR_MESH_NOT_FINITE);
  CHECK(begun.error().culprit == HB_CULPRIT_VERTEX);
  CHECK(begun.error().index == vertices);
}

TEST_CASE("the vertices of a solid count, though no triangle of its surface uses them") {
  MadeMesh body = made_box({2, 1, 1}, {4, 2, 2});
  const Index vertices = body.positions.rows();
  body.positions.conservativeResize(vertices + 2, 3);
  body.positions.bottomRows(2) << 1, 0.5, 0.5, 9, 9, 9;
  BakeOptions options = small();
  options.centers = 1000;
  options.used.assign(static_cast<std::size_t>(vertices + 2), 1);
  options.used.back() = 0;
  const Baked baked = bake(body.positions, body.triangles, options);
  CHECK(std::ssize(baked.body.centers) == vertices + 1);
  CHECK(baked.body.normalization.diagonal == doctest::Approx(std::sqrt(6)));
  REQUIRE(baked.find(HB_WARNING_VERTICES_UNUSED));
  CHECK(baked.find(HB_WARNING_VERTICES_UNUSED)->vertex == vertices + 1);
}

TEST_CASE("doubled faces, flat ones and a double side bake to the body without them, by every distance") {
  const MadeMesh body = box({-1, 0, 0}, {3, 1, 1}, {6, 3, 3});
  for (const DistanceMethod method :
       {DistanceMethod::fast_marching, DistanceMethod::euclidean, DistanceMethod::heat, DistanceMethod::mean_value}) {
    CAPTURE(static_cast<int>(method));
    BakeOptions options = small();
    options.method = method;
    const Baked plain = bake(body.positions, body.triangles, options);
    Triangles some(body.triangles.rows() + 4, 3), twice(2 * body.triangles.rows(), 3);
    some << body.triangles, body.triangles.row(5), body.triangles.row(9), 3, 7, 3, 2, 2, 2;
    std::swap(some(body.triangles.rows() + 1, 0), some(body.triangles.rows() + 1, 1));
    twice << body.triangles, body.triangles;
    twice.bottomRows(body.triangles.rows()).col(0).swap(twice.bottomRows(body.triangles.rows()).col(1));
    for (const Triangles& triangles : {some, twice}) {
      const Baked baked = bake(body.positions, triangles, options);
      REQUIRE(baked.code == HB_OK);
      CHECK(baked.body.domain.voxels() == plain.body.domain.voxels());
      CHECK(baked.body.centers == plain.body.centers);
      CHECK(baked.body.distances == plain.body.distances);
      REQUIRE(baked.find(HB_WARNING_TRIANGLES_DOUBLED));
      CHECK(baked.find(HB_WARNING_TRIANGLES_DOUBLED)->count == (triangles.rows() == some.rows() ? 2 : body.triangles.rows()));
      CHECK_FALSE(baked.find(HB_WARNING_ORIENTATION_MIXED));
    }
  }
}

TEST_CASE("of two boxes with a wall between them, one turned inside out is told, and both are inside") {
  const MadeMesh left = made_box({1, 1, 1}, {2, 2, 2});
  for (const bool turned : {false, true}) {
    CAPTURE(turned);
    MadeMesh right = box({1, 0, 0}, {1, 1, 1}, {2, 2, 2});
    if (turned) right.triangles.col(1).swap(right.triangles.col(2));
    const MadeMesh both = joined({left, right});
    const Baked baked = bake(both.positions, both.triangles, small());
    CHECK(baked.volume() == doctest::Approx(2));
    REQUIRE(static_cast<bool>(baked.find(HB_WARNING_ORIENTATION_MIXED)) == turned);
    if (turned) CHECK(std::abs(baked.find(HB_WARNING_ORIENTATION_MIXED)->count - right.triangles.rows()) <= 16);
  }
}

TEST_CASE("a handful of voxels is told, with a resolution at which it is none; more are not") {
  for (const double length : {4., 7.3, 12.1, 30.7, 55.}) {
    for (const int resolution : {8, 11, 16, 24}) {
      CAPTURE(length);
      CAPTURE(resolution);
      const MadeMesh rod = box({0.1, 0.2, 0.3}, {length, 1, 1.1}, {8, 1, 1});
      const Baked baked = bake(rod.positions, rod.triangles, small(resolution));
      if (baked.code == HB_ERROR_MESH_NO_INTERIOR) continue;
      const BakeWarning* told = baked.find(HB_WARNING_VOXELS_FEW);
      CHECK(static_cast<bool>(told) == (baked.body.domain.size() < 64));
      if (!told) continue;
      CHECK(told->count == baked.body.domain.size());
      REQUIRE(told->value > resolution);
      CHECK_FALSE(bake(rod.positions, rod.triangles, small(static_cast<int>(told->value))).find(HB_WARNING_VOXELS_FEW));
    }
  }
}
