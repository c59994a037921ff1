// hb_irbf_*: bodies as baked, made here without baking, sound or hostile; handles, solving, frames, points and measures.
//
// behind: abi/irbf.cpp core/irbf/basis.cpp core/irbf/body.cpp core/irbf/frame_kernel.cpp core/irbf/handle_constraints.cpp core/irbf/irbf.cpp core/irbf/local_global.cpp core/irbf/prepared_body.cpp core/irbf/quality.cpp core/irbf/reduced_system.cpp core/irbf/rotation_hessian.cpp core/irbf/sphere_energy.cpp core/irbf/sphere_structure.cpp
// behind: core/numerics/anderson.cpp core/numerics/closest_rotation.cpp core/mesh/vertex_normals.cpp core/kernels/kernel.cpp
#include "meshes.hpp"
#include "target.hpp"

using namespace handlebody::fuzz;

namespace {

/** A body over the box of its mesh, whose interior distances are about Euclidean. */
struct MadeBody {
  Mesh mesh;
  std::vector<std::uint32_t> voxels, centers;
  std::vector<std::uint16_t> distances;
  std::vector<double> spheres, axes;
  hb_body body{};
};

void make_grid(Bytes& bytes, MadeBody& made, const double* low, const double* high) {
  hb_body& body = made.body;
  double longest = 0, squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = high[axis] - low[axis];
    longest = std::max(longest, extent), squared += extent * extent;
    body.center[axis] = (low[axis] + high[axis]) / 2;
  }
  body.diagonal = squared > 0 ? std::sqrt(squared) : 1;
  const std::uint32_t across = bytes.from_to(2, 5);
  body.spacing = longest > 0 ? longest / body.diagonal / across : 1;
  std::uint32_t size = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = (high[axis] - low[axis]) / body.diagonal / body.spacing;
    body.dims[axis] = 2 + static_cast<std::uint32_t>(cells >= 0 && cells < 8 ? cells : 0);
    body.origin[axis] = -(body.dims[axis] - 1.) / 2 * body.spacing;
    size *= body.dims[axis];
  }
  const std::uint32_t kept = bytes.byte() < 200 ? 256 : bytes.byte();
  for (std::uint32_t v = 0; v < size; ++v)
    if (bytes.byte() < kept) made.voxels.push_back(bytes.wildly() ? bytes.index(size) : v);
}

void fill(Bytes& bytes, MadeBody& made) {
  hb_body& body = made.body;
  const std::uint32_t n = made.mesh.vertex_count(), centers = bytes.from_to(1, std::min(n, bytes.byte() < 230 ? 6u : 50u));
  for (std::uint32_t c = 0; c < centers; ++c) made.centers.push_back(bytes.wildly() ? bytes.index(n) : c * n / centers);
  body.distance_scale = 1. / 65535;
  const bool noise = bytes.byte() < 50;
  for (const std::uint32_t center : made.centers) {
    for (const std::uint32_t voxel : made.voxels) {
      const std::uint32_t cell[3]{voxel % body.dims[0], voxel / body.dims[0] % body.dims[1], voxel / body.dims[0] / body.dims[1]};
      double squared = 0;
      for (int axis = 0; axis < 3 && center < n; ++axis) {
        const double at = (made.mesh.positions[3 * center + axis] - body.center[axis]) / body.diagonal;
        squared += std::pow(body.origin[axis] + cell[axis] * body.spacing - at, 2);
      }
      const double code = std::sqrt(squared) * 65535;
      made.distances.push_back(static_cast<std::uint16_t>(noise ? bytes.byte() * 257 : code >= 0 && code < 65535 ? code : 65535));
    }
  }
  for (std::uint32_t spheres = bytes.from_to(1, bytes.byte() < 240 ? 3 : 12); spheres > 0; --spheres) {
    for (int axis = 0; axis < 3; ++axis) made.spheres.push_back(bytes.number() / 16);
    made.spheres.push_back(bytes.positive() / 32);
    const double half = bytes.byte() < 40 ? made.spheres.back() * (1 + bytes.positive()) : 0;
    made.axes.insert(made.axes.end(), {half, bytes.wildly() ? bytes.number() : 0, 0});
  }
}

