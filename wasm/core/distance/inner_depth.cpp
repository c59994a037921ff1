#include "core/distance/inner_depth.hpp"

#include <algorithm>

namespace handlebody {

double inner_depth(const VoxelDomain& domain, const std::vector<double>& depth, const Vector3& point) {
  const double h = domain.grid().spacing;
  const Vector3 at = (point - domain.grid().origin) / h;
  const Vector3 low = at.array().floor(), part = at - low;
  double mean = 0, lowest = 0, sure = 0;
  bool surrounded = true;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 offset(corner & 1, corner >> 1 & 1, corner >> 2);
    double weight = 1;
    for (int a = 0; a < 3; ++a) weight *= offset[a] > 0 ? part[a] : 1 - part[a];
    const Vector3 cell = low + offset;
    const std::int32_t v = domain.number(int(cell[0]), int(cell[1]), int(cell[2]));
    if (v >= 0) sure = std::max(sure, depth[v] - h * (part - offset).norm());
    if (weight <= 0) continue;
    const double d = v >= 0 ? depth[v] : 0;
    surrounded &= v >= 0;
    mean += weight * d;
    lowest = lowest > 0 ? std::min(lowest, d) : d;
  }
  if (!surrounded || lowest <= 0) return sure;
  // Level sets of a distance d bend outward by 1/d at most, so the mean of the corners exceeds it by half the variance over d.
  const double variance = h * h * (part.array() * (1 - part.array())).sum();
  return std::max(sure, mean - variance / (2 * lowest));
}

}  // namespace handlebody
