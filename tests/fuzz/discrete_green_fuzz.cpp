// Discrete Green's functions: matrices, and the curve by both ways.
//
// behind: abi/discrete_green.cpp core/interpolation/discrete_green.cpp
#include "target.hpp"

using namespace handlebody::fuzz;

FUZZ(bytes) {
  const std::uint32_t order = bytes.option(1, 3), boundary = bytes.option(0, 3),
                      size = bytes.option(4, bytes.byte() < 230 ? 16 : 64);
  std::vector<std::uint32_t> samples;
  for (std::uint32_t i = bytes.below(3); samples.size() < 20 && i < std::min(size, 64u); i += 1 + bytes.below(4))
    samples.push_back(bytes.wildly() ? bytes.index(size) : i);
  const std::vector<double> values = bytes.numbers(samples.size());
  const std::uint32_t count = bytes.count(static_cast<std::uint32_t>(samples.size()));
  Owned<hb_discrete_green_free> green;
  if (!green.make([&](hb_discrete_green** out) {
        return hb_discrete_green_create(size, order, boundary, samples.data(), values.data(), count, out);
      }))
    return;
  reached();
  std::uint32_t rows = 0, nullity = 0;
  require(worked(hb_discrete_green_shape(green.get(), &rows, &nullity)), "every grid has a shape");
  std::vector<double> out(std::size_t{std::max(rows, size)} * size + 1, 7);
  for (const std::uint32_t which : {0u, 1u, 2u, 3u, bytes.option(0, 3)})
    worked(hb_discrete_green_matrix(green.get(), which, out.data()));
  std::vector<double> curve(size + 1, 7), weights(samples.size() + nullity + 1, 7);
  worked(hb_discrete_green_solve_grid(green.get(), curve.data()));
  worked(hb_discrete_green_solve_radial(green.get(), curve.data(), bytes.flip() ? weights.data() : nullptr));
  require(out.back() == 7 && curve.back() == 7 && weights.back() == 7, "nothing is written beyond the results");
}
