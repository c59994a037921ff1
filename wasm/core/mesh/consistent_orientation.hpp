// Which way triangles face: whether neighbors agree along their edges, and turning triangles until they do.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

struct Orientation {
  bool closed;       // every edge is traversed as often one way as the other
  bool inside_out;   // closed, and encloses a negative volume
  Index turned;      // triangles that were turned round
  Index open_edges;  // edges that are still unbalanced afterwards
};

/** Turns triangles (welded indices) round so that neighbors agree. A mesh that is closed already is left as it is: its cavities
 *  stay cavities. Otherwise every part connected by edges of two triangles is made to agree with itself. A closed part then faces
 *  outward, so that cavities fill up, and an open one faces as the larger share of its area did. Triangles at edges of more than
 *  two, and parts that cannot agree (a Möbius band), keep whatever inside they give. */
Orientation orient_consistently(const Points& positions, Triangles& triangles);

}  // namespace handlebody
