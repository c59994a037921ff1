// Compiled with -O3: see CMakeLists.txt.
#include "core/irbf/frame_kernel.hpp"

#include <algorithm>

namespace handlebody {

FrameKernel::FrameKernel(const PointsF& positions, const MatrixF& psi)
    : vertices_(positions.rows()), centers_(psi.cols()), coefficients_(psi.cols(), 3) {
  const Index tiles = (vertices_ + lanes - 1) / lanes;
  positions_.resize(static_cast<std::size_t>(tiles * 3));
  psi_.resize(static_cast<std::size_t>(tiles * centers_));
  for (Index v = 0; v < vertices_; ++v) {
    const auto tile = static_cast<std::size_t>(v / lanes), half = static_cast<std::size_t>(v / 4 % 2);
    for (Index axis = 0; axis < 3; ++axis) positions_[tile * 3 + static_cast<std::size_t>(axis)][half][v % 4] = positions(v, axis);
    Tile* row = psi_.data() + tile * static_cast<std::size_t>(centers_);
    for (Index c = 0; c < centers_; ++c) row[c][half][v % 4] = psi(v, c);
  }
}

void FrameKernel::apply(const Matrix3& linear, const Vector3& translation, const Matrix& coefficients, PointsF& displacement) {
  coefficients_ = coefficients.cast<float>();
  const Eigen::Matrix3f a = linear.cast<float>();
  const Eigen::Vector3f t = translation.cast<float>();
  const Tile* position = positions_.data();
  const Tile* psi = psi_.data();
  float* out = displacement.data();
  for (Index first = 0; first < vertices_; first += lanes, position += 3) {
    const auto affine = [&](Index axis, std::size_t half) {
      return a(axis, 0) * position[0][half] + a(axis, 1) * position[1][half] + a(axis, 2) * position[2][half] + t(axis);
    };
    Quad x0 = affine(0, 0), y0 = affine(1, 0), z0 = affine(2, 0);
    Quad x1 = affine(0, 1), y1 = affine(1, 1), z1 = affine(2, 1);
    const float* coefficient = coefficients_.data();
    for (Index c = 0; c < centers_; ++c, ++psi, coefficient += 3) {
      const auto [low, high] = *psi;
      x0 += low * coefficient[0];
      y0 += low * coefficient[1];
      z0 += low * coefficient[2];
      x1 += high * coefficient[0];
      y1 += high * coefficient[1];
      z1 += high * coefficient[2];
    }
    const Index count = std::min(lanes, vertices_ - first);
    for (Index lane = 0; lane < count; ++lane, out += 3) {
      out[0] = lane < 4 ? x0[lane] : x1[lane - 4];
      out[1] = lane < 4 ? y0[lane] : y1[lane - 4];
      out[2] = lane < 4 ? z0[lane] : z1[lane - 4];
    }
  }
}

}  // namespace handlebody
