// Handles as linear constraints on the mapping (paper 001, eq. (4)): a position is one row, a rotation three more, the edges of a
// small structure about the handle that turn and scale with it.
#pragma once

#include <memory>
#include <vector>

#include "core/errors/result.hpp"
#include "core/irbf/basis.hpp"
#include "core/irbf/body.hpp"
#include "core/irbf/sphere_structure.hpp"
#include "core/mesh/triangle_tree.hpp"

namespace handlebody {

enum class HandleKind : unsigned { position = 0, rotation = 1 };

class HandleConstraints {
 public:
  static constexpr Index target_size = 10;  // position xyz, quaternion xyzw, scale xyz

  // Compiled once, because many places move one.
  HandleConstraints();
  HandleConstraints(HandleConstraints&&) noexcept;
  HandleConstraints& operator=(HandleConstraints&&) noexcept;
  ~HandleConstraints();

  /** Handles at `places` (k×3, model units); rotation handles grip a structure of `radius` (solver space). `surface` is the body's,
   * made when it is first needed. Fails with HANDLE_NOT_FINITE, HANDLE_OUTSIDE, INVALID_OPTION (too many), or as the basis does. */
  static Result<HandleConstraints> create(const Body& body, const Basis& basis, std::unique_ptr<TriangleTree>& surface,
                                          const ConstPoints& places, const std::vector<HandleKind>& kinds, double radius);

  Index handles() const { return std::ssize(kinds_); }

  /** Constraint points, solver space: a handle's own, then a rotation handle's six structure points. */
  const Points& points() const { return points_; }

  /** S: one row per constraint, [s 1 φ(s)] for a point and [e 0 Δφ] for an edge. */
  const MatrixXd& rows() const { return rows_; }

  /** The first handle that shares its place with an earlier one, or −1. */
  Index repeated() const;

  /** target_size numbers per handle, model units, at rest. */
  std::vector<double> rest(const ConstPoints& places) const;

  /** Where the constraint points are to go, solver space. Fails with TARGET_NOT_FINITE or HANDLE_CONFLICT. Allocates nothing. */
  Result<Done> read_targets(const double* targets, const Normalization& normalization, Points& moved) const;

  /** T of the rows from the displacements of the constraint points, times `weight`. */
  void right_hand_side(const Points& displacements, double weight, Eigen::Ref<Columns3> out) const;

  /** The largest distance between a handle's image and its target, where the rows' residual against T is `missed`. */
  double largest_miss(const Columns3& missed) const;

 private:
  std::vector<HandleKind> kinds_;
  std::vector<Index> same_as_;  // an earlier handle at the same point, or −1
  double radius_ = 0;
  Points points_;
  MatrixXd rows_;
};

}  // namespace handlebody
