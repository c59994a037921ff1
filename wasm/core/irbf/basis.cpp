// Compiled with -O3: see CMakeLists.txt.
#include "core/irbf/basis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace handlebody {

namespace {

/** Centers that are evaluated side by side, and samples per chunk. */
constexpr Index lanes = 8, chunk = 32;
/** Mean spacings of centers that a kernel is wide at least: narrower ones leave dents between them. */
constexpr double narrowest = 2;
/** A sum of kernels is no divisor when it is smaller than this part of the sum of their magnitudes. */
constexpr double cancellation = 1e-3;

/** Calls visit(first sample, count, block), with the interior distances of `count` samples from centers c to c + lanes − 1 in
 *  block[sample · lanes + lane], for all samples and blocks of centers; lanes beyond the last center repeat it. */
template <typename Scalar, typename Visit>
void for_each_block(const Body& body, const InteriorSamples& samples, const Visit& visit) {
  const auto centers = std::ssize(body.centers);
  const std::size_t voxels = body.domain.voxels().size();
  std::vector<Scalar> ratios;
  std::array<Scalar, lanes * chunk> block;
  for (Index first = 0; first < centers; first += lanes) {
    std::array<const std::uint16_t*, lanes> codes{};
    std::array<Vector3, lanes> places;
    for (Index lane = 0; lane < lanes; ++lane) {
      const Index center = std::min(first + lane, centers - 1);
      codes[lane] = body.distances.data() + static_cast<std::size_t>(center) * voxels;
      places[lane] = body.center_position(center);
    }
    samples.template block_ratios<Scalar, lanes>(places, codes, static_cast<Scalar>(body.distance_scale), ratios);
    for (Index from = 0; from < samples.size(); from += chunk) {
      const Index count = std::min(chunk, samples.size() - from);
      samples.template block_distances<Scalar, lanes>(places, ratios, from, count, block.data());
      visit(first, from, count, block.data());
    }
  }
}

}  // namespace

Basis::Basis(const Body& body, const Kernel& kernel) : body_(&body), kernel_(kernel) {
  InteriorSamples centers;
  for (Index c = 0; c < size(); ++c) centers.add(body.domain, body.center_position(c));
  Vector nearest = Vector::Constant(size(), std::numeric_limits<double>::infinity());
  for_each_block<double>(body, centers, [&](Index first, Index from, Index count, const double* block) {
    for (Index i = 0; i < count; ++i) {
      for (Index lane = 0; lane < std::min(lanes, size() - first); ++lane) {
        const Index c = first + lane;
        if (from + i != c) nearest(c) = std::min(nearest(c), block[i * lanes + lane]);
      }
    }
  });
  if (!kernel_.has_width()) return;
  if (size() > 1) spacing_ = nearest.mean();
  kernel_.width = kernel.width > 0 ? kernel.width * spacing_ : std::max(body.smooth_length, narrowest * spacing_);
}

template <typename Scalar>
Result<Done> Basis::evaluate(const InteriorSamples& samples,
                             Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> phi) const {
  const double scale = kernel_.has_width() ? 1 / kernel_.width : 1;
  std::array<double, lanes * chunk> values;
  for_each_block<Scalar>(*body_, samples, [&](Index first, Index from, Index count, const Scalar* block) {
    for (Index i = 0; i < count * lanes; ++i) {
      const double s = scale * static_cast<double>(block[i]);
      values[i] = s * s;
    }
    kernel_.values(values.data(), count * lanes);
    const Index width = std::min(lanes, size() - first);
    for (Index i = 0; i < count; ++i)
      for (Index lane = 0; lane < width; ++lane) phi(from + i, first + lane) = static_cast<Scalar>(values[i * lanes + lane]);
  });
  for (Index i = 0; i < samples.size(); ++i) {
    Scalar* row = &phi(i, 0);
    double sum = 0, size = 0;
    for (Index c = 0; c < phi.cols(); ++c) sum += static_cast<double>(row[c]), size += std::abs(static_cast<double>(row[c]));
    if (!std::isfinite(size)) {
      return Error(HB_ERROR_KERNEL_FAILED, {"The kernel gave a number that is not finite at a point of the model."},
                   {"Return a finite number for every distance from 0 on."});
    }
    if (!(size > std::numeric_limits<Scalar>::min())) continue;
    if (std::abs(sum) < cancellation * size) {
      return Error(
          HB_ERROR_INVALID_OPTION,
          {"The kernel changes sign, and at a point of the model the kernels of all centers cancel: they cannot be normalized."},
          {"Use a kernel of one sign, such as inverse-multiquadric."}, HB_CULPRIT_OPTION);
    }
    const auto inverse = static_cast<Scalar>(1 / sum);
    for (Index c = 0; c < phi.cols(); ++c) row[c] *= inverse;
  }
  return Done{};
}

template Result<Done> Basis::evaluate<double>(const InteriorSamples&, Eigen::Ref<Matrix>) const;
template Result<Done> Basis::evaluate<float>(const InteriorSamples&, Eigen::Ref<MatrixF>) const;

}  // namespace handlebody
