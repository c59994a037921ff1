// Finding bad data (2014 course, §5.3): points that an interpolant, which can pass through anything, has to bend for.
#pragma once

#include <cstdint>
#include <vector>

#include "core/interpolation/rbf.hpp"

namespace handlebody {

/** How a point's score is computed from the coefficients c of the interpolant of the points still in. All are lengths in units of
 * the values or of the function norm √(cᵀRc), summed over the outputs as squares. Indices are part of the C interface. */
enum class OutlierMethod : unsigned {
  row_sum = 0,  // √ of the point's part of cᵀRc: its row, with half the diagonal (course §5.3); negative where that part is < 0
  leave_one_out = 1,  // √ of what cᵀRc loses when the point is left out, cᵢ²/(A⁻¹)ᵢᵢ: exact, without refitting
  residual = 2,       // distance of the value from the smoothed interpolant: the course's simpler idea
};
constexpr unsigned outlier_method_count = 3;

struct OutlierOptions {
  OutlierMethod method = OutlierMethod::residual;
  double threshold = 8;  // robust standard deviations (1.4826 · median absolute deviation) above the median score
  Index most = 10;       // outliers to look for
};

struct OutlierReport {
  Vector scores;                        // of all points as given, before any is taken out; 0 for merged twins
  std::vector<std::uint32_t> outliers;  // points as given, in the order in which they were found
  std::vector<double> outlier_scores;   // the score of each when it was found, in robust standard deviations above the median
  double smoothing = 0;                 // that was used
};

/** Scores all points, takes out the highest one where it is above the threshold, fits again without it, and so on. `rbf.smoothing`
 * < 0 chooses ½ for kernels with a width and spacingᵉ for homogeneous ones, rᵉ (course §5.3: "regularizing the inverse" keeps an
 * ill-conditioned fit from choosing wrongly). Fails as Rbf::create() does, and with INVALID_OPTION for a threshold that is not
 * positive, for given centers, and for normalized kernels. O(n³) per outlier.
 *
 *  On 12 points of a smooth curve with one moved by 2.5, cubic kernel, the moved one scores 17 to 51 robust deviations by the
 *  residual and 15 to 27 by leave-one-out, while the highest of the clean curve is at 1.7 and 6.9 (its end, where leaving out
 *  extrapolates): hence the threshold. By row sums it stands out less (a threshold of 2 is about right); of three places, they
 *  named the moved point in two, and a neighbor in the third. */
Result<OutlierReport> find_outliers(const Eigen::Ref<const Matrix>& points, const Eigen::Ref<const Matrix>& values,
                                    const RbfOptions& rbf, const OutlierOptions& options);

}  // namespace handlebody
