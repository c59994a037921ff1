#include "core/interpolation/outliers.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

using namespace handlebody;

namespace {

constexpr OutlierMethod outlier_methods[] = {OutlierMethod::row_sum, OutlierMethod::leave_one_out, OutlierMethod::residual};

struct Curve {
  Matrix points{12, 1}, values{12, 1};
};

/** Twelve points of a smooth curve. */
Curve smooth_curve() {
  Curve curve;
  for (Index i = 0; i < 12; ++i) {
    curve.points(i, 0) = static_cast<double>(i);
    curve.values(i, 0) = std::sin(0.6 * static_cast<double>(i));
  }
  return curve;
}

RbfOptions outlier_rbf(KernelKind kind, double width, double smoothing) {
  RbfOptions options;
  options.basis.kernel = Kernel::of(kind, width, 1);
  options.basis.degree = options.basis.kernel.minimum_degree();
  options.smoothing = smoothing;
  return options;
}

/** Gaussians without a tail: everything about them follows from one matrix. */
struct GaussianFit {
  MatrixXd kernel, inverse, coefficients;

  GaussianFit(const Matrix& points, const Matrix& values, double width, double smoothing) {
    const Index n = points.rows();
    kernel.resize(n, n);
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) kernel(i, j) = std::exp(-(points.row(i) - points.row(j)).squaredNorm() / (width * width));
    inverse = (kernel + smoothing * MatrixXd::Identity(n, n)).inverse();
    coefficients = inverse * values;
  }

  double norm_squared(const Matrix& values) const { return (values.transpose() * coefficients).trace(); }
};

}  // namespace

TEST_CASE("outlier scores are what they are said to be, from the dense matrix of Gaussians (seed 121)") {
  constexpr double width = 1.5, smoothing = 0.1;
  std::mt19937 random(121);
  std::normal_distribution<double> normal;
  const Index n = 15;
  const Matrix points = Matrix::NullaryExpr(n, 2, [&] { return 2 * normal(random); });
  const Matrix values = Matrix::NullaryExpr(n, 3, [&] { return normal(random); });
  const GaussianFit whole(points, values, width, smoothing);
  OutlierOptions options;
  options.threshold = 1e9;
  for (const OutlierMethod method : outlier_methods) {
    options.method = method;
    const auto report = find_outliers(points, values, outlier_rbf(KernelKind::gaussian, width, smoothing), options);
    REQUIRE(report);
    CHECK(report->outliers.empty());
    CHECK(report->smoothing == smoothing);
    REQUIRE(report->scores.size() == n);
    for (Index i = 0; i < n; ++i) {
      CAPTURE(i);
      double expected = 0;
      if (method == OutlierMethod::residual) {
        expected = (values - whole.kernel * whole.coefficients).row(i).norm();
      } else if (method == OutlierMethod::row_sum) {
        const Eigen::RowVectorXd row =
            whole.kernel.row(i) * whole.coefficients - whole.kernel(i, i) / 2 * whole.coefficients.row(i);
        const double part = row.dot(whole.coefficients.row(i));
        expected = part < 0 ? -std::sqrt(-part) : std::sqrt(part);
      } else {  // fitted again without the point
        Matrix fewer(n - 1, 2), rest(n - 1, 3);
        for (Index k = 0; k + 1 < n; ++k) {
          fewer.row(k) = points.row(k < i ? k : k + 1);
          rest.row(k) = values.row(k < i ? k : k + 1);
        }
        expected = std::sqrt(whole.norm_squared(values) - GaussianFit(fewer, rest, width, smoothing).norm_squared(rest));
      }
      CHECK(report->scores[i] == doctest::Approx(expected).epsilon(1e-8));
    }
  }
}

TEST_CASE("a clean curve has no outliers; a point that is moved off it is named, wherever it is") {
  for (const OutlierMethod method : {OutlierMethod::leave_one_out, OutlierMethod::residual}) {
    OutlierOptions options;
    options.method = method;
    options.most = 1;  // without it the curve's end may stand out in its turn
    const Curve clean = smooth_curve();
    const auto none = find_outliers(clean.points, clean.values, outlier_rbf(KernelKind::cubic, 1, -1), options);
    REQUIRE(none);
    CHECK(none->outliers.empty());
    CHECK(none->smoothing == doctest::Approx(1));  // the spacing cubed
    for (const Index moved : {1, 4, 7, 10}) {
      CAPTURE(moved);
      Curve curve = clean;
      curve.values(moved, 0) += 2.5;
      const auto report = find_outliers(curve.points, curve.values, outlier_rbf(KernelKind::cubic, 1, -1), options);
      REQUIRE(report);
      REQUIRE(report->outliers == std::vector<std::uint32_t>{static_cast<std::uint32_t>(moved)});
      CHECK(report->outlier_scores.at(0) > 12);
      Index highest = -1;
      report->scores.maxCoeff(&highest);
      CHECK(highest == moved);
    }
  }
}

