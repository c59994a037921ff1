#include "core/irbf/frame_kernel.hpp"

#include <algorithm>

namespace handlebody {

FrameKernel::FrameKernel(const PointsF& positions, const MatrixF& psi)
    : vertices_(positions.rows()), centers_(psi.cols()), coefficients_(psi.cols(), 3) {
  const Index tiles = (vertices_ + lanes - 1) / lanes;
  positions_.assign(static_cast<std::size_t>(tiles * 3), Tile::Zero());
  psi_.assign(static_cast<std::size_t>(tiles * centers_), Tile::Zero());
  for (Index v = 0; v < vertices_; ++v) {
    const Index tile = v / lanes, lane = v % lanes;
    for (Index axis = 0; axis < 3; ++axis) positions_[static_cast<std::size_t>(tile * 3 + axis)](lane) = positions(v, axis);
    for (Index c = 0; c < centers_; ++c) psi_[static_cast<std::size_t>(tile * centers_ + c)](lane) = psi(v, c);
  }
}

void FrameKernel::apply(const Matrix3& linear, const Vector3& translation, const Matrix& coefficients, PointsF& displacement) {
  coefficients_ = coefficients.cast<float>();
  const Eigen::Matrix3f a = linear.cast<float>();
  const Eigen::Vector3f t = translation.cast<float>();
  const Tile* position = positions_.data();
  const Tile* psi = psi_.data();
  for (Index first = 0; first < vertices_; first += lanes, position += 3) {
    const Tile &px = position[0], &py = position[1], &pz = position[2];
    Tile x = a(0, 0) * px + a(0, 1) * py + a(0, 2) * pz + t.x();
    Tile y = a(1, 0) * px + a(1, 1) * py + a(1, 2) * pz + t.y();
    Tile z = a(2, 0) * px + a(2, 1) * py + a(2, 2) * pz + t.z();
    const float* coefficient = coefficients_.data();
    for (Index c = 0; c < centers_; ++c, ++psi, coefficient += 3) {
      x += *psi * coefficient[0];
      y += *psi * coefficient[1];
      z += *psi * coefficient[2];
    }
    const Index count = std::min(lanes, vertices_ - first);
    for (Index lane = 0; lane < count; ++lane) displacement.row(first + lane) << x(lane), y(lane), z(lane);
  }
}

}  // namespace handlebody
