#include "core/distance/heat_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace handlebody {

namespace {

// Lengths in spacings. Measured in the box, the L and the ring of the tests, 64 voxels across: mean / largest error in percent at
// five spacings from the source or more (Dirichlet means no heat at the surface, half a spacing beyond the outermost centers):
//
//                                        t    box         L           ring
//   7-point,   Dirichlet                 0.2  0.00 / 1.7  0.12 / 4.4  1.5 / 9.7    taken
//   7-point,   Dirichlet                 0.5  0.00 / 3.8  0.40 / 8.0  1.0 / 9.3
//   7-point,   Dirichlet                 1    0.01 / 5.4  0.61 / 11   1.9 / 9.9
//   7-point,   Neumann                   0.2  0.66 / 2.6  1.0 / 3.4   3.2 / 9.8
//   7-point,   Neumann                   1    1.5 / 5.1   2.2 / 6.4   5.3 / 13
//   7-point,   mean of the two           0.2  0.13 / 1.6  0.39 / 2.9  2.7 / 9.6    a third factor
//   7-point,   mean of the two           1    0.50 / 3.1  1.0 / 4.1   4.0 / 12     Crane et al.'s advice
//   trilinear, Dirichlet                 0.2  0.03 / 4.9  0.22 / 7.3  1.1 / 7.5    27 entries a row instead of 7
//   trilinear, mean of the two           1    0.61 / 5.6  1.4 / 7.8   4.1 / 11
//   Kuhn tetrahedra, Dirichlet           0.5  0.01 / 6.8  0.67 / 10   2.2 / 9.2
//   Kuhn tetrahedra, Neumann             0.5  0.19 / 10   0.50 / 10   1.8 / 9.3
//
// The 7-point stencil is this good at short times because its waves travel straight: far from the source u ~ exp(−k·x) with
// Σ cosh kᵢ constant, and the k that arrives at x has sinh kᵢ ∝ xᵢ, which is what central differences give.
constexpr double heat_time = 0.2;
constexpr double ball_radius = 3.5;
constexpr double source_decay = 4;  // of the heat that the ball starts with; steeper than the flow's, so that it acts as one source
constexpr double part_cost = 2e8;   // multiplications per step
constexpr double most_bytes = 1.5 * 1024 * 1024 * 1024;

// Heat falls by a factor of up to 1e-1.2 per voxel, and leaves the range of double after some 250 of them. There the remaining heat
// is scaled up, and becomes the source of another flow.
constexpr double relay_high = 1e-240, relay_low = 1e-260, trusted = 1e-250;

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

Result<double> HeatDistance::step() {
  const auto factor = [](SparseCholesky& cholesky, const SparseMatrix& matrix, double before, double share, Phase& phase,
                         Phase next) {
    const double part = cholesky.factor_part(matrix, part_cost);
    if (part >= 1) phase = next;
    return before + share * std::max(part, 0.0);
  };
  if (domain_->size() == 0) return 1.0;
  switch (phase_) {
    case Phase::assemble:
      assemble();
      phase_ = Phase::order;
      return 0.05;
    case Phase::order:
      if (auto done = order_rows(); !done) return done.error();
      return 0.1;
    case Phase::factor_heat:
      return factor(*heat_, heat_matrix_, 0.1, 0.45, phase_, Phase::factor_poisson);
    case Phase::factor_poisson:
      return factor(*poisson_, poisson_matrix_, 0.55, 0.45, phase_, Phase::ready);
    default:
      return 1.0;
  }
}

/** With L of the differences between face neighbors: I + t (L + the losses at the surface), and L with one voxel of each connected
 *  part held at 0. The first is an M-matrix and heat is positive, so nothing cancels: even tiny heat keeps its digits. */
void HeatDistance::assemble() {
  neighbors_ = domain_->face_neighbors();
  components_ = face_components(*domain_);
  const Index count = domain_->size();
  SparseMatrix laplacian(count, count);
  laplacian.reserve(count + std::ssize(neighbors_));
  Vector heat_diagonal(count), poisson_diagonal(count);
  // Neighbors in ascending order of their numbers, the voxel itself in the middle.
  constexpr int ascending[7] = {4, 2, 0, -1, 1, 3, 5};
  std::int32_t parts = 0;
  for (Index v = 0; v < count; ++v) {
    double inside = 0;
    laplacian.startVec(v);
    for (const int side : ascending) {
      const Index u = side < 0 ? v : neighbors_[6 * v + side];
      if (u == count) continue;
      laplacian.insertBack(v, u) = -1;
      if (u != v) ++inside;
    }
    // The surface is half a spacing from the voxel: the conductance between them is 2.
    heat_diagonal[v] = 1 + heat_time * (inside + 2 * (6 - inside));
    const bool held = components_[v] == parts;  // the first voxel of its part
    if (held) ++parts;
    poisson_diagonal[v] = inside + (held ? 1 : 0);
  }
  laplacian.finalize();
  // Not by an expression: Eigen multiplies its rows and columns to reserve entries, which overflows where sizes have 32 bits.
  heat_matrix_ = laplacian;
  heat_matrix_ *= heat_time;
  heat_matrix_.diagonal() = heat_diagonal;
  poisson_matrix_.swap(laplacian);
  poisson_matrix_.diagonal() = poisson_diagonal;
}

Result<Done> HeatDistance::order_rows() {
  const Indices order = minimum_degree_order(heat_matrix_);
  auto heat = SparseCholesky::analyze(heat_matrix_, order, most_bytes / 2);
  if (!heat) {
    return Error(HB_ERROR_OUT_OF_MEMORY,
                 {"Geodesics in heat on ", domain_->size(), " voxels would take more than ", static_cast<int>(most_bytes / 1048576),
                  " MiB."},
                 {"Use a coarser resolution, or fast marching."});
  }
  heat_ = std::move(*heat);
  auto poisson = SparseCholesky::analyze(poisson_matrix_, order, most_bytes / 2);  // the same pattern
  if (!poisson) return poisson.error();
  poisson_ = std::move(*poisson);
  const auto count = static_cast<std::size_t>(domain_->size());
  heat_field_.resize(count);
  directions_.resize(count);
  settled_.resize(count);
  ball_.reserve(count);
  phase_ = Phase::factor_heat;
  return Done{};
}

void HeatDistance::measure(const Vector3& source, double* distances) {
  const std::int32_t first = domain_->nearest(source);
  if (first < 0) return;
  const double h = domain_->grid().spacing;
  const std::int32_t part = components_[first];
  start(first, source);
  heat_->solve(heat_field_.data());
  while (point_along_gradient(part)) heat_->solve(heat_field_.data());
  for (const std::int32_t v : ball_) {
    const Vector3 away = domain_->center(v) - source;
    const double length = away.norm();
    directions_[v] = length > 0 ? Vector3(away / length) : Vector3::Zero();
  }
  integrate(part);

  // The solution is determined up to a constant, which follows from the exact distances in the ball.
  double shift = 0;
  for (const std::int32_t v : ball_) shift += (domain_->center(v) - source).norm() / h - heat_field_[v];
  shift /= static_cast<double>(ball_.size());
  for (Index v = 0; v < domain_->size(); ++v) {
    const double straight = (domain_->center(v) - source).norm();
    distances[v] = components_[v] == part ? std::max((heat_field_[v] + shift) * h, straight) : infinity;
  }
  for (const std::int32_t v : ball_) distances[v] = (domain_->center(v) - source).norm();
}

/** The ball about the source: the voxels within reach that are face-connected inside it to `first`, and their heat. */
void HeatDistance::start(std::int32_t first, const Vector3& source) {
  const double h = domain_->grid().spacing, nearest = (domain_->center(first) - source).norm();
  const double radius = std::max(ball_radius * h, nearest + h);
  const auto none = static_cast<std::int32_t>(domain_->size());
  std::fill(heat_field_.begin(), heat_field_.end(), 0.0);
  std::fill(settled_.begin(), settled_.end(), 0);
  std::fill(directions_.begin(), directions_.end(), Vector3::Zero());
  ball_.assign(1, first);
  heat_field_[first] = 1;
  for (std::size_t head = 0; head < ball_.size(); ++head) {
    for (int side = 0; side < 6; ++side) {
      const std::int32_t u = neighbors_[6 * std::size_t(ball_[head]) + side];
      if (u == none || heat_field_[u] > 0) continue;
      const double distance = (domain_->center(u) - source).norm();
      if (distance > radius) continue;
      heat_field_[u] = std::exp(-source_decay * (distance - nearest) / h);
      ball_.push_back(u);
    }
  }
}

/** X = −∇u/|∇u| at the voxels of a part that are not settled yet and warm enough. Beyond a missing neighbor u is extrapolated as
 *  u²/u_other. If some voxels are still cold, the heat field becomes the source of another flow, and the answer is true. */
bool HeatDistance::point_along_gradient(std::int32_t part) {
  const auto count = static_cast<std::int32_t>(domain_->size());
  bool cold = false, progress = false;
  for (std::int32_t v = 0; v < count; ++v) {
    if (settled_[v] || components_[v] != part) continue;
    const double u = heat_field_[v];
    if (!(u > trusted)) {
      cold = true;
      continue;
    }
    Vector3 fall = Vector3::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t low = neighbors_[6 * std::size_t(v) + 2 * axis], high = neighbors_[6 * std::size_t(v) + 2 * axis + 1];
      if (low == count && high == count) continue;
      const double below = low == count ? u / heat_field_[high] : heat_field_[low] / u;
      const double above = high == count ? u / heat_field_[low] : heat_field_[high] / u;
      fall[axis] = below - above;
    }
    const double length = fall.norm();
    if (length > 0) directions_[v] = fall / length;
    settled_[v] = progress = true;
  }
  if (!cold || !progress) return false;
  for (double& u : heat_field_) u = u > relay_low && u <= relay_high ? u / relay_high : 0;
  return true;
}

/** Solves L φ = −∇·X for the φ whose differences between face neighbors come closest to X. */
void HeatDistance::integrate(std::int32_t part) {
  const auto count = static_cast<std::int32_t>(domain_->size());
  std::fill(heat_field_.begin(), heat_field_.end(), 0.0);
  for (std::int32_t v = 0; v < count; ++v) {
    if (components_[v] != part) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t u = neighbors_[6 * std::size_t(v) + 2 * axis + 1];
      if (u == count) continue;
      const double rise = (directions_[v][axis] + directions_[u][axis]) / 2;
      heat_field_[v] -= rise;
      heat_field_[u] += rise;
    }
  }
  poisson_->solve(heat_field_.data());
}

}  // namespace handlebody
