// The deformation that is as rigid as possible (Sorkine & Alexa 2007; per triangle, in the plane: Liu et al. 2008). It minimizes
//
//   E = ½ Σ over triangles t of area(t) ‖J − R‖²,    J the gradient of the map on t, R the rotation closest to it,
//
// by rounds of a local step, which finds every R, in the plane in closed form, and a global one, which solves C u = Σ area (R − I)
// ∇φ for the displacements: one factorization for all. No round raises E. A frame starts from the last one's result and takes the
// rounds it is given; it stops early where no vertex moves by more than 1e-7 of the extent.
#pragma once

#include "core/skinning/held_deformation.hpp"

namespace handlebody {

/** Fails as HeldDeformation::set_up() does, or with OUT_OF_MEMORY or SYSTEM_SINGULAR. */
Result<std::unique_ptr<HeldDeformation>> as_rigid_as_possible(SimplexMesh mesh, HeldVertices held);

}  // namespace handlebody
