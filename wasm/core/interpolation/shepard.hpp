// Shepard's method (2014 course, §4.3): weights by an inverse power of the distance, divided by their sum,
//
//   f(x) = Σ wₖ(x) fₖ / Σ wₖ(x),    wₖ(x) = (‖x − xₖ‖ + ε)⁻ᵖ.
//
// With ε = 0 the value at a point is the point's own, as the limit has it. For p > 1 the gradient is then zero at every point (flat
// spots, Fig. 9); for p ≤ 1 there is a cusp (Fig. 10) and no gradient. Any ε > 0 only approximates, missing the value at point i by
//
//   Σₖ qₖ (fₖ − fᵢ) / (1 + Σₖ qₖ),    qₖ = (ε / (‖xᵢ − xₖ‖ + ε))ᵖ    over all other points k,
//
// and makes a small cusp of every point, whatever p, since (r + ε)⁻ᵖ is steep at r = 0. Values never leave the range of the data.
// Far away all weights become 1/n; a large p follows the nearest point. Distances of any size are safe.
#pragma once

#include "core/interpolation/interpolant.hpp"

namespace handlebody {

struct ShepardOptions {
  double power = 2;    // p > 0
  double epsilon = 0;  // ε ≥ 0, units of the points
};

class Shepard final : public Interpolant {
 public:
  /** Fails with the codes of check_data() or INVALID_OPTION. Points may coincide where ε > 0. */
  static Result<Shepard> create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                const ShepardOptions& options = {});

 private:
  Shepard(ScatteredData data, const ShepardOptions& options) : Interpolant(std::move(data)), options_(options) {}

  /** Slopes are NaN where there is a cusp. */
  void weigh(const double* query, double* w, double* slopes) override;

  ShepardOptions options_;
};

}  // namespace handlebody
