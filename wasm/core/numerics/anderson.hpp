// Anderson acceleration of a fixed-point iteration x ← G(x) (Anderson 1965; Walker & Ni 2011): the next x is the combination of the
// last few G(x) whose residuals G(x) − x cancel best.
#pragma once

#include "core/numerics/decompositions.hpp"

namespace handlebody {

class Anderson {
 public:
  /** For vectors of `size` numbers, with the differences of the last `window` steps. Allocates all that it needs. */
  Anderson(Index size, Index window);

  /** Forgets the steps so far: the next one is plain. */
  void forget() { steps_ = 0; }

  /** From x and g = G(x), the next x; may be written over either. Allocates nothing. The caller guards against steps that do harm.
   */
  void accelerate(const double* x, const double* g, double* next);

 private:
  Index window_, steps_ = 0;
  MatrixXd residuals_, images_;  // differences between successive ones, one a column, in turns
  Vector last_residual_, last_image_, residual_;
  MatrixXd gram_;    // of the residuals' differences
  MatrixXd system_;  // gram_, with a one on the diagonal where a step is yet to come
  Cholesky factor_;
  Vector weights_;
};

}  // namespace handlebody
