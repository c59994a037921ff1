// Compiled with -O3: see CMakeLists.txt.
#include "core/skinning/dual_quaternion.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/numerics/closest_rotation.hpp"

namespace handlebody {
namespace {

using Quaternion = Eigen::Matrix<double, 4, 1>;  // w, x, y, z

/** The longest column of 4 q qᵀ, which is linear in the rotation. */
Quaternion quaternion_of(const Matrix3& r) {
  const double x = r(0, 0), y = r(1, 1), z = r(2, 2);
  Eigen::Matrix4d outer;
  outer.diagonal() << 1 + x + y + z, 1 + x - y - z, 1 - x + y - z, 1 - x - y + z;
  Index longest = 0;
  for (Index i = 0; i < 3; ++i) {
    const Index u = (i + 1) % 3, v = (i + 2) % 3;
    outer(0, i + 1) = outer(i + 1, 0) = r(v, u) - r(u, v);
    outer(u + 1, v + 1) = outer(v + 1, u + 1) = r(u, v) + r(v, u);
    if (outer(i + 1, i + 1) > outer(longest, longest)) longest = i + 1;
  }
  return outer.col(longest).normalized();
}

/** Within a matrix of the plane, padded with a 1. The identity where no rotation is closest. */
Matrix3 closest_plane_rotation(const Matrix3& a) {
  const double x = a(0, 0) + a(1, 1), y = a(1, 0) - a(0, 1), length = std::sqrt(x * x + y * y);
  Matrix3 r = Matrix3::Identity();
  if (!(length > 0)) return r;
  r(0, 0) = r(1, 1) = x / length;
  r(1, 0) = y / length;
  r(0, 1) = -r(1, 0);
  return r;
}

}  // namespace

Result<DualQuaternion> DualQuaternion::create(const Eigen::Ref<const Matrix>& positions, const Eigen::Ref<const Matrix>& weights) {
  const double n = static_cast<double>(positions.rows()), h = static_cast<double>(weights.cols());
  if (auto fine = check_skin(positions, weights, n * (4 + h) + h * (8 + h)); !fine) return fine.error();
  for (Index i = 0; i < weights.rows(); ++i) {
    Index j = 0;
    while (j < weights.cols() && weights(i, j) == 0) ++j;
    if (j == weights.cols())
      return Error(HB_ERROR_WEIGHTS_MISSING, {"No handle moves vertex ", i, ": its weights are all 0."},
                   {"Give every vertex a weight, and every part of the shape a handle."}, HB_CULPRIT_VERTEX, i);
  }
  return DualQuaternion(positions, weights);
}

DualQuaternion::DualQuaternion(const Eigen::Ref<const Matrix>& positions, const Eigen::Ref<const Matrix>& weights)
    : Skin(positions.rows(), positions.cols(), weights.cols()),
      center_(box_center(positions)),
      regions_(Matrix::Zero(handles_, dimension_)),
      rest_(positions.data(), positions.data() + positions.size()),
      weights_(static_cast<std::size_t>(vertices_ * handles_)),
      pivot_(static_cast<std::size_t>(vertices_)),
      motions_(static_cast<std::size_t>(handles_ * (dimension_ - 1))),
      sides_(static_cast<std::size_t>(handles_ * handles_)) {
  for (Index axis = 0; axis < dimension_; ++axis) center_[axis] = static_cast<float>(center_[axis]);
  Vector influence = Vector::Zero(handles_);
  for (Index i = 0; i < vertices_; ++i) {
    Index pivot = 0;
    for (Index j = 1; j < handles_; ++j)
      if (std::abs(weights(i, j)) > std::abs(weights(i, pivot))) pivot = j;
    pivot_[i] = static_cast<std::uint32_t>(pivot);
    for (Index j = 0; j < handles_; ++j) {
      const double w = weights(i, j) / std::abs(weights(i, pivot));
      weights_[i * handles_ + j] = static_cast<float>(w);
      influence[j] += w * w;
      for (Index axis = 0; axis < dimension_; ++axis) regions_(j, axis) += w * w * (positions(i, axis) - center_[axis]);
    }
  }
  for (Index j = 0; j < handles_; ++j)
    for (Index axis = 0; influence[j] > 0 && axis < dimension_; ++axis) regions_(j, axis) /= influence[j];
}

void DualQuaternion::read_motions() {
  const Index d = dimension_, h = handles_;
  for (Index j = 0; j < h; ++j) {
    const double* t = transforms_.data() + j * d * (d + 1);
    Matrix3 a = Matrix3::Identity();
    Vector3 shift = Vector3::Zero(), region = shift, center = shift;
    for (Index row = 0; row < d; ++row) {
      for (Index axis = 0; axis < d; ++axis) a(row, axis) = t[row * (d + 1) + axis];
      shift[row] = t[row * (d + 1) + d];
      region[row] = regions_(j, row);
      center[row] = center_[row];
    }
    const Matrix3 r = d == 3 ? closest_rotation(a) : closest_plane_rotation(a);
    Quaternion q = quaternion_of(r);
    // From the center, A (c + g) + t = c + R g + τ: a sum of differences, zero for the identity.
    const Vector3 tau = (a - Matrix3::Identity()) * center + shift + (a - r) * region;
    Quaternion dual;
    if (d == 3) {
      const Vector3 v = q.tail<3>();
      dual << -tau.dot(v), q[0] * tau + tau.cross(v);
    } else {
      q = {q[0], q[3], 0, 0};
      dual << 0, 0, tau[0] * q[0] + tau[1] * q[1], tau[1] * q[0] - tau[0] * q[1];
    }
    for (Index k = 0; k < 4; ++k) {
      if (d == 3) motions_[2 * j][k] = static_cast<float>(q[k]);
      if (d == 3) motions_[2 * j + 1][k] = static_cast<float>(dual[k] / 2);
      if (d == 2) motions_[j][k] = static_cast<float>(q[k] + dual[k] / 2);
    }
  }
  for (Index j = 0; j < h; ++j)
    for (Index k = 0; k < h; ++k) {
      const Quad product = motions_[j * (d - 1)] * motions_[k * (d - 1)];
      const float cosine = d == 3 ? product[0] + product[1] + product[2] + product[3] : product[0] + product[1];
      sides_[j * h + k] = cosine < 0 ? -1.0F : 1.0F;
    }
}

template <Index d>
void DualQuaternion::move_all(float* out) const {
  const Index h = handles_;
  float center[d];
  for (Index axis = 0; axis < d; ++axis) center[axis] = static_cast<float>(center_[axis]);
  const float *weights = weights_.data(), *rest = rest_.data();
  for (Index i = 0; i < vertices_; ++i, weights += h, rest += d, out += d) {
    const float* sides = sides_.data() + pivot_[i] * h;
    Quad real = {}, dual = {};
    for (Index j = 0; j < h; ++j) {
      const float w = weights[j] * sides[j];
      real += w * motions_[j * (d - 1)];
      if (d == 3) dual += w * motions_[j * (d - 1) + 1];
    }
    float length = real[0] * real[0] + real[1] * real[1];
    if (d == 3) length += real[2] * real[2] + real[3] * real[3];
    if (!(length > 1e-10F)) {  // the pivot's weight is 1
      real = motions_[pivot_[i] * (d - 1)];
      if (d == 3) dual = motions_[pivot_[i] * (d - 1) + 1];
      length = 1;
    }
    const float scale = 2 / length;
    if constexpr (d == 2) {  // (q² − 1) x + 2 ε̂ q, of complex numbers
      const float w = real[0], z = real[1], dx = real[2], dy = real[3];
      const float x = rest[0] - center[0], y = rest[1] - center[1];
      out[0] = rest[0] + scale * (-z * (z * x + w * y) + dx * w - dy * z);
      out[1] = rest[1] + scale * (z * (w * x - z * y) + dx * z + dy * w);
    } else {  // v × (v × x + w x) + the vector of ε̂ q*
      const float w = real[0], vx = real[1], vy = real[2], vz = real[3];
      const float x = rest[0] - center[0], y = rest[1] - center[1], z = rest[2] - center[2];
      const float cx = vy * z - vz * y + w * x, cy = vz * x - vx * z + w * y, cz = vx * y - vy * x + w * z;
      out[0] = rest[0] + scale * (vy * cz - vz * cy + w * dual[1] - dual[0] * vx + vy * dual[3] - vz * dual[2]);
      out[1] = rest[1] + scale * (vz * cx - vx * cz + w * dual[2] - dual[0] * vy + vz * dual[1] - vx * dual[3]);
      out[2] = rest[2] + scale * (vx * cy - vy * cx + w * dual[3] - dual[0] * vz + vx * dual[2] - vy * dual[1]);
    }
  }
}

void DualQuaternion::move(float* out) {
  read_motions();
  dimension_ == 2 ? move_all<2>(out) : move_all<3>(out);
}

}  // namespace handlebody