TEST_CASE(
    "outliers come one after the other, the worst first, as many as are asked for at most; the order of the points does not matter "
    "(seed 122)") {
  Curve curve = smooth_curve();
  curve.values(2, 0) += 2.5;
  curve.values(9, 0) -= 6;
  const auto found = [&](Index most) {
    OutlierOptions options;
    options.most = most;
    options.threshold = 3;  // the two hide each other a little
    const auto report = find_outliers(curve.points, curve.values, outlier_rbf(KernelKind::cubic, 1, -1), options);
    REQUIRE(report);
    CHECK(report->outlier_scores.size() == report->outliers.size());
    return report->outliers;
  };
  CHECK(found(10) == std::vector<std::uint32_t>{9, 2});
  CHECK(found(1) == std::vector<std::uint32_t>{9});
  CHECK(found(0).empty());

  std::vector<std::uint32_t> order{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  std::mt19937 random(122);
  std::shuffle(order.begin(), order.end(), random);
  const Curve given = curve;
  for (Index i = 0; i < 12; ++i) {
    curve.points.row(i) = given.points.row(order[i]);
    curve.values.row(i) = given.values.row(order[i]);
  }
  const auto shuffled = found(10);
  REQUIRE(shuffled.size() == 2);
  CHECK(order[shuffled[0]] == 9);
  CHECK(order[shuffled[1]] == 2);
}

TEST_CASE("a twin of another point has the score 0, and indices are those of the points as given") {
  const Curve curve = smooth_curve();
  Matrix points(13, 1), values(13, 1);
  points << curve.points(3, 0), curve.points;  // the fifth is the first's twin
  values << curve.values(3, 0), curve.values;
  values(8, 0) += 4;
  const auto report = find_outliers(points, values, outlier_rbf(KernelKind::cubic, 1, -1), {});
  REQUIRE(report);
  CHECK(report->scores[4] == 0);
  CHECK(report->scores[0] != 0);
  CHECK(report->outliers == std::vector<std::uint32_t>{8});
}

TEST_CASE("kernels with a width are smoothed by one half of themselves where nothing is said") {
  const Curve curve = smooth_curve();
  const auto report = find_outliers(curve.points, curve.values, outlier_rbf(KernelKind::gaussian, 2, -1), {});
  REQUIRE(report);
  CHECK(report->smoothing == 0.5);
  const auto same = find_outliers(curve.points, curve.values, outlier_rbf(KernelKind::gaussian, 2, 0.5), {});
  REQUIRE(same);
  CHECK((report->scores - same->scores).norm() < 1e-12);
}

TEST_CASE("options that outliers cannot be found with are named, and bad data as elsewhere") {
  const Curve curve = smooth_curve();
  const auto refused = [&](const Curve& data, const RbfOptions& rbf, double threshold) {
    OutlierOptions options;
    options.threshold = threshold;
    const auto report = find_outliers(data.points, data.values, rbf, options);
    REQUIRE_FALSE(report);
    CHECK(!report.error().remedy.empty());
    return report.error().code;
  };
  const RbfOptions good = outlier_rbf(KernelKind::cubic, 1, -1);
  for (const double threshold : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    CHECK(refused(curve, good, threshold) == HB_ERROR_INVALID_OPTION);
  RbfOptions bad = good;
  bad.centers = curve.points.topRows(3);
  CHECK(refused(curve, bad, 8) == HB_ERROR_INVALID_OPTION);
  bad = good;
  bad.weight_decay = 1;
  CHECK(refused(curve, bad, 8) == HB_ERROR_INVALID_OPTION);
  bad = outlier_rbf(KernelKind::gaussian, 2, -1);
  bad.basis.normalized = true;
  CHECK(refused(curve, bad, 8) == HB_ERROR_INVALID_OPTION);
  Curve broken = curve;
  broken.values(3, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK(refused(broken, good, 8) == HB_ERROR_VALUE_NOT_FINITE);
}
