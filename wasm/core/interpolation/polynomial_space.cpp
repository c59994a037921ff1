#include "core/interpolation/polynomial_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/interpolation/polynomial.hpp"
#include "core/numerics/decompositions.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {
namespace {

// Columns count as dependent when what is left of them falls below this part of the longest.
constexpr double rank_tolerance = 1e-10;
const double root_two = std::sqrt(2.0);

// Plain loops below, and not Eigen's expressions: this runs once a fit, and each expression is compiled into code of its own, 2 kB
// gzipped in all.

double longest_column(const MatrixXd& columns) {
  double longest = 0;
  for (Index j = 0; j < columns.cols(); ++j) longest = std::max(longest, columns.col(j).squaredNorm());
  return std::sqrt(longest);
}

Index rank_of(const Vector& sizes, double longest) {
  Index rank = 0;
  while (rank < sizes.size() && sizes[rank] > rank_tolerance * longest) ++rank;
  return rank;
}

void copy_columns(const MatrixXd& from, Index count, MatrixXd& to, Index first) {
  std::copy(from.data(), from.data() + from.rows() * count, to.data() + to.rows() * first);
}

MatrixXd first_columns(const MatrixXd& a, Index count) {
  MatrixXd columns(a.rows(), count);
  copy_columns(a, count, columns, 0);
  return columns;
}

MatrixXd transposed(const MatrixXd& a) {
  MatrixXd turned(a.cols(), a.rows());
  for (Index i = 0; i < a.rows(); ++i)
    for (Index j = 0; j < a.cols(); ++j) turned(j, i) = a(i, j);
  return turned;
}

void scale(MatrixXd& a, double factor) {
  for (Index i = 0; i < a.size(); ++i) a.data()[i] *= factor;
}

/** Columns less what orthonormal ones span of them. */
MatrixXd beyond(const MatrixXd& orthonormal, MatrixXd columns) {
  for (int twice = 0; twice < 2; ++twice) {  // the second time removes what rounding left of the first
    const MatrixXd spanned = product(orthonormal, transposed_product(orthonormal, columns));
    for (Index i = 0; i < columns.size(); ++i) columns.data()[i] -= spanned.data()[i];
  }
  return columns;
}

/** The products zᵢzⱼ, i ≤ j, with the weight that makes their coefficients' norm independent of how z is turned. */
MatrixXd products_of(const MatrixXd& z, Index r) {
  MatrixXd products(z.rows(), r * (r + 1) / 2);
  for (Index i = 0, column = 0; i < r; ++i)
    for (Index j = i; j < r; ++j, ++column)
      for (Index row = 0; row < z.rows(); ++row) products(row, column) = (i == j ? 1 : root_two) * z(row, i) * z(row, j);
  return products;
}

}  // namespace

PolynomialSpace::PolynomialSpace(const Matrix& points, int degree) : degree_(degree), dimension_(points.cols()), rank_(dimension_) {
  for (int k = 0; k <= 2; ++k) counts_[k] = polynomial_count(k, dimension_);
  if (degree >= 1) reduce(points);
  monomials_.resize(polynomial_count(degree, rank_));
  slopes_.resize(monomials_.size(), rank_);
}

