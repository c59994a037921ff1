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
  auto spline = Rbf::create(points, values, fit);
  if (spline || fit.basis.degree < 1) return spline;
  const Error& error = spline.error();
  if (error.code != HB_ERROR_POINTS_DEGENERATE && (error.code != HB_ERROR_POINTS_TOO_FEW || points.rows() == 0)) return spline;
  return Error(error.code, {error.message.c_str()}, {"Give a positive beta or gamma, or points that span all dimensions."});
}

}  // namespace handlebody
