#include "core/mesh/mean_value_coordinates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/numerics/indices.hpp"

namespace handlebody {

namespace {

constexpr double at_corner = 1e-12;  // distance from a corner, relative to that from the farthest corner
constexpr double edge_on = 1e-10;    // sine of the angle between a plane and the line of sight
constexpr std::uint32_t leaf_size = 8;

// Distance of a node, in radii, beyond which its triangles count as one, on the side that the sum of their area vectors shows. On
// the dog (33,900 triangles), 32 functions from -1 to 1 at voxel centers: difference from one-sided coordinates, and native time
// per point:
//
//    opening    mean      largest   microseconds
//    2.5        0.0012    0.015     27
//    3          0.0010    0.014     41
//    4          0.0008    0.009     74    taken
//    5          0.0007    0.008     145
//    all alone  0         0         2600
constexpr double opening = 4;

}  // namespace

/** Ju et al.'s mean vector: m, the integral of the unit vector over the spherical triangle, is the sum of θₖ Nₖ/2 over its sides,
 *  and the weights are its components along the corners: wᵢ = Nᵢ·m / (Nᵢ·uᵢ rᵢ), Nᵢ being normal to the other two corners. */
TriangleShare triangle_share(const Vector3& point, const Vector3& a, const Vector3& b, const Vector3& c) {
  TriangleShare share;
  Vector3 u[3] = {a - point, b - point, c - point}, normal[3];
  double r[3], sine[3];
  for (int k = 0; k < 3; ++k) r[k] = u[k].norm();
  const double farthest = std::max({r[0], r[1], r[2]});
  for (std::size_t k = 0; k < 3; ++k) {
    if (r[k] > at_corner * farthest) continue;
    share.weights[k] = 1;
    share.contains = true;
    return share;
  }
  for (int k = 0; k < 3; ++k) u[k] /= r[k];
  Vector3 mean = Vector3::Zero();
  double around = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector3 &v = u[(k + 1) % 3], &w = u[(k + 2) % 3];
    normal[k] = v.cross(w);
    sine[k] = normal[k].norm();
    const double angle = std::atan2(sine[k], v.dot(w));
    around += angle;
    if (sine[k] > 0) normal[k] /= sine[k];
    mean += angle / 2 * normal[k];
  }
  const double determinant = u[0].cross(u[1]).dot(u[2]);
  if (std::abs(determinant) <= edge_on * std::max({sine[0], sine[1], sine[2]})) {
    // The point is in the triangle's plane, and on the triangle if the corners surround it.
    if (around < 2 * std::numbers::pi - 1e-6 || sine[0] + sine[1] + sine[2] == 0) return share;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += share.weights[k] = sine[k] * r[(k + 1) % 3] * r[(k + 2) % 3];
    for (double& weight : share.weights) weight /= sum;
    share.contains = true;
    return share;
  }
  share.side = determinant > 0 ? 1 : -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double along = normal[k].dot(u[k]);
    share.weights[k] = along != 0 ? normal[k].dot(mean) / (along * r[k]) : 0;
  }
  return share;
}

Vector mean_value_coordinates(const ConstPoints& positions, const ConstTriangles& triangles, const Vector3& point, bool one_side) {
  Vector sums[2] = {Vector::Zero(positions.rows()), Vector::Zero(positions.rows())};
  for (Index t = 0; t < triangles.rows(); ++t) {
    const TriangleShare share =
        triangle_share(point, positions.row(triangles(t, 0)).transpose(), positions.row(triangles(t, 1)).transpose(),
                       positions.row(triangles(t, 2)).transpose());
    if (share.contains) {
      sums[0].setZero();
      for (int k = 0; k < 3; ++k) sums[0][triangles(t, k)] += share.weights[k];
      return sums[0];
    }
    Vector& sum = sums[share.side < 0];
    for (int k = 0; k < 3; ++k) sum[triangles(t, k)] += share.weights[k];
  }
  // Along every ray the surface shows its sides in turn, and the first hit counts most: inside, inner sides outweigh outer ones.
  const double inner = sums[0].sum(), outer = sums[1].sum();
  if (!one_side) return (sums[0] + sums[1]) / (inner + outer);
  return inner >= -outer ? sums[0] / inner : sums[1] / outer;
}

MeanValueField::MeanValueField(const ConstPoints& positions, const ConstTriangles& triangles, const MatrixF& values)
    : positions_(positions), triangles_(triangles), values_(values), sums_(values.cols()) {
  const auto count = static_cast<std::size_t>(triangles.rows());
  order_.resize(count);
  for (std::size_t t = 0; t < count; ++t) order_[t] = static_cast<std::uint32_t>(t);
  if (count > 0) build(order_.data(), order_.data() + count);
  low_.assign(sums_.size(), std::numeric_limits<float>::max());
  high_.assign(sums_.size(), std::numeric_limits<float>::lowest());
  for (Index v = 0; v < values_.rows(); ++v)
    for (Index f = 0; f < columns(); ++f) low_[f] = std::min(low_[f], values_(v, f)), high_[f] = std::max(high_[f], values_(v, f));
}

