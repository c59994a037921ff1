#include "core/irbf/irbf.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/irbf/sphere_energy.hpp"
#include "core/mesh/enclosed_volume.hpp"
#include "core/numerics/closest_rotation.hpp"
#include "core/numerics/indices.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {

namespace {

constexpr double most_bytes = 1.5e9;
/** Multiplications that setting handles may spend on a smaller matrix for the frames: some ten milliseconds. */
constexpr double most_handle_products = 5e7;
/** Rows of Ψ that are turned into doubles for a product. */
constexpr Index vertices_at_once = 256;

Error invalid_option(const char* name, double value, const char* remedy) {
  return {HB_ERROR_INVALID_OPTION, {"IRBF's ", name, " is ", value, "."}, {remedy}, HB_CULPRIT_OPTION};
}

Result<Done> check_options(const IrbfOptions& options) {
  const double width = options.kernel.width;
  if (!(width > 0) || !std::isfinite(width)) return invalid_option("relative width", width, "Use a positive number, such as 2.");
  if (options.kernel.kind > KernelKind::custom || options.kernel.kind == KernelKind::clamped_plate)
    return invalid_option("kernel", static_cast<double>(options.kernel.kind), "Use a radial kernel of the list.");
  if (options.smoothness != 0 && !(options.smoothness >= 1e-12 && options.smoothness <= 1e6))
    return invalid_option("smoothness", options.smoothness, "Use a number from 1e-12 to 1e6, such as 1e-6, or have it chosen.");
  if (!(options.anchor_weight > 0) || !(options.anchor_weight <= 1e6))
    return invalid_option("anchor weight", options.anchor_weight, "Use a positive number up to 1e6, such as 100.");
  if (!std::isfinite(options.edge_exponent) || std::abs(options.edge_exponent) > 4)
    return invalid_option("edge exponent", options.edge_exponent, "Use a number from -4 to 4, such as -1.");
  return Done{};
}

}  // namespace

Result<std::unique_ptr<Irbf>> Irbf::create(Body body, const IrbfOptions& options) {
  if (auto checked = check_options(options); !checked) return checked.error();
  if (auto checked = check_body(body); !checked) return checked.error();
  const auto centers = static_cast<double>(body.centers.size());
  const auto spheres = static_cast<double>(body.spheres.size());
  // The float matrix while the 16-bit one is made from it, the matrices of the unknowns, the hat matrix.
  const double bytes = 6 * centers * static_cast<double>(body.positions.rows()) + 8 * (centers + 4) * (centers + 4 + 9 * spheres) +
                       8 * 9 * spheres * spheres;
  if (bytes > most_bytes) {
    return Error(HB_ERROR_OUT_OF_MEMORY,
                 {"This body, with ", body.centers.size(), " centers, ", body.spheres.size(), " spheres and ",
                  body.positions.rows(), " vertices, would take ", static_cast<int>(bytes / 1e6), " MB."},
                 {"Bake it with fewer centers or spheres, or simplify the mesh."});
  }
  std::unique_ptr<Irbf> irbf(new Irbf());
  irbf->options_ = options;
  irbf->body_ = std::move(body);
  irbf->basis_ = std::make_unique<Basis>(irbf->body_, options.kernel);
  if (auto done = irbf->prepare_spheres(); !done) return done.error();
  if (auto done = irbf->prepare_vertices(); !done) return done.error();
  return irbf;
}

Result<Done> Irbf::prepare_spheres() {
  const Index centers = basis_->size();
  auto energy = make_sphere_energy(body_, *basis_, options_.edge_exponent);
  if (!energy) return energy.error();
  smoothness_ = options_.smoothness > 0 ? options_.smoothness : automatic_smoothness(*energy);
  edge_rows_ = std::move(energy->rows);
  gram_ = MatrixXd::Zero(4 + centers, 4 + centers);
  gram_.selfadjointView<Eigen::Lower>().rankUpdate(edge_rows_.transpose());
  gram_.diagonal().tail(centers).array() += smoothness_;
  local_global_ = std::make_unique<LocalGlobal>(std::move(energy->edges), std::move(energy->edge_scale));

  rotations_ = work_.warm = local_global_->rotations();
  coefficients_ = Matrix::Zero(centers, 3);
  // A rotation handle grips a ball about as large as the smaller spheres.
  double radii = 0;
  for (const Sphere& sphere : body_.spheres) radii += sphere.radius;
  structure_radius_ = 0.5 * radii / static_cast<double>(body_.spheres.size());
  return Done{};
}

