// The normalized interior basis functions φ of paper 001, eqs. (2)–(3): φ_c(p) = Φ(d_I(p, c)) / Σ Φ(d_I(p, ·)).
#pragma once

#include "core/distance/interior_samples.hpp"
#include "core/errors/result.hpp"
#include "core/irbf/body.hpp"
#include "core/kernels/kernel.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class Basis {
 public:
  /** `kernel` is any radial one; its width is in mean spacings of the centers: the mean interior distance of a center to its
   * nearest neighbor (the bounding box's diagonal where there is only one). 0 chooses the body's smooth length, two spacings at
   * least. A kernel without a width takes distances over the bounding box's diagonal. `body` must outlive the basis. */
  Basis(const Body& body, const Kernel& kernel);

  const Kernel& kernel() const { return kernel_; }

  /** The kernel's width in mean spacings of the centers; 0 for a kernel without one. */
  double relative_width() const { return kernel_.has_width() ? kernel_.width / spacing_ : 0; }
  Index size() const { return std::ssize(body_->centers); }

  /** φ at the samples: samples × centers; every row sums to 1, but for rows where a kernel of compact support vanishes: there the
   *  affine part alone acts. Fails with KERNEL_FAILED where a caller's kernel gave a number that is not finite, and with
   *  INVALID_OPTION where kernels that change sign cancel each other, so that there is no sum to divide by. */
  template <typename Scalar>
  Result<Done> evaluate(const InteriorSamples& samples,
                        Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> phi) const;

 private:
  const Body* body_;
  Kernel kernel_;
  double spacing_ = 1;  // mean, of the centers
};

}  // namespace handlebody