/** Counts and numbers that contradict each other. */
void falsify(Bytes& bytes, hb_body& body) {
  body.vertex_count = bytes.count(body.vertex_count);
  body.triangle_count = bytes.count(body.triangle_count);
  body.voxel_count = bytes.count(body.voxel_count);
  body.center_count = bytes.count(body.center_count);
  body.sphere_count = bytes.count(body.sphere_count);
  for (std::uint32_t& side : body.dims) side = bytes.wildly() ? bytes.index(side) : side;
  for (double* number : {body.center, body.origin, &body.spacing, &body.diagonal, &body.distance_scale, &body.smooth_length})
    if (bytes.wildly()) *number = bytes.number();
}

void make_body(Bytes& bytes, MadeBody& made) {
  made.mesh = make_mesh(bytes, 3, 3);
  double low[3]{}, high[3]{};
  for (std::size_t i = 0; i < made.mesh.positions.size(); ++i) {
    const double x = made.mesh.positions[i];
    low[i % 3] = i < 3 ? x : std::min(low[i % 3], x), high[i % 3] = i < 3 ? x : std::max(high[i % 3], x);
  }
  make_grid(bytes, made, low, high);
  fill(bytes, made);
  hb_body& body = made.body;
  body.smooth_length = bytes.flip() ? 0.3 : 0;
  body.vertex_count = made.mesh.vertex_count();
  body.triangle_count = made.mesh.simplex_count();
  body.voxel_count = static_cast<std::uint32_t>(made.voxels.size());
  body.center_count = static_cast<std::uint32_t>(made.centers.size());
  body.sphere_count = static_cast<std::uint32_t>(made.spheres.size() / 4);
  body.positions = made.mesh.positions.data(), body.triangles = made.mesh.simplices.data(), body.voxels = made.voxels.data();
  body.centers = made.centers.data(), body.distances = made.distances.data(), body.spheres = made.spheres.data();
  if (bytes.flip()) body.sphere_axes = made.axes.data();
  falsify(bytes, body);
}

hb_irbf_options choose(Bytes& bytes) {
  hb_irbf_options options{2, 0, 100, -1, 0, 1, 5, 0, 2, 0, 0, 0, 0};
  if (bytes.flip()) options.relative_width = bytes.flip() ? 0 : bytes.positive();
  if (bytes.flip()) options.poisson_ratio = bytes.byte() < 240 ? 0.45 : bytes.number();
  if (bytes.flip()) options.smoothness = bytes.positive() * (bytes.flip() ? 1e-6 : 1);
  if (bytes.byte() < 60) options.anchor_weight = bytes.positive() * 100, options.edge_exponent = bytes.number();
  options.support = bytes.positive();
  options.kernel = bytes.flip() ? 5 : bytes.option(0, 15);
  options.host_kernel = bytes.option(0, 2);
  options.order = static_cast<std::int32_t>(bytes.option(2, 4));
  options.constraints = bytes.option(0, 1);
  options.precision = bytes.option(0, 1);
  options.sphere_fit = bytes.byte() < 60 ? bytes.option(0, 1) : 0;
  options.structure = bytes.byte() < 60 ? bytes.option(0, 1) : 0;
  return options;
}

std::uint32_t set_handles(Bytes& bytes, const Mesh& mesh, hb_irbf* irbf) {
  const std::uint32_t count = bytes.from_to(bytes.wildly() ? 0 : 1, 4);
  std::vector<double> points;
  std::vector<std::uint32_t> kinds;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t vertex = bytes.below(mesh.vertex_count());
    for (int axis = 0; axis < 3; ++axis) points.push_back(bytes.byte() < 4 ? bytes.number() : mesh.positions[3 * vertex + axis]);
    kinds.push_back(bytes.option(0, 1));
  }
  return worked(hb_irbf_set_handles(irbf, points.data(), kinds.data(), bytes.count(count))) ? count : 0;
}

