#include "core/interpolation/polynomial.hpp"

#include <algorithm>

namespace handlebody {
Index polynomial_count(int degree, Index dimension) {
  return degree < 0 ? 0 : degree == 0 ? 1 : degree == 1 ? 1 + dimension : 1 + dimension + dimension * (dimension + 1) / 2;
}

void polynomial_values(const double* x, Index dimension, int degree, double* out) {
  if (degree >= 0) *out++ = 1;
  if (degree >= 1) out = std::copy(x, x + dimension, out);
  if (degree >= 2)
    for (Index i = 0; i < dimension; ++i)
      for (Index j = i; j < dimension; ++j) *out++ = x[i] * x[j];
}

void polynomial_gradients(const double* x, Index dimension, int degree, double* out) {
  std::fill(out, out + polynomial_count(degree, dimension) * dimension, 0.0);
  if (degree >= 0) out += dimension;
  if (degree >= 1)
    for (Index i = 0; i < dimension; ++i, out += dimension) out[i] = 1;
  if (degree >= 2)
    for (Index i = 0; i < dimension; ++i)
      for (Index j = i; j < dimension; ++j, out += dimension) out[i] += x[j], out[j] += x[i];
}

}  // namespace handlebody
