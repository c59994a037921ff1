// The orthogonal Procrustes problem (paper 001, §4.5): the rotation nearest to a 3×3 covariance.
//
// By our own Jacobi rotations (orthogonal_columns.hpp). Rejected: Eigen::JacobiSVD, which takes 1.7 × the time in wasm and 1.9 ×
// natively; every sphere needs three to ten of these per frame. closest_rotation_test.cpp compares with it.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

/** The R in SO(3) that maximizes tr(Rᵀ H), for H = Σ wᵢ e′ᵢ eᵢᵀ: it takes the eᵢ closest to the e′ᵢ, reflections excluded. Where H
 * does not determine R (rank below 2) the answer is some rotation that attains the maximum. */
Matrix3 closest_rotation(const Matrix3& covariance);

/** A rigid motion x ↦ rotation·(x − from) + to. */
struct RigidMotion {
  Matrix3 rotation = Matrix3::Identity();
  Vector3 from = Vector3::Zero();
  Vector3 to = Vector3::Zero();
};

/** The rigid motion that takes `source` closest to `target` (k×3 each, k ≥ 1). Directions that the points leave free (one point, or
 *  points on a line) turn as little as possible. */
RigidMotion closest_rigid_motion(const ConstPoints& source, const ConstPoints& target);

}  // namespace handlebody
