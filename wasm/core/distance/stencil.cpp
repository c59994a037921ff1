#include "core/distance/stencil.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numerics/orthogonal_columns.hpp"

namespace handlebody {
namespace {

// Lengths in spacings.
constexpr double support = 1.75;           // of the weight, beyond the nearest voxel
constexpr double max_extrapolation = 1.5;  // farther points are read at this distance from the nearest voxel
constexpr double softening2 = 0.1;         // rounds off the weight's pole, which holds moving least squares close to interpolation
constexpr double spanned = 0.005;          // weighted variance along an axis above which the slope along it is trusted fully
constexpr double max_weight_sum = 3;       // Σ|w|, the most by which a stencil can magnify noise

bool trilinear(const VoxelDomain& domain, const Vector3& p, Stencil& stencil) {
  const Vector3 base = p.array().floor();
  std::array<int, 3> cell{};
  for (int a = 0; a < 3; ++a) {
    if (!(base[a] >= 0 && base[a] + 1 < domain.grid().dims[a])) return false;
    cell[a] = static_cast<int>(base[a]);
  }
  const Vector3 t = p - base;
  std::array<std::int32_t, 8> corners;
  for (int c = 0; c < 8; ++c) {
    corners[c] = domain.number(cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2));
    if (corners[c] < 0) return false;
  }
  stencil.voxels.assign(corners.begin(), corners.end());
  stencil.weights.resize(8);
  for (int c = 0; c < 8; ++c) {
    stencil.weights[c] = (c & 1 ? t[0] : 1 - t[0]) * (c & 2 ? t[1] : 1 - t[1]) * (c & 4 ? t[2] : 1 - t[2]);
  }
  return true;
}

/** (1 − (r/radius)²)² with a soft pole at 0. */
double weight(double r2, double radius) {
  const double s = 1 - r2 / (radius * radius);
  return s > 0 ? s * s / (r2 + softening2) : 0;
}

/** Flood fill from the voxel nearest the point, over the voxels within `radius` of the point. */
void gather(const VoxelDomain& domain, const Vector3& p, std::int32_t nearest, double radius, Stencil& stencil,
            std::vector<Vector3>& places) {
  constexpr int half = 5, side = 2 * half + 1;  // a window that holds the ball, max_extrapolation + radius < half
  std::array<bool, side * side * side> seen{};
  const auto origin = domain.grid().cell(domain.voxels()[nearest]);
  std::array<std::array<int, 3>, side * side * side> queue;
  int head = 0, tail = 0;
  queue[tail++] = {half, half, half};
  seen[half + side * (half + side * half)] = true;
  while (head < tail) {
    const std::array<int, 3> at = queue[head++];
    const int i = origin[0] + at[0] - half, j = origin[1] + at[1] - half, k = origin[2] + at[2] - half;
    places.emplace_back(i, j, k);
    stencil.voxels.push_back(domain.number(i, j, k));
    for (int f = 0; f < 6; ++f) {
      std::array<int, 3> next = at;
      next[f / 2] += f % 2 ? 1 : -1;
      if (next[f / 2] < 0 || next[f / 2] >= side) continue;
      bool& visited = seen[next[0] + side * (next[1] + side * next[2])];
      if (visited) continue;
      visited = true;
      const int u = origin[0] + next[0] - half, v = origin[1] + next[1] - half, w = origin[2] + next[2] - half;
      if ((Vector3(u, v, w) - p).squaredNorm() >= radius * radius || domain.number(u, v, w) < 0) continue;
      queue[tail++] = next;
    }
  }
}

/** Weights for the value at p of the linear function that fits best (Lancaster & Salkauskas 1981): with normalized weights θ, mean
 *  m and covariance C of the places, wᵢ = θᵢ (1 + (xᵢ − m)ᵀ C⁺ (p − m)). C⁺ inverts eigenvalues above `spanned` exactly and fades
 *  the others out to 0, so that the slope along a direction that the places barely span vanishes smoothly; the whole slope is
 *  reduced as far as Σ|w| ≤ 3 requires. */
void moving_least_squares(const Vector3& p, double radius, const std::vector<Vector3>& places, std::vector<double>& weights) {
  const std::size_t n = places.size();
  weights.resize(n);
  double total = 0;
  Vector3 mean = Vector3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    weights[i] = weight((places[i] - p).squaredNorm(), radius);
    total += weights[i];
    mean += weights[i] * places[i];
  }
  mean /= total;
  Matrix3 covariance = Matrix3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    weights[i] /= total;
    covariance += weights[i] * (places[i] - mean) * (places[i] - mean).transpose();
  }
  const OrthogonalColumns axes = orthogonal_columns(covariance);
  Vector3 slope = Vector3::Zero();
  for (int a = 0; a < 3; ++a) {
    const double eigenvalue = axes.columns.col(a).norm(), t = std::min(eigenvalue / spanned, 1.0);
    slope += axes.v.col(a).dot(p - mean) * t * (3 - 2 * t) / std::max(eigenvalue, spanned) * axes.v.col(a);  // t²(3 − 2t)/λ
  }
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += weights[i] * std::abs(1 + (places[i] - mean).dot(slope));
  if (sum > max_weight_sum) slope *= (max_weight_sum - 1) / (sum - 1);  // Σ|w| is convex in the slope, and 1 at slope 0
  for (std::size_t i = 0; i < n; ++i) weights[i] *= 1 + (places[i] - mean).dot(slope);
}

}  // namespace

Stencil make_stencil(const VoxelDomain& domain, const Vector3& point) {
  Stencil stencil;
  const Grid& grid = domain.grid();
  Vector3 p = (point - grid.origin) / grid.spacing;
  if (trilinear(domain, p, stencil)) return stencil;

  const std::int32_t nearest = domain.nearest(point);
  if (nearest < 0) return stencil;
  const Vector3 foot = (domain.center(nearest) - grid.origin) / grid.spacing;
  double distance = (p - foot).norm();
  if (distance > max_extrapolation) {
    p = foot + max_extrapolation / distance * (p - foot);
    distance = max_extrapolation;
  }
  const double radius = distance + support;
  std::vector<Vector3> places;
  places.reserve(64);
  stencil.voxels.reserve(64);
  gather(domain, p, nearest, radius, stencil, places);
  moving_least_squares(p, radius, places, stencil.weights);
  return stencil;
}

}  // namespace handlebody
