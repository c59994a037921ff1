#include "core/skinning/skin.hpp"

#include <algorithm>
#include <cmath>

namespace handlebody {
namespace {

bool fits_float(double number) {
  return std::isfinite(static_cast<float>(number));
}

/** Where the first number is that a float cannot hold; `count` where there is none. */
Index first_unfit(const double* numbers, Index count) {
  Index i = 0;
  while (i < count && fits_float(numbers[i])) ++i;
  return i;
}

}  // namespace

Skin::Skin(Index vertices, Index dimension, Index handles)
    : vertices_(vertices),
      dimension_(dimension),
      handles_(handles),
      transforms_(Vector::Zero(handles * dimension * (dimension + 1))) {
  for (Index j = 0; j < handles; ++j)
    for (Index axis = 0; axis < dimension; ++axis) transforms_[(j * dimension + axis) * (dimension + 1) + axis] = 1;
}

Result<Done> Skin::deform(float* out) {
  const Index bad = first_unfit(transforms_.data(), transforms_.size()), size = dimension_ * (dimension_ + 1);
  if (bad < transforms_.size())
    return Error(HB_ERROR_TARGET_NOT_FINITE,
                 {"Number ", bad % size, " of the transform of handle ", bad / size, " is ", transforms_[bad], "."},
                 {"Write finite numbers of single precision's range."}, HB_CULPRIT_HANDLE, bad / size);
  move(out);
  return Done{};
}

Result<Done> check_skin(const Eigen::Ref<const Matrix>& positions, const Eigen::Ref<const Matrix>& weights, double floats) {
  const Index n = positions.rows(), d = positions.cols(), h = weights.cols();
  if (d != 2 && d != 3)
    return Error(HB_ERROR_INVALID_SHAPE, {"Positions have ", d, " coordinates."}, {"Use 2 in the plane, 3 in space."});
  if (n == 0 || h == 0)
    return Error(HB_ERROR_INVALID_SHAPE, {"There are ", n, " vertices and ", h, " handles."}, {"Give one or more of both."});
  if (weights.rows() != n)
    return Error(HB_ERROR_INVALID_SHAPE, {"There are ", weights.rows(), " rows of weights for ", n, " vertices."},
                 {"Give every vertex one weight a handle."});
  if (!(floats <= 0x1p28))
    return Error(HB_ERROR_OUT_OF_MEMORY, {"Blending ", n, " vertices by ", h, " handles takes ", floats * 4e-9, " GB."},
                 {"Use fewer vertices or fewer handles."});
  if (const Index i = first_unfit(positions.data(), n * d); i < n * d)
    return Error(HB_ERROR_MESH_NOT_FINITE, {"Coordinate ", i % d, " of vertex ", i / d, " is ", positions.data()[i], "."},
                 {"Give finite coordinates of single precision's range."}, HB_CULPRIT_VERTEX, i / d);
  if (const Index i = first_unfit(weights.data(), n * h); i < n * h)
    return Error(HB_ERROR_VALUE_NOT_FINITE, {"The weight of handle ", i % h, " at vertex ", i / h, " is ", weights.data()[i], "."},
                 {"Give finite weights."}, HB_CULPRIT_VERTEX, i / h);
  return Done{};
}

Vector box_center(const Eigen::Ref<const Matrix>& positions) {
  Vector center(positions.cols());
  for (Index axis = 0; axis < center.size(); ++axis) {
    double low = positions(0, axis), high = low;
    for (Index i = 1; i < positions.rows(); ++i) {
      low = std::min(low, positions(i, axis));
      high = std::max(high, positions(i, axis));
    }
    center[axis] = low / 2 + high / 2;
  }
  return center;
}

}  // namespace handlebody