Result<Done> Irbf::prepare_vertices() {
  weld_ = weld_vertices(body_.positions);
  welded_triangles_ = weld_triangles(weld_, body_.triangles);
  stored_ = body_.positions.cast<float>();
  const Points solver = body_.solver_positions();
  const Index count = std::ssize(weld_.unique);
  InteriorSamples samples;
  rest_.resize(count, 3);
  for (Index u = 0; u < count; ++u) {
    const Vector3 point = solver.row(weld_.unique[u]);
    samples.add(body_.domain, point);
    rest_.row(u) = point.cast<float>();
  }
  MatrixF psi(count, basis_->size());
  if (auto done = basis_->evaluate<float>(samples, psi); !done) return done.error();
  surface_ranges_ = ColumnRanges::of(psi);
  frame_kernel_ = std::make_unique<FrameKernel>(rest_, psi, options_.precision);
  const Index edges = edge_rows_.rows();
  const double products = static_cast<double>(count) * static_cast<double>(edges * edge_rows_.cols());
  if (edges < basis_->size() && products < most_handle_products) psi_ = std::move(psi);

  displacement_ = PointsF::Zero(count, 3);
  deformed_ = rest_;
  rest_normals_.resize(count, 3);
  deformed_normals_.resize(count, 3);
  vertex_normals(rest_, welded_triangles_, rest_normals_);
  return Done{};
}

// ---- handles ----------------------------------------------------------------------------------------------------------------

Result<Done> Irbf::set_handles(const ConstPoints& handles, const std::vector<HandleKind>& kinds) {
  auto constraints = HandleConstraints::create(body_, *basis_, surface_, handles, kinds, structure_radius_);
  if (!constraints) return constraints.error();
  const Index repeated = constraints->repeated();
  if (options_.constraints == ConstraintKind::hard && repeated >= 0) {
    return Error(HB_ERROR_HANDLE_CONFLICT,
                 {"Handle ", repeated, " sits where another one does; hard constraints take one a point."},
                 {"Remove one of the two, or use soft constraints."}, HB_CULPRIT_HANDLE, repeated);
  }
  ReducedSystem system;
  if (!kinds.empty()) {
    auto made = make_reduced_system(edge_rows_, gram_, constraints->rows(), options_.anchor_weight, options_.constraints);
    if (!made) return made.error();
    system = std::move(*made);
  }
  handle_kernel_ = make_handle_kernel(system);
  by_handles_ = false;
  right_hand_side_.resize(system.inverse.cols(), 3);
  constraints_ = std::move(*constraints);
  system_ = std::move(system);
  targets_ = constraints_.rest(handles);
  work_.targets = work_.displacements = constraints_.points();
  work_.solution.resize(system_.inverse.rows(), 3);
  work_.missed.resize(constraints_.rows().rows(), 3);
  work_.solved_targets.clear();
  work_.solved_targets.reserve(targets_.size());
  if (!kinds.empty()) local_global_->set_system(system_.hat);
  return Done{};
}

/** The other product of the appendix, N × (3B + K) instead of N × C, where it is the smaller one and quickly made: few spheres,
 *  many centers. It depends on the handles: for 173,000 vertices, 400 centers and 79 spheres (the paper's Armadillo) each set of
 *  handles takes 17 billion multiplications, seconds, where the 16-bit product with Ψ itself takes five milliseconds per frame. */
