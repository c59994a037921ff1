#include "core/interpolation/interpolant.hpp"

#include <algorithm>
#include <utility>

namespace handlebody {

Interpolant::Interpolant(ScatteredData data)
    : data_(std::move(data)),
      w_(data_.points.rows()),
      slopes_(data_.points.rows(), data_.points.cols()),
      query_(data_.measures.size()) {}

const double* Interpolant::measure(const double* query) {
  if (query_.size() == 0) return query;
  for (Index axis = 0; axis < query_.size(); ++axis) query_[axis] = std::clamp(query[axis] * data_.measures[axis], -1e300, 1e300);
  return query_.data();
}

void Interpolant::evaluate(const double* queries, Index count, double* out) {
  const Index n = data_.points.rows(), m = outputs();
  const double* const w = w_.data();  // plain memory: this file is compiled for size
  for (Index q = 0; q < count; ++q, queries += dimension(), out += m) {
    weigh(measure(queries), w_.data(), nullptr);
    std::fill(out, out + m, 0.0);
    const double* value = data_.values.data();
    for (Index k = 0; k < n; ++k, value += m) {
      if (w[k] == 0) continue;  // most are, for interpolants that look at a few neighbors
      for (Index j = 0; j < m; ++j) out[j] += w[k] * value[j];
    }
  }
}

void Interpolant::gradient(const double* queries, Index count, double* out) {
  const Index n = data_.points.rows(), d = dimension(), m = outputs();
  for (Index q = 0; q < count; ++q, queries += d, out += m * d) {
    weigh(measure(queries), w_.data(), slopes_.data());
    for (Index axis = 0; axis < query_.size(); ++axis) slopes_.col(axis) *= data_.measures[axis];
    std::fill(out, out + m * d, 0.0);
    const double *value = data_.values.data(), *slope = slopes_.data();
    for (Index k = 0; k < n; ++k, value += m, slope += d)
      for (Index j = 0; j < m; ++j)
        for (Index axis = 0; axis < d; ++axis) out[j * d + axis] += value[j] * slope[axis];
  }
}

void Interpolant::weights(const double* query, double* out) {
  weigh(measure(query), w_.data(), nullptr);
  std::fill(out, out + size(), 0.0);
  for (Index k = 0; k < w_.size(); ++k) out[data_.kept[k]] = w_[k];
}

}  // namespace handlebody
