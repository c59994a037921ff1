// Which way triangles face: whether they agree along their edges, and turning them until they do.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

struct Orientation {
  bool closed;       // every edge is run through as often one way as the other
  bool inside_out;   // closed, and encloses a negative volume
  Index turned;      // triangles that were turned round
  Index open_edges;  // that are not balanced, afterwards
};

/** Turns triangles (welded indices) round so that neighbors agree. A mesh that is closed as it is stays: its cavities are cavities.
 *  Else every part that hangs together by edges of two triangles is made to agree with itself; a closed part then faces outward, so
 *  that cavities fill up, and an open one as the larger share of its area did. Triangles with an edge of more than two others, and
 *  parts that cannot agree (a Möbius band), keep what inside they give. */
Orientation orient_consistently(const Points& positions, Triangles& triangles);

}  // namespace handlebody
