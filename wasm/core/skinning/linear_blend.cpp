// Compiled with -O3: see CMakeLists.txt.
#include "core/skinning/linear_blend.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace handlebody {
namespace {

/** Vertices go in tiles of eight, as pairs of the compiler's vector type (see frame_kernel.hpp). */
constexpr Index lanes = 8;
using Quad = float __attribute__((vector_size(16)));

class LinearBlend final : public Skin {
 public:
  LinearBlend(const WeightedShape& shape, LinearBlendForm form);

 private:
  void move(float* out) override;
  void stack_transforms();
  template <Index d, bool compiled>
  void move_tiles(float* out) const;

  bool compiled_;
  Index first_ = 0;  // the handle numbered 0 in the header; −1 for the additional one with the missing weight
  double center_[3] = {};
  std::vector<Quad>
      stacked_;  // row by row of the transforms: handle 0's m₀, then mⱼ − m₀, d + 1 numbers each, all lanes of a quad alike
  std::vector<Quad> tiles_;  // d pairs of vᵢ, then wᵢⱼ for all j but 0 or, compiled, wᵢⱼ [x; 1]
};

double lacking(const double* weights, Index handles) {
  double sum = 0;
  for (Index j = 0; j < handles; ++j) sum += weights[j];
  return 1 - sum;
}

LinearBlend::LinearBlend(const WeightedShape& shape, LinearBlendForm form)
    : Skin(shape.vertices, shape.dimension, shape.handles), compiled_(form == LinearBlendForm::compiled) {
  const Index d = dimension_;
  box_center(shape.positions, vertices_, d, center_);
  for (Index i = 0; i < vertices_; ++i)
    if (std::abs(lacking(shape.weights + i * handles_, handles_)) > 1e-9) first_ = -1;
  const Index others = handles_ - 1 - first_, size = 2 * (d + others * (compiled_ ? d + 1 : 1));
  stacked_ = std::vector<Quad>(static_cast<std::size_t>((1 + others) * d * (d + 1)));
  tiles_ = std::vector<Quad>(static_cast<std::size_t>((vertices_ + lanes - 1) / lanes * size));
  for (Index i = 0; i < vertices_; ++i) {
    float* out = reinterpret_cast<float*>(tiles_.data() + i / lanes * size) + i % lanes;
    const double *position = shape.positions + i * d, *weights = shape.weights + i * handles_;
    for (Index axis = 0; axis < d; ++axis, out += lanes) *out = static_cast<float>(position[axis]);
    for (Index j = first_ + 1; j < handles_; ++j) {
      for (Index axis = 0; compiled_ && axis < d; ++axis, out += lanes)
        *out = static_cast<float>(weights[j] * (position[axis] - center_[axis]));
      *out = static_cast<float>(weights[j]);
      out += lanes;
    }
  }
}

void LinearBlend::stack_transforms() {
  const Index d = dimension_, size = d * (d + 1);
  Quad* out = stacked_.data();
  for (Index row = 0; row < d; ++row) {
    double reference[4] = {};
    for (Index j = first_; j < handles_; ++j) {
      const double* t = j < 0 ? nullptr : transforms_.data() + j * size + row * (d + 1);
      double shift = (t ? t[d] : 0) - center_[row];
      for (Index k = 0; k <= d; ++k) {
        const double a = t && k < d ? t[k] : 0;
        if (k < d) shift += a * center_[k];
        const double number = k == d ? shift : k == row ? a - 1 : a;
        *out++ = Quad{} + static_cast<float>(number - reference[k]);
        if (j == first_) reference[k] = number;
      }
    }
  }
}

/** Rows of four vertices from d quads of their coordinates; in space also one number too many, which the next call overwrites. */
template <Index d>
void store(const Quad* moved, float* out) {
  const auto put = [](float* to, Quad row) { std::memcpy(to, &row, sizeof row); };  // which need not be aligned
  const Quad low = __builtin_shufflevector(moved[0], moved[1], 0, 4, 1, 5),
             high = __builtin_shufflevector(moved[0], moved[1], 2, 6, 3, 7);
  if constexpr (d == 2) {
    put(out, low);
    put(out + 4, high);
  } else {
    const Quad z = moved[2], below = __builtin_shufflevector(z, z, 0, 0, 1, 1), above = __builtin_shufflevector(z, z, 2, 2, 3, 3);
    put(out, __builtin_shufflevector(low, below, 0, 1, 4, 5));
    put(out + 3, __builtin_shufflevector(low, below, 2, 3, 6, 7));
    put(out + 6, __builtin_shufflevector(high, above, 0, 1, 4, 5));
    put(out + 9, __builtin_shufflevector(high, above, 2, 3, 6, 7));
  }
}

/** t · [x; 1] for every other quad of x; with `all`, one more quad of x stands for the 1. */
template <Index d, bool all = false>
Quad dot(const Quad* t, const Quad* x) {
  const Quad last = all ? t[d] * x[2 * d] : t[d];
  if constexpr (d == 2) return t[0] * x[0] + (t[1] * x[2] + last);
  return (t[0] * x[0] + t[1] * x[2]) + (t[2] * x[4] + last);
}

/** One row of the transforms at a time, so that the inner loop fits the sixteen registers that engines use. */
template <Index d, bool compiled>
void LinearBlend::move_tiles(float* out) const {
  const Index others = handles_ - 1 - first_, columns = compiled ? d + 1 : 1;
  const Quad* tile = tiles_.data();
  for (Index left = vertices_; left > 0; left -= lanes, out += lanes * d) {
    const Quad *const rest = tile, *t = stacked_.data();
    Quad x[2 * d], low[d], high[d];
    for (Index k = 0; k < 2 * d; ++k) x[k] = rest[k] - static_cast<float>(center_[k / 2]);
    tile = rest + 2 * (d + others * columns);
    for (Index row = 0; row < d; ++row) {
      Quad a = dot<d>(t, x), b = dot<d>(t, x + 1);
      t += d + 1;
      for (const Quad* w = rest + 2 * d; w != tile; w += 2 * columns, t += d + 1) {
        a += compiled ? dot<d, true>(t, w) : dot<d>(t, x) * w[0];
        b += compiled ? dot<d, true>(t, w + 1) : dot<d>(t, x + 1) * w[1];
      }
      low[row] = a + rest[2 * row];
      high[row] = b + rest[2 * row + 1];
    }
    float last[lanes * d + 1];
    float* const to = left > lanes ? out : last;
    store<d>(low, to);
    store<d>(high, to + 4 * d);
    if (left <= lanes) std::copy(last, last + left * d, out);
  }
}

void LinearBlend::move(float* out) {
  stack_transforms();
  if (dimension_ == 2) {
    compiled_ ? move_tiles<2, true>(out) : move_tiles<2, false>(out);
  } else {
    compiled_ ? move_tiles<3, true>(out) : move_tiles<3, false>(out);
  }
}

}  // namespace

Result<std::unique_ptr<Skin>> linear_blend(const WeightedShape& shape, LinearBlendForm form) {
  const double n = static_cast<double>(shape.vertices), d = static_cast<double>(shape.dimension),
               h = static_cast<double>(shape.handles + 1);
  const double floats = n * (d + (form == LinearBlendForm::compiled ? (d + 1) * h : h)) + 4 * (d + 1) * d * h;
  if (auto fine = check_shape(shape, floats); !fine) return fine.error();
  return std::unique_ptr<Skin>(std::make_unique<LinearBlend>(shape, form));
}

}  // namespace handlebody
