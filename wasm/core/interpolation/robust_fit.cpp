#include "core/interpolation/robust_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/numerics/decompositions.hpp"
#include "core/numerics/indices.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {
namespace {

/** Norms of the rows of values − design · (least squares over the `rows`, weighted by their `roots`). */
Vector misfits(const MatrixXd& design, const Matrix& values, const Indices& rows, const Vector& roots) {
  const auto count = std::ssize(rows);
  MatrixXd some(count, design.cols()), wanted(count, values.cols());
  for (Index i = 0; i < count; ++i) {
    some.row(i) = roots[i] * design.row(rows[i]);
    wanted.row(i) = roots[i] * values.row(rows[i]);
  }
  const MatrixXd fitted = product(design, Qr(std::move(some)).solve(std::move(wanted)));
  return (values - fitted).rowwise().norm();
}

Indices all_rows(Index count) {
  Indices rows(count);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<std::uint32_t>(i);
  return rows;
}

/** The middle one of the numbers; NaN counts as the largest. */
double median(const Vector& numbers) {
  std::vector<double> sorted(numbers.data(), numbers.data() + numbers.size());
  for (double& number : sorted)
    if (std::isnan(number)) number = std::numeric_limits<double>::infinity();
  Indices order = all_rows(numbers.size());
  const auto middle = order.size() / 2;
  nth_element(order.data(), order.data() + middle, order.data() + order.size(),
              [&](std::uint32_t a, std::uint32_t b) { return sorted[a] != sorted[b] ? sorted[a] < sorted[b] : a < b; });
  return sorted[order[middle]];
}

}  // namespace

Vector least_absolute_weights(const MatrixXd& design, const Matrix& values) {
  const Indices rows = all_rows(design.rows());
  Vector weights = Vector::Ones(design.rows());
  const double spread = (values.colwise().maxCoeff() - values.colwise().minCoeff()).maxCoeff();
  const double floor = 1e-7 * (spread > 0 ? spread : 1);
  for (int round = 0; round < 200; ++round) {
    const Vector errors = misfits(design, values, rows, weights.cwiseSqrt());
    if (!errors.allFinite()) break;
    double change = 0;
    const double least = std::max(errors.minCoeff(), floor);
    for (Index i = 0; i < weights.size(); ++i) {
      const double weight = least / std::max(errors[i], floor);
      change = std::max(change, std::abs(weight - weights[i]));
      weights[i] = weight;
    }
    if (change < 1e-9) break;
  }
  return weights;
}

Vector least_median_weights(const MatrixXd& design, const Matrix& values) {
  const Index n = design.rows(), p = design.cols();
  constexpr int trials = 3000;
  std::uint64_t state = 0x9e3779b97f4a7c15u;  // xorshift64: the same choices every time
  const auto below = [&](std::size_t bound) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<std::size_t>(state % bound);
  };
  Indices deck = all_rows(n);
  const Vector ones = Vector::Ones(p);
  double least = std::numeric_limits<double>::infinity();
  Vector best = misfits(design, values, all_rows(n), Vector::Ones(n));
  for (int trial = 0; trial < trials; ++trial) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(p); ++i) std::swap(deck[i], deck[i + below(deck.size() - i)]);
    const Vector errors = misfits(design, values, Indices(deck.begin(), deck.begin() + p), ones);
    const double middle = median(errors);
    if (middle < least) {
      least = middle;
      best = errors;
    }
  }
  // Rousseeuw & Leroy's scale, consistent for normal errors, with their correction for small samples.
  const double freedom = static_cast<double>(std::max<Index>(n - p, 1));
  const double spread = (values.colwise().maxCoeff() - values.colwise().minCoeff()).maxCoeff();
  const double deviation = std::max(1.4826 * (1 + 5 / freedom) * least, 1e-9 * spread);
  Vector weights(n);
  for (Index i = 0; i < n; ++i) weights[i] = best[i] <= 2.5 * deviation ? 1 : 0;
  return weights;
}

}  // namespace handlebody
