// The functions that a radial basis interpolant combines linearly (2014 course, eq. (1) of §4.4 and §5.2): a kernel at each of k
// centers and the polynomials up to a degree,
//
//   φᵢ(x) = aᵢ φ(‖x − cᵢ‖/hᵢ),  i < k,   then   p₁(x), p₂(x), …
//
// `normalized` divides the kernels by their sum (course §4.4.1): constants are then in the span without a tail, and the values stay
// bounded far away. Where no kernel reaches (beyond the supports of compact ones, or where all underflow) the nearest center's
// counts alone, as it does in the limit of wider ones. With a `metric` M distances are Mahalanobis's, ‖x‖² = xᵀMx (course §4.4).
//
// Internally, coordinates are moved and scaled to a bounding box with a unit diagonal, y = scale · Lᵀ(x − center) with M = LLᵀ.
// This changes the conditioning and not the functions: widths are scaled along; homogeneous kernels change by the factor
// amplitude_of_scale(), and r² ln r also by a multiple of r², which the side conditions of its tail turn into a polynomial.
#pragma once

#include "core/errors/result.hpp"
#include "core/interpolation/polynomial_space.hpp"
#include "core/kernels/kernel.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

struct RadialBasisOptions {
  Kernel kernel;            // width in units of the points
  int order = 2;            // of polyharmonic and clamped_plate
  int degree = -1;          // of the polynomials: −1 (none) to 2; at least kernel.minimum_degree() unless normalized
  bool normalized = false;  // needs a kernel without zeros

  // One width per center instead of kernel.width (k, units of the points), or empty. Multiquadrics are then scaled by their widths,
  // √(hᵢ² + r²), so that all grow alike and the side condition Σcᵢ = 0 still cancels the growth. No theorem guarantees that unequal
  // widths give a regular matrix.
  Vector widths = {};

  MatrixXd metric = {};  // d×d, symmetric and positive definite, or empty for Euclidean distances; Rbf evens out axes then
};

/** Lᵀ of M = LLᵀ, whose distances are those of Lᵀx; empty for an empty `metric`. Fails with INVALID_OPTION where it is not a metric
 * of `dimension` dimensions. */
Result<MatrixXd> metric_root(const MatrixXd& metric, Index dimension);

class RadialBasis {
 public:
  // Compiled once, because many places move one.
  RadialBasis(const RadialBasis&);
  RadialBasis(RadialBasis&&) noexcept;
  RadialBasis& operator=(RadialBasis&&) noexcept;
  ~RadialBasis();

  /** `points` (n×d) decide scale, origin and which polynomials there are (polynomial_space.hpp); `centers` k×d. Fails with
   * INVALID_OPTION. */
  static Result<RadialBasis> create(const Matrix& points, const Matrix& centers, const RadialBasisOptions& options);

  Index centers() const { return centers_.rows(); }
  Index tail() const { return space_.size(); }
  Index size() const { return centers() + tail(); }
  Index dimension() const { return center_.size(); }
  const Kernel& kernel() const { return kernel_; }
  int degree() const { return space_.degree(); }
  bool normalized() const { return normalized_; }
  /** Whether the kernels' matrix at their own centers is symmetric. */
  bool symmetric() const { return !normalized_ && !own_widths_; }

  /** Widths in units of the points (k). */
  Vector widths() const;
  /** Inner lengths are this times the caller's. */
  double scale() const { return scale_; }

  /** A kernel in inner coordinates is this times the kernel in the caller's: s^e, s the scale and e the homogeneity, and for
   * tension a factor that makes its values about 1. */
  double amplitude_of_scale() const { return amplitude_of_scale_; }

  /** Points (n×d) in inner coordinates. */
  Matrix to_inner(const Matrix& points) const;

  /** The polynomials (tail()) at a place in inner coordinates (d). */
  void polynomials(const double* inner, double* out);

  /** All functions (size()) at `query` (d, the caller's coordinates). Allocates nothing. */
  void values(const double* query, double* out);

  /** The kernels alone from center `first` on (centers() − first), not normalized. */
  void kernels_from(Index first, const double* query, double* out);

  /** The gradients of all functions: out size()×d, axis after axis, in the caller's coordinates. Allocates nothing. */
  void gradients(const double* query, double* out);

  /** Σ coefficients · functions: `coefficients` m×size() column-major, out count×m. Allocates nothing for m ≤
   * largest_block_outputs; blocks of queries share each center's work. */
  void combine(const MatrixXd& coefficients, const double* queries, Index count, double* out);

 private:
  static constexpr Index block = 64;
  static constexpr Index largest_block_outputs = 8;

  RadialBasis() = default;
  void set_frame(const Matrix& points);
  Result<Done> set_widths(const RadialBasisOptions& options);
  Result<Done> set_ball(const Matrix& points);
  void to_inner(const double* query, double* inner) const;
  void squared_distances(Index first = 0);
  void kernels_of_distances(Index first, double* out);
  double plate_margin(const double* inner) const;
  void nearest_alone(double* out);

  Kernel kernel_;
  int order_ = 2;
  bool normalized_ = false, own_widths_ = false;
  PolynomialSpace space_;
  Vector center_;    // d, the caller's coordinates
  MatrixXd linear_;  // d×d: Lᵀ, or empty
  double scale_ = 1, amplitude_of_scale_ = 1;
  MatrixXd centers_;        // k×d, inner: the centers' first coordinates, then the second …
  Vector widths_;           // k, inner
  Vector inverse_squares_;  // k: 1/width², 1 for kernels without
  Vector amplitudes_;       // k: aᵢ
  Vector plate_margins_;    // k: 1 − ‖c‖² in the ball, of the clamped plate
  // Scratch.
  Vector inner_, squared_, slopes_, row_, coordinates_;
  Matrix polynomials_;
  Eigen::Array<double, block, Eigen::Dynamic> block_inner_, block_sums_;
};

}  // namespace handlebody
