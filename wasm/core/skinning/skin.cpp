#include "core/skinning/skin.hpp"

#include <algorithm>
#include <cmath>

namespace handlebody {
namespace {

bool fits_float(double number) {
  return std::isfinite(static_cast<float>(number));
}

/** Index of the first number that a float cannot hold; `count` where there is none. */
Index first_unfit(const double* numbers, Index count) {
  Index i = 0;
  while (i < count && fits_float(numbers[i])) ++i;
  return i;
}

}  // namespace

Skin::Skin(Index vertices, Index dimension, Index handles)
    : vertices_(vertices), dimension_(dimension), handles_(handles), transforms_(handles * dimension * (dimension + 1)) {
  for (Index row = 0; row < handles * dimension; ++row) transforms_[row * (dimension + 1) + row % dimension] = 1;
}

Result<Done> Skin::deform(float* out) {
  const Index size = dimension_ * (dimension_ + 1), numbers = handles_ * size, bad = first_unfit(transforms_.data(), numbers);
  if (bad < numbers)
    return Error(HB_ERROR_TARGET_NOT_FINITE,
                 {"Number ", bad % size, " of the transform of handle ", bad / size, " is ", transforms_[bad], "."},
                 {"Write finite numbers of single precision's range."}, HB_CULPRIT_HANDLE, bad / size);
  move(out);
  return Done{};
}

Result<Done> check_shape(const WeightedShape& shape, double floats) {
  const auto [positions, weights, n, d, h] = shape;
  if (d != 2 && d != 3)
    return Error(HB_ERROR_INVALID_SHAPE, {"Positions have ", d, " coordinates."}, {"Use 2 in the plane, 3 in space."});
  if (n <= 0 || h <= 0)
    return Error(HB_ERROR_INVALID_SHAPE, {"There are ", n, " vertices and ", h, " handles."}, {"Give one or more of both."});
  if (!(floats <= 0x1p28))
    return Error(HB_ERROR_OUT_OF_MEMORY, {"Blending ", n, " vertices by ", h, " handles takes ", floats * 4e-9, " GB."},
                 {"Use fewer vertices or fewer handles."});
  if (const Index i = first_unfit(positions, n * d); i < n * d)
    return Error(HB_ERROR_MESH_NOT_FINITE, {"Coordinate ", i % d, " of vertex ", i / d, " is ", positions[i], "."},
                 {"Give finite coordinates of single precision's range."}, HB_CULPRIT_VERTEX, i / d);
  if (const Index i = first_unfit(weights, n * h); i < n * h)
    return Error(HB_ERROR_VALUE_NOT_FINITE, {"The weight of handle ", i % h, " at vertex ", i / h, " is ", weights[i], "."},
                 {"Give finite weights."}, HB_CULPRIT_VERTEX, i / h);
  return Done{};
}

void box_center(const double* positions, Index vertices, Index dimension, double* center) {
  for (Index axis = 0; axis < dimension; ++axis) {
    double low = positions[axis], high = low;
    for (Index i = 1; i < vertices; ++i) {
      low = std::min(low, positions[i * dimension + axis]);
      high = std::max(high, positions[i * dimension + axis]);
    }
    center[axis] = static_cast<float>((low + high) / 2);
  }
}

}  // namespace handlebody
