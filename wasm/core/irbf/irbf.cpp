#include "core/irbf/irbf.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace handlebody {

namespace {

/** Two handles share a place, or a target, when closer than this part of the diagonal. */
constexpr double same_place = 1e-9;
constexpr Index most_handles = 1024;
constexpr double most_bytes = 1.5e9;

/** Points of the minimal structure of a sphere (Fig. 7a): the ends of three perpendicular edges, −x +x −y +y −z +z. */
Vector3 structure_point(const Vector3& center, double radius, Index i) {
  Vector3 point = center;
  point(i / 2) += i % 2 == 0 ? -radius : radius;
  return point;
}

Error invalid_option(const char* name, double value, const char* remedy) {
  return {HB_ERROR_INVALID_OPTION, {"IRBF's ", name, " is ", value, "."}, {remedy}, HB_CULPRIT_OPTION};
}

/** Rows that handles add to Z: one for the position, three more edges for the rotation. */
Index constraint_count(const std::vector<HandleKind>& kinds) {
  Index count = 0;
  for (const HandleKind kind : kinds) count += kind == HandleKind::rotation ? 4 : 1;
  return count;
}

Result<Done> check_options(const IrbfOptions& options) {
  if (!(options.relative_width > 0) || !std::isfinite(options.relative_width)) {
    return invalid_option("relative width", options.relative_width, "Use a positive number, such as 2.");
  }
  if (!(options.smoothness >= 1e-12) || !(options.smoothness <= 1e6)) {
    return invalid_option("smoothness", options.smoothness, "Use a number from 1e-12 to 1e6, such as 1e-6.");
  }
  if (!(options.anchor_weight > 0) || !(options.anchor_weight <= 1e6)) {
    return invalid_option("anchor weight", options.anchor_weight, "Use a positive number up to 1e6, such as 100.");
  }
  if (!std::isfinite(options.edge_exponent) || std::abs(options.edge_exponent) > 4) {
    return invalid_option("edge exponent", options.edge_exponent, "Use a number from -4 to 4, such as -1.");
  }
  return Done{};
}

}  // namespace

Result<std::unique_ptr<Irbf>> Irbf::create(Body body, const IrbfOptions& options) {
  if (auto checked = check_options(options); !checked) return checked.error();
  if (auto checked = check_body(body); !checked) return checked.error();
  const auto centers = static_cast<double>(body.centers.size());
  const auto spheres = static_cast<double>(body.spheres.size());
  const double bytes = 4 * centers * static_cast<double>(body.positions.rows()) + 8 * (centers + 4) * (centers + 4 + 9 * spheres) +
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
  irbf->surface_ = std::make_unique<TriangleTree>(irbf->body_.solver_positions(), irbf->body_.triangles);
  irbf->basis_ = std::make_unique<Basis>(irbf->body_, options.kernel, options.relative_width);
  irbf->prepare_spheres();
  irbf->prepare_vertices();
  return irbf;
}

void Irbf::prepare_spheres() {
  const Index spheres = static_cast<Index>(body_.spheres.size());
  const Index centers = basis_->size();
  InteriorSamples samples;
  for (const Sphere& sphere : body_.spheres) {
    for (Index i = 0; i < 6; ++i) samples.add(body_.domain, structure_point(sphere.center, sphere.radius, i));
  }
  Matrix phi(samples.size(), centers);
  basis_->evaluate<double>(samples, phi);

  edges_.resize(3 * spheres, 3);
  edge_scale_.resize(3 * spheres);
  edge_rows_ = MatrixXd::Zero(3 * spheres, 4 + centers);
  for (Index row = 0; row < 3 * spheres; ++row) {
    const Vector3 edge = samples.point(2 * row + 1) - samples.point(2 * row);
    // Eq. (8) squares a residual that is weighted by w = ‖e‖^α, so every row carries √w.
    const double root = std::exp(options_.edge_exponent / 2 * std::log(edge.norm()));  // std::pow is 4 kB of tables
    edges_.row(row) = root * edge;
    edge_scale_(row) = 1 / root;
    edge_rows_.row(row).head<3>() = root * edge;
    edge_rows_.row(row).tail(centers) = root * (phi.row(2 * row + 1) - phi.row(2 * row));
  }
  gram_ = MatrixXd::Zero(4 + centers, 4 + centers);
  add_gram(edge_rows_, gram_);
  gram_.diagonal().tail(centers).array() += options_.smoothness;

  rotations_.assign(static_cast<std::size_t>(spheres), Matrix3::Identity());
  coefficients_ = Matrix::Zero(centers, 3);
  // A rotation handle grips a ball about as large as the smaller spheres.
  double radii = 0;
  for (const Sphere& sphere : body_.spheres) radii += sphere.radius;
  structure_radius_ = 0.5 * radii / static_cast<double>(spheres);
}

