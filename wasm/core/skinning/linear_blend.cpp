// Compiled with -O3: see CMakeLists.txt.
#include "core/skinning/linear_blend.hpp"

#include <algorithm>
#include <cmath>

namespace handlebody {
namespace {

constexpr Index lanes = 4;

}  // namespace

Result<LinearBlend> LinearBlend::create(const Eigen::Ref<const Matrix>& positions, const Eigen::Ref<const Matrix>& weights,
                                        LinearBlendForm form) {
  const double n = static_cast<double>(positions.rows()), d = static_cast<double>(positions.cols()),
               h = static_cast<double>(weights.cols() + 1);
  const double floats = n * (d + (form == LinearBlendForm::compiled ? (d + 1) * h : h)) + 4 * (d + 1) * d * h;
  if (auto fine = check_skin(positions, weights, floats); !fine) return fine.error();
  return LinearBlend(positions, weights, form);
}

LinearBlend::LinearBlend(const Eigen::Ref<const Matrix>& positions, const Eigen::Ref<const Matrix>& weights, LinearBlendForm form)
    : Skin(positions.rows(), positions.cols(), weights.cols()), form_(form), columns_(handles_), center_(box_center(positions)) {
  const Index n = vertices_, d = dimension_, tiles = (n + lanes - 1) / lanes;
  Vector lacking(n);
  for (Index i = 0; i < n; ++i) {
    double sum = 0;
    for (Index j = 0; j < handles_; ++j) sum += weights(i, j);
    lacking[i] = 1 - sum;
    if (std::abs(lacking[i]) > 1e-9) columns_ = handles_ + 1;
  }
  for (Index axis = 0; axis < d; ++axis) center_[axis] = static_cast<float>(center_[axis]);
  const Index rows = form == LinearBlendForm::direct ? 1 : d + 1;
  rest_.assign(static_cast<std::size_t>(tiles * d), Quad{});
  weights_.assign(static_cast<std::size_t>(tiles * columns_ * rows), Quad{});
  stacked_.assign(static_cast<std::size_t>(columns_ * d * (d + 1)), Quad{});
  for (Index i = 0; i < n; ++i) {
    const Index tile = i / lanes, lane = i % lanes;
    for (Index axis = 0; axis < d; ++axis) rest_[tile * d + axis][lane] = static_cast<float>(positions(i, axis));
    Quad* row = weights_.data() + tile * columns_ * rows;
    for (Index j = 0; j < columns_; ++j) {
      const double w = j < handles_ ? weights(i, j) : lacking[i];
      for (Index axis = 0; axis < rows - 1; ++axis) (*row++)[lane] = static_cast<float>(w * (positions(i, axis) - center_[axis]));
      (*row++)[lane] = static_cast<float>(w);
    }
  }
}

void LinearBlend::stack_transforms() {
  const Index d = dimension_;
  Quad* out = stacked_.data();
  for (Index j = 0; j < columns_; ++j)
    for (Index row = 0; row < d; ++row) {
      const double* t = j < handles_ ? transforms_.data() + (j * d + row) * (d + 1) : nullptr;
      double image = t ? t[d] : 0;  // of c
      for (Index axis = 0; axis < d; ++axis) {
        const double a = t ? t[axis] : 0;
        image += a * center_[axis];
        *out++ = Quad{} + static_cast<float>(axis == row ? a - 1 : a);
      }
      *out++ = Quad{} + static_cast<float>(image - center_[row]);
    }
}

/** Rows of four vertices, of which the last tile may have fewer. */
template <Index d, typename Quad>
static void store(const Quad* moved, Index count, float* out) {
  for (Index lane = 0; lane < std::min(lanes, count); ++lane)
    for (Index axis = 0; axis < d; ++axis) *out++ = moved[axis][lane];
}

template <Index d>
void LinearBlend::move_direct(float* out) const {
  const Quad *rest = rest_.data(), *weight = weights_.data();
  Quad center[d];
  for (Index axis = 0; axis < d; ++axis) center[axis] = Quad{} + static_cast<float>(center_[axis]);
  for (Index left = vertices_; left > 0; left -= lanes, rest += d, out += lanes * d) {
    Quad blend[d * (d + 1)] = {};
    const Quad* transform = stacked_.data();
    for (Index j = 0; j < columns_; ++j, ++weight, transform += d * (d + 1))
      for (Index k = 0; k < d * (d + 1); ++k) blend[k] += *weight * transform[k];
    Quad moved[d];
    for (Index row = 0; row < d; ++row) {
      moved[row] = blend[row * (d + 1) + d];
      for (Index axis = 0; axis < d; ++axis) moved[row] += blend[row * (d + 1) + axis] * (rest[axis] - center[axis]);
      moved[row] += rest[row];
    }
    store<d>(moved, left, out);
  }
}

template <Index d>
void LinearBlend::move_compiled(float* out) const {
  const Quad *rest = rest_.data(), *compiled = weights_.data();
  for (Index left = vertices_; left > 0; left -= lanes, rest += d, out += lanes * d) {
    Quad moved[d] = {};
    const Quad* transform = stacked_.data();
    for (Index j = 0; j < columns_; ++j, compiled += d + 1, transform += d * (d + 1))
      for (Index row = 0; row < d; ++row)
        for (Index k = 0; k <= d; ++k) moved[row] += compiled[k] * transform[row * (d + 1) + k];
    for (Index row = 0; row < d; ++row) moved[row] += rest[row];
    store<d>(moved, left, out);
  }
}

void LinearBlend::move(float* out) {
  stack_transforms();
  const bool direct = form_ == LinearBlendForm::direct;
  if (dimension_ == 2) {
    direct ? move_direct<2>(out) : move_compiled<2>(out);
  } else {
    direct ? move_direct<3>(out) : move_compiled<3>(out);
  }
}

}  // namespace handlebody
