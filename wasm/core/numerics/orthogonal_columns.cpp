// Compiled with -O3: see CMakeLists.txt.
#include "core/numerics/orthogonal_columns.hpp"

#include <cmath>

namespace handlebody {
namespace {

/** (x, y) ← (cx − sy, sx + cy) for columns p and q. */
void rotate(Matrix3& m, Index p, Index q, double c, double s) {
  const Vector3 x = m.col(p), y = m.col(q);
  m.col(p) = c * x - s * y;
  m.col(q) = s * x + c * y;
}

}  // namespace

OrthogonalColumns orthogonal_columns(const Matrix3& a) {
  OrthogonalColumns result{a, Matrix3::Identity()};
  auto& [columns, v] = result;
  constexpr int most_sweeps = 16;  // four or five are usual: convergence is quadratic
  bool perpendicular = false;
  for (int sweep = 0; sweep < most_sweeps && !perpendicular; ++sweep) {
    perpendicular = true;
    for (Index p = 0; p < 2; ++p) {
      for (Index q = p + 1; q < 3; ++q) {
        const double pp = columns.col(p).squaredNorm(), qq = columns.col(q).squaredNorm();
        const double pq = columns.col(p).dot(columns.col(q));
        if (pp < qq) {  // longest first
          rotate(columns, p, q, 0, -1);
          rotate(v, p, q, 0, -1);
        }
        if (pq * pq <= 1e-31 * pp * qq) continue;
        perpendicular = false;
        const double gap = std::abs(pp - qq) / 2, sine = pp < qq ? -pq : pq;
        const double tangent = sine / (gap + std::sqrt(gap * gap + pq * pq));
        const double c = 1 / std::sqrt(1 + tangent * tangent);
        rotate(columns, p, q, c, -c * tangent);
        rotate(v, p, q, c, -c * tangent);
      }
    }
  }
  return result;
}

}  // namespace handlebody