void Irbf::prepare_vertices() {
  weld_ = weld_vertices(body_.positions);
  welded_triangles_ = weld_triangles(weld_, body_.triangles);
  stored_ = body_.positions.cast<float>();
  const Points solver = body_.solver_positions();
  const Index count = static_cast<Index>(weld_.unique.size());
  InteriorSamples samples;
  rest_.resize(count, 3);
  for (Index u = 0; u < count; ++u) {
    const Vector3 point = solver.row(weld_.unique[static_cast<std::size_t>(u)]);
    samples.add(body_.domain, point);
    rest_.row(u) = point.cast<float>();
  }
  MatrixF psi(count, basis_->size());
  basis_->evaluate<float>(samples, psi);
  frame_kernel_ = std::make_unique<FrameKernel>(rest_, psi);

  displacement_ = PointsF::Zero(count, 3);
  deformed_ = rest_;
  rest_normals_.resize(count, 3);
  deformed_normals_.resize(count, 3);
  vertex_normals(rest_, welded_triangles_, rest_normals_);
}

// ---- handles ----------------------------------------------------------------------------------------------------------------

Result<Points> Irbf::constraint_points(const ConstPoints& handles, const std::vector<HandleKind>& kinds) const {
  if (handles.rows() > most_handles) {
    return Error(HB_ERROR_INVALID_OPTION, {handles.rows(), " handles were given; the solver takes up to 1024."},
                 {"Use fewer handles."});
  }
  Index count = handles.rows();
  for (const HandleKind kind : kinds) count += kind == HandleKind::rotation ? 6 : 0;
  Points points(count, 3);
  Index row = 0;
  for (Index k = 0; k < handles.rows(); ++k) {
    if (!handles.row(k).allFinite()) {
      return Error(HB_ERROR_HANDLE_NOT_FINITE, {"Handle ", k, " has a coordinate that is not a finite number."},
                   {"Give x, y and z as ordinary numbers."}, HB_CULPRIT_HANDLE, k);
    }
    const Vector3 point = body_.normalization.to_solver(handles.row(k).transpose());
    // The surface itself counts as inside, and so does what a voxel blurs; a point cloud has voxels only.
    if (std::abs(surface_->winding_number(point)) <= 0.5 && surface_->distance(point) > body_.domain.grid().spacing &&
        (body_.domain.center(body_.domain.nearest(point)) - point).norm() > body_.domain.grid().spacing) {
      return Error(HB_ERROR_HANDLE_OUTSIDE, {"Handle ", k, " lies outside the model."},
                   {"Put it on a vertex or at a point inside the surface."}, HB_CULPRIT_HANDLE, k);
    }
    points.row(row++) = point;
    if (kinds[static_cast<std::size_t>(k)] != HandleKind::rotation) continue;
    for (Index i = 0; i < 6; ++i) points.row(row++) = structure_point(point, structure_radius_, i);
  }
  return points;
}

