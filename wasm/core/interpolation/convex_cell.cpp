#include "core/interpolation/convex_cell.hpp"

#include <algorithm>
#include <cmath>

namespace handlebody {
namespace {

constexpr double rounding = 1e-15;

using Side = ConvexCell::Side;

/** Where the line of `a` meets that of `b`, somewhere between `from` and `to`. Found along `a` from its point nearest to the
 * origin: so it is on both lines up to rounding even where they are almost parallel, and only its place along them is uncertain. */
void cross(const Side& a, const Side& b, const Side& from, const Side& to, double* at) {
  const double cosine = a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1];
  const double sine = a.normal[0] * b.normal[1] - a.normal[1] * b.normal[0];
  const double along = (b.offset - a.offset * cosine) / sine;
  const double x = a.offset * a.normal[0] - along * a.normal[1];
  const double y = a.offset * a.normal[1] + along * a.normal[0];
  const double behind = (x - from.vertex[0]) * (x - to.vertex[0]) + (y - from.vertex[1]) * (y - to.vertex[1]);
  const Side& end = std::abs(from.excess) < std::abs(to.excess) ? from : to;
  // If rounding puts it elsewhere, the lines coincide as far as doubles can tell, and an end is as good.
  const bool between = behind <= 0 && end.excess != 0;
  at[0] = between ? x : end.vertex[0];
  at[1] = between ? y : end.vertex[1];
}

}  // namespace

ConvexCell::ConvexCell(Index capacity) : sides_(capacity), spare_(sides_.size()) {}

void ConvexCell::start(double half) {
  count_ = 4;
  sides_[0] = {{1, 0}, half, box, {half, half}, 0};
  sides_[1] = {{0, 1}, half, box, {-half, half}, 0};
  sides_[2] = {{-1, 0}, half, box, {-half, -half}, 0};
  sides_[3] = {{0, -1}, half, box, {half, -half}, 0};
}

void ConvexCell::copy(const ConvexCell& other) {
  count_ = other.count_;
  std::copy(other.sides_.data(), other.sides_.data() + count_, sides_.data());
}

void ConvexCell::cut(double normal_x, double normal_y, double offset, Index owner, Index meeting) {
  Index farthest = 0;
  for (Index k = 0; k < count_; ++k) {
    Side& s = sides_[k];
    const double x = s.vertex[0], y = s.vertex[1];
    s.excess = normal_x * x + normal_y * y - offset - rounding * (std::abs(x) + std::abs(y) + std::abs(offset));
    const Index a = s.owner, b = after(k).owner;
    if ((a == owner && b == meeting) || (a == meeting && b == owner)) s.excess = 0;
    if (s.excess > side(farthest).excess) farthest = k;
  }
  if (count_ == 0 || !(side(farthest).excess > 0)) return;

  // The vertices beyond the line are neighbors of the farthest one: `first` to `last`, which may wrap around the list's end.
  Index beyond = 1, first = farthest, last = farthest;
  for (; beyond < count_ && before(first).excess > 0; ++beyond) first = first > 0 ? first - 1 : count_ - 1;
  for (; beyond < count_ && after(last).excess > 0; ++beyond) last = last + 1 < count_ ? last + 1 : 0;
  if (beyond == count_) {
    count_ = 0;
    return;
  }

  // The sides between them are removed; the new one takes their place, at the end of the list.
  Side line{{normal_x, normal_y}, offset, owner, {0, 0}, 0};
  cross(after(last), line, side(last), after(last), line.vertex);
  const Index left = count_ - beyond + 1;
  for (Index k = 0, from = last; k < left; ++k) {
    from = from + 1 < count_ ? from + 1 : 0;
    spare_[k] = side(from);
  }
  cross(side(first), line, before(first), side(first), spare_[left - 1].vertex);
  spare_[left] = line;
  sides_.swap(spare_);
  count_ = left + 1;
}

double ConvexCell::area() const {
  double twice = 0;
  for (Index k = 0; k < count_; ++k) {
    const double *a = side(k).vertex, *b = after(k).vertex;
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return std::max(twice / 2, 0.0);
}

double ConvexCell::reach() const {
  double largest = 0;
  for (Index k = 0; k < count_; ++k) {
    const double *v = side(k).vertex, squared = v[0] * v[0] + v[1] * v[1];
    largest = std::max(largest, squared);
  }
  return largest;
}

}  // namespace handlebody
