// Anderson acceleration of a fixed-point iteration x ← G(x) (Anderson 1965; Walker & Ni 2011): the next x is the combination of the
// last few G(x) whose residuals G(x) − x cancel best.
#pragma once

#include "core/numerics/decompositions.hpp"

namespace handlebody {

class Anderson {
 public:
  /** For vectors of `size` numbers, with the differences of the last `window` steps. Allocates all that it needs. */
  Anderson(Index size, Index window);

  /** Forgets all steps so far: the next one is plain, x ← G(x). */
  void forget() { steps_ = 0; }

  /** From x and g = G(x), the next x; may be written over either. Allocates nothing. The caller must reject steps that do harm. */
  void accelerate(const double* x, const double* g, double* next);

 private:
  Index window_, steps_ = 0;
  MatrixXd residuals_, images_;  // differences between successive ones, one per column, reused in turn
  Vector last_residual_, last_image_, residual_;
  MatrixXd gram_;    // of the differences of the residuals
  MatrixXd system_;  // gram_, with 1 on the diagonal of columns that are not filled yet
  Cholesky factor_;
  Vector weights_;
};

}  // namespace handlebody
