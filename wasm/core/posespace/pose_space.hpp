// A pose space (2014 course, §2.2 and §3.4): examples sit at places in a space of a few named dimensions, and at any point of it
// every example gets a weight: 1 at its own place, 0 at the others', a smooth function in between. The shape at that point is
// the weighted sum of the examples' shapes; these weights sum to 1 everywhere, so shapes may be absolute or displacements.
#pragma once

#include "core/interpolation/rbf.hpp"

namespace handlebody {

/** Indices are part of the C interface. */
enum class PoseSpaceMethod : unsigned {
  cardinal = 0,    // RBF with a polynomial tail of degree 0 or 1 (Shape by Example, §2.2)
  normalized = 1,  // normalized RBF (the course's recommendation, §4.4.1); a tail is possible but not needed
};
constexpr unsigned pose_space_method_count = 2;

/** Defaults: multiquadrics, each as wide as half the distance to the nearest other example, and a constant tail.
 *
 * Measured on 20 sets of 16 to 22 expressions on Russell's plane (places of the 1980 paper's Fig. 4, two of which lie 0.06 apart);
 * smallest and largest weight inside the convex hull, on the pad [−1, 1]² outside of it, and at ten times that distance, over all
 * sets; L1 is Σ|w| halfway between neighbors, the mean over the set of 21:
 *
 *                                                   hull           pad outside      far             L1
 *     multiquadric, own widths ½, constant tail    −0.32  1.15    −0.62  1.26    −0.69   1.19      1.50     cardinal default
 *     the same, widths ¼                           −0.23  1.06    −0.46  1.11    −0.51   1.01      1.33
 *     multiquadric, width ¼ of mean spacing        −0.64  1.40    −0.70  1.61    −0.66   1.14
 *     multiquadric, width the mean spacing         −2.17  2.79    −5.07  7.71    −4.16   6.66
 *     linear, constant tail                        −0.16  1.00    −0.33  0.99    −0.39   0.87      1.19     kinks at examples
 *     thin plate, linear tail                      −0.95  1.58    −2.61  4.36   −17.2   26.2       1.92
 *     cubic, linear tail                           −1.82  2.44   −14.9  21.0   −220    320
 *     normalized inverse multiquadric, own widths  −0.23  1.08    −0.27  1.20    −0.08   0.47      1.29     normalized default
 *     normalized inverse quadratic, own widths     −0.19  1.10    −0.22  1.19    −0.03   0.54      1.18
 *     normalized Gaussian, own widths ¾            −0.23  1.28    −0.23  1.40                               steps
 *
 * The cardinal default is smooth (analytic), follows direction beyond the hull instead of fading to a mean, and stays bounded there
 * as Σc = 0 cancels the kernel's growth. A common width does badly: what suits isolated examples gives close ones large weights
 * (rows 3 and 4). On random sets of 5 to 29 places it stays within −0.42 … 1.21 inside the hull; in one to six dimensions with
 * clusters down to 1e-4 within −0.95 … 1.34. Normalized is closer to [0, 1] (−0.33 … 1.21 there) but favors isolated examples. */
struct PoseSpaceOptions {
  PoseSpaceMethod method = PoseSpaceMethod::cardinal;
  KernelKind kernel = KernelKind::multiquadric;

  /** Units of the places. 0 means automatic: for each example a part of the distance to its nearest neighbor, which is ½ for
   * multiquadrics, ¾ for Gaussians and 1 for the inverse kernels. Ignored by kernels without a width. */
  double width = 0;

  /** Tail: 0 or 1 for cardinal, −1 to 1 for normalized. Degree 1 makes weights reproduce linear functions, Σ wₖ(x) xₖ = x, and
   * grow linearly outside the hull. */
  int degree = 0;
};

class PoseSpace {
 public:
  /** `places` n×d. Distances are Euclidean, except that no axis counts as shorter than a thousandth of the longest
   * (comparable_axes()). A single example has weight 1 everywhere, whatever the options.
   *
   * Fails with EXAMPLES_TOO_FEW, EXAMPLE_NOT_FINITE, EXAMPLE_DUPLICATE (two places closer than 1e-9 of the extent on every axis:
   * the later is the culprit, the message holds both numbers), EXAMPLES_DEGENERATE (a singular system) and INVALID_OPTION. */
  static Result<PoseSpace> create(const Eigen::Ref<const Matrix>& places, const PoseSpaceOptions& options = {});

  Index size() const { return rbf_.size(); }
  Index dimension() const { return rbf_.dimension(); }

  /** The n weights at `query` (d); they sum to 1. Allocates nothing. Fails with QUERY_NOT_FINITE.
   * A query farther than 1000 diagonals from the examples' center is first pulled back to that distance, where weights of degree
   * −1 and 0 have settled to within a thousandth or so; farther out, rounding would grow with the distance. */
  Result<Done> weights(const Eigen::Ref<const Vector>& query, Eigen::Ref<Vector> out);

 private:
  PoseSpace(Rbf rbf, const Matrix& places, Vector measures);

  static Result<PoseSpace> attempt(const Eigen::Ref<const Matrix>& places, const PoseSpaceOptions& options);

  Rbf rbf_;
  Vector measures_;   // d: of the axes, or empty
  Vector center_;     // d
  double reach_ = 0;  // 1000 diagonals
  Vector query_;      // d: scratch
  Vector offset_;     // likewise
};

}  // namespace handlebody
