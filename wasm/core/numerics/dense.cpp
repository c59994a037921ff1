// Compiled with -O3: see CMakeLists.txt.
#include "core/numerics/dense.hpp"

#include <algorithm>
#include <cmath>

namespace handlebody {
namespace {

/** y += sign · Σ x[k·step] · columns.col(k), four columns a pass over y. */
void add_columns(double* __restrict y, Index rows, const double* __restrict columns, Index stride, const double* __restrict x,
                 Index step, Index count, double sign) {
  Index k = 0;
  for (; k + 4 <= count; k += 4, columns += 4 * stride, x += 4 * step) {
    const double *c0 = columns, *c1 = c0 + stride, *c2 = c1 + stride, *c3 = c2 + stride;
    const double x0 = sign * x[0], x1 = sign * x[step], x2 = sign * x[2 * step], x3 = sign * x[3 * step];
    for (Index i = 0; i < rows; ++i) y[i] += (x0 * c0[i] + x1 * c1[i]) + (x2 * c2[i] + x3 * c3[i]);
  }
  for (; k < count; ++k, columns += stride, x += step) {
    const double x0 = sign * x[0];
    for (Index i = 0; i < rows; ++i) y[i] += x0 * columns[i];
  }
}

/** Two numbers anywhere in memory: sums of products are not vectorized by themselves, since that changes their order. */
using Pair = double __attribute__((vector_size(16)));
using Unaligned = double __attribute__((vector_size(16), aligned(8), may_alias));
inline Pair load(const double* from) {
  return *reinterpret_cast<const Unaligned*>(from);
}
inline void store(Pair pair, double* to) {
  *reinterpret_cast<Unaligned*>(to) = pair;
}

}  // namespace

void multiply(const MatrixXd& a, const Columns3& x, Columns3& out) {
  out.setZero();
  const Index rows = a.rows(), count = a.cols();
  double* __restrict ox = out.data();
  double* __restrict oy = ox + rows;
  double* __restrict oz = oy + rows;
  // One pass over the matrix, which is what takes the time, serves all three.
  Index k = 0;
  for (; k + 4 <= count; k += 4) {
    const double *c0 = &a(0, k), *c1 = c0 + rows, *c2 = c1 + rows, *c3 = c2 + rows;
    const double x0 = x(k, 0), x1 = x(k + 1, 0), x2 = x(k + 2, 0), x3 = x(k + 3, 0);
    const double y0 = x(k, 1), y1 = x(k + 1, 1), y2 = x(k + 2, 1), y3 = x(k + 3, 1);
    const double z0 = x(k, 2), z1 = x(k + 1, 2), z2 = x(k + 2, 2), z3 = x(k + 3, 2);
    for (Index i = 0; i < rows; ++i) {
      const double a0 = c0[i], a1 = c1[i], a2 = c2[i], a3 = c3[i];
      ox[i] += (x0 * a0 + x1 * a1) + (x2 * a2 + x3 * a3);
      oy[i] += (y0 * a0 + y1 * a1) + (y2 * a2 + y3 * a3);
      oz[i] += (z0 * a0 + z1 * a1) + (z2 * a2 + z3 * a3);
    }
  }
  for (; k < count; ++k) {
    const double* c0 = &a(0, k);
    for (Index i = 0; i < rows; ++i) {
      ox[i] += x(k, 0) * c0[i];
      oy[i] += x(k, 1) * c0[i];
      oz[i] += x(k, 2) * c0[i];
    }
  }
}

void multiply_symmetric(const MatrixXd& lower, const Columns3& x, Columns3& out) {
  out.setZero();
  const Index n = lower.rows();
  Index j = 0;
  for (; j + 2 <= n; j += 2) {
    const double *c0 = &lower(0, j), *c1 = c0 + n;
    for (Index axis = 0; axis < 3; ++axis) {
      // Three passes over two columns, which stay in the cache.
      const double* from = x.data() + axis * n;
      double* to = out.data() + axis * n;
      const double x0 = from[j], x1 = from[j + 1];
      const Pair both0{x0, x0}, both1{x1, x1};
      Pair sum0{}, sum1{};
      Index i = j + 2;
      for (; i + 2 <= n; i += 2) {
        const Pair a0 = load(c0 + i), a1 = load(c1 + i), numbers = load(from + i);
        store(load(to + i) + (a0 * both0 + a1 * both1), to + i);
        sum0 += a0 * numbers, sum1 += a1 * numbers;
      }
      double total0 = sum0[0] + sum0[1], total1 = sum1[0] + sum1[1];
      if (i < n) {
        to[i] += c0[i] * x0 + c1[i] * x1;
        total0 += c0[i] * from[i], total1 += c1[i] * from[i];
      }
      to[j] += total0 + c0[j] * x0 + c0[j + 1] * x1;
      to[j + 1] += total1 + c0[j + 1] * x0 + c1[j + 1] * x1;
    }
  }
  for (; j < n; ++j) out.row(j) += lower(j, j) * x.row(j);
}

void solve_cholesky(const MatrixXd& factor, Vector& solution) {
  // Two columns a pass: x is read, or written, half as often.
  const Index n = factor.rows();
  double* x = solution.data();
  Index j = 0;
  for (; j + 2 <= n; j += 2) {
    const double *c0 = &factor(0, j), *c1 = c0 + n;
    const double x0 = x[j] /= c0[j];
    const double x1 = x[j + 1] = (x[j + 1] - x0 * c0[j + 1]) / c1[j + 1];
    for (Index i = j + 2; i < n; ++i) x[i] -= x0 * c0[i] + x1 * c1[i];
  }
  if (j < n) x[j] /= factor(j, j) * factor(j, j);  // the last of an odd number: by L, and by Lᵀ
  for (j -= 2; j >= 0; j -= 2) {
    const double *c0 = &factor(0, j), *c1 = c0 + n;
    Pair sum0{}, sum1{};
    Index i = j + 2;
    for (; i + 2 <= n; i += 2) {
      const Pair numbers = load(x + i);
      sum0 += load(c0 + i) * numbers, sum1 += load(c1 + i) * numbers;
    }
    double total0 = sum0[0] + sum0[1], total1 = sum1[0] + sum1[1];
    if (i < n) total0 += c0[i] * x[i], total1 += c1[i] * x[i];
    x[j + 1] = (x[j + 1] - total1) / c1[j + 1];
    x[j] = (x[j] - total0 - c0[j + 1] * x[j + 1]) / c0[j];
  }
}

void multiply(const MatrixXd& a, const Vector& x, Eigen::Ref<Vector> out) {
  out.setZero();
  add_columns(out.data(), a.rows(), a.data(), a.rows(), x.data(), 1, a.cols(), 1);
}

MatrixXd product(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd out = MatrixXd::Zero(a.rows(), b.cols());
  for (Index j = 0; j < b.cols(); ++j) add_columns(&out(0, j), a.rows(), a.data(), a.rows(), &b(0, j), 1, a.cols(), 1);
  return out;
}

void add_gram(const MatrixXd& b, MatrixXd& a) {
  const MatrixXd transposed = b.transpose();
  const Index n = a.rows();
  for (Index j = 0; j < n; ++j) add_columns(&a(j, j), n - j, &transposed(j, 0), n, &transposed(j, 0), n, b.rows(), 1);
}

bool factor_cholesky(MatrixXd& a) {
  const Index n = a.rows();
  for (Index j = 0; j < n; ++j) {
    add_columns(&a(j, j), n - j, &a(j, 0), n, &a(j, 0), n, j, -1);
    const double pivot = a(j, j);
    if (!(pivot > 0)) return false;
    a.col(j).tail(n - j) /= std::sqrt(pivot);
  }
  return true;
}

void solve_cholesky(const MatrixXd& factor, MatrixXd& b) {
  const Index n = factor.rows(), rows = b.rows();
  for (Index j = 0; j < n; ++j) {  // b ← b L⁻ᵀ
    add_columns(&b(0, j), rows, &b(0, 0), rows, &factor(j, 0), n, j, -1);
    b.col(j) /= factor(j, j);
  }
  for (Index j = n; j-- > 0;) {  // b ← b L⁻¹
    add_columns(&b(0, j), rows, b.data() + rows * (j + 1), rows, factor.data() + n * j + j + 1, 1, n - 1 - j, -1);
    b.col(j) /= factor(j, j);
  }
}

void factor_lu(MatrixXd& a, std::vector<Index>& pivots) {
  constexpr Index width = 16;  // columns a panel
  const Index n = a.rows();
  pivots.resize(n);
  // What the columns from `first` on, factored up to `done`, do to column j.
  const auto eliminate = [&](Index first, Index done, Index j) {
    for (Index k = first; k < done; ++k) add_columns(&a(k, j) + 1, done - 1 - k, &a(k, k) + 1, n, &a(k, j), 1, 1, -1);
    add_columns(a.data() + n * j + done, n - done, a.data() + n * first + done, n, &a(first, j), 1, done - first, -1);
  };
  for (Index first = 0; first < n; first += width) {
    const Index last = std::min(first + width, n);
    for (Index j = first; j < last; ++j) {
      eliminate(first, j, j);
      Index pivot = j;
      for (Index i = j + 1; i < n; ++i) {
        if (std::abs(a(i, j)) > std::abs(a(pivot, j))) pivot = i;
      }
      pivots[j] = pivot;
      for (Index k = 0; k < n; ++k) std::swap(a(j, k), a(pivot, k));
      for (Index i = j + 1; i < n; ++i) a(i, j) /= a(j, j);
    }
    for (Index j = last; j < n; ++j) eliminate(first, last, j);
  }
}

void solve_lu(const MatrixXd& factor, const std::vector<Index>& pivots, MatrixXd& b) {
  const Index n = factor.rows(), rows = b.rows();
  for (Index j = 0; j < n; ++j) {  // b ← b U⁻¹
    add_columns(&b(0, j), rows, b.data(), rows, &factor(0, j), 1, j, -1);
    b.col(j) /= factor(j, j);
  }
  for (Index j = n; j-- > 0;) {  // b ← b L⁻¹
    add_columns(&b(0, j), rows, b.data() + rows * (j + 1), rows, factor.data() + n * j + j + 1, 1, n - 1 - j, -1);
  }
  for (Index j = n; j-- > 0;) b.col(j).swap(b.col(pivots[j]));
}

void solve_lu(const MatrixXd& factor, const std::vector<Index>& pivots, double* x) {
  const Index n = factor.rows();
  for (Index j = 0; j < n; ++j) std::swap(x[j], x[pivots[j]]);
  for (Index j = 0; j < n; ++j) add_columns(x + j + 1, n - 1 - j, factor.data() + n * j + j + 1, n, x + j, 1, 1, -1);
  for (Index j = n; j-- > 0;) {
    x[j] /= factor(j, j);
    add_columns(x, j, factor.data() + n * j, n, x + j, 1, 1, -1);
  }
}

}  // namespace handlebody
