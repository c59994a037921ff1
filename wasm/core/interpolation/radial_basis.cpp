#include "core/interpolation/radial_basis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/kernels/clamped_plate.hpp"
#include "core/numerics/decompositions.hpp"
#include "core/numerics/products.hpp"
#include "core/numerics/safe_norm.hpp"

namespace handlebody {
namespace {

Error option_error(std::initializer_list<Word> message, std::initializer_list<Word> remedy) {
  return {HB_ERROR_INVALID_OPTION, message, remedy, HB_CULPRIT_OPTION};
}

Result<Done> check_options(const RadialBasisOptions& options, Index dimension, Index centers) {
  const Kernel& kernel = options.kernel;
  const bool has_order = kernel.kind == KernelKind::polyharmonic || kernel.kind == KernelKind::clamped_plate;
  if (has_order && (options.order > 8 || options.order <= dimension / 2))
    return dimension < 16 ? option_error({"Order ", options.order, " is not possible in ", dimension, " dimensions."},
                                         {"The order of this kernel is more than half the dimension, and 8 at most: use order ",
                                          dimension / 2 + 1, "."})
                          : option_error({"No order of this kernel is possible in ", dimension, " dimensions."},
                                         {"Use the kernel cubic or gaussian, which have no order."});
  const int needed = kernel.minimum_degree();
  if (needed > 2)
    return option_error({"This kernel needs a polynomial tail of degree ", needed, ", and 2 is the most there is."},
                        {"Use order ", std::min<Index>(8, (5 + dimension) / 2), ", or less."});
  if (options.degree < -1 || options.degree > 2)
    return option_error({"The degree of the polynomial tail is not -1, 0, 1 or 2."}, {"Use degree 2, or leave it out."});
  if (options.normalized && (kernel.vanishes_at_center() || kernel.kind == KernelKind::clamped_plate))
    return option_error({"This kernel is zero at its own place or on a sphere and cannot be normalized."},
                        {"Use gaussian, multiquadric, inverse-multiquadric or inverse-quadratic, or leave out normalized."});
  if (!options.normalized && options.degree < needed)
    return option_error({"This kernel needs a polynomial tail of degree ", needed, " or more; it has degree ", options.degree, "."},
                        {"Raise the degree to ", needed, "."});
  if (options.widths.size() != 0 && options.widths.size() != centers)
    return option_error({"There are ", options.widths.size(), " widths for ", centers, " centers."},
                        {"Give one width a center, or leave them out."});
  if (options.widths.size() != 0 && kernel.kind == KernelKind::clamped_plate)
    return option_error({"The clamped plate has one ball for all centers."},
                        {"Leave out the widths, or give a single one: the ball's radius."});
  const auto valid = [](double width) { return width > 0 && std::isfinite(width); };
  if (options.widths.size() == 0 && !valid(kernel.width))
    return option_error({"The width is ", kernel.width, ", not a positive finite number."},
                        {"Give it in units of the points, or leave it out."});
  for (Index i = 0; i < options.widths.size(); ++i)
    if (!valid(options.widths[i]))
      return Error(HB_ERROR_INVALID_OPTION,
                   {"The width of center ", i, " is ", options.widths[i], ", not a positive finite number."},
                   {"Give widths in units of the points, or leave them out."}, HB_CULPRIT_CENTER, i);
  return Done{};
}

}  // namespace

Result<MatrixXd> metric_root(const MatrixXd& metric, Index dimension) {
  if (metric.size() == 0) return MatrixXd();
  bool valid = metric.rows() == dimension && metric.cols() == dimension;
  for (Index i = 0; valid && i < dimension; ++i)
    for (Index j = 0; j < i; ++j)
      valid = valid && std::abs(metric(i, j) - metric(j, i)) <= 1e-12 * std::abs(metric(i, i) + metric(j, j));
  if (valid) {
    const Cholesky cholesky(metric);
    if (cholesky.succeeded()) return MatrixXd(cholesky.factor().triangularView<Eigen::Lower>().transpose());
  }
  return option_error({"The metric is not a symmetric, positive definite ", dimension, "×", dimension, " matrix."},
                      {"Give the inverse of a covariance matrix, or leave out metric for Euclidean distances."});
}

RadialBasis::RadialBasis(const RadialBasis&) = default;
RadialBasis::RadialBasis(RadialBasis&&) noexcept = default;
RadialBasis& RadialBasis::operator=(RadialBasis&&) noexcept = default;
RadialBasis::~RadialBasis() = default;

Result<RadialBasis> RadialBasis::create(const Matrix& points, const Matrix& centers, const RadialBasisOptions& options) {
  const Index dimension = points.cols(), k = centers.rows();
  if (auto valid = check_options(options, dimension, k); !valid) return valid.error();
  RadialBasis basis;
  basis.kernel_ = options.kernel;
  basis.kernel_.exponent = Kernel::of(options.kernel.kind, 1, dimension, options.order).exponent;
  basis.order_ = options.order;
  basis.normalized_ = options.normalized;
  auto root = metric_root(options.metric, dimension);
  if (!root) return root.error();
  basis.linear_ = std::move(*root);
  basis.set_frame(points);
  basis.inner_.resize(dimension);
  basis.centers_ = basis.to_inner(centers);
  basis.amplitudes_ = Vector::Ones(k);
  if (auto sized = basis.set_widths(options); !sized) return sized.error();
  if (options.kernel.kind == KernelKind::clamped_plate)
    if (auto inside = basis.set_ball(centers); !inside) return inside.error();
  basis.space_ = PolynomialSpace(basis.to_inner(points), options.degree);
  basis.coordinates_.resize(dimension);
  basis.squared_.resize(k);
  basis.slopes_.resize(k);
  basis.row_.resize(basis.size());
  basis.polynomials_.resize(basis.tail(), dimension);
  basis.block_inner_.resize(block, dimension);
  basis.block_sums_.resize(block, largest_block_outputs);
  return basis;
}

void RadialBasis::set_frame(const Matrix& points) {
  const Index d = points.cols();
  center_ = points.colwise().maxCoeff() / 2 + points.colwise().minCoeff() / 2;
  Vector lower = Vector::Constant(d, std::numeric_limits<double>::infinity()), upper = -lower, inner(d);
  for (Index i = 0; i < points.rows(); ++i) {
    to_inner(&points(i, 0), inner.data());
    lower = lower.cwiseMin(inner);
    upper = upper.cwiseMax(inner);
  }
  const double diagonal = safe_norm(upper - lower);
  scale_ = diagonal > 0 ? 1 / diagonal : 1;
}

Result<Done> RadialBasis::set_widths(const RadialBasisOptions& options) {
  const Index k = centers();
  own_widths_ = options.widths.size() != 0;
  widths_ = own_widths_ ? options.widths : Vector::Constant(k, options.kernel.width);
  widths_ *= scale_;
  inverse_squares_ = Vector::Ones(k);
  amplitude_of_scale_ = 1;
  for (int e = kernel_.homogeneity(); e > 0; --e) amplitude_of_scale_ *= scale_;
  if (kernel_.kind == KernelKind::tension) {
    auto inner = kernel_.tension.scaled(scale_);
    if (inner) {
      amplitude_of_scale_ = 1 / std::max(std::abs(inner->value(0)), std::abs(inner->value(0.5)));
      inner = kernel_.tension.scaled(scale_, amplitude_of_scale_);
    }
    if (!inner) return inner.error();
    kernel_.tension = *inner;
  }
  if (!kernel_.has_width()) return Done{};
  if (!(widths_.minCoeff() >= 1e-30 && widths_.maxCoeff() <= 1e30))
    return option_error({"A width is out of all proportion to the extent of the points."},
                        {"Give widths in units of the points, or leave them out."});
  for (Index i = 0; i < k; ++i) inverse_squares_[i] = 1 / (widths_[i] * widths_[i]);
  if (own_widths_ && kernel_.kind == KernelKind::multiquadric) amplitudes_ = widths_ / widths_.maxCoeff();
  return Done{};
}

/** The ball of the clamped plate is centered on the points' box, and its radius is the width. */
Result<Done> RadialBasis::set_ball(const Matrix& points) {
  plate_margins_.resize(centers());
  for (Index i = 0; i < centers(); ++i) {
    inner_ = centers_.row(i).transpose();
    plate_margins_[i] = plate_margin(inner_.data());
    if (!(plate_margins_[i] > 0))
      return Error(HB_ERROR_INVALID_OPTION,
                   {"Point ", i, " is not inside the clamped plate's ball, whose radius is the width ", kernel_.width, "."},
                   {"Use a width of ", 1.5 * std::sqrt(centers_.rowwise().squaredNorm().maxCoeff()) / scale_,
                    " or more: the ball is centered on the box of the ", points.rows(), " points."},
                   HB_CULPRIT_POINT, i);
  }
  return Done{};
}

Vector RadialBasis::widths() const {
  return widths_ / scale_;
}

void RadialBasis::to_inner(const double* query, double* inner) const {
  const Index d = dimension();
  const double* center = center_.data();
  if (linear_.size() == 0) {
    for (Index axis = 0; axis < d; ++axis) inner[axis] = scale_ * (query[axis] - center[axis]);
    return;
  }
  const double* linear = linear_.data();
  for (Index row = 0; row < d; ++row) {
    inner[row] = 0;
    for (Index axis = row; axis < d; ++axis) inner[row] += scale_ * linear[axis * d + row] * (query[axis] - center[axis]);
  }
}

Matrix RadialBasis::to_inner(const Matrix& points) const {
  Matrix inner(points.rows(), points.cols());
  for (Index i = 0; i < points.rows(); ++i) to_inner(&points(i, 0), &inner(i, 0));
  return inner;
}

void RadialBasis::polynomials(const double* inner, double* out) {
  space_.coordinates(inner, coordinates_.data());
  space_.values(coordinates_.data(), out);
}

double RadialBasis::plate_margin(const double* inner) const {
  double squared = 0;
  for (Index axis = 0; axis < dimension(); ++axis) squared += inner[axis] * inner[axis];
  return 1 - squared * inverse_squares_[0];
}

/** s² from inner_ to the centers from `first` on. */
void RadialBasis::squared_distances(Index first) {
  const Index k = centers(), count = k - first;
  double* __restrict out = squared_.data();
  std::fill(out, out + count, 0.0);
  for (Index axis = 0; axis < dimension(); ++axis) {
    const double* __restrict c = centers_.data() + axis * k + first;
    const double x = inner_.data()[axis];
    for (Index i = 0; i < count; ++i) out[i] += (x - c[i]) * (x - c[i]);
  }
  const double* __restrict inverse = inverse_squares_.data() + first;
  for (Index i = 0; i < count; ++i) out[i] *= inverse[i];
}

/** The kernels from the squared distances, which are overwritten. */
void RadialBasis::kernels_of_distances(Index first, double* out) {
  const Index count = centers() - first;
  if (kernel_.kind == KernelKind::clamped_plate) {
    const ClampedPlate plate{order_, dimension()};
    const double margin = plate_margin(inner_.data());
    for (Index i = 0; i < count; ++i) out[i] = margin > 0 ? plate.value(squared_[i], margin * plate_margins_[first + i]) : 0;
    return;
  }
  kernel_.values(squared_.data(), count);
  const double *amplitudes = amplitudes_.data() + first, *radial = squared_.data();
  for (Index i = 0; i < count; ++i) out[i] = amplitudes[i] * radial[i];
}

void RadialBasis::kernels_from(Index first, const double* query, double* out) {
  to_inner(query, inner_.data());
  squared_distances(first);
  kernels_of_distances(first, out);
}

/** The limit of the quotients where inner_ is reached by no kernel, while all widen alike: 1 for the nearest center in terms of its
 * width, or shared evenly by several. (So far away that squares of distances overflow, all are equally near.) */
void RadialBasis::nearest_alone(double* out) {
  squared_distances();
  const double nearest = squared_.minCoeff();
  const auto share = static_cast<double>((squared_.array() == nearest).count());
  for (Index i = 0; i < centers(); ++i) out[i] = squared_[i] == nearest ? 1 / share : 0;
}

void RadialBasis::values(const double* query, double* out) {
  const Index k = centers();
  to_inner(query, inner_.data());
  squared_distances();
  // Far from all centers every Gaussian underflows and 0/0 would follow; the smallest exponent cancels in the quotient.
  if (normalized_ && kernel_.kind == KernelKind::gaussian) squared_.array() -= squared_.minCoeff();
  kernels_of_distances(0, out);
  if (normalized_) {
    double sum = 0;
    for (Index i = 0; i < k; ++i) sum += out[i];
    if (sum != 0 && std::isfinite(sum))
      for (Index i = 0; i < k; ++i) out[i] /= sum;
    else
      nearest_alone(out);
  }
  polynomials(inner_.data(), out + k);
}

void RadialBasis::gradients(const double* query, double* out) {
  const Index k = centers(), d = dimension(), n = size();
  values(query, row_.data());  // inner_ too
  squared_distances();
  if (kernel_.kind == KernelKind::clamped_plate) {
    const ClampedPlate plate{order_, d};
    const double margin = plate_margin(inner_.data());
    for (Index i = 0; i < k; ++i) {
      const bool inside = margin > 0;
      const double b = margin * plate_margins_[i];
      const double slope = inside ? 2 * plate.slope(squared_[i], b) : 0;
      const double boundary = inside ? -2 * plate_margins_[i] * plate.boundary_slope(squared_[i], b) : 0;
      for (Index axis = 0; axis < d; ++axis)
        out[axis * n + i] = inverse_squares_[0] * (slope * (inner_[axis] - centers_(i, axis)) + boundary * inner_[axis]);
    }
  } else {
    if (normalized_ && kernel_.kind == KernelKind::gaussian) {
      slopes_.array() = -2.0 * (squared_.minCoeff() - squared_.array()).exp();
    } else {
      slopes_ = squared_;
      kernel_.slopes(slopes_.data(), k);
    }
    for (Index i = 0; i < k; ++i) slopes_[i] *= amplitudes_[i] * inverse_squares_[i];
    for (Index axis = 0; axis < d; ++axis)
      for (Index i = 0; i < k; ++i) out[axis * n + i] = slopes_[i] * (inner_[axis] - centers_(i, axis));
  }
  if (normalized_) {  // ∇(φᵢ/Σ) = (∇φᵢ − φᵢ/Σ · Σ∇φ)/Σ; the sum is that of the kernels before the division
    Vector& raw = squared_;
    if (kernel_.kind == KernelKind::gaussian) raw.array() -= raw.minCoeff();
    kernel_.values(raw.data(), k);
    double sum = 0;
    for (Index i = 0; i < k; ++i) sum += amplitudes_[i] * raw[i];
    for (Index axis = 0; axis < d; ++axis) {
      double total = 0;
      for (Index i = 0; i < k; ++i) total += out[axis * n + i];
      for (Index i = 0; i < k; ++i)
        out[axis * n + i] = sum != 0 && std::isfinite(sum) ? (out[axis * n + i] - row_[i] * total) / sum : 0;
    }
  }
  space_.coordinates(inner_.data(), coordinates_.data());
  space_.gradients(coordinates_.data(), polynomials_.data());
  for (Index j = 0; j < tail(); ++j)
    for (Index axis = 0; axis < d; ++axis) out[axis * n + k + j] = polynomials_(j, axis);
  // Back to the caller's axes: y = scale · Lᵀ(x − center), so ∇ₓ = scale · L ∇ᵧ, the last axis first, which no other needs.
  Eigen::Map<MatrixXd> all(out, n, d);
  all *= scale_;
  if (linear_.size() == 0) return;
  for (Index axis = d; axis-- > 0;) {
    all.col(axis) *= linear_(axis, axis);
    for (Index row = 0; row < axis; ++row) all.col(axis) += linear_(row, axis) * all.col(row);
  }
}

void RadialBasis::combine(const MatrixXd& coefficients, const double* queries, Index count, double* out) {
  const Index k = centers(), d = dimension(), m = coefficients.rows();
  if (normalized_ || kernel_.kind == KernelKind::clamped_plate || m > largest_block_outputs || count < 4) {
    for (Index q = 0; q < count; ++q, queries += d, out += m) {
      values(queries, row_.data());
      multiply(coefficients, row_, Eigen::Map<Vector>(out, m));
    }
    return;
  }
  for (Index first = 0; first < count; first += block) {
    const Index width = std::min(block, count - first);
    auto inner = block_inner_.topRows(width);
    auto sums = block_sums_.topLeftCorner(width, m);
    for (Index q = 0; q < width; ++q) {
      to_inner(queries + (first + q) * d, inner_.data());
      inner.row(q) = inner_.transpose();
      polynomials(inner_.data(), row_.data());
      Eigen::Map<Vector> sum(out + (first + q) * m, m);
      multiply(coefficients.rightCols(tail()), row_.head(tail()), sum);
      sums.row(q) = sum.transpose();
    }
    for (Index i = 0; i < k; ++i) {
      Eigen::Array<double, Eigen::Dynamic, 1, 0, block, 1> column = (inner.col(0) - centers_(i, 0)).square();
      for (Index axis = 1; axis < d; ++axis) column += (inner.col(axis) - centers_(i, axis)).square();
      column *= inverse_squares_[i];
      kernel_.values(column.data(), width);
      for (Index j = 0; j < m; ++j) sums.col(j) += coefficients(j, i) * amplitudes_[i] * column;
    }
    Eigen::Map<Matrix>(out + first * m, width, m) = sums.matrix();
  }
}

}  // namespace handlebody