void PolynomialSpace::reduce(const Matrix& points) {
  const Index n = points.rows(), d = dimension_;
  const double root_n = std::sqrt(static_cast<double>(n));
  Vector center(d), extents(d);
  MatrixXd offsets(n, d), even(n, d);
  for (Index axis = 0; axis < d; ++axis) {
    double sum = 0, extent = 0, low = points(0, axis), high = low;
    for (Index i = 0; i < n; ++i) {
      sum += points(i, axis);
      low = std::min(low, points(i, axis));
      high = std::max(high, points(i, axis));
    }
    // Rounded, the mean of equal numbers may be another one, and all of them would seem to lie beside it.
    center[axis] = low == high ? low : sum / static_cast<double>(n);
    for (Index i = 0; i < n; ++i) extent = std::max(extent, std::abs(offsets(i, axis) = points(i, axis) - center[axis]));
    extents[axis] = extent > 0 && std::isfinite(1 / extent) ? extent : 1;
    for (Index i = 0; i < n; ++i) even(i, axis) = offsets(i, axis) / extents[axis];
  }
  const double longest = longest_column(even);
  MatrixXd across = transposed(even);
  const auto [orthonormal, sizes] = column_span(std::move(even));
  rank_ = rank_of(sizes, longest);
  // Quadratic functions are told apart in orthonormal coordinates, where the set's proportions do not matter.
  MatrixXd lower(n, 1 + rank_);
  Index kept = 0;
  if (degree_ == 2 && rank_ > 0) {
    std::fill(lower.data(), lower.data() + n, 1 / root_n);
    copy_columns(orthonormal, rank_, lower, 1);
    const MatrixXd products = products_of(orthonormal, rank_);
    kept = rank_of(column_span(beyond(lower, products)).sizes, longest_column(products));
  }
  const Index all = rank_ * (rank_ + 1) / 2;
  reduced_ = rank_ < d || (degree_ == 2 && kept < all);
  if (!reduced_) return;
  MatrixXd span = MatrixXd::Identity(d, rank_);
  if (rank_ > 0) {
    if (rank_ < d) {
      span = first_columns(column_span(std::move(across)).basis, rank_);
      for (Index k = 0; k < rank_; ++k)
        for (Index axis = 0; axis < d; ++axis) span(axis, k) *= extents[axis];
      span = first_columns(column_span(std::move(span)).basis, rank_);
      offsets = product(offsets, span);
    }
    MatrixXd whitened = transposed(span);
    scale(whitened, root_n);
    Qr(offsets).solve_r_transposed(whitened);
    span = transposed(whitened);
  }
  axes_.resize(rank_, d);
  // By rows: the transpose of what is by columns.
  std::copy(span.data(), span.data() + span.size(), axes_.data());
  shift_.resize(rank_);
  turn(center.data(), shift_.data());
  if (degree_ == 2 && kept < all) {
    MatrixXd z(n, rank_);
    Vector offset(d), turned(rank_);
    for (Index i = 0; i < n; ++i) {
      for (Index axis = 0; axis < d; ++axis) offset[axis] = points(i, axis) - center[axis];
      turn(offset.data(), turned.data());
      for (Index k = 0; k < rank_; ++k) z(i, k) = turned[k];
    }
    copy_columns(z, rank_, lower, 1);
    for (Index i = n; i < lower.size(); ++i) lower.data()[i] /= root_n;
    quadratic_ = first_columns(column_span(transposed(beyond(lower, products_of(z, rank_)))).basis, kept);
  }
  counts_[1] = 1 + rank_;
  counts_[2] = 1 + rank_ + kept;
}

void PolynomialSpace::coordinates(const double* x, double* z) const {
  turn(x, z);
  for (Index k = 0; k < shift_.size(); ++k) z[k] -= shift_[k];
}

void PolynomialSpace::turn(const double* offset, double* z) const {
  if (!reduced_) {
    std::copy(offset, offset + dimension_, z);
    return;
  }
  for (Index k = 0; k < rank_; ++k) {
    z[k] = 0;
    for (Index axis = 0; axis < dimension_; ++axis) z[k] += axes_(k, axis) * offset[axis];
  }
}

void PolynomialSpace::values(const double* z, double* out) {
  if (size() == monomials_.size()) return polynomial_values(z, rank_, degree_, out);
  polynomial_values(z, rank_, degree_, monomials_.data());
  const Index linear = 1 + rank_;
  std::copy(monomials_.data(), monomials_.data() + linear, out);
  out += linear;
  for (Index k = 0; k < quadratic_.cols(); ++k) {
    out[k] = 0;
    for (Index i = 0, row = 0; i < rank_; ++i)
      for (Index j = i; j < rank_; ++j, ++row) out[k] += (i == j ? 1 : root_two) * quadratic_(row, k) * monomials_[linear + row];
  }
}

void PolynomialSpace::gradients(const double* z, double* out) {
  if (!reduced_) return polynomial_gradients(z, rank_, degree_, out);
  polynomial_gradients(z, rank_, degree_, slopes_.data());
  const Index d = dimension_, linear = 1 + rank_;
  std::fill(out, out + size() * d, 0.0);
  const auto add = [&](Index function, double factor, Index monomial) {
    for (Index k = 0; k < rank_; ++k)
      for (Index axis = 0; axis < d; ++axis) out[function * d + axis] += factor * slopes_(monomial, k) * axes_(k, axis);
  };
  for (Index j = 0; j < linear; ++j) add(j, 1, j);
  if (degree_ < 2) return;
  if (size() == monomials_.size()) {
    for (Index j = linear; j < size(); ++j) add(j, 1, j);
    return;
  }
  for (Index f = 0; f < quadratic_.cols(); ++f)
    for (Index i = 0, row = 0; i < rank_; ++i)
      for (Index j = i; j < rank_; ++j, ++row) add(linear + f, (i == j ? 1 : root_two) * quadratic_(row, f), linear + row);
}

}  // namespace handlebody
