#include "core/numerics/safe_norm.hpp"

#include <algorithm>
#include <cmath>

namespace handlebody {

double safe_norm(const Vector& x) {
  return x.stableNorm();
}

double safe_distance(const double* x, const double* y, Index dimension) {
  double squared = 0;
  for (Index i = 0; i < dimension; ++i) squared += (x[i] - y[i]) * (x[i] - y[i]);
  if (squared > 1e-280 && squared < 1e280) return std::sqrt(squared);
  double largest = 0;
  for (Index i = 0; i < dimension; ++i) largest = std::max(largest, std::abs(x[i] - y[i]));
  if (!(largest > 0) || !std::isfinite(largest)) return largest;
  squared = 0;
  for (Index i = 0; i < dimension; ++i) squared += (x[i] - y[i]) / largest * ((x[i] - y[i]) / largest);
  return largest * std::sqrt(squared);
}

}  // namespace handlebody
