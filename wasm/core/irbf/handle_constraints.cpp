#include "core/irbf/handle_constraints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace handlebody {

namespace {

/** Two handles share a place, or a target, when closer than this part of the diagonal. */
constexpr double same_place = 1e-9;
constexpr Index most_handles = 1024;
constexpr double farthest = 1e6;  // that a target may be, in diagonals, and its scales

/** Whether a point may carry a handle: inside, or so near to the surface that voxels cannot tell. Vertices always may. The surface
 * is used only where voxels do not decide: its tree takes longer to build than all else that handles need. */
bool is_near(const Body& body, std::unique_ptr<TriangleTree>& surface, const Vector3& point) {
  const double spacing = body.domain.grid().spacing;
  const std::int32_t voxel = body.domain.nearest(point);
  if (voxel >= 0 && (body.domain.center(voxel) - point).norm() <= spacing) return true;
  for (Index v = 0; v < body.positions.rows(); ++v)
    if ((body.normalization.to_solver(body.positions.row(v).transpose()) - point).norm() <= 1e-6 * spacing) return true;
  if (body.triangles.rows() == 0) return voxel >= 0 && (body.domain.center(voxel) - point).norm() <= 2 * spacing;
  if (!surface) surface = std::make_unique<TriangleTree>(body.solver_positions(), body.triangles);
  return std::abs(surface->winding_number(point)) > 0.5 || surface->distance(point) <= spacing;
}

}  // namespace

HandleConstraints::HandleConstraints() = default;
HandleConstraints::HandleConstraints(HandleConstraints&&) noexcept = default;
HandleConstraints& HandleConstraints::operator=(HandleConstraints&&) noexcept = default;
HandleConstraints::~HandleConstraints() = default;

Result<HandleConstraints> HandleConstraints::create(const Body& body, const Basis& basis, std::unique_ptr<TriangleTree>& surface,
                                                    const ConstPoints& places, const std::vector<HandleKind>& kinds,
                                                    double radius) {
  if (places.rows() > most_handles) {
    return Error(HB_ERROR_INVALID_OPTION, {places.rows(), " handles were given; the solver takes up to 1024."},
                 {"Use fewer handles."});
  }
  HandleConstraints constraints;
  constraints.kinds_ = kinds;
  constraints.radius_ = radius;
  Index points = 0, rows = 0;
  for (const HandleKind kind : kinds) {
    points += kind == HandleKind::rotation ? 7 : 1;
    rows += kind == HandleKind::rotation ? 4 : 1;
  }
  constraints.points_.resize(points, 3);
  Index next = 0;
  for (Index k = 0; k < places.rows(); ++k) {
    if (!places.row(k).allFinite()) {
      return Error(HB_ERROR_HANDLE_NOT_FINITE, {"Handle ", k, " has a coordinate that is not a finite number."},
                   {"Give x, y and z as ordinary numbers."}, HB_CULPRIT_HANDLE, k);
    }
    const Vector3 point = body.normalization.to_solver(places.row(k).transpose());
    if (!is_near(body, surface, point)) {
      return Error(HB_ERROR_HANDLE_OUTSIDE, {"Handle ", k, " lies outside the model."},
                   {"Put it on a vertex or at a point inside the surface."}, HB_CULPRIT_HANDLE, k);
    }
    constraints.points_.row(next++) = point;
    if (kinds[k] != HandleKind::rotation) continue;
    for (Index i = 0; i < 6; ++i) constraints.points_.row(next++) = structure_point(point, radius, i);
  }

  InteriorSamples samples;
  for (Index i = 0; i < points; ++i) samples.add(body.domain, constraints.points_.row(i).transpose());
  Matrix phi = Matrix::Zero(points, basis.size());
  if (auto done = basis.evaluate<double>(samples, phi); !done) return done.error();
  constraints.rows_ = MatrixXd::Zero(rows, 4 + basis.size());
  Index row = 0, point = 0;
  for (const HandleKind kind : kinds) {
    constraints.rows_.row(row).head<3>() = constraints.points_.row(point);
    constraints.rows_(row, 3) = 1;
    constraints.rows_.row(row++).tail(basis.size()) = phi.row(point++);
    if (kind != HandleKind::rotation) continue;
    for (Index edge = 0; edge < 3; ++edge, point += 2) {
      constraints.rows_.row(row).head<3>() = constraints.points_.row(point + 1) - constraints.points_.row(point);
      constraints.rows_.row(row++).tail(basis.size()) = phi.row(point + 1) - phi.row(point);
    }
  }

  constraints.same_as_.assign(kinds.size(), -1);
  for (Index k = 1; k < places.rows(); ++k) {
    for (Index other = 0; other < k; ++other) {
      if ((places.row(k) - places.row(other)).norm() > same_place * body.normalization.diagonal) continue;
      constraints.same_as_[k] = other;
      break;
    }
  }
  return constraints;
}

