#include "core/posespace/pose_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/safe_norm.hpp"

namespace handlebody {

namespace {

constexpr double reach = 1000;  // diagonals
constexpr double largest_cardinal_error = 1e-6;

/** Width as a part of the distance to the nearest neighbor: see PoseSpaceOptions. */
double automatic_width(KernelKind kind) {
  switch (kind) {
    case KernelKind::multiquadric:
      return 0.5;
    case KernelKind::gaussian:
      return 0.75;
    default:
      return 1;
  }
}

// Halving first, since the extent of huge coordinates may overflow.
double diagonal_of(const Eigen::Ref<const Matrix>& places) {
  const Vector half = places.colwise().maxCoeff() / 2 - places.colwise().minCoeff() / 2;
  return 2 * safe_norm(half);
}

/** Distance of every place to its nearest neighbor, or EXAMPLE_DUPLICATE. */
Result<Vector> spacing_of(const Matrix& places) {
  const Index count = places.rows();
  const Vector tolerances = place_tolerances(places);
  Vector spacing = Vector::Constant(count, std::numeric_limits<double>::infinity());
  Vector apart(places.cols());
  for (Index i = 1; i < count; ++i) {
    for (Index j = 0; j < i; ++j) {
      apart = places.row(i) - places.row(j);
      const double distance = safe_norm(apart);
      if (at_one_place(&places(i, 0), &places(j, 0), tolerances))
        return Error(HB_ERROR_EXAMPLE_DUPLICATE, {"Example ", i, " is at the same place as example ", j, "."},
                     {"Move one of the two, or remove it."}, HB_CULPRIT_EXAMPLE, i);
      spacing[i] = std::min(spacing[i], distance);
      spacing[j] = std::min(spacing[j], distance);
    }
  }
  return spacing;
}

/** Errors of scattered interpolation speak of points; here these are examples. */
Error as_examples(const Error& error) {
  const auto with = [&](hb_status code) {
    return Error(code, {error.message.c_str()}, {error.remedy.c_str()},
                 error.culprit == HB_CULPRIT_POINT ? HB_CULPRIT_EXAMPLE : error.culprit, error.index);
  };
  switch (error.code) {
    case HB_ERROR_POINTS_TOO_FEW:
      return with(HB_ERROR_EXAMPLES_TOO_FEW);
    case HB_ERROR_POINTS_DEGENERATE:
    case HB_ERROR_SYSTEM_SINGULAR:
      return with(HB_ERROR_EXAMPLES_DEGENERATE);
    default:
      return with(error.code);
  }
}

/** Equations that are singular in double precision still give some answer, so the cardinal property itself is tested: weight 1 at
 * an example's own place, 0 at the others'. */
Result<Done> check_cardinal(Rbf& rbf, const Matrix& places) {
  Vector weights(places.rows()), place(places.cols());
  for (Index i = 0; i < places.rows(); ++i) {
    place = places.row(i).transpose();
    rbf.weights(place.data(), weights.data());
    weights[i] -= 1;
    const double error = weights.lpNorm<Eigen::Infinity>();
    if (!(error <= largest_cardinal_error))
      return Error(HB_ERROR_EXAMPLES_DEGENERATE,
                   {"The interpolation system is singular in double precision (condition number ", rbf.fit().condition(),
                    "); it misses example ", i, " by ", error, "."},
                   {"Move examples apart that almost coincide."}, HB_CULPRIT_EXAMPLE, i);
  }
  return Done{};
}

}  // namespace

Result<PoseSpace> PoseSpace::create(const Eigen::Ref<const Matrix>& places, const PoseSpaceOptions& options) {
  auto made = attempt(places, options);
  if (made || made.error().code != HB_ERROR_EXAMPLES_DEGENERATE) return made;
  // What would do is found by trying it.
  const Error& error = made.error();
  const auto advise = [&](const char* remedy) {
    return Error(error.code, {error.message.c_str()}, {remedy}, error.culprit, error.index);
  };
  PoseSpaceOptions other = options;
  other.width = 0;
  if (options.width > 0 && attempt(places, other)) return advise("Leave out the width.");
  other = PoseSpaceOptions{};
  if (attempt(places, other)) return advise("Leave out kernel, method, width and degree.");
  return made;
}

Result<PoseSpace> PoseSpace::attempt(const Eigen::Ref<const Matrix>& given, const PoseSpaceOptions& options) {
  const Index count = given.rows();
  if (count == 0 || given.cols() == 0)
    return Error(HB_ERROR_EXAMPLES_TOO_FEW, {"A pose space needs at least one example."},
                 {"Give one or more examples with a place."});
  for (Index i = 0; i < count; ++i)
    if (!given.row(i).allFinite())
      return Error(HB_ERROR_EXAMPLE_NOT_FINITE, {"The place of example ", i, " is not finite."},
                   {"Remove NaN and infinite coordinates."}, HB_CULPRIT_EXAMPLE, i);
  if (!(options.width >= 0) || !std::isfinite(options.width))
    return Error(HB_ERROR_INVALID_OPTION, {"The width is not a positive finite number."},
                 {"Give it in units of the places, or leave it out to have it chosen."}, HB_CULPRIT_OPTION, -1);
  auto measures = comparable_axes(given);
  if (!measures) return as_examples(measures.error());
  const Matrix places = measured(given, *measures);
  const bool normalized = options.method == PoseSpaceMethod::normalized;
  const Kernel kernel{options.kernel, options.width > 0 ? options.width : 1};
  if (options.degree < (normalized ? -1 : 0) || options.degree > 1)
    return Error(
        HB_ERROR_INVALID_OPTION, {"The degree is not 0 or 1."},
        {kernel.minimum_degree() > 0 ? "Use degree 1." : "Use degree 0, or 1 for weights that reproduce linear functions."},
        HB_CULPRIT_OPTION, -1);
  if (normalized && kernel.vanishes_at_center())
    return Error(HB_ERROR_INVALID_OPTION, {"This kernel is zero at its own place and cannot be normalized."},
                 {"Use gaussian, multiquadric, inverse-multiquadric or inverse-quadratic, or leave out the method and the degree."},
                 HB_CULPRIT_OPTION, -1);

  RbfOptions rbf;
  rbf.advised = false;
  rbf.basis.kernel = kernel;
  rbf.basis.degree = options.degree;
  rbf.basis.normalized = normalized;
  if (count == 1) {
    // The only answer is the constant 1, which some kernels and degrees would leave undetermined or refuse.
    rbf.basis.kernel = {KernelKind::multiquadric, 1};
    rbf.basis.degree = 0;
    rbf.basis.normalized = false;
  } else {
    auto spacing = spacing_of(places);
    if (!spacing) return spacing.error();
    if (options.width == 0 && spacing->allFinite() && rbf.basis.kernel.has_width())
      rbf.basis.widths = automatic_width(options.kernel) * *spacing;
  }
  auto interpolant = Rbf::create(places, Matrix::Zero(count, 1), rbf);
  if (!interpolant) return as_examples(interpolant.error());
  if (auto cardinal = check_cardinal(*interpolant, places); !cardinal) return cardinal.error();
  return PoseSpace(std::move(*interpolant), places, std::move(*measures));
}

PoseSpace::PoseSpace(Rbf rbf, const Matrix& places, Vector measures)
    : rbf_(std::move(rbf)),
      measures_(std::move(measures)),
      center_(places.colwise().maxCoeff() / 2 + places.colwise().minCoeff() / 2),
      reach_(reach * std::max(diagonal_of(places), std::numeric_limits<double>::min())),
      query_(places.cols()),
      offset_(places.cols()) {}

Result<Done> PoseSpace::weights(const Eigen::Ref<const Vector>& query, Eigen::Ref<Vector> out) {
  for (Index k = 0; k < query.size(); ++k)
    if (!std::isfinite(query[k]))
      return Error(HB_ERROR_QUERY_NOT_FINITE, {"Coordinate ", k, " of the query is not finite."},
                   {"Ask for weights at finite coordinates."});
  query_ = query;
  for (Index k = 0; k < measures_.size(); ++k) query_[k] = std::clamp(query_[k] * measures_[k], -1e300, 1e300);
  offset_ = query_ / 2 - center_ / 2;
  const double half_distance = safe_norm(offset_);
  if (half_distance > reach_ / 2) query_ = center_ + offset_ * (reach_ / half_distance);
  rbf_.weights(query_.data(), out.data());
  return Done{};
}

}  // namespace handlebody
