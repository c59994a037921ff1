// Compiled with -O3: see CMakeLists.txt.
#include "core/irbf/local_global.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/closest_rotation.hpp"

namespace handlebody {

namespace {

constexpr Index window = 8;
/** A step may raise the energy by rounding. */
constexpr double rounding = 1e-12;

}  // namespace

LocalGlobal::LocalGlobal(Points edges, Vector edge_scale)
    : edges_(std::move(edges)),
      edge_scale_(std::move(edge_scale)),
      anderson_(3 * edges_.rows(), window),
      displaced_(Columns3::Zero(edges_.rows(), 3)),
      turned_(displaced_),
      stepped_(displaced_),
      rotations_(edges_.rows() / 3, Matrix3::Identity()),
      trial_(rotations_) {}

LocalGlobal::LocalGlobal(LocalGlobal&&) noexcept = default;
LocalGlobal& LocalGlobal::operator=(LocalGlobal&&) noexcept = default;
LocalGlobal::~LocalGlobal() = default;

void LocalGlobal::set_system(const MatrixXd& hat) {
  hat_ = &hat;
  hessian_ = RotationHessian(edges_, hat);
  right_hand_side_ = image_ = residual_ = Columns3::Zero(hat.rows(), 3);
}

double LocalGlobal::energy(const std::vector<Matrix3>& rotations) {
  // What is solved for are displacements: √w (M_b − I) e.
  for (Index b = 0; b < std::ssize(rotations); ++b) {
    const Matrix3 turn = rotations[b] - Matrix3::Identity();
    right_hand_side_.middleRows<3>(3 * b).noalias() = edges_.middleRows<3>(3 * b) * turn.transpose();
  }
  for (Index axis = 0; axis < 3; ++axis)
    image_.col(axis).noalias() = hat_->selfadjointView<Eigen::Lower>() * right_hand_side_.col(axis);
  return right_hand_side_.cwiseProduct(right_hand_side_ - image_).sum();
}

void LocalGlobal::start(double energy) {
  energy_ = energy;
  displaced_ = image_.topRows(edges_.rows());
  anderson_.forget();
  accelerated_ = true;  // at rest or warm, the quasi-Newton step is the better first one, too
}

/** The local step: Procrustes, eq. (12), for every sphere. */
void LocalGlobal::plain_step(std::vector<Matrix3>& rotations) const {
  for (Index b = 0; b < std::ssize(rotations); ++b) {
    const Matrix3 moved = displaced_.middleRows<3>(3 * b) + edges_.middleRows<3>(3 * b);
    rotations[b] = closest_rotation(moved.transpose() * edges_.middleRows<3>(3 * b));
  }
}

/** A step from rotations_, whose right-hand side and image are up to date. Anderson acceleration combines turned edges, from which
 * closest rotations make a step again. */
void LocalGlobal::accelerated_step() {
  if (hessian_.empty()) {
    plain_step(trial_);
  } else {
    residual_ = right_hand_side_ - image_;
    hessian_.step(edges_, residual_, rotations_, trial_);
  }
  for (Index b = 0; b < std::ssize(rotations_); ++b) {
    const auto edges = edges_.middleRows<3>(3 * b);
    turned_.middleRows<3>(3 * b).noalias() = edges * rotations_[b].transpose();
    stepped_.middleRows<3>(3 * b).noalias() = edges * trial_[b].transpose();
  }
  anderson_.accelerate(turned_.data(), stepped_.data(), stepped_.data());
  for (Index b = 0; b < std::ssize(rotations_); ++b) {
    trial_[b] = closest_rotation(stepped_.middleRows<3>(3 * b).transpose() * edges_.middleRows<3>(3 * b));
  }
}

LocalGlobalReport LocalGlobal::run(const LocalGlobalOptions& options) {
  LocalGlobalReport report;
  while (report.iterations < options.max_iterations && !report.converged) {
    ++report.iterations;
    // The step is taken here and not at the end of the last iteration, since a frame may have only one.
    const bool accelerated = options.accelerate && accelerated_;
    if (accelerated) {
      accelerated_step();
    } else {
      plain_step(trial_);
    }
    const double energy = this->energy(trial_);
    if (accelerated && !(energy <= energy_ * (1 + rounding))) {  // the step raised the energy: a plain one cannot
      accelerated_ = false;
      this->energy(rotations_);  // their right-hand side and image again
      continue;
    }
    energy_ = energy;
    rotations_.swap(trial_);
    const auto moved = image_.topRows(edges_.rows()) - displaced_;
    report.change = std::sqrt((moved.rowwise().squaredNorm().array() * edge_scale_.array().square()).maxCoeff());
    report.converged = report.change < options.tolerance;
    displaced_ = image_.topRows(edges_.rows());
    accelerated_ = true;
  }
  report.energy = energy_;
  return report;
}

}  // namespace handlebody
