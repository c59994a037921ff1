#include "core/mesh/surface_geodesics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handlebody {

namespace {

/** A new distance must be shorter by this fraction, or rounding errors would make vertices be visited again. */
constexpr double worth = 1e-9;

}  // namespace

SurfaceGeodesics::SurfaceGeodesics(const ConstPoints& positions, const ConstTriangles& triangles)
    : positions_(positions), triangles_(triangles) {
  starts_.assign(static_cast<std::size_t>(positions.rows()) + 1, 0);
  const std::uint32_t* const corners = triangles_.data();
  const auto count = static_cast<std::size_t>(3 * triangles_.rows());
  for (std::size_t c = 0; c < count; ++c) ++starts_[corners[c] + 1];
  for (std::size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
  around_.resize(count);
  Indices filled(starts_.begin(), starts_.end() - 1);
  for (std::size_t c = 0; c < count; ++c) around_[filled[corners[c]]++] = static_cast<std::uint32_t>(c / 3);
}

void SurfaceGeodesics::measure(std::uint32_t source, double* distances) {
  std::fill(distances, distances + positions_.rows(), std::numeric_limits<double>::infinity());
  const auto later = [](const Trial& s, const Trial& t) { return s.distance > t.distance; };
  heap_.clear();
  offer(source, 0, distances);
  while (!heap_.empty()) {
    const Trial next = heap_.front();
    std::pop_heap(heap_.begin(), heap_.end(), later);
    heap_.pop_back();
    const std::uint32_t v = next.vertex;
    if (next.distance > distances[v]) continue;  // it was offered a shorter one since
    for (std::uint32_t k = starts_[v]; k < starts_[v + 1]; ++k) {
      const std::uint32_t* const t = triangles_.data() + 3 * std::size_t{around_[k]};
      const int at = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      const std::uint32_t a = t[(at + 1) % 3], b = t[(at + 2) % 3];
      cross(v, b, a, distances);
      cross(v, a, b, distances);
    }
  }
}

void SurfaceGeodesics::offer(std::uint32_t vertex, double distance, double* distances) {
  if (!(distance < distances[vertex] * (1 - worth))) return;
  distances[vertex] = distance;
  heap_.push_back({distance, vertex});
  std::push_heap(heap_.begin(), heap_.end(), [](const Trial& s, const Trial& t) { return s.distance > t.distance; });
}

/** Offers `to` two paths: along the edge from `a`, and one across the edge ab of their triangle. In the triangle's plane the
 *  distances of a and b determine where the source would be, and the second path is straight from there. A vertex may be offered a
 *  shorter path after it was visited, because in an obtuse triangle b can be farther than `to`; it is visited again then. */
void SurfaceGeodesics::cross(std::uint32_t a, std::uint32_t b, std::uint32_t to, double* distances) {
  const double da = distances[a], db = distances[b];
  const Vector3 p = positions_.row(a), ab = positions_.row(b).transpose() - p, ac = positions_.row(to).transpose() - p;
  const double length2 = ac.squaredNorm(), edge2 = ab.squaredNorm();
  offer(to, da + std::sqrt(length2), distances);
  if (!(db < std::numeric_limits<double>::infinity()) || edge2 == 0) return;
  const double edge = std::sqrt(edge2);
  const double x = ac.dot(ab) / edge, y = std::sqrt(std::max(length2 - x * x, 0.0));    // `to`, from a and along ab
  const double sx = (edge2 + da * da - db * db) / (2 * edge), sy2 = da * da - sx * sx;  // the source, beyond ab
  if (!(sy2 >= 0)) return;
  const double sy = std::sqrt(sy2), rise = y + sy;
  // Where the path crosses ab.
  const double at = rise > 0 ? (sx * y + x * sy) / rise : x;
  if (at < 0 || at > edge) return;
  offer(to, std::sqrt((x - sx) * (x - sx) + rise * rise), distances);
}

}  // namespace handlebody
