#include "core/irbf/irbf.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/mesh/enclosed_volume.hpp"
#include "core/mesh/vertex_normals.hpp"
#include "core/numerics/closest_rotation.hpp"
#include "core/numerics/indices.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {

namespace {

/** Rows of Ψ that are turned into doubles for a product. */
constexpr Index vertices_at_once = 256;
/** Of a sphere's shape: numbers beyond this, and volumes below that part, are no shapes that solving could reach. */
constexpr double largest_stretch = 1000, least_volume = 1e-6;

}  // namespace

Result<std::unique_ptr<Irbf>> Irbf::create(Body body, const IrbfOptions& options) {
  auto prepared = PreparedBody::create(std::move(body), options);
  if (!prepared) return prepared.error();
  return std::make_unique<Irbf>(std::move(*prepared));
}

Irbf::Irbf(std::shared_ptr<const PreparedBody> body)
    : prepared_(std::move(body)),
      displacement_(PointsF::Zero(prepared_->rest.rows(), 3)),
      deformed_(prepared_->rest),
      deformed_normals_(prepared_->rest.rows(), 3),
      frame_(prepared_->kernel->scratch()),
      local_global_(prepared_->edges, prepared_->edge_scale, prepared_->options.sphere_fit, prepared_->options.volume()),
      shapes_(prepared_->body.spheres.size() * shape_size),
      maps_(local_global_.maps()),
      coefficients_(Matrix::Zero(prepared_->basis.size(), 3)) {
  work_.warm = maps_;
  for (std::size_t s = 0; s < shapes_.size(); s += shape_size) shapes_[s] = shapes_[s + 4] = shapes_[s + 8] = 1;
  work_.solved_shapes = shapes_;
}

// ---- handles ----------------------------------------------------------------------------------------------------------------

Result<Done> Irbf::set_handles(const ConstPoints& handles, const std::vector<HandleKind>& kinds) {
  auto constraints =
      HandleConstraints::create(prepared_->body, prepared_->basis, prepared_->surface, handles, kinds, prepared_->structure_radius);
  if (!constraints) return constraints.error();
  const Index repeated = constraints->repeated();
  if (prepared_->options.constraints == ConstraintKind::hard && repeated >= 0) {
    return Error(HB_ERROR_HANDLE_CONFLICT,
                 {"Handle ", repeated, " sits where another one does; hard constraints take one a point."},
                 {"Remove one of the two, or use soft constraints."}, HB_CULPRIT_HANDLE, repeated);
  }
  ReducedSystem system;
  if (!kinds.empty()) {
    auto made = make_reduced_system(prepared_->edge_rows, prepared_->gram, constraints->rows(), prepared_->anchor_weight,
                                    prepared_->options.constraints);
    if (!made) return made.error();
    system = std::move(*made);
  }
  // All that takes memory comes before anything changes: where that runs out on the way, the former handles are whole.
  auto kernel = make_handle_kernel(system);
  auto frame = kernel ? kernel->scratch() : FrameKernel::Scratch();
  Matrix right_hand_side(system.inverse.cols(), 3);
  auto targets = constraints->rest(handles);
  Workspace work;
  work.targets = work.displacements = constraints->points();
  work.solution.resize(system.inverse.rows(), 3);
  work.missed.resize(constraints->rows().rows(), 3);
  work.warm = work_.warm;
  work.solved_targets.reserve(targets.size());
  work.solved_shapes = work_.solved_shapes;
  LocalGlobal local_global(prepared_->edges, prepared_->edge_scale, prepared_->options.sphere_fit, prepared_->options.volume());
  local_global.shape(work.solved_shapes.data());
  local_global.maps() = local_global_.maps();
  if (!kinds.empty()) local_global.set_system(system.hat);

  handle_kernel_ = std::move(kernel);
  handle_frame_ = std::move(frame);
  by_handles_ = false;
  right_hand_side_ = std::move(right_hand_side);
  constraints_ = std::move(*constraints);
  system_ = std::move(system);
  targets_ = std::move(targets);
  work_ = std::move(work);
  local_global_ = std::move(local_global);
  local_global_.follow(system_.hat);
  return Done{};
}

