// What of a list of triangles is a surface: without those that have no area, and with faces that are there twice taken once.
#pragma once

#include "core/numerics/types.hpp"

namespace handlebody {

struct SoundSurface {
  Triangles triangles;  // those with an area, in the order given; then those without one that close gaps between the others
  Index with_area = 0;
  Index flat = 0;     // triangles given that have no area: two corners in one place, or three in a line
  Index doubled = 0;  // copies of a face that were left out
};

/** Of triangles with welded indices:
 *
 *  - One without area is left out, unless it is needed where a large face meets smaller ones along an edge: there its three sides
 *    are what the others lack. One that has a corner off the rest of the surface is left out as well.
 *  - Of triangles with the same three corners one is left, turned to fit its neighbors, if the surface is then as closed as
 *    without any copy: double-sided faces, and exports that have a part twice. Where it would not be, they are no copies: two
 *    opposite ones are a wall between two parts, which cancels out, and two alike belong to two parts that overlap.
 *
 *  Where no triangle has an area all are left as they are. */
SoundSurface sound_surface(const Points& positions, const Triangles& triangles);

}  // namespace handlebody
