// Compiled with -O3: see CMakeLists.txt.
#include "core/irbf/frame_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handlebody {

namespace {

constexpr double most = 32767;             // of a 16-bit number
constexpr double most_sum = 2147483647.0;  // of a 32-bit one

using Pairs = std::int16_t __attribute__((vector_size(16)));
using Sums = std::int32_t __attribute__((vector_size(16)));

/** Products of the numbers of two pairs, added up pair by pair. One instruction where the machine has it. */
inline Sums dot(Pairs a, Pairs b) {
#if defined(__wasm_simd128__)
  return reinterpret_cast<Sums>(__builtin_wasm_dot_s_i32x4_i16x8(a, b));
#elif defined(__SSE2__)
  return reinterpret_cast<Sums>(__builtin_ia32_pmaddwd128(a, b));
#else
  Sums sums;
  for (int lane = 0; lane < 4; ++lane) sums[lane] = a[2 * lane] * b[2 * lane] + a[2 * lane + 1] * b[2 * lane + 1];
  return sums;
#endif
}

inline Pairs splat(std::int32_t pair) {
  return reinterpret_cast<Pairs>(Sums{pair, pair, pair, pair});
}

std::int32_t pack(std::int32_t low, std::int32_t high) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(low & 0xffff) | static_cast<std::uint32_t>(high) << 16);
}

}  // namespace

FrameKernel::FrameKernel(const PointsF& positions, const MatrixF& matrix, FramePrecision precision)
    : precision_(precision), vertices_(positions.rows()), columns_(matrix.cols()) {
  const Index tiles = (vertices_ + lanes - 1) / lanes;
  positions_.resize(tiles * 3);
  for (Index v = 0; v < vertices_; ++v) {
    FloatTile* tile = positions_.data() + v / lanes * 3;
    for (Index axis = 0; axis < 3; ++axis) tile[axis][v % lanes / 4][v % 4] = positions(v, axis);
  }
  if (precision == FramePrecision::floating) {
    store_floats(matrix);
  } else {
    store_fixed(matrix);
  }
}

void FrameKernel::store_floats(const MatrixF& matrix) {
  floats_.resize((vertices_ + lanes - 1) / lanes * columns_);
  for (Index v = 0; v < vertices_; ++v) {
    FloatTile* row = floats_.data() + v / lanes * columns_;
    for (Index c = 0; c < columns_; ++c) row[c][v % lanes / 4][v % 4] = matrix(v, c);
  }
}

void FrameKernel::store_fixed(const MatrixF& matrix) {
  const Index pairs = (columns_ + 1) / 2, chunks = (pairs + chunk - 1) / chunk;
  const auto columns = static_cast<std::size_t>(columns_);
  fixed_.resize((vertices_ + lanes - 1) / lanes * pairs);
  largest_sums_.assign(chunks, 0);
  std::vector<float> low(columns, 0), high(columns, 0), means(columns), scales(columns);
  means_.assign(columns, 0);
  for (Index v = 0; v < vertices_; ++v) {
    const float* row = &matrix(v, 0);
    for (std::size_t c = 0; c < columns; ++c) {
      low[c] = v == 0 ? row[c] : std::min(low[c], row[c]);
      high[c] = v == 0 ? row[c] : std::max(high[c], row[c]);
      means_[c] += static_cast<double>(row[c]);
    }
  }
  units_.resize(columns);
  for (std::size_t c = 0; c < columns; ++c) {
    means[c] = static_cast<float>(means_[c] / static_cast<double>(vertices_));
    means_[c] = means[c];
    const double reach = std::max(high[c] - means[c], means[c] - low[c]);
    units_[c] = reach / most;
    const double scale = most / reach;
    scales[c] = scale <= std::numeric_limits<float>::max() ? static_cast<float>(scale) : 0;
  }
  for (Index v = 0; v < vertices_; ++v) {
    FixedTile* row = fixed_.data() + v / lanes * pairs;
    const float* numbers = &matrix(v, 0);
    const auto quad = static_cast<std::size_t>(v % lanes / 4);
    for (Index c = 0, k = 0; c < columns_; ++k) {
      float sum = 0;
      for (const Index end = std::min(columns_, c + 2 * chunk); c < end; ++c) {
        const float scaled = (numbers[c] - means[c]) * scales[c];
        const float code =
            std::max(-32767.f, std::min(32767.f, std::floor(scaled + 0.5f)));  // in this order, a number also for NaN
        row[c / 2][quad][v % 4 * 2 + c % 2] = static_cast<std::int16_t>(code);
        sum += std::abs(code);
      }
      double& largest = largest_sums_[k];
      largest = std::max(largest, static_cast<double>(sum));
    }
  }
}

