// Dual quaternion blending (Kavan, Collins, Žára & O'Sullivan 2008): every vertex moves rigidly, by an average of rigid motions
// that is one itself, so that nothing collapses where handles turn against each other.
//
// A motion x ↦ R x + τ is q̂ = q + ε ½ τ q, with q the unit quaternion of R; vertex i moves by Σⱼ wᵢⱼ σᵢⱼ q̂ⱼ, divided by the length
// of its real part. q̂ and −q̂ are one motion: σᵢⱼ = ±1 puts every q̂ⱼ on the side of the vertex's pivot, the handle with its largest
// |wᵢⱼ| (antipodality). In the plane q is the unit complex number e^(iθ/2) and q̂ = q + ε ½ τ q̄, a half angle too: blends of full
// angles would depend on the origin.
//
// Only the rigid part of a transform T = [A | t] counts: the rotation closest to A, scale and shear left out, and the translation
// that takes the handle's own region, the mean of the vertices by wᵢⱼ², where T takes it. Sums of weights do not matter. Where
// weights of both signs cancel the blend, the vertex follows its pivot. Single precision, and displacements from the box's middle
// as in linear_blend.hpp: identities leave every vertex exactly where it was.
#pragma once

#include <vector>

#include "core/skinning/skin.hpp"

namespace handlebody {

class DualQuaternion final : public Skin {
 public:
  /** `positions` n×d, `weights` n×h. Fails as check_skin() does, or with WEIGHTS_MISSING (culprit: the vertex). */
  static Result<DualQuaternion> create(const Eigen::Ref<const Matrix>& positions, const Eigen::Ref<const Matrix>& weights);

 private:
  /** w, x, y, z of a quaternion, or the real and the dual complex number of a motion in the plane. */
  using Quad = float __attribute__((vector_size(16)));

  DualQuaternion(const Eigen::Ref<const Matrix>& positions, const Eigen::Ref<const Matrix>& weights);

  void move(float* out) override;
  void read_motions();
  template <Index d>
  void move_all(float* out) const;

  Vector center_;
  Matrix regions_;                    // h×d: where handles act, from the center
  std::vector<float> rest_;           // n×d
  std::vector<float> weights_;        // n×h, every row's largest ±1
  std::vector<std::uint32_t> pivot_;  // n
  std::vector<Quad> motions_;         // real and dual, or in the plane both in one, a handle
  std::vector<float> sides_;          // h×h: whether two motions' real parts point to the same side, ±1
};

}  // namespace handlebody