std::unique_ptr<FrameKernel> Irbf::make_handle_kernel(const ReducedSystem& system) const {
  const Index columns = system.inverse.cols(), centers = basis_->size(), count = psi_.rows();
  const double products = static_cast<double>(count) * static_cast<double>(columns * (4 + centers));
  if (count == 0 || columns >= centers || products >= most_handle_products) return nullptr;
  MatrixF matrix(count, columns);
  MatrixXd parameters(std::min(count, vertices_at_once), 4 + centers);  // [x 1 Ψ], some vertices of it
  for (Index first = 0; first < count; first += vertices_at_once) {
    const Index some = std::min(vertices_at_once, count - first);
    parameters.topLeftCorner(some, 3) = rest_.middleRows(first, some).cast<double>();
    parameters.col(3).setOnes();
    parameters.topRightCorner(some, centers) = psi_.middleRows(first, some).cast<double>();
    matrix.middleRows(first, some) = product(parameters.topRows(some), system.inverse).cast<float>();
  }
  return std::make_unique<FrameKernel>(rest_, matrix, options_.precision);
}

// ---- solving ----------------------------------------------------------------------------------------------------------------

Result<SolveReport> Irbf::solve(const SolveOptions& options) {
  if (handle_count() == 0) {
    return Error(HB_ERROR_HANDLES_MISSING, {"There are no handles to solve for."}, {"Set at least one handle first."});
  }
  if (auto read = constraints_.read_targets(targets_.data(), body_.normalization, work_.targets); !read) return read.error();

  // Rigid motions do not change the energy, so the solve happens in a frame that is carried along rigidly with the handles: the
  // unknown there is only the deformation, and it is exactly zero when the handles move rigidly.
  const Points& points = constraints_.points();
  const RigidMotion frame = closest_rigid_motion(points, work_.targets);
  const Matrix3& turn = frame.rotation;
  LocalGlobal& iteration = *local_global_;
  if (work_.solved_targets != targets_) {
    for (Index i = 0; i < points.rows(); ++i) {
      const Vector3 local = turn.transpose() * (work_.targets.row(i).transpose() - frame.to) + frame.from;
      work_.displacements.row(i) = local.transpose() - points.row(i);
    }
    constraints_.right_hand_side(work_.displacements, system_.weight, iteration.constraints());

    // Start from the last rotations, unless carrying the rest shape along rigidly is clearly better.
    std::vector<Matrix3>& rotations = iteration.rotations();
    std::fill(rotations.begin(), rotations.end(), Matrix3::Identity());
    double energy = iteration.energy(rotations);
    if (solved_) {
      for (std::size_t b = 0; b < rotations_.size(); ++b) work_.warm[b] = turn.transpose() * rotations_[b];
      const double warm_energy = iteration.energy(work_.warm);
      const bool warm = warm_energy < 2 * energy;
      if (warm) rotations.swap(work_.warm);
      energy = warm ? warm_energy : iteration.energy(rotations);
    }
    iteration.start(energy);
    work_.solved_targets = targets_;
  }
  const LocalGlobalReport done = iteration.run({options.max_iterations, options.tolerance, options.accelerate});

  for (Index axis = 0; axis < 3; ++axis) {
    work_.solution.col(axis).noalias() = system_.inverse * iteration.right_hand_side().col(axis);
    work_.missed.col(axis).noalias() = constraints_.rows() * work_.solution.col(axis);
  }
  work_.missed -= iteration.constraints() / system_.weight;
  linear_ = turn * (Matrix3::Identity() + work_.solution.topRows<3>().transpose()) - Matrix3::Identity();
  translation_ = frame.to + turn * (work_.solution.row(3).transpose() - frame.from);
  coefficients_.noalias() = work_.solution.bottomRows(basis_->size()) * turn.transpose();
  for (std::size_t b = 0; b < rotations_.size(); ++b) rotations_[b] = turn * iteration.rotations()[b];
  solved_ = true;
  by_handles_ = handle_kernel_ != nullptr;
  if (by_handles_) {
    carried_linear_ = turn - Matrix3::Identity();
    carried_translation_ = frame.to - turn * frame.from;
    right_hand_side_.noalias() = iteration.right_hand_side() * turn.transpose();
  }

  SolveReport report;
  report.energy = std::max(done.energy, 0.0);
  report.anchor_error = constraints_.largest_miss(work_.missed) * body_.normalization.diagonal;
  report.change = done.change;
  report.iterations = done.iterations;
  report.converged = done.converged;
  return report;
}

