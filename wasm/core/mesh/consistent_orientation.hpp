// Which way triangles face: whether neighbors agree along their edges, and turning triangles until they do.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

struct Orientation {
  bool closed;       // every edge is traversed as often one way as the other
  bool inside_out;   // closed, and all parts that lie in no other face inward
  Index turned;      // triangles that were turned round
  Index open_edges;  // edges that are still unbalanced afterwards
};

/** Turns triangles (welded indices) round so that neighbors agree. Parts are connected by edges of two triangles. A part that does
 * not agree with itself is made to: then it faces outward if it is closed, so that cavities fill up, and as the larger share of its
 * area did if it is open. A closed part that agrees and faces inward stays a cavity where it lies in another part, and is turned
 * where it does not. A mesh that is closed, and inside out as a whole, stays as it is. Triangles at edges of more than two, and
 * parts that cannot agree (a Möbius band), keep whatever inside they give. */
Orientation orient_consistently(const Points& positions, Triangles& triangles);

}  // namespace handlebody
