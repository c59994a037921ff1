#include "core/distance/fast_marching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace handlebody {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double ball_radius = 3.5;  // in spacings
constexpr std::int32_t unseen = -1, done = -2;

}  // namespace

FastMarching::FastMarching(const VoxelDomain& domain)
    : domain_(&domain),
      neighbors_(domain.face_neighbors()),
      accepted_(static_cast<std::size_t>(domain.size()) + 1),
      places_(static_cast<std::size_t>(domain.size()) + 1) {
  heap_.reserve(places_.size());
  ball_.reserve(places_.size());
}

double FastMarching::solve(std::int32_t voxel) const {
  const double distance = solve_upwind(voxel);
  const auto none = static_cast<std::int32_t>(accepted_.size() - 1);
  const std::int32_t* sides = &neighbors_[6 * std::size_t(voxel)];
  const bool boundary = std::find(sides, sides + 6, none) != sides + 6;
  return boundary ? solve_simplices(voxel, distance) : distance;
}

/** The upwind update at a voxel, from accepted values only. Along each axis the derivative is one-sided, of second order
 *  (3d − 4a + b)/2h where the next voxel b is accepted too and not above a (Sethian 1999, §8.4), else (d − a)/h: in both cases
 *  s·(d − t)/h, with s = 3/2, t = (4a − b)/3 or s = 1, t = a. */
double FastMarching::solve_upwind(std::int32_t voxel) const {
  struct Term {
    double value, t, s2;
  };
  Term terms[3];
  int count = 0;
  const std::int32_t* sides = &neighbors_[6 * std::size_t(voxel)];
  for (int axis = 0; axis < 3; ++axis) {
    const std::int32_t low = sides[2 * axis], high = sides[2 * axis + 1];
    const int side = accepted_[low] <= accepted_[high] ? 2 * axis : 2 * axis + 1;
    const double a = accepted_[sides[side]];
    if (a == infinity) continue;
    const double b = accepted_[neighbors_[6 * std::size_t(sides[side]) + side]];
    const Term term = b <= a ? Term{a, (4 * a - b) / 3, 2.25} : Term{a, a, 1};
    int place = count++;
    for (; place > 0 && terms[place - 1].value > term.value; --place) terms[place] = terms[place - 1];
    terms[place] = term;
  }

  // Σ s²(d − t)² = h², with the nearest axes first; an axis joins while the solution so far lies above it.
  const double h = domain_->grid().spacing;
  double s2 = 0, st = 0, stt = 0, d = infinity;
  for (int n = 0; n < count && terms[n].value < d; ++n) {
    const Term& term = terms[n];
    s2 += term.s2, st += term.s2 * term.t, stt += term.s2 * term.t * term.t;
    const double discriminant = st * st - s2 * (stt - h * h);
    if (discriminant < 0) break;
    const double next = (st + std::sqrt(discriminant)) / s2;
    if (next < term.value) break;
    d = next;
  }
  return d;
}

/** Along a boundary the axes have no neighbors to look at, and a wave that creeps along a staircase takes every step the long way
 *  round: on a ring of 64 voxels the mean error is 2.0% without this update and 1.3% with it. So boundary voxels look at diagonal
 *  neighbors too: the least of linear interpolation plus Euclidean distance over the simplices face, edge, corner neighbor (w, u,
 *  c) of the 26-neighborhood (Tsitsiklis 1995). Only a chain of inside voxels is taken; only one of falling distances can hold the
 *  least. */
double FastMarching::solve_simplices(std::int32_t voxel, double d) const {
  const double h = domain_->grid().spacing;
  for (int a = 0; a < 6; ++a) {
    const std::int32_t w = neighbors_[6 * std::size_t(voxel) + a];
    const double dw = accepted_[w];
    if (dw >= d) continue;
    for (int b = 0; b < 6; ++b) {
      if (b / 2 == a / 2) continue;
      const std::int32_t u = neighbors_[6 * std::size_t(w) + b];
      const double du = accepted_[u];
      if (du >= dw) continue;
      const double p = (dw - du) / h;
      d = std::min(d, 2 * p * p <= 1 ? dw + h * std::sqrt(1 - p * p) : du + h * std::numbers::sqrt2);
      const int third = 2 * (3 - a / 2 - b / 2);
      for (int c = third; c < third + 2; ++c) {
        const double dc = accepted_[neighbors_[6 * std::size_t(u) + c]];
        if (dc >= du) continue;
        const double q = (du - dc) / h, r2 = 1 - p * p - q * q;
        d = std::min(d, 3 * q * q <= 1 ? du + h * std::sqrt(2 - 2 * q * q) : dc + h * std::numbers::sqrt3);
        if (q <= p && p * p <= r2) d = std::min(d, dw + h * std::sqrt(r2));
      }
    }
  }
  return d;
}