/** The other product of the appendix, N × (3B + K) instead of N × C, where it is the smaller one and quickly made: few spheres,
 *  many centers. It depends on the handles: for 173,000 vertices, 400 centers and 79 spheres (the paper's Armadillo) each set of
 *  handles takes 17 billion multiplications, seconds, where the 16-bit product with Ψ itself takes five milliseconds per frame. */
std::unique_ptr<const FrameKernel> Irbf::make_handle_kernel(const ReducedSystem& system) const {
  const Index columns = system.inverse.cols(), centers = prepared_->basis.size(), count = prepared_->psi.rows();
  const double products = static_cast<double>(count) * static_cast<double>(columns * (4 + centers));
  if (count == 0 || columns == 0 || columns >= centers || products >= most_handle_products) return nullptr;
  MatrixF matrix(count, columns);
  MatrixXd parameters(std::min(count, vertices_at_once), 4 + centers);  // [x 1 Ψ], some vertices of it
  for (Index first = 0; first < count; first += vertices_at_once) {
    const Index some = std::min(vertices_at_once, count - first);
    parameters.topLeftCorner(some, 3) = prepared_->rest.middleRows(first, some).cast<double>();
    parameters.col(3).setOnes();
    parameters.topRightCorner(some, centers) = prepared_->psi.middleRows(first, some).cast<double>();
    matrix.middleRows(first, some) = product(parameters.topRows(some), system.inverse).cast<float>();
  }
  return std::make_unique<const FrameKernel>(prepared_->rest, matrix, prepared_->options.precision);
}

// ---- solving ----------------------------------------------------------------------------------------------------------------

Result<Done> Irbf::check_shapes() const {
  for (std::size_t s = 0; s < shapes_.size(); s += shape_size) {
    const double* const shape = &shapes_[s];
    const auto sphere = static_cast<std::int64_t>(s / shape_size);
    if (!std::all_of(shape, shape + shape_size, [](double x) { return std::abs(x) <= largest_stretch; })) {
      return Error(HB_ERROR_TARGET_NOT_FINITE,
                   {"The shape of sphere ", sphere, " has a number that is not finite, or beyond 1000."},
                   {"Use a linear map near the identity, which keeps the sphere."}, HB_CULPRIT_SPHERE, sphere);
    }
    const double volume = Eigen::Map<const Matrix3>(shape).determinant();
    if (volume >= least_volume) continue;
    return Error(HB_ERROR_SHAPE_INVERTED,
                 {"The shape of sphere ", sphere, " turns it inside out or flat: its determinant is ", volume, "."},
                 {"Use a linear map with a positive determinant, 0.000001 at least."}, HB_CULPRIT_SPHERE, sphere);
  }
  return Done{};
}

/** Sets out for new targets or shapes, in the frame that is carried along with the handles. */
void Irbf::begin(const RigidMotion& frame) {
  LocalGlobal& iteration = local_global_;
  const Points& points = constraints_.points();
  const Matrix3& turn = frame.rotation;
  double along = 0, square = 0;  // of the handles' places and their targets, for the scale that goes with the frame
  for (Index i = 0; i < points.rows(); ++i) {
    const Vector3 arm = points.row(i).transpose() - frame.from;
    const Vector3 moved = turn.transpose() * (work_.targets.row(i).transpose() - frame.to);
    work_.displacements.row(i) = (moved - arm).transpose();
    along += arm.dot(moved);
    square += arm.squaredNorm();
  }
  constraints_.right_hand_side(work_.displacements, system_.weight, iteration.constraints());
  if (work_.solved_shapes != shapes_) {
    iteration.shape(shapes_.data());
    work_.solved_shapes = shapes_;
  }

  // Start from the last maps, unless carrying the rest shape along is clearly better: rigidly, or as large as the handles say.
  const bool grows = prepared_->options.sphere_fit == SphereFit::similarity && along > 0 && square > 0;
  std::vector<Matrix3>& maps = iteration.maps();
  iteration.rest(grows ? along / square : 1);
  double energy = iteration.energy(maps);
  if (solved_) {
    for (std::size_t b = 0; b < maps_.size(); ++b) work_.warm[b] = turn.transpose() * maps_[b];
    const double warm_energy = iteration.energy(work_.warm);
    const bool warm = warm_energy < 2 * energy;
    if (warm) maps.swap(work_.warm);
    energy = warm ? warm_energy : iteration.energy(maps);
  }
  iteration.start(energy);
  work_.solved_targets = targets_;
}

