#include "core/irbf/basis.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace handlebody {

template <typename Visit>
void Basis::for_each_center(const InteriorSamples& samples, const Visit& visit) const {
  std::vector<double> ratios;
  const std::size_t voxels = body_->domain.voxels().size();
  for (Index c = 0; c < size(); ++c) {
    const std::uint16_t* codes = body_->distances.data() + static_cast<std::size_t>(c) * voxels;
    const Vector3 center = body_->center_position(c);
    samples.distance_ratios(
        center, [&](std::uint32_t v) { return body_->distance_scale * codes[v]; }, ratios);
    visit(c, center, ratios);
  }
}

Basis::Basis(const Body& body, KernelKind kind, double relative_width) : body_(&body), kernel_{kind, 1} {
  InteriorSamples centers;
  for (Index c = 0; c < size(); ++c) centers.add(body.domain, body.center_position(c));
  Vector nearest = Vector::Constant(size(), std::numeric_limits<double>::infinity());
  for_each_center(centers, [&](Index c, const Vector3& center, const std::vector<double>& ratios) {
    for (Index other = 0; other < size(); ++other) {
      if (other != c) nearest(other) = std::min(nearest(other), centers.distance(ratios, center, other));
    }
  });
  kernel_.width = relative_width * (size() > 1 ? nearest.mean() : 1.0);
}

template <typename Scalar>
void Basis::evaluate(const InteriorSamples& samples,
                     Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> phi) const {
  for_each_center(samples, [&](Index c, const Vector3& center, const std::vector<double>& ratios) {
    for (Index i = 0; i < samples.size(); ++i) phi(i, c) = static_cast<Scalar>(kernel_(samples.distance(ratios, center, i)));
  });
  for (Index i = 0; i < samples.size(); ++i) {
    const Scalar sum = phi.row(i).sum();
    // A compactly supported or fast decaying kernel may vanish everywhere at a far point: the affine part alone acts there.
    if (sum > std::numeric_limits<Scalar>::min()) phi.row(i) /= sum;
  }
}

template void Basis::evaluate<double>(const InteriorSamples&, Eigen::Ref<Matrix>) const;
template void Basis::evaluate<float>(const InteriorSamples&, Eigen::Ref<MatrixF>) const;

}  // namespace handlebody
