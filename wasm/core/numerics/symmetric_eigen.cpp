#include "core/numerics/symmetric_eigen.hpp"

#include <cmath>

namespace handlebody {

namespace {

/** Columns x, y ← c x − s y, s x + c y. */
void rotate(double* x, double* y, Index count, Index stride, double c, double s) {
  for (Index i = 0; i < count * stride; i += stride) {
    const double u = x[i], v = y[i];
    x[i] = c * u - s * v;
    y[i] = s * u + c * v;
  }
}

}  // namespace

void symmetric_eigen(MatrixXd& a, MatrixXd& vectors) {
  const Index n = a.rows();
  vectors.setIdentity(n, n);
  double total = 0;
  for (Index i = 0; i < n * n; ++i) total += a.data()[i] * a.data()[i];
  for (int sweep = 0; sweep < 30; ++sweep) {
    double off = 0;
    for (Index q = 1; q < n; ++q) {
      for (Index p = 0; p < q; ++p) {
        const double entry = a(p, q);
        off += entry * entry;
        if (entry == 0) continue;
        // The smaller of the two angles that make a(p, q) vanish.
        const double half = (a(q, q) - a(p, p)) / (2 * entry);
        const double t = (half >= 0 ? 1 : -1) / (std::abs(half) + std::sqrt(1 + half * half));
        const double c = 1 / std::sqrt(1 + t * t), s = t * c;
        rotate(&a(0, p), &a(0, q), n, 1, c, s);
        rotate(&a(p, 0), &a(q, 0), n, n, c, s);
        rotate(&vectors(0, p), &vectors(0, q), n, 1, c, s);
      }
    }
    if (off <= 1e-30 * total) return;
  }
}

}  // namespace handlebody
