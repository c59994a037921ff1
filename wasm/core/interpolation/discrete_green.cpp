#include "core/interpolation/discrete_green.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/decompositions.hpp"
#include "core/numerics/indices.hpp"
#include "core/numerics/products.hpp"

namespace handlebody {
namespace {

constexpr Index largest_size = 1024;

/** First differences of `rows`: between neighbors only, with zeros beyond both ends (`outer`), or around a circle. */
Matrix differences(const Matrix& rows, bool outer, bool cyclic, bool backward) {
  const Index given = rows.rows(),
              count = cyclic  ? given
                      : outer ? given + 1
                              : given - 1,
              shift = outer || (cyclic && backward) ? 1 : 0;
  Matrix out = Matrix::Zero(count, rows.cols());
  for (Index i = 0; i < count; ++i)
    for (const Index sign : {1, -1}) {
      Index from = i - shift + (sign > 0 ? 1 : 0);
      if (cyclic) from = (from + given) % given;
      if (from >= 0 && from < given) out.row(i) += static_cast<double>(sign) * rows.row(from);
    }
  return out;
}

/** D: differences of differences. For Dirichlet and Neumann, D₁ and −D₁ᵀ alternate, from samples to gaps and back. */
Matrix difference_matrix(Index size, int order, GridBoundary boundary) {
  Matrix d = Matrix::Identity(size, size);
  for (int step = 0; step < order; ++step) {
    const bool even = step % 2 == 0;
    const bool outer = boundary == GridBoundary::dirichlet ? even : boundary == GridBoundary::neumann && !even;
    d = differences(d, outer, boundary == GridBoundary::periodic, !even);
  }
  return d;
}

/** Orthonormal columns 1, t, t² … of the centered grid. */
Matrix null_space(Index size, Index columns) {
  Matrix basis(size, columns);
  const double count = static_cast<double>(size), mean_square = (count * count - 1) / 12;
  for (Index i = 0; i < size; ++i) {
    const double t = static_cast<double>(i) - (count - 1) / 2;
    const double row[] = {1, t, t * t - mean_square};
    for (Index a = 0; a < columns; ++a) basis(i, a) = row[a];
  }
  for (Index a = 0; a < columns; ++a) basis.col(a).normalize();
  return basis;
}

/** Free ends: the kernel of m = |i − j| without its part in the null space, (I − N Nᵀ) K (I − N Nᵀ). */
MatrixXd free_green(int order, const MatrixXd& n) {
  const MatrixXd k = MatrixXd::NullaryExpr(n.rows(), n.rows(), [order](Index i, Index j) {
    const auto m = static_cast<double>(std::abs(i - j));
    return order == 1 ? -m / 2 : order == 2 ? m * (m * m - 1) / 12 : -m * (m * m - 1) * (m * m - 4) / 240;
  });
  // Both sides at once: K − N Wᵀ − W Nᵀ with W = KN − ½ N (NᵀKN)
  const MatrixXd image = product(k, n), w = image - product(n, transposed_product(n, image) / 2),
                 one_side = product(n, w.transpose());
  return k - (one_side + one_side.transpose());
}

void remove_mean(Eigen::Ref<Vector> x) {
  x.array() -= x.mean();
}

/** x ← (D₁ᵀD₁)⁻¹ x, or the generalized inverse: the slope falls by x from gap to gap; its first value follows from the boundary. */
void integrate_twice(Eigen::Ref<Vector> x, GridBoundary boundary) {
  const Index size = x.size();
  const bool dirichlet = boundary == GridBoundary::dirichlet;
  if (!dirichlet) remove_mean(x);
  double fallen = 0, sum = 0;
  for (Index i = 0; i < size; ++i) sum += fallen += x[i];
  double slope = 0;
  if (dirichlet) slope = sum / static_cast<double>(size + 1);                       // so that f is 0 one step beyond the end
  if (boundary == GridBoundary::periodic) slope = sum / static_cast<double>(size);  // or back at its first value
  double f = dirichlet ? slope : 0;
  for (Index i = 0; i < size; ++i) {
    slope -= x[i];
    x[i] = f;
    f += slope;
  }
  if (!dirichlet) remove_mean(x);
}

MatrixXd green_matrix(int order, GridBoundary boundary, const MatrixXd& basis) {
  if (boundary == GridBoundary::free) return free_green(order, basis);
  MatrixXd green = MatrixXd::Identity(basis.rows(), basis.rows());
  for (Index j = 0; j < green.cols(); ++j)
    for (int step = 0; step < order; ++step) integrate_twice(green.col(j), boundary);
  return green;
}

}  // namespace

Result<DiscreteGreen> DiscreteGreen::create(Index size, int order, GridBoundary boundary, const std::uint32_t* samples,
                                            const double* values, Index count) {
  if (order < 1 || order > 3)
    return Error(HB_ERROR_INVALID_OPTION, {"The order ", order, " of the differences is not 1, 2 or 3."}, {"Use 1, 2 or 3."},
                 HB_CULPRIT_OPTION);
  if (size <= order || size > largest_size)
    return Error(HB_ERROR_INVALID_OPTION, {"A grid of ", size, " samples is not supported with differences of order ", order, "."},
                 {"Use ", order + 1, " to ", largest_size, " samples."}, HB_CULPRIT_OPTION);
  const Index nullity = boundary == GridBoundary::free ? order : boundary == GridBoundary::dirichlet ? 0 : 1;
  if (count < std::max<Index>(nullity, 1))
    return Error(HB_ERROR_POINTS_TOO_FEW,
                 {count, count == 1 ? " sample does" : " samples do", " not determine the part of the curve that D cannot see, of ",
                  nullity, nullity == 1 ? " dimension." : " dimensions."},
                 {"Give at least ", std::max<Index>(nullity, 1), nullity > 1 ? " samples." : "."});
  std::vector<Index> given(size, -1);
  for (Index k = 0; k < count; ++k) {
    if (!in_range(samples[k], size))
      return Error(HB_ERROR_INVALID_OPTION, {"Sample ", k, " is at ", samples[k], ", outside the grid."},
                   {"Use 0 to ", size - 1, "."}, HB_CULPRIT_POINT, k);
    if (!std::isfinite(values[k]))
      return Error(HB_ERROR_VALUE_NOT_FINITE, {"The value of sample ", k, " is ", values[k], "."},
                   {"Remove NaN and infinite values."}, HB_CULPRIT_POINT, k);
    Index& first = given[samples[k]];
    if (first >= 0)
      return Error(HB_ERROR_POINT_DUPLICATE, {"Sample ", k, " is at ", samples[k], ", as sample ", first, " is."},
                   {"Give each place of the grid once."}, HB_CULPRIT_POINT, k);
    first = k;
  }

  DiscreteGreen made;
  made.samples_.assign(samples, samples + count);
  made.values_.resize(count);
  std::copy(values, values + count, made.values_.data());
  made.difference_ = difference_matrix(size, order, boundary);
  made.null_space_ = handlebody::null_space(size, nullity);
  made.green_ = green_matrix(order, boundary, made.null_space_);
  return made;
}

Matrix DiscreteGreen::squared() const {
  // Row by row, since D is banded: Eigen's product would multiply zeros, N³ of them.
  Matrix out = Matrix::Zero(size(), size());
  for (Index row = 0; row < difference_.rows(); ++row)
    for (Index i = 0; i < size(); ++i)
      if (difference_(row, i) != 0) out.row(i) += difference_(row, i) * difference_.row(row);
  return out;
}

void DiscreteGreen::solve_grid(double* f) const {
  std::vector<Index> number(size(), 0), place;
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    number[samples_[k]] = -1;
    f[samples_[k]] = values_[static_cast<Index>(k)];
  }
  for (Index i = 0; i < size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = std::ssize(place);
    place.push_back(i);
  }
  const auto unknowns = std::ssize(place);

