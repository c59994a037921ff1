// Dual quaternion blending (Kavan, Collins, Žára & O'Sullivan 2008): every vertex moves rigidly, by an average of rigid motions
// that is one itself, so that nothing collapses where handles turn against each other.
//
// A motion x ↦ R x + τ is q̂ = q + ε ½ τ q, with q the unit quaternion of R; vertex i moves by Σⱼ wᵢⱼ σᵢⱼ q̂ⱼ, divided by the length
// of its real part. q̂ and −q̂ are one motion: σᵢⱼ = ±1 puts every q̂ⱼ on the side of the vertex's pivot, the handle with its largest
// |wᵢⱼ| (antipodality). In the plane q is the unit complex number e^(iθ/2) and q̂ = q + ε ½ τ q̄, a half angle too: blends of full
// angles would depend on the origin.
//
// Only the rigid part of a transform T = [A | t] counts: the rotation closest to A, without scale and shear, and the translation
// that takes the handle's own region, the mean of the vertices by wᵢⱼ², where T takes it. Sums of weights do not matter. Where
// weights of both signs cancel the blend, the vertex follows its pivot. Single precision, and displacements from the box's middle
// as in linear_blend.hpp: identities leave every vertex exactly where it was.
#pragma once

#include "core/skinning/skin.hpp"

namespace handlebody {

/** Fails as check_shape() does, or with WEIGHTS_MISSING (culprit: the vertex) where all weights of a vertex are 0. */
Result<std::unique_ptr<Skin>> dual_quaternion_blend(const WeightedShape& shape);

}  // namespace handlebody
