#include "core/interpolation/interpolant.hpp"

#include <algorithm>
#include <utility>

namespace handlebody {

Interpolant::Interpolant(ScatteredData data)
    : data_(std::move(data)), w_(data_.points.rows()), slopes_(data_.points.rows(), data_.points.cols()) {}

void Interpolant::evaluate(const double* queries, Index count, double* out) {
  const Index n = data_.points.rows(), m = outputs();
  for (Index q = 0; q < count; ++q, queries += dimension(), out += m) {
    weigh(queries, w_.data(), nullptr);
    std::fill(out, out + m, 0.0);
    for (Index k = 0; k < n; ++k) {
      const double w = w_[k];
      if (w == 0) continue;  // most are, for interpolants that look at a few neighbors
      const double* value = &data_.values(k, 0);
      for (Index j = 0; j < m; ++j) out[j] += w * value[j];
    }
  }
}

void Interpolant::gradient(const double* queries, Index count, double* out) {
  const Index n = data_.points.rows(), d = dimension(), m = outputs();
  for (Index q = 0; q < count; ++q, queries += d, out += m * d) {
    weigh(queries, w_.data(), slopes_.data());
    std::fill(out, out + m * d, 0.0);
    for (Index k = 0; k < n; ++k)
      for (Index j = 0; j < m; ++j)
        for (Index axis = 0; axis < d; ++axis) out[j * d + axis] += data_.values(k, j) * slopes_(k, axis);
  }
}

void Interpolant::weights(const double* query, double* out) {
  weigh(query, w_.data(), nullptr);
  std::fill(out, out + size(), 0.0);
  for (Index k = 0; k < w_.size(); ++k) out[data_.kept[static_cast<std::size_t>(k)]] = w_[k];
}

}  // namespace handlebody
