// Radial basis interpolation of scattered data (2014 course, §4.4 and §5): factor once, evaluate many times.
//
//   f(x) = Σᵢ cᵢ φᵢ(x) + Σⱼ dⱼ pⱼ(x)
//
// through the values, near them (`smoothing`, `weight_decay`), or with fewer centers than points by least squares; see
// linear_fit.hpp for the equations and radial_basis.hpp for the functions.
#pragma once

#include <memory>

#include "core/interpolation/interpolant.hpp"
#include "core/interpolation/linear_fit.hpp"
#include "core/interpolation/radial_basis.hpp"

namespace handlebody {

/** Indices are part of the C interface. */
enum class WidthChoice : unsigned {
  given = 0,
  spacing = 1,        // from the mean distance to the nearest neighbor: width_choice.hpp
  leave_one_out = 2,  // least leave-one-out error
};
constexpr unsigned width_choice_count = 3;

/** Indices are part of the C interface. */
enum class RobustMethod : unsigned { none = 0, least_absolute = 1, least_median = 2 };  // robust_fit.hpp
constexpr unsigned robust_method_count = 3;

struct RbfOptions {
  RadialBasisOptions basis;
  WidthChoice width_choice = WidthChoice::given;
  double smoothing = 0;                      // λ ≥ 0 of R + λI, in units of the kernel; needs a center at each point
  double weight_decay = 0;                   // λ ≥ 0 of eq. (3), in units of the kernel squared
  Matrix centers = {};                       // k×d, or empty for the points themselves
  RobustMethod robust = RobustMethod::none;  // needs fewer centers than points
  bool advised = true;                       // whether a failure looks for what would help, by further fits
};

/** How good a fit is. Lengths in units of the points. */
struct RbfReport {
  double condition = 0;  // 1-norm condition number of the factored equations: an estimate, rarely more than three times too small
  double residual = 0;   // largest misfit at a point
  double spacing = 0;    // mean distance of the points to their nearest neighbors; 0 for a single point
  double least_width = 0, largest_width = 0;
  double suggested_width = 0;      // where ill conditioned, far off its points or narrow: one that is not, by trial; else 0
  double suggested_smoothing = 0;  // where ill conditioned or far off its points: one that helps, by trial; else 0
  double suggested_decay = 0;      // likewise a weight decay, where no smoothing helps
};
constexpr double comfortable_condition = 1e8;

class Rbf final : public Interpolant {
 public:
  // Compiled once, because many places move one.
  Rbf(Rbf&&) noexcept;
  Rbf& operator=(Rbf&&) noexcept;
  ~Rbf();

  /** Fails with the codes of check_data() and RadialBasis::create(), OUT_OF_MEMORY (a matrix of more than largest_matrix_bytes,
   * refused before it is allocated), KERNEL_FAILED, SYSTEM_SINGULAR, or INVALID_OPTION. */
  static Result<Rbf> create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                            const RbfOptions& options);

  void evaluate(const double* queries, Index count, double* out) override;
  void gradient(const double* queries, Index count, double* out) override;

  const RadialBasis& basis() const { return basis_; }
  const LinearFit& fit() const { return *fit_; }

  RbfReport report();

  /** The kernels' coefficients c (k×m), in the caller's units. */
  Matrix kernel_coefficients() const;

  /** Error of each prediction fᵢ − f₋ᵢ(xᵢ) (n×m, the points as given) where f₋ᵢ is fitted without point i: exact, and without
   * refitting. With a center at each point it is cᵢ/(A⁻¹)ᵢᵢ from the inverse of the block matrix A, for any kernel, tail, smoothing
   * and widths (held fixed); with fixed centers (fᵢ − f(xᵢ))/(1 − Hᵢᵢ), H the matrix from values to fitted values. A point that has
   * a twin is predicted by it. Fails with INVALID_OPTION for normalized kernels, whose basis changes with every point, and for
   * robust fits. */
  Result<Matrix> leave_one_out();

  /** How much each point counts (n as given): 1, or less where a robust fit mistrusts it. */
  Vector row_weights() const;

  /** The n×size() matrix whose row k has the coefficients of the k-th cardinal function. Made at first use. */
  const MatrixXd& cardinal();

 private:
  Rbf(ScatteredData data, RadialBasis basis, const RbfOptions& options);

  void weigh(const double* query, double* w, double* slopes) override;
  Matrix fitted();  // n×m, at the points
  double enough(double start, double RbfOptions::*option) const;
  double enough_smoothing() const;
  double enough_decay() const;
  void multiply_gradients(const MatrixXd& coefficients, double* out);

  RadialBasis basis_;
  RbfOptions options_;
  std::unique_ptr<LinearFit> fit_;
  Vector row_weights_;     // n, or empty
  MatrixXd coefficients_;  // m×size()
  MatrixXd cardinal_;      // n×size(), or empty as yet
  Vector row_;             // scratch
  MatrixXd gradients_;     // size()×d, scratch
  Vector slope_;           // as long as there are points or outputs, scratch
};

/** check_data() in the metric of a fit. An empty one is Euclidean, unless axes need to be made comparable (comparable_axes()): then
 * it becomes the metric that does so. Fails with INVALID_OPTION for what is not a metric. */
Result<ScatteredData> check_in_metric(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                      MatrixXd& metric, Coincident coincident);

/** The largest dense matrix that is allocated: 1 GiB. */
constexpr double largest_matrix_bytes = 1073741824.0;

/** OUT_OF_MEMORY where the matrices for so many points and centers are too large, with the size that they would have. */
Result<Done> check_size(double points, double centers, double polynomials);

}  // namespace handlebody
