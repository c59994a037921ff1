#include "core/irbf/quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/mesh/kuhn_tetrahedra.hpp"
#include "core/numerics/closest_rotation.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {

namespace {

constexpr double most_bytes = 1e9;
/** Rows of Ψ that are turned into doubles for a product. */
constexpr Index corners_at_once = 256;
/** A tetrahedron is flat when its volume is below this part of its longest edge's cube. */
constexpr double flat = 1e-9;

Matrix3 edges_of(const std::uint32_t* corners, const Points& points) {
  Matrix3 edges;
  for (Index k = 0; k < 3; ++k) edges.col(k) = (points.row(corners[k + 1]) - points.row(corners[0])).transpose();
  return edges;
}

double determinant(const Matrix3& m) {
  return m.col(0).dot(Vector3(m.col(1)).cross(Vector3(m.col(2))));
}

}  // namespace

Quality measure_tetrahedra(const Eigen::Ref<const Tetrahedra>& tetrahedra, const Points& rest, const Points& deformed) {
  Quality quality;
  double before = 0, after = 0;
  for (Index t = 0; t < tetrahedra.rows(); ++t) {
    const std::uint32_t* corners = tetrahedra.data() + 4 * t;
    const Matrix3 from = edges_of(corners, rest), to = edges_of(corners, deformed);
    const double six_volumes = determinant(from), longest = from.colwise().norm().maxCoeff();
    before += six_volumes, after += determinant(to);
    if (std::abs(six_volumes) <= flat * longest * longest * longest) continue;
    // df = to · from⁻¹, with the inverse from cross products.
    Matrix3 inverse;
    for (Index k = 0; k < 3; ++k)
      inverse.row(k) = Vector3(from.col((k + 1) % 3)).cross(Vector3(from.col((k + 2) % 3))).transpose() / six_volumes;
    Matrix3 gradient;
    for (Index k = 0; k < 3; ++k) gradient.col(k) = to * inverse.col(k);
    const double distortion = std::abs(six_volumes) / 6 * (gradient - closest_rotation(gradient)).squaredNorm();
    quality.total_distortion += distortion;
    quality.max_distortion = std::max(quality.max_distortion, distortion);
    if (!(determinant(gradient) > 0)) ++quality.flips;
    ++quality.tetrahedra;
  }
  quality.volume_ratio = before != 0 ? after / before : 1;
  return quality;
}

ColumnRanges ColumnRanges::of(const MatrixF& matrix) {
  ColumnRanges ranges;
  const auto columns = static_cast<std::size_t>(matrix.cols());
  ranges.low.assign(columns, 0);
  ranges.high.assign(columns, 0);
  for (Index i = 0; i < matrix.rows(); ++i) {
    const float* row = &matrix(i, 0);
    for (std::size_t c = 0; c < columns; ++c) {
      ranges.low[c] = i == 0 ? row[c] : std::min(ranges.low[c], row[c]);
      ranges.high[c] = i == 0 ? row[c] : std::max(ranges.high[c], row[c]);
    }
  }
  return ranges;
}

namespace {

Error too_large(Index voxels, double bytes) {
  return {HB_ERROR_OUT_OF_MEMORY,
          {"Measuring ", voxels, " voxels takes ", bytes / 1e6, " MB."},
          {"Measure tetrahedra of your own, or bake at a lower resolution."}};
}

}  // namespace

