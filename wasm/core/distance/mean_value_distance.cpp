#include "core/distance/mean_value_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mesh/enclosed_volume.hpp"
#include "core/mesh/weld.hpp"
#include "core/numerics/decompositions.hpp"
#include "core/numerics/indices.hpp"

namespace handlebody {

namespace {

constexpr double most_bytes = 1.5 * 1024 * 1024 * 1024;
constexpr double least_eigenvalue = 1e-4;  // of the largest: smaller ones are errors of the distances
constexpr Index voxels_per_step = 256;
constexpr Index vertices_at_once = 256;  // turned into doubles for a product

/** Fails unless every edge is traversed as often one way as the other. */
Result<Done> check_closed(const Triangles& triangles, const Indices& original) {
  const std::uint32_t* const corners = triangles.data();
  const auto count = static_cast<std::size_t>(3 * triangles.rows());
  const auto from = [&](std::uint32_t e) { return corners[e]; };
  const auto to = [&](std::uint32_t e) { return corners[e % 3 == 2 ? e - 2 : e + 1]; };
  const auto low = [&](std::uint32_t e) { return std::min(from(e), to(e)); };
  const auto high = [&](std::uint32_t e) { return std::max(from(e), to(e)); };
  const Indices edges = sorted_indices(count, [&](std::uint32_t e, std::uint32_t f) {
    if (low(e) != low(f)) return low(e) < low(f);
    return high(e) != high(f) ? high(e) < high(f) : e < f;
  });
  for (std::size_t first = 0, next; first < count; first = next) {
    int balance = 0;
    for (next = first; next < count && low(edges[next]) == low(edges[first]) && high(edges[next]) == high(edges[first]); ++next)
      balance += from(edges[next]) == low(edges[next]) ? 1 : -1;
    if (balance == 0) continue;
    return Error(HB_ERROR_MESH_OPEN,
                 {"Mean value distances need a closed surface: an edge of triangle ", original[edges[first] / 3],
                  " has no triangle on its other side, or one that is turned over."},
                 {"Close the mesh and orient it, or use another distance."}, HB_CULPRIT_TRIANGLE, original[edges[first] / 3]);
  }
  return Done{};
}

}  // namespace

Result<MeanValueDistance> MeanValueDistance::begin(const ConstPoints& positions, const ConstTriangles& triangles,
                                                   const VoxelDomain& domain) {
  // Squared distances and coordinates of vertices, the field's moments, coordinates of voxels.
  const double bytes = sizeof(float) * (static_cast<double>(positions.rows()) * (most_landmarks + 2 * most_coordinates) +
                                        static_cast<double>(triangles.rows()) * (most_coordinates + 40) +
                                        static_cast<double>(domain.size()) * most_coordinates);
  if (bytes > most_bytes) {
    return Error(
        HB_ERROR_OUT_OF_MEMORY,
        {"Mean value distances on ", positions.rows(), " vertices and ", domain.size(), " voxels would take ", bytes / 1e6, " MB."},
        {"Simplify the mesh, use a coarser resolution, or use another distance."});
  }
  MeanValueDistance made;
  made.domain_ = &domain;

  // Vertices that are used, each position once.
  const Weld weld = weld_vertices(positions);
  const Triangles welded = weld_triangles(weld, triangles);
  Indices number(weld.unique.size(), no_index), used, original;
  made.triangles_.resize(welded.rows(), 3);
  for (Index t = 0; t < welded.rows(); ++t) {
    if (welded(t, 0) == welded(t, 1) || welded(t, 1) == welded(t, 2) || welded(t, 2) == welded(t, 0)) continue;
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& v = number[welded(t, k)];
      if (v == no_index) {
        v = static_cast<std::uint32_t>(used.size());
        used.push_back(weld.unique[welded(t, k)]);
      }
      made.triangles_(std::ssize(original), k) = v;
    }
    original.push_back(static_cast<std::uint32_t>(t));
  }
  made.triangles_.conservativeResize(std::ssize(original), 3);
  made.positions_.resize(std::ssize(used), 3);
  for (std::size_t v = 0; v < used.size(); ++v) made.positions_.row(static_cast<Index>(v)) = positions.row(used[v]);
  if (original.empty()) {
    return Error(HB_ERROR_MESH_NO_TRIANGLES, {"The mesh has no triangle with three different corners."},
                 {"Mean value distances need a closed surface; use another distance."});
  }
  if (auto closed = check_closed(made.triangles_, original); !closed) return closed.error();
  if (enclosed_volume(made.positions_, made.triangles_) < 0) made.triangles_.col(1).swap(made.triangles_.col(2));

  // The first landmark is the vertex farthest from the middle of them all; its distances tell what is connected.
  made.geodesics_.emplace(made.positions_, made.triangles_);
  const auto count = static_cast<std::size_t>(made.positions_.rows());
  made.from_landmark_.resize(count);
  made.coverage_.assign(count, std::numeric_limits<double>::infinity());
  Vector3 middle = Vector3::Zero();
  for (std::size_t v = 0; v < count; ++v) middle += made.positions_.row(static_cast<Index>(v)).transpose();
  middle /= static_cast<double>(count);
  Index start = 0;
  for (Index v = 1; v < made.positions_.rows(); ++v) {
    const auto away = [&](Index u) { return (made.positions_.row(u).transpose() - middle).squaredNorm(); };
    if (away(v) > away(start)) start = v;
  }
  made.landmarks_.assign(1, static_cast<std::uint32_t>(start));
  made.geodesics_->measure(made.landmarks_[0], made.from_landmark_.data());
  for (Index t = 0; t < made.triangles_.rows(); ++t) {
    if (made.from_landmark_[made.triangles_(t, 0)] < std::numeric_limits<double>::infinity()) continue;
    return Error(
        HB_ERROR_MESH_NOT_CONNECTED,
        {"Mean value distances need a surface of one connected part: triangle ", original[t], " belongs to another than the rest."},
        {"Join the parts, or use another distance."}, HB_CULPRIT_TRIANGLE, original[t]);
  }
  made.squared_.resize(made.positions_.rows(), std::min(most_landmarks, made.positions_.rows()));
  return made;
}

