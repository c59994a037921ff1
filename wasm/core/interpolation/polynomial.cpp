#include "core/interpolation/polynomial.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/decompositions.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {
namespace {

// Columns count as dependent when what is left of them falls below this part of the longest.
constexpr double rank_tolerance = 1e-10;

/** Removes the span of the first `count` columns, which are orthonormal, from the others, and replaces these by orthonormal columns
 * that span what is left. Returns how many there are. */
Index orthonormalize(MatrixXd& columns, Index count) {
  const auto front = columns.leftCols(count);
  auto rest = columns.rightCols(columns.cols() - count);
  const double longest = std::sqrt(rest.colwise().squaredNorm().maxCoeff());
  for (int twice = 0; twice < 2; ++twice)  // the second time removes what rounding left of the first
    rest -= product(front, transposed_product(front, rest));
  const auto [basis, sizes] = column_span(rest);
  rest.leftCols(basis.cols()) = basis;
  return (sizes.array() > rank_tolerance * longest).count();
}

const char* plural(Index count) {
  return count == 1 ? "" : "s";
}

}  // namespace

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

Result<Done> check_unisolvent(const Matrix& points, int degree) {
  const Index count = points.rows(), d = points.cols(), needed = polynomial_count(degree, d);
  const char* const kind = degree == 0 ? "constant" : degree == 1 ? "linear function" : "quadratic function";
  if (count < needed)
    return Error(HB_ERROR_POINTS_TOO_FEW,
                 {count, " point", plural(count), count == 1 ? " does" : " do", " not determine a ", kind, " of ", d, " dimension",
                  plural(d), "."},
                 {"Add points until there are ", needed, degree > 0 ? ", or lower the degree." : "."});
  if (degree < 1) return Done{};

  // In orthonormal coordinates the question is the same, and the set's proportions do not matter.
  MatrixXd columns(count, 1 + d);
  columns.col(0).setConstant(1 / std::sqrt(static_cast<double>(count)));
  columns.rightCols(d) = points;
  const Index spanned = orthonormalize(columns, 1);
  if (spanned < d)
    return Error(HB_ERROR_POINTS_DEGENERATE,
                 {"The points span ", spanned,
                  spanned == 0   ? " dimensions (they coincide)"
                  : spanned == 1 ? " dimension only (they lie on one line)"
                  : spanned == 2 ? " dimensions only (they lie on one plane)"
                                 : " dimensions only",
                  ", which does not determine a ", kind, " of ", d, " dimension", plural(d), "."},
                 {"Use degree 0, add a point outside, or drop a dimension."});
  if (degree < 2) return Done{};

  columns.conservativeResize(Eigen::NoChange, needed);
  for (Index i = 1, column = 1 + d; i <= d; ++i)
    for (Index j = i; j <= d; ++j, ++column) columns.col(column) = columns.col(i).cwiseProduct(columns.col(j));
  const Index quadratic = 1 + d + orthonormalize(columns, 1 + d);
  if (quadratic == needed) return Done{};
  return Error(HB_ERROR_POINTS_DEGENERATE,
               {"The points determine only ", quadratic, " of the ", needed, " coefficients of a quadratic function of ", d,
                " dimension", plural(d),
                d == 1   ? ": they are at two places."
                : d == 2 ? ": they lie on one conic."
                         : ": they lie on one quadric."},
               {"Use degree 1, or add a point elsewhere."});
}

}  // namespace handlebody
