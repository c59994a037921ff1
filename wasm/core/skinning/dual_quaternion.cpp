#include "core/skinning/dual_quaternion.hpp"

#include <cmath>
#include <utility>

#include "core/numerics/closest_rotation.hpp"

namespace handlebody {
namespace {

/** w, x, y, z of a quaternion, or the real and the dual complex number of a motion in the plane; in memory, four floats without
 * alignment. */
using Quad = float __attribute__((vector_size(16), aligned(4)));

class DualQuaternion final : public Skin {
 public:
  /** `pivots`: of each vertex the handle with its largest weight. */
  DualQuaternion(const WeightedShape& shape, std::vector<std::uint32_t> pivots);

 private:
  void move(float* out) override;
  void read_motion(Index handle);
  template <Index d>
  void move_all(float* out) const;

  const Quad* motion(Index handle) const { return reinterpret_cast<const Quad*>(motions_.data()) + handle * (dimension_ - 1); }

  double center_[3] = {};
  std::vector<double> regions_;        // h×3: where handles act, from the center
  std::vector<float> rows_;            // per vertex: d numbers of vᵢ, h of wᵢⱼ, the largest ±1
  std::vector<std::uint32_t> pivots_;  // n
  std::vector<float> motions_;         // per handle: real and dual quaternion, or in the plane both in one
  std::vector<float> sides_;           // h×h: whether two motions' real parts point to the same side, ±1
};

DualQuaternion::DualQuaternion(const WeightedShape& shape, std::vector<std::uint32_t> pivots)
    : Skin(shape.vertices, shape.dimension, shape.handles),
      regions_(handles_ * 3),
      rows_(vertices_ * (dimension_ + handles_)),
      pivots_(std::move(pivots)),
      motions_(handles_ * (dimension_ - 1) * 4),
      sides_(handles_ * handles_) {
  const Index d = dimension_, h = handles_;
  box_center(shape.positions, vertices_, d, center_);
  std::vector<double> influence(h);
  float* row = rows_.data();
  const double *position = shape.positions, *weights = shape.weights;
  for (Index i = 0; i < vertices_; ++i, position += d, weights += h) {
    for (Index axis = 0; axis < d; ++axis) *row++ = static_cast<float>(position[axis]);
    for (Index j = 0; j < h; ++j) {
      const double w = weights[j] / std::abs(weights[pivots_[i]]);
      *row++ = static_cast<float>(w);
      influence[j] += w * w;
      for (Index axis = 0; axis < d; ++axis) regions_[3 * j + axis] += w * w * (position[axis] - center_[axis]);
    }
  }
  for (Index k = 0; k < 3 * h; ++k) regions_[k] /= influence[k / 3] > 0 ? influence[k / 3] : 1;
}

void DualQuaternion::read_motion(Index handle) {
  const Index d = dimension_;
  const double *t = transforms_.data() + handle * d * (d + 1), *region = regions_.data() + 3 * handle;
  Matrix3 a = Matrix3::Identity(), r = a;
  for (Index row = 0; row < d; ++row)
    for (Index axis = 0; axis < d; ++axis) a(row, axis) = t[row * (d + 1) + axis];
  if (d == 3) {
    r = closest_rotation(a);
  } else {
    const double x = a(0, 0) + a(1, 1), y = a(1, 0) - a(0, 1), length = std::sqrt(x * x + y * y);
    if (length > 0) {
      r(0, 0) = r(1, 1) = x / length;
      r(1, 0) = y / length;
      r(0, 1) = -r(1, 0);
    }
  }
  // 4 q qᵀ is linear in the rotation: its longest column is a multiple of q.
  double outer[4][4] = {{1 + r(0, 0) + r(1, 1) + r(2, 2)}};
  Index longest = 0;
  for (Index i = 0; i < 3; ++i) {
    const Index u = (i + 1) % 3, v = (i + 2) % 3;
    outer[i + 1][i + 1] = 1 + r(i, i) - r(u, u) - r(v, v);
    outer[0][i + 1] = outer[i + 1][0] = r(v, u) - r(u, v);
    outer[u + 1][v + 1] = outer[v + 1][u + 1] = r(u, v) + r(v, u);
    if (outer[i + 1][i + 1] > outer[longest][longest]) longest = i + 1;
  }
  const double scale = 1 / std::sqrt(4 * outer[longest][longest]);
  const double w = outer[longest][0] * scale, x = outer[longest][1] * scale, y = outer[longest][2] * scale,
               z = outer[longest][3] * scale;
  // From the center, A (c + g) + t = c + R g + τ: a sum of differences, zero for the identity.
  double tau[3] = {};
  for (Index row = 0; row < d; ++row) {
    tau[row] = t[row * (d + 1) + d];
    for (Index axis = 0; axis < d; ++axis)
      tau[row] += (a(row, axis) - (axis == row ? 1 : 0)) * center_[axis] + (a(row, axis) - r(row, axis)) * region[axis];
  }
  const double dual[4] = {-(tau[0] * x + tau[1] * y + tau[2] * z) / 2, (w * tau[0] + tau[1] * z - tau[2] * y) / 2,
                          (w * tau[1] + tau[2] * x - tau[0] * z) / 2, (w * tau[2] + tau[0] * y - tau[1] * x) / 2};
  const double space[8] = {w, x, y, z, dual[0], dual[1], dual[2], dual[3]}, plane[4] = {w, z, dual[1], dual[2]};
  for (Index k = 0; k < 4 * (d - 1); ++k) motions_[handle * 4 * (d - 1) + k] = static_cast<float>(d == 3 ? space[k] : plane[k]);
}

template <Index d>
void DualQuaternion::move_all(float* out) const {
  const Index h = handles_;
  float center[d];
  for (Index axis = 0; axis < d; ++axis) center[axis] = static_cast<float>(center_[axis]);
  const float* row = rows_.data();
  for (Index i = 0; i < vertices_; ++i, row += d + h, out += d) {
    const float *weights = row + d, *sides = sides_.data() + pivots_[i] * h;
    const Quad* q = motion(0);
    Quad real = {}, dual = {};
    for (Index j = 0; j < h; ++j) {
      const float weight = weights[j] * sides[j];
      real += weight * *q++;
      if (d == 3) dual += weight * *q++;
    }
    const auto square = [&] {
      return real[0] * real[0] + real[1] * real[1] + (d == 3 ? real[2] * real[2] + real[3] * real[3] : 0);
    };
    float length = square();
    if (!(length > 1e-10F)) {  // the blend canceled: take the pivot's own motion
      real = motion(pivots_[i])[0];
      dual = motion(pivots_[i])[d - 2];
      length = square();
    }
    const float scale = 2 / length, x = row[0] - center[0], y = row[1] - center[1];
    if constexpr (d == 2) {  // (q² − 1) x + 2 ε̂ q, of complex numbers
      const float w = real[0], v = real[1], dx = real[2], dy = real[3];
      out[0] = row[0] + scale * (-v * (v * x + w * y) + dx * w - dy * v);
      out[1] = row[1] + scale * (v * (w * x - v * y) + dx * v + dy * w);
    } else {  // 2 v × (v × x + w x) + the vector of 2 ε̂ q*
      const float w = real[0], vx = real[1], vy = real[2], vz = real[3], z = row[2] - center[2];
      const float cx = vy * z - vz * y + w * x, cy = vz * x - vx * z + w * y, cz = vx * y - vy * x + w * z;
      out[0] = row[0] + scale * (vy * cz - vz * cy + w * dual[1] - dual[0] * vx + vy * dual[3] - vz * dual[2]);
      out[1] = row[1] + scale * (vz * cx - vx * cz + w * dual[2] - dual[0] * vy + vz * dual[1] - vx * dual[3]);
      out[2] = row[2] + scale * (vx * cy - vy * cx + w * dual[3] - dual[0] * vz + vx * dual[2] - vy * dual[1]);
    }
  }
}

void DualQuaternion::move(float* out) {
  const Index h = handles_;
  for (Index j = 0; j < h; ++j) read_motion(j);
  for (Index j = 0; j < h; ++j)
    for (Index k = 0; k < h; ++k) {
      const Quad product = *motion(j) * *motion(k);
      const float cosine = product[0] + product[1] + (dimension_ == 3 ? product[2] + product[3] : 0);
      sides_[j * h + k] = cosine < 0 ? -1.0F : 1.0F;
    }
  dimension_ == 2 ? move_all<2>(out) : move_all<3>(out);
}

}  // namespace

Result<std::unique_ptr<Skin>> dual_quaternion_blend(const WeightedShape& shape) {
  const Index n = shape.vertices, h = shape.handles;
  const double floats = static_cast<double>(n) * static_cast<double>(4 + h) + static_cast<double>(h) * static_cast<double>(14 + h);
  if (auto fine = check_shape(shape, floats); !fine) return fine.error();
  std::vector<std::uint32_t> pivots(n);
  for (Index i = 0; i < n; ++i) {
    const double* weights = shape.weights + i * h;
    Index pivot = 0;
    for (Index j = 1; j < h; ++j)
      if (std::abs(weights[j]) > std::abs(weights[pivot])) pivot = j;
    if (weights[pivot] == 0)
      return Error(HB_ERROR_WEIGHTS_MISSING, {"No handle moves vertex ", i, ": its weights are all 0."},
                   {"Give every vertex a weight, and every part of the shape a handle."}, HB_CULPRIT_VERTEX, i);
    pivots[i] = static_cast<std::uint32_t>(pivot);
  }
  return std::unique_ptr<Skin>(std::make_unique<DualQuaternion>(shape, std::move(pivots)));
}

}  // namespace handlebody
