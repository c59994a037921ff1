// What the tests of scattered interpolants share.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/interpolation/interpolant.hpp"
#include "oracle_lines.hpp"

namespace handlebody::test {

inline std::vector<double> numbers(const std::string& line, const std::string& key) {
  return oracle_numbers(line, key);
}

inline Matrix random_points(std::mt19937& random, Index count, Index dimension) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix::NullaryExpr(count, dimension, [&] { return uniform(random); });
}

inline Matrix matrix_of(const std::vector<double>& values, Index columns) {
  return Eigen::Map<const Matrix>(values.data(), std::ssize(values) / columns, columns);
}

inline Matrix values_at(Interpolant& f, const Matrix& queries) {
  Matrix out(queries.rows(), f.outputs());
  f.evaluate(queries.data(), queries.rows(), out.data());
  return out;
}

/** Gradients (rows × outputs·dimension) at the rows of `queries`. */
inline Matrix gradients_at(Interpolant& f, const Matrix& queries) {
  Matrix out(queries.rows(), f.outputs() * f.dimension());
  f.gradient(queries.data(), queries.rows(), out.data());
  return out;
}

inline Vector weights_at(Interpolant& f, const Matrix& query) {
  Vector out(f.size());
  f.weights(query.data(), out.data());
  return out;
}

/** Largest difference between gradients and central differences of step `h`, relative to the largest gradient. */
inline double gradient_error(Interpolant& f, const Matrix& queries, double h) {
  const Matrix gradients = gradients_at(f, queries);
  const Index d = f.dimension();
  double error = 0;
  for (Index axis = 0; axis < d; ++axis) {
    Matrix left = queries, right = queries;
    left.col(axis).array() -= h;
    right.col(axis).array() += h;
    const Matrix differences = (values_at(f, right) - values_at(f, left)) / (2 * h);
    for (Index i = 0; i < queries.rows(); ++i)
      for (Index j = 0; j < f.outputs(); ++j) {
        const double apart = std::abs(differences(i, j) - gradients(i, j * d + axis));
        error = apart <= error ? error : apart;  // a NaN stays
      }
  }
  return error / std::max(1.0, gradients.cwiseAbs().maxCoeff());
}

}  // namespace handlebody::test