FrameKernel::Scratch FrameKernel::scratch() const {
  Scratch scratch;
  if (precision_ == FramePrecision::floating) {
    scratch.floats.resize(columns_, 3);
  } else {
    scratch.packed.resize(3 * ((columns_ + 1) / 2));
    scratch.worth.resize(3 * largest_sums_.size());
  }
  return scratch;
}

/** To 16 bits: coefficient · unit of its column = worth · code. */
void FrameKernel::scale_coefficients(const Matrix& coefficients, Scratch& scratch) const {
  for (Index axis = 0; axis < 3; ++axis) {
    for (Index c = 0, k = 0; c < columns_; ++k) {
      const Index end = std::min(columns_, c + 2 * chunk);
      const auto size = [&](Index column) { return coefficients(column, axis) * units_[column]; };
      double largest = 0;
      for (Index column = c; column < end; ++column) largest = std::max(largest, std::abs(size(column)));
      // |Σ code·code| ≤ Σ |code of the matrix| (scale·largest + ½) < 2³¹.
      const double sum = largest_sums_[k];
      const double scale = largest > 0 ? std::min(most, sum > 0 ? most_sum / sum - 1 : most) / largest : 0;
      for (; c < end; c += 2) {
        const auto code = [&](Index column) {
          return column < end ? static_cast<std::int32_t>(std::lrint(size(column) * scale)) : 0;
        };
        scratch.packed[c / 2 * 3 + axis] = pack(code(c), code(c + 1));
      }
      scratch.worth[3 * k + axis] = scale > 0 ? static_cast<float>(1 / scale) : 0;
    }
  }
}

inline void FrameKernel::add_floats(Index tile, const Scratch& scratch, std::array<FloatTile, 3>& sums) const {
  const FloatTile* row = floats_.data() + tile * columns_;
  const float* coefficient = scratch.floats.data();
  for (Index c = 0; c < columns_; ++c, ++row, coefficient += 3) {
    for (std::size_t q = 0; q < quads; ++q) {
      const Quad numbers = (*row)[q];
      for (std::size_t axis = 0; axis < 3; ++axis) sums[axis][q] += numbers * coefficient[axis];
    }
  }
}

inline void FrameKernel::add_fixed(Index tile, const Scratch& scratch, std::array<FloatTile, 3>& sums) const {
  const Index pairs = (columns_ + 1) / 2;
  const FixedTile* row = fixed_.data() + tile * pairs;
  const std::int32_t* packed = scratch.packed.data();
  const float* worth = scratch.worth.data();
  for (Index first = 0; first < pairs; first += chunk, worth += 3) {
    std::array<std::array<Sums, quads>, 3> partial{};
    for (const FixedTile* end = row + std::min(chunk, pairs - first); row < end; ++row, packed += 3) {
      const std::array<Pairs, 3> coefficient{splat(packed[0]), splat(packed[1]), splat(packed[2])};
      for (std::size_t q = 0; q < quads; ++q) {
        const Pairs numbers = (*row)[q];
        for (std::size_t axis = 0; axis < 3; ++axis) partial[axis][q] += dot(numbers, coefficient[axis]);
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t q = 0; q < quads; ++q) sums[axis][q] += __builtin_convertvector(partial[axis][q], Quad) * worth[axis];
  }
}

void FrameKernel::apply(const Matrix3& linear, const Vector3& translation, const Matrix& coefficients, Scratch& scratch,
                        PointsF& displacement) const {
  const bool fixed = precision_ == FramePrecision::fixed;
  Vector3 shift = translation;
  if (fixed) {
    scale_coefficients(coefficients, scratch);
    for (Index c = 0; c < columns_; ++c)
      for (Index axis = 0; axis < 3; ++axis) shift[axis] += means_[c] * coefficients(c, axis);
  } else {
    scratch.floats = coefficients.cast<float>();
  }
  const Eigen::Matrix3f a = linear.cast<float>();
  const Eigen::Vector3f t = shift.cast<float>();
  const FloatTile* position = positions_.data();
  float* out = displacement.data();
  for (Index first = 0; first < vertices_; first += lanes, position += 3) {
    std::array<FloatTile, 3> sums;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto row = static_cast<Index>(axis);
      for (std::size_t q = 0; q < quads; ++q)
        sums[axis][q] = a(row, 0) * position[0][q] + a(row, 1) * position[1][q] + a(row, 2) * position[2][q] + t(row);
    }
    if (fixed) {
      add_fixed(first / lanes, scratch, sums);
    } else {
      add_floats(first / lanes, scratch, sums);
    }
    const Index count = std::min(lanes, vertices_ - first);
    for (Index lane = 0; lane < count; ++lane, out += 3)
      for (std::size_t axis = 0; axis < 3; ++axis) out[axis] = sums[axis][lane / 4][lane % 4];
  }
}

}  // namespace handlebody