Result<std::unique_ptr<const VoxelQuality>> VoxelQuality::create(const Body& body, const Basis& basis,
                                                                 const ColumnRanges& on_surface) {
  const VoxelDomain& domain = body.domain;
  const Grid& grid = domain.grid();
  // Bytes of the grid's corner numbers; per voxel, six tetrahedra and at most eight corners of its own.
  const std::array<std::int64_t, 3> across{grid.dims[0] + 1, grid.dims[1] + 1, grid.dims[2] + 1};
  const double fixed = 4.0 * static_cast<double>(across[0] * across[1] * across[2]) + 1300.0 * static_cast<double>(domain.size());
  if (fixed > most_bytes) return too_large(domain.size(), fixed);
  std::unique_ptr<VoxelQuality> quality(new VoxelQuality());
  // Corners of the grid's cells, one more along each axis than there are voxels, numbered as they are met.
  std::vector<std::int32_t> numbers(static_cast<std::size_t>(across[0] * across[1] * across[2]), -1);
  std::vector<std::uint8_t> uses;  // of each corner by voxels: eight for those inside
  InteriorSamples samples;
  quality->tetrahedra_.resize(6 * domain.size(), 4);
  for (Index v = 0; v < domain.size(); ++v) {
    const auto cell = grid.cell(domain.voxels()[v]);
    std::array<std::uint32_t, 8> corners{};
    for (int c = 0; c < 8; ++c) {
      const std::array<std::int32_t, 3> at{cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)};
      std::int32_t& number = numbers[static_cast<std::size_t>(at[0] + across[0] * (at[1] + across[1] * at[2]))];
      if (number < 0) {
        number = static_cast<std::int32_t>(uses.size());
        uses.push_back(0);
        samples.add(domain, grid.origin + grid.spacing * (Vector3(at[0], at[1], at[2]) - Vector3::Constant(0.5)));
      }
      ++uses[number];
      corners[c] = static_cast<std::uint32_t>(number);
    }
    for (std::size_t t = 0; t < kuhn_tetrahedra.size(); ++t)
      for (std::size_t k = 0; k < 4; ++k)
        quality->tetrahedra_(6 * v + static_cast<Index>(t), static_cast<Index>(k)) = corners[kuhn_tetrahedra[t][k]];
  }
  // Most voxels have one corner of their own and those of thin shapes up to eight: how much the basis takes is known only now.
  const double bytes = fixed + 4.0 * static_cast<double>(samples.size()) * static_cast<double>(basis.size());
  if (bytes > most_bytes) return too_large(domain.size(), bytes);
  quality->psi_ = MatrixF::Zero(samples.size(), basis.size());
  if (auto done = basis.evaluate<float>(samples, quality->psi_); !done) return done.error();
  quality->rest_.resize(samples.size(), 3);
  double worst = 0;
  for (Index i = 0; i < samples.size(); ++i) {
    quality->rest_.row(i) = samples.point(i);
    if (uses[i] < 8) continue;
    for (std::size_t c = 0; c < on_surface.low.size(); ++c) {
      const float value = quality->psi_(i, static_cast<Index>(c)), low = on_surface.low[c], high = on_surface.high[c];
      const float beyond = std::max(value - high, low - value);
      if (beyond > 0 && high > low) worst = std::max(worst, static_cast<double>(beyond / (high - low)));
    }
  }
  quality->maximum_principle_ = worst;
  return std::unique_ptr<const VoxelQuality>(std::move(quality));
}

Quality VoxelQuality::measure(const Matrix3& linear, const Vector3& translation, const Matrix& coefficients,
                              double diagonal) const {
  const MatrixXd columns = coefficients;
  Points deformed(rest_.rows(), 3);
  for (Index first = 0; first < rest_.rows(); first += corners_at_once) {
    const Index some = std::min(corners_at_once, rest_.rows() - first);
    auto moved = deformed.middleRows(first, some);
    moved = rest_.middleRows(first, some) * (Matrix3::Identity() + linear).transpose();
    moved.rowwise() += translation.transpose();
    moved += product(psi_.middleRows(first, some).cast<double>(), columns);
  }
  Quality quality = measure_tetrahedra(tetrahedra_, rest_, deformed);
  const double cube = diagonal * diagonal * diagonal;
  quality.total_distortion *= cube;
  quality.max_distortion *= cube;
  quality.maximum_principle = maximum_principle_;
  return quality;
}

}  // namespace handlebody