void move(Bytes& bytes, hb_irbf* irbf, std::uint32_t handles, std::uint32_t spheres) {
  double* const targets = hb_irbf_targets(irbf);
  for (std::uint32_t i = 0; i < 10 * handles; ++i)
    if (bytes.byte() < 60) targets[i] += bytes.number() / 4;
  double* const shapes = hb_irbf_shapes(irbf);
  if (bytes.byte() < 60)
    for (std::uint32_t i = 0; i < 9 * spheres; ++i)
      if (bytes.byte() < 60) shapes[i] += bytes.number() / 8;
  hb_irbf_report report;
  const std::uint32_t iterations = bytes.option(0, 20);
  // A million iterations are done where they are asked for: these end at once.
  const double tolerance = iterations > 21 ? 1e300 : bytes.flip() ? 1e-5 : bytes.number();
  if (!worked(hb_irbf_solve(irbf, iterations, tolerance, bytes.option(0, 1), &report))) return;
  reached();
  require(std::isfinite(report.energy) && std::isfinite(report.anchor_error), "a solution is made of numbers");
}

/** Frames, points and measures of the present deformation, solved or at rest. */
void read(Bytes& bytes, const Mesh& mesh, hb_irbf* irbf) {
  std::vector<float> frame(mesh.positions.size() + 1, 7), normals(frame);
  std::vector<float> rest(mesh.positions.size());
  for (float& x : rest) x = static_cast<float>(std::clamp(bytes.number(), -1e30, 1e30));
  worked(hb_irbf_deform(irbf, frame.data(), bytes.flip() ? rest.data() : nullptr, bytes.flip() ? normals.data() : nullptr));
  require(frame.back() == 7 && normals.back() == 7, "nothing is written beyond the vertices");
  const std::uint32_t count = bytes.below(4);
  std::vector<double> points = bytes.numbers(3 * count), out(3 * count + 1, 7);
  worked(hb_irbf_evaluate(irbf, points.data(), bytes.count(count), out.data()));
  require(out.back() == 7, "nothing is written beyond the points");
  if (bytes.byte() > 100) return;
  std::vector<std::uint32_t> tetrahedra;
  for (std::uint32_t i = 4 * bytes.below(4); i > 0; --i) tetrahedra.push_back(bytes.index(mesh.vertex_count()));
  hb_irbf_quality quality;
  worked(hb_irbf_measure(irbf, tetrahedra.data(), bytes.count(static_cast<std::uint32_t>(tetrahedra.size() / 4)), &quality));
}

}  // namespace

extern "C" double hb_host_kernel(std::uint32_t number, std::uint32_t derivative, double s) {
  if (number == 1) return s > 1 ? std::nan("") : 1;
  if (number == 2) return 1e308 * s;
  return derivative ? -2 * s * std::exp(-s * s) : std::exp(-s * s);
}

FUZZ(bytes) {
  MadeBody made;
  make_body(bytes, made);
  const hb_irbf_options options = choose(bytes);
  Owned<hb_irbf_free> irbf, shared;
  if (!irbf.make([&](hb_irbf** out) { return hb_irbf_create(&made.body, &options, out); })) return;
  require(std::memcmp(hb_irbf_positions(irbf.get()), made.mesh.positions.data(), made.mesh.positions.size() * 8) == 0,
          "positions are as they came");
  hb_irbf* now = irbf.get();
  for (std::uint32_t rounds = bytes.from_to(1, 3); rounds > 0; --rounds) {
    if (const std::uint32_t handles = set_handles(bytes, made.mesh, now))
      for (std::uint32_t moves = bytes.from_to(1, 3); moves > 0; --moves) move(bytes, now, handles, made.body.sphere_count);
    read(bytes, made.mesh, now);
    if (!shared.get() && bytes.byte() < 60) {
      require(shared.make([&](hb_irbf** out) { return hb_irbf_share(irbf.get(), out); }), "every deformation can be shared");
      now = shared.get();
    }
  }
}
