#include "core/interpolation/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace handlebody {
namespace {

// Columns count as dependent when what is left of them falls below this part of the largest.
constexpr double rank_tolerance = 1e-10;

/** Rank of the matrix: Gram–Schmidt with column pivoting. */
Index rank_of(MatrixXd rest) {
  double largest = 0;
  for (Index rank = 0; rank < rest.cols(); ++rank) {
    Index pivot = 0;
    const double norm = std::sqrt(rest.colwise().squaredNorm().maxCoeff(&pivot));
    largest = std::max(largest, norm);
    if (!(norm > rank_tolerance * largest)) return rank;
    const Vector direction = rest.col(pivot) / norm;
    for (int twice = 0; twice < 2; ++twice)  // the second pass removes what rounding left of the first
      for (Index j = 0; j < rest.cols(); ++j) rest.col(j) -= direction.dot(rest.col(j)) * direction;
  }
  return rest.cols();
}

}  // namespace

Index polynomial_count(int degree, Index dimension) {
  if (degree < 0) return 0;
  if (degree == 0) return 1;
  return degree == 1 ? 1 + dimension : (dimension + 1) * (dimension + 2) / 2;
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
  out += dimension;
  if (degree >= 1)
    for (Index i = 0; i < dimension; ++i, out += dimension) out[i] = 1;
  if (degree >= 2)
    for (Index i = 0; i < dimension; ++i)
      for (Index j = i; j < dimension; ++j, out += dimension) {
        out[i] += x[j];
        out[j] += x[i];
      }
}

Result<Done> check_unisolvent(const Matrix& points, int degree) {
  const Index n = points.rows(), d = points.cols(), count = polynomial_count(degree, d);
  if (n < count)
    return Error(HB_ERROR_POINTS_TOO_FEW,
                 {n, n == 1 ? " point does" : " points do", " not determine a polynomial of degree ", degree, " in ", d,
                  d == 1 ? " dimension." : " dimensions."},
                 {"Give at least ", count, " points, or use a lower degree (with a kernel that allows it, such as multiquadric)."});
  if (degree < 1) return Done{};
  MatrixXd monomials(n, count);
  Vector row(count);
  for (Index i = 0; i < n; ++i) {
    polynomial_values(&points(i, 0), d, degree, row.data());
    monomials.row(i) = row.transpose();
  }
  const Index spanned = rank_of(monomials.leftCols(1 + d)) - 1;
  if (spanned < d)
    return Error(HB_ERROR_POINTS_DEGENERATE,
                 {"The points span ", spanned,
                  spanned == 0   ? " dimensions (they coincide)"
                  : spanned == 1 ? " dimension only (they lie on one line)"
                                 : " dimensions only",
                  ", which does not determine a polynomial of degree ", degree, " in ", d, " dimensions."},
                 {"Use degree 0 (with a kernel such as multiquadric), add a point outside, or drop a dimension."});
  if (degree < 2 || rank_of(std::move(monomials)) == count) return Done{};
  return Error(
      HB_ERROR_POINTS_DEGENERATE,
      {"The points lie on a conic or quadric, such as two lines or a sphere, which does not determine a polynomial of degree 2."},
      {"Use degree 1, or add a point elsewhere."});
}

}  // namespace handlebody
