// Shepard's method (2014 course, §4.3): weights by an inverse power of the distance, divided by their sum,
//
//   f(x) = Σ wₖ(x) fₖ / Σ wₖ(x),    wₖ(x) = (‖x − xₖ‖ + ε)⁻ᵖ.
//
// With ε = 0 the value at a point is the point's own, as the limit has it; any ε > 0 only approximates. For p > 1 the gradient is
// zero at every point (flat spots, Fig. 9); for p ≤ 1 there is a cusp (Fig. 10) and no gradient. Far away all weights become 1/n.
#pragma once

#include "core/interpolation/interpolant.hpp"

namespace handlebody {

struct ShepardOptions {
  double power = 2;    // p > 0
  double epsilon = 0;  // ε ≥ 0, units of the points
};

class Shepard final : public Interpolant {
 public:
  /** Fails with the codes of check_data() or INVALID_OPTION. */
  static Result<Shepard> create(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                const ShepardOptions& options = {});

 private:
  Shepard(ScatteredData data, const ShepardOptions& options) : Interpolant(std::move(data)), options_(options) {}

  void weigh(const double* query, double* w, double* slopes) override;

  ShepardOptions options_;
};

}  // namespace handlebody
