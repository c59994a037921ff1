// How a sphere is strained, for the energy of its volume: fixed corotated elasticity (Stomakhin, Howes, Schroeder & Teran,
// "Energetically consistent invertible elasticity", SCA 2012), of which paper 001's eq. (8) is the part ‖F − R‖².
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** Of a deformation gradient F = R S, with S symmetric where F does not reflect. */
struct Strain {
  Matrix3 turn = Matrix3::Identity();      // R
  Matrix3 cofactor = Matrix3::Identity();  // Rᵀ ∂(det F)/∂F
  double growth = 0;                       // det F − 1
};

Strain strain_of(const Matrix3& gradient);

}  // namespace handlebody