  // R, its right-hand side in the last column, from the rows of D one by one: a row starts in the last row of r, and rotations with
  // rows of R reduce it, or it becomes one. So a band stays a band; Eigen's dense factorizations would take O(N³).
  Matrix r = Matrix::Zero(unknowns + 1, unknowns + 1);
  std::vector<Index> end(place.size(), 0);  // of each row of R: 0 where there is none yet
  auto row = r.row(unknowns);
  for (Index equation = 0; equation < difference_.rows(); ++equation) {
    row.setZero();
    Index first = unknowns, last = 0;
    for (Index i = 0; i < size(); ++i) {
      const Index j = number[i];
      const double factor = difference_(equation, i);
      if (factor == 0) continue;
      if (j < 0) {
        row[unknowns] -= factor * f[i];
        continue;
      }
      row[j] = factor;
      first = std::min(first, j);
      last = j + 1;
    }
    for (Index c = first; c < last; ++c) {
      if (row[c] == 0) continue;
      Index& reach = end[c];
      if (reach == 0) {
        r.row(c) = row;
        reach = last;
        break;
      }
      last = reach = std::max(last, reach);
      Eigen::JacobiRotation<double> rotation;
      rotation.makeGivens(r(c, c), row[c]);
      r.middleCols(c, last - c).applyOnTheLeft(c, unknowns, rotation.adjoint());
      r.col(unknowns).applyOnTheLeft(c, unknowns, rotation.adjoint());
    }
  }
  for (Index c = unknowns; c-- > 0;) {
    double rest = r(c, unknowns);
    for (Index j = c + 1; j < end[c]; ++j) rest -= r(c, j) * f[place[j]];
    f[place[c]] = rest / r(c, c);
  }
}

void DiscreteGreen::solve_radial(double* f, double* weights) const {
  const Index count = values_.size(), columns = null_space_.cols();
  // λ in units of 1/G and N of order 1, so that pivots are comparable.
  const double largest = std::max(green_.diagonal().maxCoeff(), 0.0), scale = std::sqrt(static_cast<double>(size()));
  MatrixXd green(size(), count), system = MatrixXd::Zero(count + columns, count + columns);
  for (Index k = 0; k < count; ++k) {
    const Index place = samples_[k];
    green.col(k) = green_.row(place).transpose();  // G is symmetric
    for (Index l = 0; l < count; ++l) system(l, k) = green(samples_[l], k) / largest;
    for (Index a = 0; a < columns; ++a) system(k, count + a) = system(count + a, k) = scale * null_space_(place, a);
  }
  Vector solution = Vector::Zero(count + columns);
  solution.head(count) = values_;
  solution = Lu(std::move(system)).solve(solution);
  solution.head(count) /= largest;
  solution.tail(columns) *= scale;
  if (weights) std::copy(solution.begin(), solution.end(), weights);
  Eigen::Map<Vector>(f, size()) = product(green, solution.head(count)) + product(null_space_, solution.tail(columns));
}

}  // namespace handlebody