Result<SolveReport> Irbf::solve(const SolveOptions& options) {
  if (handle_count() == 0) {
    return Error(HB_ERROR_HANDLES_MISSING, {"There are no handles to solve for."}, {"Set at least one handle first."});
  }
  if (auto read = constraints_.read_targets(targets_.data(), prepared_->body.normalization, work_.targets); !read)
    return read.error();
  if (auto checked = check_shapes(); !checked) return checked.error();

  // Rigid motions do not change the energy, so the solve happens in a frame that is carried along rigidly with the handles: the
  // unknown there is only the deformation, and it is exactly zero when the handles move rigidly.
  const RigidMotion frame = closest_rigid_motion(constraints_.points(), work_.targets);
  const Matrix3& turn = frame.rotation;
  LocalGlobal& iteration = local_global_;
  if (work_.solved_targets != targets_ || work_.solved_shapes != shapes_) begin(frame);
  const LocalGlobalReport done = iteration.run({options.max_iterations, options.tolerance, options.accelerate});

  for (Index axis = 0; axis < 3; ++axis) {
    work_.solution.col(axis).noalias() = system_.inverse * iteration.right_hand_side().col(axis);
    work_.missed.col(axis).noalias() = constraints_.rows() * work_.solution.col(axis);
  }
  work_.missed -= iteration.constraints() / system_.weight;
  linear_ = turn * (Matrix3::Identity() + work_.solution.topRows<3>().transpose()) - Matrix3::Identity();
  translation_ = frame.to + turn * (work_.solution.row(3).transpose() - frame.from);
  coefficients_.noalias() = work_.solution.bottomRows(prepared_->basis.size()) * turn.transpose();
  for (std::size_t b = 0; b < maps_.size(); ++b) maps_[b] = turn * iteration.maps()[b];
  solved_ = true;
  by_handles_ = handle_kernel_ != nullptr;
  if (by_handles_) {
    carried_linear_ = turn - Matrix3::Identity();
    carried_translation_ = frame.to - turn * frame.from;
    right_hand_side_.noalias() = iteration.right_hand_side() * turn.transpose();
  }

  SolveReport report;
  report.energy = std::max(done.energy, 0.0);
  report.anchor_error = constraints_.largest_miss(work_.missed) * prepared_->body.normalization.diagonal;
  report.change = done.change;
  report.iterations = done.iterations;
  report.converged = done.converged;
  return report;
}

// ---- deforming --------------------------------------------------------------------------------------------------------------

void Irbf::deform(float* positions, const float* rest_normals, float* normals) {
  if (by_handles_) {
    handle_kernel_->apply(carried_linear_, carried_translation_, right_hand_side_, handle_frame_, displacement_);
  } else {
    prepared_->kernel->apply(linear_, translation_, coefficients_, frame_, displacement_);
  }
  const auto diagonal = static_cast<float>(prepared_->body.normalization.diagonal);
  const float *stored = prepared_->stored.data(), *displacement = displacement_.data();
  const Index count = vertex_count();
  for (Index v = 0; v < count; ++v) {
    const float* moved = displacement + 3 * prepared_->weld.to_unique[v];
    for (Index axis = 0; axis < 3; ++axis) positions[3 * v + axis] = stored[3 * v + axis] + diagonal * moved[axis];
  }
  if (normals == nullptr) return;

  deformed_ = prepared_->rest + displacement_;
  vertex_normals(deformed_, prepared_->triangles, deformed_normals_);
  Eigen::Map<PointsF> out_normals(normals, vertex_count(), 3);
  for (Index v = 0; v < vertex_count(); ++v) {
    const Index u = prepared_->weld.to_unique[v];
    const Eigen::Vector3f to = deformed_normals_.row(u);
    if (rest_normals == nullptr) {
      out_normals.row(v) = to;
      continue;
    }
    // An authored normal turns as the area-weighted one does, by the smallest rotation.
    const Eigen::Vector3f from = prepared_->rest_normals.row(u);
    const Eigen::Vector3f authored = Eigen::Map<const PointsF>(rest_normals, vertex_count(), 3).row(v);
    const Eigen::Vector3f axis = from.cross(to);
    const float cosine = from.dot(to);
    const Eigen::Vector3f turned = axis.cross(authored);
    out_normals.row(v) = cosine > -0.999f ? Eigen::Vector3f(authored + turned + axis.cross(turned) / (1 + cosine)) : to;
  }
}