double MeanValueDistance::step() {
  // Shares of the time on the dog.
  switch (phase_) {
    case Phase::landmarks:
      add_landmark();
      return 0.4 * static_cast<double>(landmarks_.size() - 1) / static_cast<double>(squared_.cols());
    case Phase::embed:
      embed();
      return 0.45;
    case Phase::voxels:
      carry();
      return 0.45 + 0.55 * static_cast<double>(next_voxel_) / std::max(static_cast<double>(domain_->size()), 1.0);
    case Phase::ready:
      break;
  }
  return 1;
}

/** Measures from the newest landmark, and makes the vertex farthest from all of them the next one. */
void MeanValueDistance::add_landmark() {
  const Index column = std::ssize(landmarks_) - 1;
  geodesics_->measure(landmarks_.back(), from_landmark_.data());
  std::size_t farthest = 0;
  for (std::size_t v = 0; v < coverage_.size(); ++v) {
    const double distance = from_landmark_[v];
    squared_(static_cast<Index>(v), column) = static_cast<float>(distance * distance);
    coverage_[v] = std::min(coverage_[v], distance);
    if (coverage_[v] > coverage_[farthest]) farthest = v;
  }
  if (column + 1 == squared_.cols()) {
    geodesics_.reset();
    coverage_ = {};
    from_landmark_ = {};
    phase_ = Phase::embed;
    return;
  }
  landmarks_.push_back(static_cast<std::uint32_t>(farthest));
}

/** Classical scaling of the landmarks, B = −½ J D² J = Σ λₖ uₖ uₖᵀ, and of any vertex from its squared distances δ to them: its
 *  coordinate k is ½ uₖ·(μ − δ)/√|λₖ|, with the sign of λₖ, where μ is the mean of D²'s columns. */
void MeanValueDistance::embed() {
  const Index count = squared_.cols();
  MatrixXd b(count, count);
  for (Index i = 0; i < count; ++i) b.row(i) = squared_.row(landmarks_[i]).cast<double>();
  b = 0.5 * (b + b.transpose()).eval();
  const Vector mean = b.rowwise().mean();
  b.colwise() -= mean;
  b.rowwise() -= mean.transpose();
  b.array() += mean.mean();
  b *= -0.5;
  const auto [values, vectors] = symmetric_eigen(b);
  const Indices order = sorted_indices(count, [&values = values](std::uint32_t i, std::uint32_t j) {
    return std::abs(values[i]) > std::abs(values[j]) || (std::abs(values[i]) == std::abs(values[j]) && i < j);
  });
  Index m = 0;
  while (m < std::min(count, most_coordinates) && std::abs(values[order[m]]) > least_eigenvalue * std::abs(values[order[0]])) ++m;

  MatrixXd axes(count, m);
  for (Index k = 0; k < m; ++k) {
    const double eigenvalue = values[order[k]];
    signs_.push_back(eigenvalue > 0 ? 1.0F : -1.0F);
    axes.col(k) = 0.5 / std::sqrt(std::abs(eigenvalue)) * signs_.back() * vectors.col(order[k]);
  }
  MatrixF coordinates(squared_.rows(), m);
  MatrixXd away(std::min(vertices_at_once, squared_.rows()), count);  // μ − δ of some vertices
  for (Index first = 0; first < squared_.rows(); first += away.rows()) {
    const Index some = std::min(away.rows(), squared_.rows() - first);
    away.topRows(some) = (-squared_.middleRows(first, some).cast<double>()).rowwise() + mean.transpose();
    coordinates.middleRows(first, some) = (away.topRows(some) * axes).cast<float>();
  }
  squared_.resize(0, 0);
  field_ = std::make_unique<MeanValueField>(positions_, triangles_, coordinates);
  coordinates_.resize(domain_->size(), m);
  at_source_.resize(m);
  phase_ = Phase::voxels;
}

void MeanValueDistance::carry() {
  const Index end = std::min(domain_->size(), next_voxel_ + voxels_per_step);
  for (; next_voxel_ < end; ++next_voxel_)
    field_->evaluate(domain_->center(next_voxel_), coordinates_.data() + next_voxel_ * coordinates_.cols());
  if (end == domain_->size()) phase_ = Phase::ready;
}

void MeanValueDistance::measure(const Vector3& source, double* distances) {
  field_->evaluate(source, at_source_.data());
  const Index m = coordinates_.cols();
  for (Index v = 0; v < domain_->size(); ++v) {
    const float* const at = coordinates_.data() + v * m;
    float sum = 0;
    for (Index k = 0; k < m; ++k) {
      const float difference = at[k] - at_source_[k];
      sum += signs_[k] * difference * difference;
    }
    distances[v] = std::sqrt(std::max(static_cast<double>(sum), (domain_->center(v) - source).squaredNorm()));
  }
}

}  // namespace handlebody
