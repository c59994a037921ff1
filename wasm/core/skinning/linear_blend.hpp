// Linear blend skinning: every vertex goes where the average of the handles' transforms takes it,
//
//   uᵢ = Σⱼ wᵢⱼ Tⱼ [vᵢ; 1],
//
// in two forms. *Direct* blends the h matrices at every vertex and applies the blend. *Compiled* multiplies the stacked transforms
// by one matrix C that is made once (the lecture's compile_blending_weights): row i has wᵢⱼ [vᵢ; 1] for all j, n × (d + 1)h
// numbers. Both do the same (d + 1) d h multiplications a vertex; direct reads h + d numbers for them, compiled (d + 1) h + d.
//
// Arithmetic is single precision, and of displacements: with c the middle of the box and sᵢ = Σⱼ wᵢⱼ,
//
//   uᵢ = vᵢ + Σⱼ wᵢⱼ (Dⱼ (vᵢ − c) + τⱼ) − (1 − sᵢ) vᵢ,    Dⱼ = Aⱼ − I,  τⱼ = Aⱼ c + tⱼ − c    for Tⱼ = [Aⱼ | tⱼ],
//
// so that identities leave vᵢ exactly where it was, and errors are some 1e-7 of the shape's and the motion's extent wherever the
// shape lies. The last term, zero for weights that sum to 1 (to 1e-9 everywhere), is one more handle: weight 1 − sᵢ and T = 0.
#pragma once

#include <vector>

#include "core/skinning/skin.hpp"

namespace handlebody {

enum class LinearBlendForm { direct, compiled };

class LinearBlend final : public Skin {
 public:
  /** `positions` n×d, `weights` n×h, any finite numbers. Fails as check_skin() does. */
  static Result<LinearBlend> create(const Eigen::Ref<const Matrix>& positions, const Eigen::Ref<const Matrix>& weights,
                                    LinearBlendForm form = LinearBlendForm::direct);

 private:
  /** One number of four vertices: a vector type of the compiler's, as in frame_kernel.hpp. */
  using Quad = float __attribute__((vector_size(16)));

  LinearBlend(const Eigen::Ref<const Matrix>& positions, const Eigen::Ref<const Matrix>& weights, LinearBlendForm form);

  void move(float* out) override;
  void stack_transforms();
  template <Index d>
  void move_direct(float* out) const;
  template <Index d>
  void move_compiled(float* out) const;

  LinearBlendForm form_;
  Index columns_;              // handles, with the one for what sums lack
  Vector center_;              // c, as floats hold it
  std::vector<Quad> rest_;     // d a tile of four vertices
  std::vector<Quad> weights_;  // wᵢⱼ: columns_ a tile; compiled: wᵢⱼ [vᵢ − c; 1], (d + 1) columns_ a tile
  std::vector<Quad> stacked_;  // [Dⱼ | τⱼ], every number four times: a multiplication takes it straight from memory
};

}  // namespace handlebody