Result<Points> Irbf::evaluate(const ConstPoints& points) const {
  for (Index i = 0; i < points.rows(); ++i) {
    if (points.row(i).allFinite()) continue;
    return Error(HB_ERROR_QUERY_NOT_FINITE, {"Point ", i, " has a coordinate that is not a finite number."},
                 {"Ask at finite coordinates."}, HB_CULPRIT_QUERY, i);
  }
  const Points solver =
      (points.rowwise() - prepared_->body.normalization.center.transpose()) / prepared_->body.normalization.diagonal;
  InteriorSamples samples;
  for (Index i = 0; i < solver.rows(); ++i) samples.add(prepared_->body.domain, solver.row(i).transpose());
  Matrix phi = Matrix::Zero(solver.rows(), prepared_->basis.size());
  if (auto done = prepared_->basis.evaluate<double>(samples, phi); !done) return done.error();
  Points displacements = solver * linear_.transpose() + product(phi, coefficients_);
  displacements.rowwise() += translation_.transpose();
  Points deformed = points + prepared_->body.normalization.diagonal * displacements;
  return deformed;
}

Result<Quality> Irbf::quality(const Eigen::Ref<const Tetrahedra>& tetrahedra) {
  const double diagonal = prepared_->body.normalization.diagonal;
  if (!prepared_->voxel_quality) {
    auto made = VoxelQuality::create(prepared_->body, prepared_->basis, prepared_->surface_ranges);
    if (!made) return made.error();
    prepared_->voxel_quality = std::move(*made);
  }
  Quality quality = prepared_->voxel_quality->measure(linear_, translation_, coefficients_, diagonal);
  const double inside =
      static_cast<double>(prepared_->body.domain.size()) * std::exp(3 * std::log(prepared_->body.domain.grid().spacing * diagonal));
  const double at_rest = enclosed_volume(prepared_->body.positions, prepared_->body.triangles);
  PointsF moved(vertex_count(), 3);
  deform(moved.data(), nullptr, nullptr);
  const Points deformed = moved.cast<double>();
  if (tetrahedra.rows() > 0) {
    for (Index t = 0; t < tetrahedra.rows(); ++t) {
      if (in_range(tetrahedra.row(t).maxCoeff(), vertex_count())) continue;
      return Error(HB_ERROR_MESH_INDEX_OUT_OF_RANGE, {"Tetrahedron ", t, " uses a vertex that the body does not have."},
                   {"Give tetrahedra of the baked mesh's own vertices."}, HB_CULPRIT_TETRAHEDRON, t);
    }
    const double principle = quality.maximum_principle;
    quality = measure_tetrahedra(tetrahedra, prepared_->body.positions, deformed);
    quality.maximum_principle = principle;
  } else if (std::abs(at_rest) > 0.5 * inside && std::abs(at_rest) < 2 * inside) {
    // Where the surface is closed and oriented, it gives the volume better than voxels; soup and clouds are neither.
    quality.volume_ratio = enclosed_volume(deformed, prepared_->body.triangles) / at_rest;
  }
  return quality;
}

}  // namespace handlebody