// ---- deforming --------------------------------------------------------------------------------------------------------------

void Irbf::deform(float* positions, const float* rest_normals, float* normals) {
  if (by_handles_) {
    handle_kernel_->apply(carried_linear_, carried_translation_, right_hand_side_, displacement_);
  } else {
    frame_kernel_->apply(linear_, translation_, coefficients_, displacement_);
  }
  const auto diagonal = static_cast<float>(body_.normalization.diagonal);
  const float *stored = stored_.data(), *displacement = displacement_.data();
  const Index count = vertex_count();
  for (Index v = 0; v < count; ++v) {
    const float* moved = displacement + 3 * weld_.to_unique[v];
    for (Index axis = 0; axis < 3; ++axis) positions[3 * v + axis] = stored[3 * v + axis] + diagonal * moved[axis];
  }
  if (normals == nullptr) return;

  deformed_ = rest_ + displacement_;
  vertex_normals(deformed_, welded_triangles_, deformed_normals_);
  Eigen::Map<PointsF> out_normals(normals, vertex_count(), 3);
  for (Index v = 0; v < vertex_count(); ++v) {
    const Index u = weld_.to_unique[v];
    const Eigen::Vector3f to = deformed_normals_.row(u);
    if (rest_normals == nullptr) {
      out_normals.row(v) = to;
      continue;
    }
    // An authored normal turns as the area-weighted one does, by the smallest rotation.
    const Eigen::Vector3f from = rest_normals_.row(u);
    const Eigen::Vector3f authored = Eigen::Map<const PointsF>(rest_normals, vertex_count(), 3).row(v);
    const Eigen::Vector3f axis = from.cross(to);
    const float cosine = from.dot(to);
    const Eigen::Vector3f turned = axis.cross(authored);
    out_normals.row(v) = cosine > -0.999f ? Eigen::Vector3f(authored + turned + axis.cross(turned) / (1 + cosine)) : to;
  }
}

Result<Points> Irbf::evaluate(const ConstPoints& points) const {
  const Points solver = (points.rowwise() - body_.normalization.center.transpose()) / body_.normalization.diagonal;
  InteriorSamples samples;
  for (Index i = 0; i < solver.rows(); ++i) samples.add(body_.domain, solver.row(i).transpose());
  Matrix phi = Matrix::Zero(solver.rows(), basis_->size());
  if (auto done = basis_->evaluate<double>(samples, phi); !done) return done.error();
  Points displacements = solver * linear_.transpose() + product(phi, coefficients_);
  displacements.rowwise() += translation_.transpose();
  Points deformed = points + body_.normalization.diagonal * displacements;
  return deformed;
}

Result<Quality> Irbf::quality(const Eigen::Ref<const Tetrahedra>& tetrahedra) {
  const double diagonal = body_.normalization.diagonal;
  if (!voxel_quality_) {
    auto made = VoxelQuality::create(body_, *basis_, surface_ranges_);
    if (!made) return made.error();
    voxel_quality_ = std::move(*made);
  }
  Quality quality = voxel_quality_->measure(linear_, translation_, coefficients_, diagonal);
  const double inside = static_cast<double>(body_.domain.size()) * std::exp(3 * std::log(body_.domain.grid().spacing * diagonal));
  const double at_rest = enclosed_volume(body_.positions, body_.triangles);
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
    quality = measure_tetrahedra(tetrahedra, body_.positions, deformed);
    quality.maximum_principle = principle;
  } else if (std::abs(at_rest) > 0.5 * inside && std::abs(at_rest) < 2 * inside) {
    // Where the surface is closed and oriented, it gives the volume better than voxels; soup and clouds are neither.
    quality.volume_ratio = enclosed_volume(deformed, body_.triangles) / at_rest;
  }
  return quality;
}

}  // namespace handlebody
