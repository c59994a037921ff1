// Linear blend skinning: every vertex goes where the average of the handles' transforms takes it,
//
//   uᵢ = Σⱼ wᵢⱼ Tⱼ [vᵢ; 1],
//
// in two forms. *Direct* blends the h matrices at every vertex and applies the blend. *Compiled* multiplies the stacked transforms
// by one matrix C that is made once (the lecture's compile_blending_weights): row i has wᵢⱼ [vᵢ; 1] for all j, n × (d + 1)h
// numbers. Both do the same (d + 1) d h multiplications per vertex; direct reads h + d numbers for them, compiled (d + 1) h + d.
//
// Arithmetic is in single precision, on displacements relative to those of one handle, number 0. With c the middle of the box and
// x = vᵢ − c,
//
//   uᵢ = vᵢ + m₀(x) + Σⱼ wᵢⱼ (mⱼ(x) − m₀(x)),    mⱼ(x) = (Aⱼ − I) x + (Aⱼ c + tⱼ − c)    for Tⱼ = [Aⱼ | tⱼ],
//
// wherever weights sum to 1. So a motion that all handles share is reproduced, identities leave vᵢ exactly where it was, and errors
// are some 1e-7 of the shape's and the motion's extent wherever the shape lies. If a sum differs from 1 by more than 1e-9, all
// vertices get one more handle as number 0, with T = 0 and the missing weight.
#pragma once

#include "core/skinning/skin.hpp"

namespace handlebody {

enum class LinearBlendForm { direct, compiled };

/** Weights may be any finite numbers. Fails as check_shape() does. */
Result<std::unique_ptr<Skin>> linear_blend(const WeightedShape& shape, LinearBlendForm form = LinearBlendForm::direct);

}  // namespace handlebody
