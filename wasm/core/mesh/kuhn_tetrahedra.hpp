// A cube split into six tetrahedra (Kuhn 1960), one for each path from corner 0 to corner 7 along three edges, where corner
// i + 2j + 4k is (i, j, k).
#pragma once

#include <array>

namespace handlebody {

/** Volumes are positive, and cubes side by side agree on the diagonal of the face between them. */
inline constexpr std::array<std::array<int, 4>, 6> kuhn_tetrahedra{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}, {0, 6, 4, 7}, {0, 3, 2, 7}}};

}  // namespace handlebody
