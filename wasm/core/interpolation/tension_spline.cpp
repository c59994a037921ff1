#include "core/interpolation/tension_spline.hpp"

namespace handlebody {

Result<Rbf> tension_spline(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                           const TensionSplineOptions& options) {
  auto kernel = TensionKernel::create(options.alpha, options.beta, options.gamma, points.cols());
  if (!kernel) return kernel.error();
  RbfOptions fit;
  fit.basis.kernel.kind = KernelKind::tension;
  fit.basis.kernel.tension = *kernel;
  fit.basis.degree = kernel->minimum_degree();
  fit.smoothing = options.smoothing;
  return Rbf::create(points, values, fit);
}

}  // namespace handlebody
