#include "core/interpolation/polynomial_space.hpp"

#include <algorithm>
#include <cmath>

#include "core/interpolation/polynomial.hpp"
#include "core/numerics/decompositions.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {
namespace {

// Columns count as dependent when what is left of them falls below this part of the longest.
constexpr double rank_tolerance = 1e-10;
const double root_two = std::sqrt(2.0);

double longest_column(const MatrixXd& columns) {
  return columns.cols() ? std::sqrt(columns.colwise().squaredNorm().maxCoeff()) : 0;
}

Index rank_of(const Vector& sizes, double longest) {
  return (sizes.array() > rank_tolerance * longest).count();
}

/** Columns less what orthonormal ones span of them. */
MatrixXd beyond(const MatrixXd& orthonormal, MatrixXd columns) {
  for (int twice = 0; twice < 2; ++twice)  // the second time removes what rounding left of the first
    columns -= product(orthonormal, transposed_product(orthonormal, columns));
  return columns;
}

/** The products zᵢzⱼ, i ≤ j, with the weight that makes their coefficients' norm independent of how z is turned. */
MatrixXd products_of(const MatrixXd& z) {
  const Index r = z.cols();
  MatrixXd products(z.rows(), r * (r + 1) / 2);
  for (Index i = 0, column = 0; i < r; ++i)
    for (Index j = i; j < r; ++j, ++column) products.col(column) = (i == j ? 1 : root_two) * z.col(i).cwiseProduct(z.col(j));
  return products;
}

}  // namespace

PolynomialSpace::PolynomialSpace(const Matrix& points, int degree) : degree_(degree), dimension_(points.cols()), rank_(dimension_) {
  const Index n = points.rows(), d = dimension_;
  for (int k = 0; k <= 2; ++k) counts_[k] = polynomial_count(k, d);
  if (degree >= 1) {
    const Vector center = points.colwise().mean();
    MatrixXd offsets = points.rowwise() - center.transpose();
    Vector extents = Vector::Ones(d);
    MatrixXd even = offsets;
    for (Index axis = 0; axis < d; ++axis) {
      const double extent = offsets.col(axis).cwiseAbs().maxCoeff();
      if (extent > 0 && std::isfinite(1 / extent)) even.col(axis) /= extents[axis] = extent;
    }
    const double longest = longest_column(even);
    const auto [orthonormal, sizes] = column_span(even);
    rank_ = rank_of(sizes, longest);
    // Quadratic functions are told apart in orthonormal coordinates, where the set's proportions do not matter.
    MatrixXd lower(n, 1 + rank_), left;
    Index kept = 0;
    if (degree == 2 && rank_ > 0) {
      lower.col(0).setConstant(1 / std::sqrt(static_cast<double>(n)));
      lower.rightCols(rank_) = orthonormal.leftCols(rank_);
      const MatrixXd products = products_of(orthonormal.leftCols(rank_));
      left = beyond(lower, products);
      kept = rank_of(column_span(left).sizes, longest_column(products));
    }
    const Index all = rank_ * (rank_ + 1) / 2;
    reduced_ = rank_ < d || (degree == 2 && kept < all);
    if (reduced_) {
      axes_ = MatrixXd::Identity(rank_, d);
      if (rank_ > 0) {
        if (rank_ < d) {
          MatrixXd span = column_span(even.transpose()).basis.leftCols(rank_);
          span = column_span(extents.asDiagonal() * span).basis.leftCols(rank_);
          offsets = product(offsets, span);
          axes_ = span.transpose();
        }
        const Qr qr(offsets);
        MatrixXd whitened = std::sqrt(static_cast<double>(n)) * axes_;
        qr.solve_r_transposed(whitened);
        axes_ = whitened;
      }
      shift_.resize(rank_);
      turn(center.data(), shift_.data());
      if (degree == 2 && kept < all) {
        const MatrixXd z = product(points.rowwise() - center.transpose(), axes_.transpose());
        lower.rightCols(rank_) = z / std::sqrt(static_cast<double>(n));
        left = beyond(lower, products_of(z));
        quadratic_ = column_span(left.transpose()).basis.leftCols(kept);
      }
      counts_[1] = 1 + rank_;
      counts_[2] = 1 + rank_ + kept;
    }
  }
  monomials_.resize(polynomial_count(degree, rank_));
  slopes_.resize(monomials_.size(), rank_);
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
