// What every scattered-data interpolant has in common: n points in d dimensions, m values at each, and at any place x a weight for
// each point, so that the value there is f(x) = Σₖ wₖ(x) fₖ. All of them are linear in the values once they are made.
#pragma once

#include "core/errors/result.hpp"
#include "core/interpolation/scattered_data.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class Interpolant {
 public:
  Interpolant(Interpolant&&) noexcept = default;
  Interpolant& operator=(Interpolant&&) noexcept = default;
  virtual ~Interpolant() = default;

  Index size() const { return data_.given; }  // points as given, those that were merged included
  Index dimension() const { return data_.points.cols(); }
  Index outputs() const { return data_.values.cols(); }
  const ScatteredData& data() const { return data_; }

  /** Whether gradient() means anything. */
  virtual bool differentiable() const { return true; }

  /** Values (count×m) at `queries` (count×d, finite). Allocates nothing. */
  virtual void evaluate(const double* queries, Index count, double* out);

  /** Gradients (count×m×d: of the first output along every axis, then of the second …) at `queries`. Allocates nothing. */
  virtual void gradient(const double* queries, Index count, double* out);

  /** The weights (size()) of all points as given at one `query` (d). A point that was merged into another has weight 0. */
  void weights(const double* query, double* out);

 protected:
  explicit Interpolant(ScatteredData data);

  /** The weights w (n) of the points that were kept and, unless `slopes` is null, the gradient of each (n×d). `query` has the
   *  measures of the data, if there are any. Uses the object's own scratch space only. */
  virtual void weigh(const double* query, double* w, double* slopes) = 0;

  ScatteredData data_;

 private:
  const double* measure(const double* query);

  Vector w_;       // scratch of evaluate() and gradient()
  Matrix slopes_;  // likewise
  Vector query_;   // likewise, where there are measures
};

}  // namespace handlebody
