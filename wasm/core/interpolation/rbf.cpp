#include "core/interpolation/rbf.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/numerics/dense.hpp"

namespace handlebody {

namespace {

// Dimensions count as dependent when a pivot falls below this part of the largest.
constexpr double rank_tolerance = 1e-10;
constexpr double largest_cardinal_error = 1e-6;

Index polynomial_count(int degree, Index dimension) {
  return degree < 0 ? 0 : degree == 0 ? 1 : dimension + 1;
}

bool vanishes_at_its_place(KernelKind kind) {
  return kind == KernelKind::linear || kind == KernelKind::cubic || kind == KernelKind::thin_plate;
}

Error option_error(std::initializer_list<Word> message, std::initializer_list<Word> remedy) {
  return {HB_ERROR_INVALID_OPTION, message, remedy, HB_CULPRIT_OPTION};
}

Result<Done> check_options(const RadialBasisOptions& options, Index count) {
  if (options.degree < -1 || options.degree > 1)
    return option_error({"The degree of the tail is not -1, 0 or 1."}, {"Use -1, 0 or 1."});
  if (options.normalized && vanishes_at_its_place(options.kernel.kind))
    return option_error({"This kernel is zero at its own place and cannot be normalized."},
                        {"Use gaussian, multiquadric, inverse multiquadric or inverse quadratic, or do not normalize."});
  const int needed = options.kernel.minimum_degree();
  if (!options.normalized && options.degree < needed)
    return option_error({"This kernel needs a polynomial tail of degree ", needed, " or more."},
                        {"Raise the degree to ", needed, "."});
  if (options.widths.size() != 0 && options.widths.size() != count)
    return option_error({"There are ", options.widths.size(), " widths for ", count, " places."},
                        {"Give one width a place, or none."});
  const bool widths_valid = options.widths.size() == 0 ? options.kernel.width > 0 && std::isfinite(options.kernel.width)
                                                       : options.widths.allFinite() && options.widths.minCoeff() > 0;
  if (!widths_valid) return option_error({"A width is not a positive finite number."}, {"Give widths in units of the places."});
  return Done{};
}

double largest_row_sum(const MatrixXd& matrix) {
  double largest = 0;
  for (Index i = 0; i < matrix.rows(); ++i) {
    double sum = 0;
    for (Index j = 0; j < matrix.cols(); ++j) sum += std::abs(matrix(i, j));
    largest = std::max(largest, sum);
  }
  return largest;
}

/** Dimension of the affine span of the scaled `places`: Gram–Schmidt with column pivoting (Eigen's QR would be 20 kB of wasm). */
Index affine_rank(const Matrix& places) {
  Eigen::MatrixXd rest = places.rowwise() - places.colwise().mean();
  double largest = 0;
  for (Index rank = 0; rank < rest.cols(); ++rank) {
    Index pivot = 0;
    const double norm = std::sqrt(rest.colwise().squaredNorm().maxCoeff(&pivot));
    largest = std::max(largest, norm);
    if (norm <= rank_tolerance * largest) return rank;
    const Vector direction = rest.col(pivot) / norm;
    for (int twice = 0; twice < 2; ++twice)  // the second pass removes what rounding left of the first
      for (Index j = 0; j < rest.cols(); ++j) rest.col(j) -= direction.dot(rest.col(j)) * direction;
  }
  return rest.cols();
}

/** Checks that the scaled `places` determine a polynomial of degree 1. */
Result<Done> check_span(const Matrix& places) {
  const Index count = places.rows(), dimension = places.cols();
  if (count < dimension + 1)
    return Error(HB_ERROR_EXAMPLES_TOO_FEW,
                 {count, (count == 1 ? " place does" : " places do"), " not determine a linear function of ", dimension,
                  (dimension == 1 ? " dimension." : " dimensions.")},
                 {"Add places until there are ", dimension + 1,
                  ", or use degree 0, which any number of places supports (with a kernel such as multiquadric)."});
  const Index spanned = affine_rank(places);
  if (spanned == dimension) return Done{};
  return Error(HB_ERROR_EXAMPLES_DEGENERATE,
               {"The places span ", spanned,
                spanned == 0   ? " dimensions (they coincide)"
                : spanned == 1 ? " dimension only (they lie on one line)"
                               : " dimensions only",
                ", which does not determine a linear function of ", dimension, " dimensions."},
               {"Use degree 0 (with a kernel such as multiquadric), add a place outside, or drop a dimension."});
}

}  // namespace

Result<RadialBasisInterpolant> RadialBasisInterpolant::create(const Eigen::Ref<const Matrix>& places,
                                                              const RadialBasisOptions& options) {
  const Index count = places.rows(), dimension = places.cols();
  if (count == 0 || dimension == 0) return Error(HB_ERROR_EXAMPLES_TOO_FEW, {"There are no places."}, {"Give at least one place."});
  for (Index i = 0; i < count; ++i)
    if (!places.row(i).allFinite())
      return Error(HB_ERROR_EXAMPLE_NOT_FINITE, {"Place ", i, " is not finite."}, {"Remove NaN and infinite coordinates."},
                   HB_CULPRIT_EXAMPLE, i);
  if (auto checked = check_options(options, count); !checked) return checked.error();

  RadialBasisInterpolant rbf;
  rbf.kernel_ = options.kernel;
  rbf.degree_ = options.degree;
  rbf.normalized_ = options.normalized;

  // Unit box. Halving first keeps the extent of huge coordinates from overflowing.
  const Vector lower = places.colwise().minCoeff(), upper = places.colwise().maxCoeff();
  const double diagonal = 2 * safe_norm(upper / 2 - lower / 2);
  rbf.center_ = upper / 2 + lower / 2;
  rbf.scale_ = diagonal > 0 ? 1 / diagonal : 1;
  if (!std::isfinite(diagonal) || !std::isfinite(rbf.scale_) || rbf.scale_ == 0)
    return Error(HB_ERROR_EXAMPLES_DEGENERATE, {"The extent of the places, ", diagonal, ", is beyond double precision."},
                 {"Rescale the places to ordinary numbers."});
  rbf.places_ = (places.rowwise() - rbf.center_.transpose()) * rbf.scale_;
  rbf.widths_ = options.widths.size() ? options.widths : Vector::Constant(count, options.kernel.width);
  rbf.widths_ *= rbf.scale_;
  if (!(rbf.widths_.minCoeff() >= 1e-30 && rbf.widths_.maxCoeff() <= 1e30))
    return option_error({"A width is out of all proportion to the extent of the places."}, {"Give widths in units of the places."});
  rbf.amplitudes_ = Vector::Ones(count);
  if (options.kernel.kind == KernelKind::multiquadric) rbf.amplitudes_ = rbf.widths_ / rbf.widths_.maxCoeff();
  if (options.degree == 1)
    if (auto spanned = check_span(rbf.places_); !spanned) return spanned.error();

  // The block matrix: its first n rows are the basis at the places themselves.
  const Index size = count + polynomial_count(options.degree, dimension);
  rbf.query_.resize(dimension);
  rbf.basis_.resize(size);
  MatrixXd system = MatrixXd::Zero(size, size);  // transposed: one column a place
  for (Index i = 0; i < count; ++i) {
    rbf.evaluate_basis(rbf.places_.row(i).transpose(), rbf.basis_);
    system.col(i) = rbf.basis_;
  }
  for (Index i = 0; i < count; ++i)
    for (Index j = count; j < size; ++j) system(i, j) = system(j, i);

  // Indefinite even when symmetric, so LU and not Cholesky; in place, since n² doubles may be most of the memory.
  const double norm = largest_row_sum(system);
  std::vector<Index> pivots;
  factor_lu(system, pivots);
  rbf.cardinal_ = MatrixXd::Identity(count, size);
  solve_lu(system, pivots, rbf.cardinal_);
  rbf.condition_ = norm * largest_row_sum(rbf.cardinal_);

  // LU of a singular matrix still returns something, so the promise itself is tested: 1 at the own place, 0 at the others.
  Vector weights(count);
  for (Index i = 0; i < count; ++i) {
    rbf.evaluate_basis(rbf.places_.row(i).transpose(), rbf.basis_);
    multiply(rbf.cardinal_, rbf.basis_, weights);
    weights[i] -= 1;
    const double error = weights.lpNorm<Eigen::Infinity>();
    rbf.cardinal_error_ = error <= rbf.cardinal_error_ ? rbf.cardinal_error_ : error;  // a NaN stays
    if (!(error <= largest_cardinal_error))
      return Error(HB_ERROR_EXAMPLES_DEGENERATE,
                   {"The interpolation system is singular in double precision (condition number ", rbf.condition_,
                    "); it misses place ", i, " by ", error, "."},
                   {"Use a smaller width, move places apart that almost coincide, or choose another kernel."}, HB_CULPRIT_EXAMPLE,
                   i);
  }
  return rbf;
}

void RadialBasisInterpolant::evaluate_basis(const Eigen::Ref<const Vector>& scaled_query, Eigen::Ref<Vector> out) const {
  const Index count = places_.rows();
  Kernel kernel = kernel_;
  auto radial = out.head(count);
  if (normalized_ && kernel_.kind == KernelKind::gaussian) {
    // Far from all places every Gaussian underflows and 0/0 would follow; the smallest exponent cancels in the quotient.
    for (Index i = 0; i < count; ++i) radial[i] = (places_.row(i).transpose() - scaled_query).norm() / widths_[i];
    radial = radial.array().square();
    radial = (radial.minCoeff() - radial.array()).exp();
  } else {
    for (Index i = 0; i < count; ++i) {
      kernel.width = widths_[i];
      radial[i] = amplitudes_[i] * kernel((places_.row(i).transpose() - scaled_query).norm());
    }
  }
  if (normalized_) radial /= radial.sum();
  if (degree_ >= 0) out[count] = 1;
  if (degree_ >= 1) out.tail(places_.cols()) = scaled_query;
}

void RadialBasisInterpolant::weights(const Eigen::Ref<const Vector>& query, Eigen::Ref<Vector> out) {
  query_ = (query - center_) * scale_;
  evaluate_basis(query_, basis_);
  multiply(cardinal_, basis_, out);
}

}  // namespace handlebody