MatrixXd Irbf::constraint_rows(const Points& points, const std::vector<HandleKind>& kinds) const {
  const Index centers = basis_->size();
  InteriorSamples samples;
  for (Index i = 0; i < points.rows(); ++i) samples.add(body_.domain, points.row(i).transpose());
  Matrix phi(points.rows(), centers);
  basis_->evaluate<double>(samples, phi);

  MatrixXd rows = MatrixXd::Zero(constraint_count(kinds), 4 + centers);
  const double mu = options_.anchor_weight;
  Index row = 0, point = 0;
  for (const HandleKind kind : kinds) {
    rows.row(row).head<3>() = mu * points.row(point);
    rows(row, 3) = mu;
    rows.row(row++).tail(centers) = mu * phi.row(point++);
    if (kind != HandleKind::rotation) continue;
    for (Index edge = 0; edge < 3; ++edge, point += 2) {
      rows.row(row).head<3>() = mu * (points.row(point + 1) - points.row(point));
      rows.row(row++).tail(centers) = mu * (phi.row(point + 1) - phi.row(point));
    }
  }
  return rows;
}

Result<Done> Irbf::set_handles(const ConstPoints& handles, const std::vector<HandleKind>& kinds) {
  auto points = constraint_points(handles, kinds);
  if (!points) return points.error();

  Handles next;
  next.kinds = kinds;
  next.points = std::move(*points);
  next.same_as.assign(kinds.size(), -1);
  for (Index k = 1; k < handles.rows(); ++k) {
    for (Index other = 0; other < k; ++other) {
      const double apart = (handles.row(k) - handles.row(other)).norm();
      if (apart > same_place * body_.normalization.diagonal) continue;
      next.same_as[static_cast<std::size_t>(k)] = other;
      break;
    }
  }
  if (!kinds.empty()) {
    next.rows = constraint_rows(next.points, kinds);
    MatrixXd factor = gram_;
    add_gram(next.rows, factor);
    if (!factor_cholesky(factor)) {
      return Error(HB_ERROR_INTERNAL, {"The system of handles and spheres is not positive definite."},
                   {"Raise the smoothness, or move handles apart."});
    }
    MatrixXd solved(edge_rows_.rows() + next.rows.rows(), edge_rows_.cols());
    solved.topRows(edge_rows_.rows()) = edge_rows_;
    solved.bottomRows(next.rows.rows()) = next.rows;
    solve_cholesky(factor, solved);
    next.inverse = solved.transpose();
    next.reduced = product(edge_rows_, next.inverse);
  }
  handles_ = std::move(next);

  work_.targets = work_.displacements = handles_.points;
  work_.right_hand_side.resize(handles_.inverse.cols(), 3);
  work_.edges.resize(edges_.rows(), 3);
  work_.previous.resize(edges_.rows(), 3);
  work_.solution.resize(handles_.inverse.rows(), 3);
  work_.missed.resize(handles_.rows.rows(), 3);
  work_.rotations = work_.warm = rotations_;

  targets_.assign(kinds.size() * static_cast<std::size_t>(target_size), 0);
  for (Index k = 0; k < handles.rows(); ++k) {
    Eigen::Map<Eigen::Matrix<double, target_size, 1>> target(targets_.data() + k * target_size);
    target << handles.row(k).transpose(), 0, 0, 0, 1, 1, 1, 1;
  }
  return Done{};
}

// ---- solving ----------------------------------------------------------------------------------------------------------------

Result<Done> Irbf::read_targets() {
  Index row = 0;
  for (Index k = 0; k < handle_count(); ++k) {
    const Eigen::Map<const Eigen::Matrix<double, target_size, 1>> target(targets_.data() + k * target_size);
    const bool rotates = handles_.kinds[static_cast<std::size_t>(k)] == HandleKind::rotation;
    const Eigen::Quaterniond rotation(target(6), target(3), target(4), target(5));
    const bool finite = rotates ? target.allFinite() && rotation.norm() > 1e-9 : target.head<3>().allFinite();
    // A target far beyond any screen is a slip too, and its squares would overflow below.
    if (!finite || (target.head<3>() - body_.normalization.center).norm() > 1e6 * body_.normalization.diagonal) {
      return Error(HB_ERROR_TARGET_NOT_FINITE,
                   {"The target of handle ", k, (finite ? " is a million model sizes away." : " is not a finite number.")},
                   {"Give a position near the model and, for rotation handles, a unit quaternion and finite scales."},
                   HB_CULPRIT_HANDLE, k);
    }
    const Index other = handles_.same_as[static_cast<std::size_t>(k)];
    if (other >= 0) {
      const Eigen::Map<const Vector3> wanted(targets_.data() + other * target_size);
      if ((wanted - target.head<3>()).norm() > same_place * body_.normalization.diagonal) {
        return Error(HB_ERROR_HANDLE_CONFLICT, {"Handles ", other, " and ", k, " sit on one point but have different targets."},
                     {"Give both the same target, or remove one of them."}, HB_CULPRIT_HANDLE, k);
      }
    }
    const Vector3 place = body_.normalization.to_solver(target.head<3>());
    work_.targets.row(row++) = place;
    if (!rotates) continue;
    const Matrix3 turn = rotation.normalized().toRotationMatrix() * target.tail<3>().asDiagonal();
    for (Index i = 0; i < 6; ++i) {
      work_.targets.row(row++) = place + turn * structure_point(Vector3::Zero(), structure_radius_, i);
    }
  }
  return Done{};
}