void MeanValueField::build(std::uint32_t* first, std::uint32_t* last) {
  const std::size_t node = nodes_.size(), row = static_cast<std::size_t>(3 * columns());
  nodes_.emplace_back();
  moments_.resize(moments_.size() + row);
  nodes_[node] = summarize(first, last, &moments_[node * row]);
  if (last - first <= std::ptrdiff_t{leaf_size}) {
    nodes_[node].first = static_cast<std::uint32_t>(first - order_.data());
    nodes_[node].count = static_cast<std::uint32_t>(last - first);
  } else {
    // Halves, by centroid, along the longest side of the box of the triangles' first corners.
    Vector3 low = corner(*first, 0), high = low;
    for (const std::uint32_t* t = first; t < last; ++t) low = low.cwiseMin(corner(*t, 0)), high = high.cwiseMax(corner(*t, 0));
    int axis = 0;
    (high - low).maxCoeff(&axis);
    std::uint32_t* const middle = first + (last - first) / 2;
    nth_element(first, middle, last, [&](std::uint32_t s, std::uint32_t t) {
      const double x = corner(s, 0)[axis] + corner(s, 1)[axis] + corner(s, 2)[axis];
      const double y = corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis];
      return x < y || (x == y && s < t);
    });
    build(first, middle);
    build(middle, last);
  }
  nodes_[node].skip = static_cast<std::uint32_t>(nodes_.size());
}

MeanValueField::Node MeanValueField::summarize(const std::uint32_t* first, const std::uint32_t* last, float* moments) const {
  Node node{};
  std::fill(moments, moments + 3 * columns(), 0.0F);
  node.center.setZero(), node.area.setZero();
  double area = 0;
  for (const std::uint32_t* t = first; t < last; ++t) {
    const Vector3 a = corner(*t, 0), b = corner(*t, 1), c = corner(*t, 2);
    const Vector3 normal = (b - a).cross(c - a) / 2;
    node.area += normal;
    node.center += normal.norm() * (a + b + c) / 3;
    area += normal.norm();
    for (Index f = 0; f < columns(); ++f) {
      const float mean = (values_(triangles_(*t, 0), f) + values_(triangles_(*t, 1), f) + values_(triangles_(*t, 2), f)) / 3;
      for (int k = 0; k < 3; ++k) moments[k * columns() + f] += static_cast<float>(normal[k]) * mean;
    }
  }
  node.center = area > 0 ? Vector3(node.center / area) : corner(*first, 0);
  for (const std::uint32_t* t = first; t < last; ++t) {
    for (int k = 0; k < 3; ++k) node.radius = std::max(node.radius, (corner(*t, k) - node.center).norm());
  }
  return node;
}

/** Adds up the weighted functions of the triangles that show `side` into sums_, returns their weight, and the weight of the others
 * in `other`; both positive. Where the point is on the surface, sums_ are the functions there. */
double MeanValueField::gather(const Vector3& point, int side, double& other, bool& on_surface) {
  const Index m = columns();
  float* const sums = sums_.data();
  std::fill(sums_.begin(), sums_.end(), 0.0F);
  double total = 0;
  other = 0;
  for (std::size_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const Vector3 to = node.center - point;
    const double distance2 = to.squaredNorm();
    if (distance2 > opening * opening * node.radius * node.radius && distance2 > 0) {
      // ∫ f (x − p)·n / r⁴ dA
      const double scale = 1 / (distance2 * distance2), weight = side * scale * node.area.dot(to);
      if (weight > 0) {
        const float* const moment = &moments_[n * static_cast<std::size_t>(3 * m)];
        const auto x = static_cast<float>(side * scale * to[0]), y = static_cast<float>(side * scale * to[1]),
                   z = static_cast<float>(side * scale * to[2]);
        for (Index f = 0; f < m; ++f) sums[f] += x * moment[f] + y * moment[m + f] + z * moment[2 * m + f];
        total += weight;
      } else {
        other -= weight;
      }
      n = node.skip;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      const std::uint32_t t = order_[k];
      const TriangleShare share = triangle_share(point, corner(t, 0), corner(t, 1), corner(t, 2));
      if (share.contains) {
        std::fill(sums_.begin(), sums_.end(), 0.0F);
        on_surface = true;
      } else if (share.side != side) {
        for (const double weight : share.weights) other += std::abs(weight);
        continue;
      }
      const float sign = share.contains ? 1.0F : static_cast<float>(side);
      for (int c = 0; c < 3; ++c) {
        const auto weight = static_cast<float>(share.weights[c]) * sign;
        const float* const value = values_.data() + triangles_(t, c) * m;
        for (Index f = 0; f < m; ++f) sums[f] += weight * value[f];
        total += weight;
      }
      if (share.contains) return 1;
    }
    ++n;
  }
  return total;
}

void MeanValueField::evaluate(const Vector3& point, float* out) {
  bool on_surface = false;
  double other = 0, total = gather(point, 1, other, on_surface);
  if (!on_surface && other > total) total = gather(point, -1, other, on_surface);
  for (Index f = 0; f < columns(); ++f) {
    const double mean = total > 0 ? static_cast<double>(sums_[f]) / total : 0;
    out[f] = static_cast<float>(std::clamp(mean, static_cast<double>(low_[f]), static_cast<double>(high_[f])));
  }
}

}  // namespace handlebody
