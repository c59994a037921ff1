// Deformations that minimize a quadratic energy (lecture, "Energy-based Deformation"): one factorization, and one solve per frame.
// With u the displacement and f = v + u the map,
//
//   dirichlet   ½ ∫|∇u|²            = ½ uᵀ C u         kinks at the handles, shrinks where they pull
//   laplacian   ½ ∫(Δu)²            = ½ uᵀ C M⁻¹ C u   smooth
//   conformal   ½ ∫|∇f|² − area(f)                     each triangle's distance to a similarity: angles stay, sizes may not
//
// with C the cotangent Laplacian, M the Voronoi masses and area(f) the signed one, positive where f keeps orientation (Lévy et al.
// 2002; the first step of Igarashi et al. 2005, integrated). The first two treat each coordinate separately, and are not invariant
// under rotations. Conformal has 2n unknowns, and is 0 for similarities only.
#pragma once

#include "core/skinning/held_deformation.hpp"

namespace handlebody {

enum class QuadraticEnergy { dirichlet, laplacian, conformal };

/** Fails as HeldDeformation::set_up() does, or with OUT_OF_MEMORY or SYSTEM_SINGULAR. */
Result<std::unique_ptr<HeldDeformation>> quadratic_deformation(SimplexMesh mesh, HeldVertices held, QuadraticEnergy energy);

}  // namespace handlebody
