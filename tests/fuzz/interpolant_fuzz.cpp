// Shepard, moving least squares, simplices and natural neighbors, and what is asked of them.
//
// behind: abi/interpolant.cpp abi/moving_least_squares.cpp abi/natural_neighbor.cpp abi/simplex_linear.cpp core/interpolation/interpolant.cpp core/interpolation/scattered_data.cpp
// behind: core/interpolation/shepard.cpp core/interpolation/moving_least_squares.cpp core/interpolation/simplex_linear.cpp core/interpolation/natural_neighbor.cpp core/interpolation/delaunay_cell.cpp core/interpolation/convex_cell.cpp core/interpolation/nearest_in_hull.cpp core/interpolation/least_norm_weights.cpp
#include "scattered.hpp"

using namespace handlebody::fuzz;

FUZZ(bytes) {
  const std::uint32_t method = bytes.below(4);
  const Scattered data(bytes, method == 3 ? 2 : 0);
  const GivenPoints given = data.view(bytes);
  Interpolant made;
  double width = -1;
  const bool there = made.make([&](hb_interpolant** out) {
    switch (method) {
      case 0:
        return hb_shepard_create(given.points, given.values, given.count, given.dimension, given.outputs, bytes.positive(),
                                 bytes.flip() ? 0 : bytes.positive(), out);
      case 1: {
        const hb_moving_least_squares_options options{bytes.positive(), bytes.flip() ? 0 : bytes.positive(),
                                                      bytes.flip() ? 0 : bytes.positive(),
                                                      static_cast<std::int32_t>(bytes.option(0, 2)), bytes.option(0, 2)};
        return hb_moving_least_squares_create(given.points, given.values, given.count, given.dimension, given.outputs, &options,
                                              bytes.flip() ? &width : nullptr, out);
      }
      case 2:
        return hb_simplex_linear_create(given.points, given.values, given.count, given.dimension, given.outputs, bytes.option(0, 1),
                                        out);
      default:
        return hb_natural_neighbor_create(given.points, given.values, given.count, given.dimension, given.outputs,
                                          bytes.option(0, 1), out);
    }
  });
  if (!there) return;
  reached();
  ask(bytes, data, made.get());
}