/** The constraints' part of the right-hand side, from the displacements of the constraint points. */
void Irbf::set_constraint_targets() {
  const Points& moved = work_.displacements;
  const double mu = options_.anchor_weight;
  Index row = edges_.rows(), point = 0;
  for (const HandleKind kind : handles_.kinds) {
    work_.right_hand_side.row(row++) = mu * moved.row(point++);
    if (kind != HandleKind::rotation) continue;
    for (Index edge = 0; edge < 3; ++edge, point += 2) {
      work_.right_hand_side.row(row++) = mu * (moved.row(point + 1) - moved.row(point));
    }
  }
}

/** The spheres' part of the right-hand side: how far each rotation moves its edges. */
void Irbf::set_edge_targets(const std::vector<Matrix3>& rotations) {
  for (Index b = 0; b < static_cast<Index>(rotations.size()); ++b) {
    const Matrix3 turn = rotations[static_cast<std::size_t>(b)] - Matrix3::Identity();
    work_.right_hand_side.middleRows<3>(3 * b).noalias() = edges_.middleRows<3>(3 * b) * turn.transpose();
  }
}

/** Eq. (10) after a global step with the present right-hand side; leaves that step's solution in the workspace. */
double Irbf::energy() {
  multiply(handles_.inverse, work_.right_hand_side, work_.solution);
  multiply(edge_rows_, work_.solution, work_.edges);
  return (work_.edges - work_.right_hand_side.topRows(edges_.rows())).squaredNorm() +
         options_.smoothness * work_.solution.bottomRows(basis_->size()).squaredNorm();
}

/** Local/global iterations on the reduced matrix: displacements of edges in, rotations out; neither C nor N appears. */
void Irbf::iterate(int max_iterations, double tolerance, SolveReport& report) {
  work_.previous = edges_;
  while (report.iterations < max_iterations && !report.converged) {
    set_edge_targets(work_.rotations);
    multiply(handles_.reduced, work_.right_hand_side, work_.edges);
    work_.edges += edges_;
    for (Index b = 0; b < static_cast<Index>(work_.rotations.size()); ++b) {  // Procrustes, eq. (12)
      work_.rotations[static_cast<std::size_t>(b)] =
          closest_rotation(work_.edges.middleRows<3>(3 * b).transpose() * edges_.middleRows<3>(3 * b));
    }
    const auto moved = (work_.edges - work_.previous).rowwise().squaredNorm().array() * edge_scale_.array().square();
    report.change = std::sqrt(moved.maxCoeff());
    report.converged = ++report.iterations > 1 && report.change < tolerance;
    work_.edges.swap(work_.previous);
  }
}

/** Largest distance, model units, between a handle's image and its target under the workspace's solution. */
double Irbf::largest_miss() const {
  double largest = 0;
  Index row = 0;
  for (const HandleKind kind : handles_.kinds) {
    largest = std::max(largest, work_.missed.row(row).norm());
    row += kind == HandleKind::rotation ? 4 : 1;
  }
  return largest / options_.anchor_weight * body_.normalization.diagonal;
}

