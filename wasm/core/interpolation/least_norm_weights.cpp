#include "core/interpolation/least_norm_weights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handlebody {
namespace {

constexpr double negative = 1e-12;     // weights below minus this are
constexpr double independent = 1e-12;  // the part of a point that the others do not span, squared
constexpr double flat = 1e-13;         // part of a coordinate's size below which it depends on the others
constexpr double accurate = 1e-11;     // distance of the mean from the place
constexpr Index steps_per_point = 20;

}  // namespace

LeastNormWeights::LeastNormWeights(Index most, Index dimension)
    : points_(most, dimension), basis_(most, dimension + 1), values_(most), slopes_(most), pivot_(dimension + 1), kept_(most) {}

/** Gram–Schmidt over the points that are kept: first 1, then the coordinates, the largest remainder first; those that depend on the
 * ones before are left out. Then v = Σ βⱼ basisⱼ, with β determined by Σ v = 1 and Σ v q = 0 over the points that are kept. */
void LeastNormWeights::orthonormalize() {
  const Index columns = basis_.cols();
  const auto product = [&](Index a, Index b) {
    double sum = 0;
    for (Index i = 0; i < count_; ++i)
      if (kept_[i]) sum += basis_(i, a) * basis_(i, b);
    return sum;
  };
  Vector& parts = pivot_;
  parts.setZero();
  parts[0] = 1;
  for (Index i = 0; i < count_; ++i) {
    basis_(i, 0) = 1;
    std::copy_n(point(i), columns - 1, &basis_(i, 0) + 1);
  }
  const auto subtract = [&](Index c, Index from) {
    const double along = product(c, from);
    for (Index i = 0; i < count_; ++i) basis_(i, from) -= along * basis_(i, c);
    parts[from] -= along * parts[c];
  };
  double size = 0;
  for (Index c = 0; c < columns; ++c) {
    Index largest = c;
    double squared = product(c, c);
    for (Index k = c + 1; k < columns && c > 0; ++k) {
      const double other = product(k, k);
      if (!(other > squared)) continue;
      squared = other;
      largest = k;
    }
    if (largest != c) {
      for (Index i = 0; i < count_; ++i) std::swap(basis_(i, c), basis_(i, largest));
      std::swap(parts[c], parts[largest]);
    }
    for (Index j = 0; j < c; ++j) subtract(j, c);  // once more, for the sake of orthogonality
    const double norm = std::sqrt(product(c, c));
    if (c <= 1) size = norm;
    const double scale = norm > flat * size ? 1 / norm : 0;
    for (Index i = 0; i < count_; ++i) basis_(i, c) *= scale;
    parts[c] *= scale;
    for (Index k = c + 1; k < columns; ++k) subtract(c, k);
  }
  along(parts.data(), values_);
}

/** out ← basis · row. */
void LeastNormWeights::along(const double* row, Vector& out) {
  const Index columns = basis_.cols();
  for (Index i = 0; i < count_; ++i) {
    double sum = 0;
    for (Index c = 0; c < columns; ++c) sum += basis_(i, c) * row[c];
    out[i] = sum;
  }
}

/** Keeps the basis orthonormal when point i joins (sign 1) or leaves (−1) those kept: basis ← basis (I ± bᵢ bᵢᵀ)^(−1/2). */
void LeastNormWeights::reweigh(Index i, double sign) {
  const Index columns = basis_.cols();
  std::copy(&basis_(i, 0), &basis_(i, 0) + columns, pivot_.data());
  along(pivot_.data(), slopes_);
  const double squared = slopes_[i];
  if (!(squared > 0)) return;
  const double factor = (1 / std::sqrt(1 + sign * squared) - 1) / squared;
  for (Index r = 0; r < count_; ++r)
    for (Index c = 0; c < columns; ++c) basis_(r, c) += factor * slopes_[r] * pivot_[c];
}

/** Raises the multiplier λ of wₗ ≥ 0, with wₗ = v(qₗ) + λ, until that is 0. Points whose own multiplier −v(qᵢ) vanishes on the way
 * are taken back. */
bool LeastNormWeights::let_go(Index leaving, Index& steps_left) {
  for (double multiplier = 0; steps_left > 0; --steps_left) {
    along(&basis_(leaving, 0), slopes_);
    const double rest = 1 - slopes_[leaving];
    const bool spanned = rest > independent;  // by the others: otherwise one must be taken back first
    double step = spanned ? -(values_[leaving] + multiplier) / rest : std::numeric_limits<double>::infinity();
    Index returning = -1;
    for (Index i = 0; i < count_; ++i) {
      if (kept_[i] || !(slopes_[i] < 0) || !(values_[i] / slopes_[i] < step)) continue;
      step = values_[i] / slopes_[i];
      returning = i;
    }
    if (!spanned && returning < 0) return false;
    for (Index i = 0; i < count_; ++i) values_[i] -= step * slopes_[i];
    multiplier += step;
    const Index changed = returning < 0 ? leaving : returning;
    kept_[changed] = returning >= 0;
    reweigh(changed, returning < 0 ? -1 : 1);
    if (returning < 0) return true;
  }
  return false;
}

bool LeastNormWeights::solve(Index count) {
  const Index d = points_.cols();
  count_ = count;
  std::fill(kept_.begin(), kept_.begin() + count, std::uint8_t{1});
  orthonormalize();
  bool exact = true;
  for (Index steps_left = steps_per_point * count; steps_left > 0;) {
    Index lowest = -1;
    double value = -negative;
    for (Index i = 0; i < count; ++i) {
      if (!kept_[i] || !(values_[i] < value)) continue;
      value = values_[i];
      lowest = i;
    }
    if (lowest < 0 && exact) break;
    if (lowest >= 0 && let_go(lowest, steps_left)) {
      exact = false;
      continue;
    }
    // Recompute the values without the errors of the updates. A place beyond a face, if only by rounding, is moved onto it.
    if (lowest >= 0) kept_[lowest] = 0;
    orthonormalize();
    exact = true;
    --steps_left;
  }

  double sum = 0, off = 0;
  for (Index i = 0; i < count; ++i) sum += values_[i] = kept_[i] ? std::max(values_[i], 0.0) : 0;
  for (Index i = 0; i < count; ++i) values_[i] /= sum;
  for (Index axis = 0; axis < d; ++axis) {
    double mean = 0;
    for (Index i = 0; i < count; ++i) mean += values_[i] * points_(i, axis);
    off += mean * mean;
  }
  return off <= accurate * accurate;
}

}  // namespace handlebody
