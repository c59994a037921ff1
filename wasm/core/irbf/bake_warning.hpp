// What a bake tells its user although it worked.
#pragma once

#include <optional>

#include "core/errors/status.h"
#include "core/numerics/types.hpp"

namespace handlebody {

/** The codes' meaning is in status.h. A warning concerns `count` things (triangles, links, vertices); the worst is at `place`
 * (model units), and is vertex `vertex` if it is one. */
struct BakeWarning {
  hb_warning_code code;
  Index count = 0;
  double value = 0;  // LIMBS_MERGED, VOXELS_FEW: a resolution that would do, 0 where none up to 512 does.
                     // PART_OUTSIDE: how far out, model units
  std::optional<Vector3> place = std::nullopt;
  Index vertex = -1;
};

}  // namespace handlebody
