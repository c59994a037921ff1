// A convex polygon in the plane, cut down by one half-plane after the other.
//
// Every vertex is the crossing of the two lines that meet there, not of lines through other vertices: errors do not build up, and a
// polygon that begins as a huge box ends with all its digits.
#pragma once

#include <vector>

#include "core/numerics/types.hpp"

namespace handlebody {

class ConvexCell {
 public:
  /** One side, counter-clockwise: it lies on the line {y : normal·y = offset}, the polygon where normal·y ≤ offset. */
  struct Side {
    double normal[2];  // of length 1
    double offset;
    Index owner;       // the caller's number for it, or `box`
    double vertex[2];  // where it ends and the next begins
    double excess;     // scratch of cut(): how far the vertex is beyond the line
  };

  static constexpr Index box = -1;

  /** A polygon of at most `capacity` sides; all space is made here. */
  explicit ConvexCell(Index capacity);

  /** The square |y₀|, |y₁| ≤ half. */
  void start(double half);

  /** Takes the other's sides; its capacity must not be larger. */
  void copy(const ConvexCell& other);

  /** Keeps what satisfies normal·y ≤ offset (of a normal of length 1). A line that only touches, or cuts by no more than rounding
   *  does, leaves the polygon as it is. Where the line is known to go through the vertex between the sides of `owner` and
   *  `meeting`, it does so exactly, whatever rounding says. */
  void cut(double normal_x, double normal_y, double offset, Index owner, Index meeting = box);

  Index size() const { return count_; }  // 0 where nothing is left
  const Side& side(Index k) const { return sides_[k]; }
  const Side& after(Index k) const { return side(k + 1 < count_ ? k + 1 : 0); }
  const Side& before(Index k) const { return side(k > 0 ? k - 1 : count_ - 1); }

  double area() const;

  /** The square of the largest distance of a vertex from the origin. */
  double reach() const;

 private:
  std::vector<Side> sides_, spare_;
  Index count_ = 0;
};

}  // namespace handlebody