void FastMarching::march(const Vector3& source, double* distances) {
  std::fill(accepted_.begin(), accepted_.end(), infinity);
  std::fill(places_.begin(), places_.end(), unseen);
  places_.back() = done;  // "no voxel" is never updated
  heap_.clear();

  initialize(source);
  while (!heap_.empty()) {
    double distance;
    const std::int32_t voxel = pop(distance);
    accept(voxel, distance);
  }
  std::copy(accepted_.begin(), accepted_.end() - 1, distances);
}

/** Euclidean distances in a ball about the source, over the voxels that are face-connected inside it to the one nearest the source.
 */
void FastMarching::initialize(const Vector3& source) {
  const std::int32_t first = domain_->nearest(source);
  if (first < 0) return;
  const double h = domain_->grid().spacing;
  const double radius = std::max(ball_radius * h, (domain_->center(first) - source).norm() + h);
  ball_.assign(1, first);
  places_[first] = done;
  for (std::size_t head = 0; head < ball_.size(); ++head) {
    for (int side = 0; side < 6; ++side) {
      const std::int32_t u = neighbors_[6 * std::size_t(ball_[head]) + side];
      if (places_[u] == done || (domain_->center(u) - source).squaredNorm() > radius * radius) continue;
      places_[u] = done;
      ball_.push_back(u);
    }
  }
  for (const std::int32_t v : ball_) accepted_[v] = (domain_->center(v) - source).norm();
  for (const std::int32_t v : ball_) accept(v, accepted_[v]);
}

void FastMarching::accept(std::int32_t voxel, double distance) {
  accepted_[voxel] = distance;
  places_[voxel] = done;
  for (int side = 0; side < 6; ++side) {
    const std::int32_t u = neighbors_[6 * std::size_t(voxel) + side];
    if (places_[u] != done) push(u, solve(u));
  }
}

/** Gives a voxel its trial distance; a later update knows more accepted neighbors and replaces an earlier one, up or down. */
void FastMarching::push(std::int32_t voxel, double distance) {
  std::int32_t place = places_[voxel];
  if (place == unseen) {
    place = static_cast<std::int32_t>(heap_.size());
    heap_.push_back({distance, voxel});
    sift_up(place, distance, voxel);
  } else if (distance < heap_[place].distance) {
    sift_up(place, distance, voxel);
  } else {
    sift_down(place, distance, voxel);
  }
}

std::int32_t FastMarching::pop(double& distance) {
  const Trial top = heap_.front(), last = heap_.back();
  heap_.pop_back();
  if (!heap_.empty()) sift_down(0, last.distance, last.voxel);
  distance = top.distance;
  return top.voxel;
}

void FastMarching::sift_up(std::int32_t place, double distance, std::int32_t voxel) {
  while (place > 0) {
    const std::int32_t parent = (place - 1) / 2;
    if (heap_[parent].distance <= distance) break;
    heap_[place] = heap_[parent];
    places_[heap_[place].voxel] = place;
    place = parent;
  }
  heap_[place] = {distance, voxel};
  places_[voxel] = place;
}

void FastMarching::sift_down(std::int32_t place, double distance, std::int32_t voxel) {
  const auto size = static_cast<std::int32_t>(heap_.size());
  for (std::int32_t child = 2 * place + 1; child < size; child = 2 * place + 1) {
    if (child + 1 < size && heap_[child + 1].distance < heap_[child].distance) ++child;
    if (heap_[child].distance >= distance) break;
    heap_[place] = heap_[child];
    places_[heap_[place].voxel] = place;
    place = child;
  }
  heap_[place] = {distance, voxel};
  places_[voxel] = place;
}

}  // namespace handlebody