Index HandleConstraints::repeated() const {
  const auto found = std::find_if(same_as_.begin(), same_as_.end(), [](Index other) { return other >= 0; });
  return found == same_as_.end() ? -1 : found - same_as_.begin();
}

std::vector<double> HandleConstraints::rest(const ConstPoints& places) const {
  std::vector<double> targets(kinds_.size() * static_cast<std::size_t>(target_size), 0);
  for (Index k = 0; k < places.rows(); ++k) {
    Eigen::Map<Eigen::Matrix<double, target_size, 1>> target(targets.data() + k * target_size);
    target << places.row(k).transpose(), 0, 0, 0, 1, 1, 1, 1;
  }
  return targets;
}

Result<Done> HandleConstraints::read_targets(const double* targets, const Normalization& normalization, Points& moved) const {
  Index row = 0;
  for (Index k = 0; k < handles(); ++k) {
    const Eigen::Map<const Eigen::Matrix<double, target_size, 1>> target(targets + k * target_size);
    const bool rotates = kinds_[k] == HandleKind::rotation;
    const Eigen::Quaterniond rotation(target(6), target(3), target(4), target(5));
    const double length = rotation.norm();
    const bool finite = rotates ? target.allFinite() && std::isfinite(length) : target.head<3>().allFinite();
    if (rotates && finite && !(length > 1e-9))
      return Error(HB_ERROR_TARGET_NOT_FINITE, {"The rotation of handle ", k, " is (0, 0, 0, 0), which has no direction."},
                   {"Give a unit quaternion: (0, 0, 0, 1) does not turn."}, HB_CULPRIT_HANDLE, k);
    // A target far beyond any screen, or as large, is a mistake too, and its squares would overflow below.
    if (!finite || (target.head<3>() - normalization.center).norm() > farthest * normalization.diagonal ||
        (rotates && target.tail<3>().norm() > farthest)) {
      return Error(
          HB_ERROR_TARGET_NOT_FINITE,
          {"The target of handle ", k, (finite ? " is a million model sizes away, or as large." : " is not a finite number.")},
          {"Give a position near the model and, for rotation handles, a unit quaternion and finite scales."}, HB_CULPRIT_HANDLE, k);
    }
    const Index other = same_as_[k];
    if (other >= 0) {
      const Eigen::Map<const Vector3> wanted(targets + other * target_size);
      if ((wanted - target.head<3>()).norm() > same_place * normalization.diagonal) {
        return Error(HB_ERROR_HANDLE_CONFLICT, {"Handles ", other, " and ", k, " sit on one point but have different targets."},
                     {"Give both the same target, or remove one of them."}, HB_CULPRIT_HANDLE, k);
      }
    }
    const Vector3 place = normalization.to_solver(target.head<3>());
    moved.row(row++) = place;
    if (!rotates) continue;
    const Matrix3 turn = rotation.normalized().toRotationMatrix() * target.tail<3>().asDiagonal();
    for (Index i = 0; i < 6; ++i) moved.row(row++) = place + turn * structure_point(Vector3::Zero(), radius_, i);
  }
  return Done{};
}

void HandleConstraints::right_hand_side(const Points& displacements, double weight, Eigen::Ref<Columns3> out) const {
  Index row = 0, point = 0;
  for (const HandleKind kind : kinds_) {
    out.row(row++) = weight * displacements.row(point++);
    if (kind != HandleKind::rotation) continue;
    for (Index edge = 0; edge < 3; ++edge, point += 2)
      out.row(row++) = weight * (displacements.row(point + 1) - displacements.row(point));
  }
}

double HandleConstraints::largest_miss(const Columns3& missed) const {
  double largest = 0;
  Index row = 0;
  for (const HandleKind kind : kinds_) {
    largest = std::max(largest, missed.row(row).norm());
    row += kind == HandleKind::rotation ? 4 : 1;
  }
  return largest;
}

}  // namespace handlebody
