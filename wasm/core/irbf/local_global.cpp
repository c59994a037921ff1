// Compiled with -O3: see CMakeLists.txt.
#include "core/irbf/local_global.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/closest_rotation.hpp"

namespace handlebody {

namespace {

constexpr Index window = 20;
/** A step may raise the energy by rounding. */
constexpr double rounding = 1e-12;
/** A sphere that shrinks to nothing could not turn any more. */
constexpr double least_scale = 1e-3;
/** One that is nothing at rest keeps its size: there is nothing to tell another by. */
constexpr double least_square = 1e-200;
/** And one that is hardly more has no volume to speak of: the cube of this is a number still. */
constexpr double least_volume_square = 1e-90;
/** Where not even this part of a plain step lowers the energy, nothing does. */
constexpr double least_part = 1e-4;
/** Iterations after which the Hessian is made again. */
constexpr int renewed_after = 15;

// Of 3×3 matrices, compiled once: inlined they are half of this file. A sphere's edges are the rows of one.

[[gnu::noinline]] Matrix3 times(const Matrix3& a, const Matrix3& b) {
  return a * b;
}
[[gnu::noinline]] Matrix3 transposed_times(const Matrix3& a, const Matrix3& b) {
  return a.transpose() * b;
}

[[gnu::noinline]] Matrix3 three(const Points& rows, Index sphere) {
  return rows.middleRows<3>(3 * sphere);
}
[[gnu::noinline]] Matrix3 three(const Columns3& rows, Index sphere) {
  return rows.middleRows<3>(3 * sphere);
}

[[gnu::noinline]] Matrix3 mapped_rows(const Matrix3& edges, const Matrix3& map) {
  return edges * map.transpose();
}

}  // namespace

LocalGlobal::LocalGlobal(Points edges, Vector edge_scale, SphereFit fit, double volume)
    : fit_(fit),
      volume_(fit == SphereFit::rigid ? volume : 0),
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
      trial_(maps_),
      inverse_grams_(volume_ > 0 ? maps_.size() : 0),
      strains_(inverse_grams_.size()),
      turns_(inverse_grams_.size()),
      held_(Vector::Zero(std::ssize(inverse_grams_))),
      pressure_(held_) {
  measure();
}

LocalGlobal::LocalGlobal(LocalGlobal&&) noexcept = default;
LocalGlobal& LocalGlobal::operator=(LocalGlobal&&) noexcept = default;
LocalGlobal::~LocalGlobal() = default;

void LocalGlobal::set_system(const MatrixXd& hat) {
  hat_ = &hat;
  hessian_ = RotationHessian(edges_, hat, fit_, volume_);
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
  for (Index b = 0; b < std::ssize(inverse_grams_); ++b) {
    const Matrix3 edges = three(shaped_, b);
    inverse_grams_[b] = squares_[b] > least_volume_square ? Matrix3(transposed_times(edges, edges).inverse()) : Matrix3::Identity();
  }
}

/** R (I + q RᵀC W G⁻¹) with C = cof F, W a third of Σ w‖S e‖² and G the edges' Gram matrix, which is W for edges as long as each
 *  other: where q = −κ (J − 1), edges that aim there have the energy's gradient. */
Matrix3 LocalGlobal::pressed(const Matrix3& turn, double pressure, Index sphere) const {
  const double third = squares_[sphere] / 3;
  return turn + pressure * third * times(turn, times(strains_[sphere].cofactor, inverse_grams_[sphere]));
}

/** What the energy has beyond the least squares' one for these maps; takes the strains for the image. */
double LocalGlobal::volume_energy(const std::vector<Matrix3>& maps) {
  double energy = 0;
  for (Index b = 0; b < std::ssize(strains_); ++b) {
    const Matrix3 moved = three(image_, b) + three(edges_, b), edges = three(shaped_, b);
    Strain& strain = strains_[b];
    // F is exact for what is affine there, and the least squares' one otherwise.
    strain = strain_of(times(transposed_times(moved, edges), inverse_grams_[b]));
    const Matrix3 mapped = mapped_rows(edges, maps[b]), turned = mapped_rows(edges, strain.turn);
    energy += (mapped - turned).cwiseProduct(2 * moved - mapped - turned).sum();
    energy += volume_ * squares_[b] / 3 * strain.growth * strain.growth;
  }
  return energy;
}

double LocalGlobal::energy(const std::vector<Matrix3>& maps) {
  // What is solved for are displacements: √w (M_b S − I) e.
  for (Index i = 0; i < edges_.rows(); ++i) {
    const Vector3 mapped = maps[i / 3] * shaped_.row(i).transpose();
    for (Index axis = 0; axis < 3; ++axis) right_hand_side_(i, axis) = mapped[axis] - edges_(i, axis);
  }
  for (Index axis = 0; axis < 3; ++axis)
    image_.col(axis).noalias() = hat_->selfadjointView<Eigen::Lower>() * right_hand_side_.col(axis);
  return right_hand_side_.cwiseProduct(right_hand_side_ - image_).sum() + volume_energy(maps);
}

void LocalGlobal::start(double energy) {
  energy_ = energy;
  displaced_ = image_.topRows(edges_.rows());
  anderson_.forget();
  age_ = 0;
  patience_ = renewed_after;
  renewed_ = false;
  newton_ = !hessian_.empty();
  plain_part_ = 1;
  stalled_ = false;
  accelerated_ = true;  // at rest or warm, the quasi-Newton step is the better first one, too
}

/** Procrustes, eq. (12), and where spheres may grow the scale that goes with the rotation: tr(Rᵀ H)/Σ w‖S e‖². */
Matrix3 LocalGlobal::closest_map(const Matrix3& covariance, Index sphere) const {
  Matrix3 map = closest_rotation(covariance);
  if (fit_ == SphereFit::similarity && squares_[sphere] > least_square)
    map *= std::max(map.cwiseProduct(covariance).sum() / squares_[sphere], least_scale);
  return map;
}

/** The local step for every sphere. Where volume is resisted, the part of it that lowers the energy: it goes against the energy's
 *  gradient, preconditioned by the global step. */
void LocalGlobal::plain_step(std::vector<Matrix3>& maps) const {
  for (Index b = 0; b < std::ssize(maps); ++b) {
    if (volume_ > 0) {
      const Matrix3 aim = pressed(strains_[b].turn, -volume_ * strains_[b].growth, b);
      maps[b] = maps_[b] + plain_part_ / (1 + 3 * volume_) * (aim - maps_[b]);
      continue;
    }
    maps[b] = closest_map(transposed_times(three(displaced_, b) + three(edges_, b), three(shaped_, b)), b);
  }
}

/** For the maps at hand, whose right-hand side and image are up to date. */
void LocalGlobal::renew_hessian() {
  age_ = 0;
  if (hessian_.empty()) return;
  residual_ = right_hand_side_ - image_;
  std::vector<Matrix3> turns(maps_.size());
  for (Index b = 0; b < std::ssize(maps_); ++b) {
    turns[b] = closest_rotation(maps_[b]);
    mapped_.middleRows<3>(3 * b) = mapped_rows(three(shaped_, b), maps_[b]);
  }
  if (!hessian_.renew(mapped_, *hat_, residual_, turns)) return;
  newton_ = renewed_ = true;
  anderson_.forget();
}

void LocalGlobal::quasi_newton_step() {
  residual_ = right_hand_side_ - image_;
  if (volume_ == 0) {
    hessian_.step(shaped_, residual_, maps_, trial_);
    return;
  }
  for (Index b = 0; b < std::ssize(maps_); ++b) {
    const Matrix3& cofactor = strains_[b].cofactor;
    turns_[b] = closest_rotation(maps_[b]);
    const Matrix3 stretch = transposed_times(turns_[b], maps_[b]) - Matrix3::Identity();
    mapped_.middleRows<3>(3 * b) = mapped_rows(three(shaped_, b), maps_[b]);
    // The pressure of the map at hand, which acceleration may have taken anywhere.
    const double pressure = stretch.cwiseProduct(cofactor).sum() / std::max(cofactor.squaredNorm(), 1e-6);
    pressure_[b] = -squares_[b] / 3 * (strains_[b].growth + pressure / volume_);
    held_[b] = pressure;
  }
  hessian_.step(mapped_, residual_, turns_, pressure_, trial_);
  for (Index b = 0; b < std::ssize(maps_); ++b) trial_[b] = pressed(trial_[b], held_[b] + pressure_[b], b);
}

/** A step from maps_, whose right-hand side and image are up to date, quasi-Newton's until that raised the energy. Anderson
 * acceleration combines mapped edges, from which closest maps make a step again. */
void LocalGlobal::accelerated_step() {
  if (newton_) {
    quasi_newton_step();
  } else {
    plain_step(trial_);
  }
  for (Index b = 0; b < std::ssize(maps_); ++b) {
    const Matrix3 edges = three(shaped_, b);
    mapped_.middleRows<3>(3 * b) = mapped_rows(edges, maps_[b]);
    stepped_.middleRows<3>(3 * b) = mapped_rows(edges, trial_[b]);
  }
  anderson_.accelerate(mapped_.data(), stepped_.data(), stepped_.data());
  for (Index b = 0; b < std::ssize(maps_); ++b) {
    const Matrix3 covariance = transposed_times(three(stepped_, b), three(shaped_, b));
    trial_[b] = volume_ > 0 ? times(covariance, inverse_grams_[b]) : closest_map(covariance, b);
  }
}

LocalGlobalReport LocalGlobal::run(const LocalGlobalOptions& options) {
  LocalGlobalReport report;
  report.converged = stalled_;
  while (report.iterations < options.max_iterations && !report.converged) {
    ++report.iterations;
    // The step is taken here and not at the end of the last iteration, since a frame may have only one.
    const bool accelerated = options.accelerate && accelerated_;
    if (options.accelerate && ++age_ > patience_) renew_hessian();
    if (accelerated) {
      accelerated_step();
    } else {
      plain_step(trial_);
    }
    const double energy = this->energy(trial_);
    if ((accelerated || volume_ > 0) && !(energy <= energy_ + rounding * std::abs(energy_))) {
      // The step raised the energy: a plain one cannot, or where volume is resisted a short one.
      if (!accelerated) plain_part_ /= 4;
      if (accelerated && newton_) {
        newton_ = false;
        anderson_.forget();
        if (renewed_) patience_ *= 2;  // it does not pay off here
      }
      accelerated_ = false;
      this->energy(maps_);  // their right-hand side and image again
      stalled_ = report.converged = plain_part_ < least_part;
      continue;
    }
    plain_part_ = 1;
    energy_ = energy;
    maps_.swap(trial_);
    if (!std::isfinite(energy)) break;  // beyond numbers: nothing gets better from there
    const auto moved = image_.topRows(edges_.rows()) - displaced_;
    report.change = std::sqrt((moved.rowwise().squaredNorm().array() * edge_scale_.array().square()).maxCoeff());
    // A local step goes only a part of its way where volume is resisted.
    report.converged = report.change * (accelerated && newton_ ? 1 : 1 + 3 * volume_) < options.tolerance;
    displaced_ = image_.topRows(edges_.rows());
    accelerated_ = true;
  }
  report.energy = energy_;
  return report;
}

}  // namespace handlebody
