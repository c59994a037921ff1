// Pose spaces and their weights.
//
// behind: abi/pose_space.cpp core/posespace/pose_space.cpp
#include "scattered.hpp"

using namespace handlebody::fuzz;

FUZZ(bytes) {
  const Scattered data(bytes, 0);
  const std::uint32_t method = bytes.option(0, 1);
  Owned<hb_pose_space_free> space;
  const std::uint32_t count = bytes.count(data.count), dimension = bytes.count(data.dimension), kernel = bytes.option(0, 7);
  const double width = bytes.flip() ? 0 : bytes.positive();
  // Normalized, −1 is no tail.
  const auto degree = static_cast<std::int32_t>(bytes.option(method == 1 ? 0 : 1, 2) - 1);
  if (!space.make([&](hb_pose_space** out) {
        return hb_pose_space_create(data.points.data(), count, dimension, method, kernel, width, degree, out);
      }))
    return;
  reached();
  std::vector<double> weights(data.count + 1, 7), query = bytes.numbers(data.dimension);
  for (std::uint32_t times = bytes.from_to(1, 4); times > 0; --times) {
    if (bytes.flip()) std::copy_n(data.points.begin() + bytes.below(data.count) * data.dimension, data.dimension, query.begin());
    worked(hb_pose_space_weights(space.get(), query.data(), weights.data()));
    query = bytes.numbers(data.dimension);
  }
  require(weights.back() == 7, "there is one weight for each example");
}
