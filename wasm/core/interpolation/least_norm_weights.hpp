// The most even weights by which a place is the weighted mean of given ones: of all such weights, those of least norm.
//
//   minimize ½ Σ wᵢ²   where   Σ wᵢ qᵢ = 0,   Σ wᵢ = 1,   w ≥ 0,
//
// with the qᵢ relative to the place. By its Lagrangian wᵢ = max(0, v(qᵢ)) for one affine function v, so points that are mirror
// images of each other as seen from the place have equal weights, and their order does not matter. The dual method of Goldfarb and
// Idnani (Mathematical Programming 27, 1983) starts without w ≥ 0 and drops, one at a time, the points that would be negative;
// points whose multiplier vanishes meanwhile are taken back. The points kept always span the space. Every round raises the optimum,
// so no set of points comes twice, and the method ends.
//
// The affine functions are kept orthonormal over the points kept while these come and go, by an update of rank one each, which
// Eigen's factorizations do not have for rows.
#pragma once

#include <cstdint>
#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

class LeastNormWeights {
 public:
  /** Makes the scratch space for up to `most` points in `dimension` ≥ 0 dimensions. */
  LeastNormWeights(Index most, Index dimension);

  /** Where to write the coordinates of point i, relative to the place. */
  double* point(Index i) { return points_.data() + i * points_.cols(); }

  /** The weights of points 0 … `count` − 1, which span the space unless there is just one. False, and no weights, where the place
   * is outside their hull by more than 1e-9 in terms of weights. A step takes O(count · d); there is one for each point that is
   * dropped, up to a bound beyond which the answer is false. Allocates nothing. */
  bool solve(Index count);

  double weight(Index i) const { return values_[i]; }

 private:
  void orthonormalize();
  void along(const double* row, Vector& out);
  void reweigh(Index i, double sign);
  bool let_go(Index leaving, Index& steps_left);

  Matrix points_;  // most×d
  Index count_ = 0;
  Matrix basis_;                    // most×(d+1): affine functions at all points, orthonormal over those kept
  Vector values_;                   // v
  Vector slopes_;                   // change of v
  Vector pivot_;                    // d+1: a row of basis_
  std::vector<std::uint8_t> kept_;  // whether wᵢ = v(qᵢ); otherwise it is 0, and v(qᵢ) ≤ 0
};

}  // namespace handlebody
