// A cheap estimate of a condition number from factors that are there already.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/types.hpp"

namespace handlebody {

/** A lower bound, mostly within a factor of three, of ‖A⁻¹‖₁ (Hager 1984; Higham, ACM TOMS 14, 1988) from a handful of solutions:
 *  `solve(x)` overwrites x (`size` numbers) with A⁻¹x, `solve_transposed(x)` with A⁻ᵀx. Infinite where A is singular. */
template <typename Solve, typename SolveTransposed>
double estimate_inverse_norm(Index size, const Solve& solve, const SolveTransposed& solve_transposed) {
  Vector x = Vector::Constant(size, 1 / static_cast<double>(size));
  double norm = 0;
  for (int round = 0; round < 5; ++round) {
    solve(x.data());
    double sum = 0;
    for (const double number : x) sum += std::abs(number);
    if (!std::isfinite(sum)) return std::numeric_limits<double>::infinity();
    if (round > 0 && sum <= norm) break;
    norm = sum;
    for (double& number : x) number = number < 0 ? -1 : 1;
    solve_transposed(x.data());
    Index steepest = 0;
    for (Index i = 1; i < size; ++i)
      if (std::abs(x[i]) > std::abs(x[steepest])) steepest = i;
    x.setZero();
    x[steepest] = 1;
  }
  // Higham's safeguard against matrices that deceive the ascent: a vector of alternating, slowly growing numbers.
  for (Index i = 0; i < size; ++i)
    x[i] = (i % 2 ? -1 : 1) * (1 + static_cast<double>(i) / static_cast<double>(size > 1 ? size - 1 : 1));
  solve(x.data());
  double sum = 0;
  for (const double number : x) sum += std::abs(number);
  return std::max(norm, 2 * sum / (3 * static_cast<double>(size)));
}

}  // namespace handlebody