Result<SolveReport> Irbf::solve(int max_iterations, double tolerance) {
  if (handle_count() == 0) {
    return Error(HB_ERROR_HANDLES_MISSING, {"There are no handles to solve for."}, {"Set at least one handle first."});
  }
  if (auto read = read_targets(); !read) return read.error();

  // The energy does not change when the whole picture turns, so the solve happens in a frame that is carried along rigidly with the
  // handles: what is unknown there is only the deformation, and it is exactly zero when the handles move rigidly.
  const RigidMotion frame = closest_rigid_motion(handles_.points, work_.targets);
  const Matrix3& turn = frame.rotation;
  for (Index i = 0; i < handles_.points.rows(); ++i) {
    const Vector3 local = turn.transpose() * (work_.targets.row(i).transpose() - frame.to) + frame.from;
    work_.displacements.row(i) = local.transpose() - handles_.points.row(i);
  }
  set_constraint_targets();

  // Start from the last rotations, unless carrying the rest shape along rigidly is clearly better.
  std::fill(work_.rotations.begin(), work_.rotations.end(), Matrix3::Identity());
  set_edge_targets(work_.rotations);
  const double rigid_energy = energy();
  if (solved_) {
    for (std::size_t b = 0; b < rotations_.size(); ++b) work_.warm[b] = turn.transpose() * rotations_[b];
    set_edge_targets(work_.warm);
    if (energy() < 2 * rigid_energy) work_.rotations.swap(work_.warm);
  }

  SolveReport report;
  iterate(max_iterations, tolerance, report);

  set_edge_targets(work_.rotations);
  report.energy = energy();
  multiply(handles_.rows, work_.solution, work_.missed);
  work_.missed -= work_.right_hand_side.bottomRows(work_.missed.rows());
  report.anchor_error = largest_miss();
  linear_ = turn * (Matrix3::Identity() + work_.solution.topRows<3>().transpose()) - Matrix3::Identity();
  translation_ = frame.to + turn * (work_.solution.row(3).transpose() - frame.from);
  coefficients_ = work_.solution.bottomRows(basis_->size()).lazyProduct(turn.transpose());
  for (std::size_t b = 0; b < rotations_.size(); ++b) rotations_[b] = turn * work_.rotations[b];
  solved_ = true;
  return report;
}

// ---- deforming --------------------------------------------------------------------------------------------------------------

void Irbf::deform(float* positions, const float* rest_normals, float* normals) {
  frame_kernel_->apply(linear_, translation_, coefficients_, displacement_);
  const auto diagonal = static_cast<float>(body_.normalization.diagonal);
  Eigen::Map<PointsF> out(positions, vertex_count(), 3);
  for (Index v = 0; v < vertex_count(); ++v) {
    out.row(v) = stored_.row(v) + diagonal * displacement_.row(weld_.to_unique[static_cast<std::size_t>(v)]);
  }
  if (normals == nullptr) return;

  deformed_ = rest_ + displacement_;
  vertex_normals(deformed_, welded_triangles_, deformed_normals_);
  Eigen::Map<PointsF> out_normals(normals, vertex_count(), 3);
  for (Index v = 0; v < vertex_count(); ++v) {
    const Index u = weld_.to_unique[static_cast<std::size_t>(v)];
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

Points Irbf::evaluate(const ConstPoints& points) const {
  const Points solver = (points.rowwise() - body_.normalization.center.transpose()) / body_.normalization.diagonal;
  InteriorSamples samples;
  for (Index i = 0; i < solver.rows(); ++i) samples.add(body_.domain, solver.row(i).transpose());
  Matrix phi(solver.rows(), basis_->size());
  basis_->evaluate<double>(samples, phi);
  Points deformed = points;
  for (Index i = 0; i < solver.rows(); ++i) {
    Vector3 displacement = linear_ * solver.row(i).transpose() + translation_;
    for (Index c = 0; c < phi.cols(); ++c) displacement += phi(i, c) * coefficients_.row(c).transpose();
    deformed.row(i) += body_.normalization.diagonal * displacement.transpose();
  }
  return deformed;
}

}  // namespace handlebody
