// The normalized interior basis functions φ of paper 001, eqs. (2)–(3): φ_c(p) = Φ(d_I(p, c)) / Σ Φ(d_I(p, ·)).
#pragma once

#include "core/distance/interior_samples.hpp"
#include "core/irbf/body.hpp"
#include "core/kernels/kernel.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class Basis {
 public:
  /** `relative_width` is the kernel's width in mean spacings of the centers: the mean interior distance of a center to its nearest
   *  neighbor (the bounding box's diagonal where there is only one). `body` must outlive the basis. */
  Basis(const Body& body, KernelKind kind, double relative_width);

  const Kernel& kernel() const { return kernel_; }
  Index size() const { return static_cast<Index>(body_->centers.size()); }

  /** φ at the samples: samples × centers; every row sums to 1. */
  template <typename Scalar>
  void evaluate(const InteriorSamples& samples,
                Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> phi) const;

 private:
  /** Calls visit(c, center, ratios) for every center with the ratios of its field at the samples' voxels. */
  template <typename Visit>
  void for_each_center(const InteriorSamples& samples, const Visit& visit) const;

  const Body* body_;
  Kernel kernel_;
};

}  // namespace handlebody
