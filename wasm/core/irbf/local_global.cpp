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
/** A sphere that shrinks to nothing could not turn any more. */
constexpr double least_scale = 1e-3;
/** One that is nothing at rest keeps its size: there is nothing to tell another by. */
constexpr double least_square = 1e-200;

}  // namespace

LocalGlobal::LocalGlobal(Points edges, Vector edge_scale, SphereFit fit)
    : fit_(fit),
      edges_(std::move(edges)),
      shaped_(edges_),
      squares_(edges_.rows() / 3),
      edge_scale_(std::move(edge_scale)),
      anderson_(3 * edges_.rows(), window),
      displaced_(Columns3::Zero(edges_.rows(), 3)),
      mapped_(displaced_),
      stepped_(displaced_),
      unshaped_(edges_.rows() / 3, Matrix3::Identity()),
      maps_(unshaped_),
      trial_(maps_) {
  measure();
}

LocalGlobal::LocalGlobal(LocalGlobal&&) noexcept = default;
LocalGlobal& LocalGlobal::operator=(LocalGlobal&&) noexcept = default;
LocalGlobal::~LocalGlobal() = default;

void LocalGlobal::set_system(const MatrixXd& hat) {
  hat_ = &hat;
  hessian_ = RotationHessian(edges_, hat, fit_);
  right_hand_side_ = image_ = residual_ = Columns3::Zero(hat.rows(), 3);
}

void LocalGlobal::shape(const double* shapes) {
  for (Index b = 0; b < squares_.size(); ++b) {
    Matrix3 covariance = Matrix3::Zero();  // Σ e (S e)ᵀ
    for (Index i = 3 * b; i < 3 * b + 3; ++i)
      for (Index row = 0; row < 3; ++row) {
        double sum = 0;
        for (Index k = 0; k < 3; ++k) sum += shapes[9 * b + 3 * row + k] * edges_(i, k);
        shaped_(i, row) = sum;
        for (Index k = 0; k < 3; ++k) covariance(k, row) += edges_(i, k) * sum;
      }
    unshaped_[b] = closest_rotation(covariance);
    // What only stretches turns nothing, by rounding either.
    if ((unshaped_[b] - Matrix3::Identity()).squaredNorm() < rounding * rounding) unshaped_[b].setIdentity();
  }
  measure();
}

void LocalGlobal::rest(double scale) {
  for (std::size_t b = 0; b < maps_.size(); ++b) maps_[b] = scale * unshaped_[b];
}

void LocalGlobal::measure() {
  for (Index b = 0; b < squares_.size(); ++b) squares_[b] = 0;
  for (Index i = 0; i < shaped_.size(); ++i) squares_[i / 9] += shaped_.data()[i] * shaped_.data()[i];
}

double LocalGlobal::energy(const std::vector<Matrix3>& maps) {
  // What is solved for are displacements: √w (M_b S − I) e.
  for (Index i = 0; i < edges_.rows(); ++i) {
    const Vector3 mapped = maps[i / 3] * shaped_.row(i).transpose();
    for (Index axis = 0; axis < 3; ++axis) right_hand_side_(i, axis) = mapped[axis] - edges_(i, axis);
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

/** Procrustes, eq. (12), and where spheres may grow the scale that goes with the rotation: tr(Rᵀ H)/Σ w‖S e‖². */
Matrix3 LocalGlobal::closest_map(const Matrix3& covariance, Index sphere) const {
  Matrix3 map = closest_rotation(covariance);
  if (fit_ == SphereFit::similarity && squares_[sphere] > least_square)
    map *= std::max(map.cwiseProduct(covariance).sum() / squares_[sphere], least_scale);
  return map;
}

/** The local step for every sphere. */
void LocalGlobal::plain_step(std::vector<Matrix3>& maps) const {
  for (Index b = 0; b < std::ssize(maps); ++b) {
    const Matrix3 moved = displaced_.middleRows<3>(3 * b) + edges_.middleRows<3>(3 * b);
    maps[b] = closest_map(moved.transpose() * shaped_.middleRows<3>(3 * b), b);
  }
}

/** A step from maps_, whose right-hand side and image are up to date. Anderson acceleration combines mapped edges, from which
 * closest maps make a step again. */
void LocalGlobal::accelerated_step() {
  if (hessian_.empty()) {
    plain_step(trial_);
  } else {
    residual_ = right_hand_side_ - image_;
    hessian_.step(shaped_, residual_, maps_, trial_);
  }
  for (Index b = 0; b < std::ssize(maps_); ++b) {
    const auto edges = shaped_.middleRows<3>(3 * b);
    mapped_.middleRows<3>(3 * b).noalias() = edges * maps_[b].transpose();
    stepped_.middleRows<3>(3 * b).noalias() = edges * trial_[b].transpose();
  }
  anderson_.accelerate(mapped_.data(), stepped_.data(), stepped_.data());
  for (Index b = 0; b < std::ssize(maps_); ++b)
    trial_[b] = closest_map(stepped_.middleRows<3>(3 * b).transpose() * shaped_.middleRows<3>(3 * b), b);
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
      this->energy(maps_);  // their right-hand side and image again
      continue;
    }
    energy_ = energy;
    maps_.swap(trial_);
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
