// Points with values out of bytes, and the questions that every interpolant answers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "target.hpp"

namespace handlebody::fuzz {

/** The arguments that all *_create functions share. */
struct GivenPoints {
  const double *points, *values;
  std::uint32_t count, dimension, outputs;
};

struct Scattered {
  /** `of_dimension` 0 for any. */
  Scattered(Bytes& bytes, std::uint32_t of_dimension) {
    dimension = of_dimension > 0 && !bytes.wildly() ? of_dimension : bytes.byte() < 230 ? bytes.from_to(1, 3) : bytes.from_to(1, 8);
    outputs = bytes.byte() < 200 ? 1 : bytes.from_to(1, 3);
    count = bytes.byte() < 240 ? bytes.from_to(1, 16) : bytes.from_to(1, 150);
    points = bytes.numbers(count * dimension);
    values = bytes.numbers(count * outputs);
    switch (bytes.byte() % 16) {
      case 0:  // on a line, or nearly
        for (std::uint32_t i = 0; i < count * dimension; ++i)
          if (i % dimension > 0) points[i] = points[i - 1] * (1 + (bytes.wildly() ? 1e-12 : 0));
        break;
      case 1:  // on a grid
        for (double& x : points) x = std::round(x);
        break;
      case 2:  // all on a circle
        for (std::uint32_t i = 0; i < count && dimension > 1; ++i)
          points[i * dimension] = std::cos(0.5 * i), points[i * dimension + 1] = std::sin(0.5 * i);
        break;
      default:
        break;
    }
    const double scale = bytes.scale(), shift = bytes.byte() < 230 ? 0 : bytes.number() * 1e6;
    for (double& x : points) x = x * scale + shift;
    if (bytes.byte() < 20)
      for (double& value : values) value *= bytes.scale();
  }

  GivenPoints view(Bytes& bytes) const {
    return {points.data(), values.data(), bytes.count(count), bytes.count(dimension), bytes.wildly() ? 0 : outputs};
  }

  std::vector<double> points, values;
  std::uint32_t count, dimension, outputs;
};

/** Values, gradients, weights and twins, at the points, near them and anywhere. */
inline void ask(Bytes& bytes, const Scattered& data, hb_interpolant* made) {
  const std::uint32_t d = data.dimension, queries = bytes.from_to(0, 6);
  std::vector<double> at = bytes.numbers(queries * d);
  for (std::uint32_t q = 0; q < queries; ++q) {
    const std::uint8_t kind = bytes.byte();
    const std::uint32_t near = bytes.below(data.count);
    for (std::uint32_t axis = 0; axis < d && kind < 160; ++axis)
      at[q * d + axis] = data.points[near * d + axis] + (kind < 60 ? 0 : at[q * d + axis] * (kind < 100 ? 1e-9 : 0.1));
  }
  std::vector<double> out(queries * std::size_t{std::max(data.count, data.outputs * d)} + 1, 7);
  worked(hb_interpolant_evaluate(made, at.data(), bytes.count(queries), out.data()));
  worked(hb_interpolant_gradient(made, at.data(), bytes.count(queries), out.data()));
  worked(hb_interpolant_weights(made, at.data(), bytes.count(queries), out.data()));
  require(out.back() == 7, "nothing is written beyond the results");
  std::vector<std::uint32_t> twins(data.count);
  worked(hb_interpolant_twins(made, twins.data()));
  for (std::uint32_t i = 0; i < data.count; ++i)
    require(twins[i] <= i && twins[twins[i]] == twins[i], "a twin is an earlier point, or the point itself");
}

}  // namespace handlebody::fuzz
