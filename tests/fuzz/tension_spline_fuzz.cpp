// Splines with tension, in one, two and three dimensions, and with zero slope at the ends.
//
// behind: abi/tension_spline.cpp core/interpolation/tension_spline.cpp core/interpolation/tension_spline_1d.cpp core/kernels/tension_kernel.cpp core/numerics/bessel_k.cpp core/numerics/hyperbolic.cpp
#include "scattered.hpp"

using namespace handlebody::fuzz;

FUZZ(bytes) {
  const Scattered data(bytes, bytes.from_to(1, 3));
  const GivenPoints given = data.view(bytes);
  hb_tension_spline_options options{bytes.positive(), bytes.flip() ? 0 : bytes.positive() * bytes.scale(),
                                    bytes.flip() ? 0 : bytes.positive(), bytes.flip() ? 0 : bytes.positive(), 0};
  if (data.dimension == 1) options.ends = bytes.option(0, 1), options.alpha *= bytes.byte() > 20;
  if (options.ends == 1 && !bytes.wildly()) options.gamma = options.smoothing = 0;
  Interpolant made;
  if (!made.make([&](hb_interpolant** out) {
        return hb_tension_spline_create(given.points, given.values, given.count, given.dimension, given.outputs, &options, out);
      }))
    return;
  reached();
  ask(bytes, data, made.get());
  hb_rbf_report report;
  require(worked(hb_rbf_get_report(made.get(), &report)) == (options.ends == 0),
          "only a spline over all of space is a radial basis fit");
}
