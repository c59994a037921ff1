#include "core/distance/surface_crossings.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

constexpr std::size_t most_crossings = 4'000'000;  // 160 MB
constexpr double most_visits = 2e8;                // lines looked at: some seconds

struct Place {
  double u, v;
};

/** Which side of the edge from p to q the line x runs on, +1 left or −1 right; a line through the edge counts as displaced, a
 *  little along u and much less along v. 0 for an edge without length. */
int side_of(const Place& p, const Place& q, const Place& x) {
  const double du = q.u - p.u, dv = q.v - p.v;
  const double area = du * (x.v - p.v) - dv * (x.u - p.u);
  if (area != 0) return area > 0 ? 1 : -1;
  if (dv != 0) return dv < 0 ? 1 : -1;
  return du > 0 ? 1 : du < 0 ? -1 : 0;
}

}  // namespace

SurfaceCrossings::SurfaceCrossings(const Grid& grid, int axis) : grid_(grid), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3) {
  starts_.assign(static_cast<std::size_t>(grid.dims[u_]) * grid.dims[v_] + 1, 0);
}

std::size_t SurfaceCrossings::line_of(const std::array<std::int32_t, 3>& cell) const {
  return cell[u_] + static_cast<std::size_t>(grid_.dims[u_]) * cell[v_];
}

std::int64_t SurfaceCrossings::first_voxel(std::size_t line) const {
  std::array<std::int32_t, 3> cell{};
  cell[u_] = static_cast<std::int32_t>(line % grid_.dims[u_]), cell[v_] = static_cast<std::int32_t>(line / grid_.dims[u_]);
  return grid_.linear(cell[0], cell[1], cell[2]);
}

std::int64_t SurfaceCrossings::stride() const {
  return axis_ == 0 ? 1 : axis_ == 1 ? grid_.dims[0] : std::int64_t{grid_.dims[0]} * grid_.dims[1];
}

/** Finds the lines that meet the triangle's projection, by winding numbers in the plane: of the edges that straddle a line's v, a
 *  ray from it along u crosses those that go up with the line on their left, or down with it on their right. */
bool SurfaceCrossings::add(const Points& positions, const std::uint32_t* corners) {
  Place place[3];
  double along[3];
  for (int c = 0; c < 3; ++c) {
    const auto position = positions.row(corners[c]);
    place[c] = {(position[u_] - grid_.origin[u_]) / grid_.spacing, (position[v_] - grid_.origin[v_]) / grid_.spacing};
    along[c] = (position[axis_] - grid_.origin[axis_]) / grid_.spacing;
  }
  const auto range = [&](double a, double b, double c, int axis) {
    const double last = grid_.dims[axis] - 1;
    return std::pair(static_cast<int>(std::ceil(std::clamp(std::min({a, b, c}), 0., last + 1))),
                     static_cast<int>(std::floor(std::clamp(std::max({a, b, c}), -1., last))));
  };
  const auto [u0, u1] = range(place[0].u, place[1].u, place[2].u, u_);
  const auto [v0, v1] = range(place[0].v, place[1].v, place[2].v, v_);
  if (u0 > u1 || v0 > v1) return true;
  visits_ += (u1 - u0 + 1.) * (v1 - v0 + 1.);
  if (visits_ > most_visits) return false;

  const double e1u = place[1].u - place[0].u, e1v = place[1].v - place[0].v, e2u = place[2].u - place[0].u,
               e2v = place[2].v - place[0].v, area = e1u * e2v - e1v * e2u;
  const double low = std::min({along[0], along[1], along[2]}), high = std::max({along[0], along[1], along[2]});
  for (int v = v0; v <= v1; ++v) {
    for (int u = u0; u <= u1; ++u) {
      const Place x{double(u), double(v)};
      int winding = 0;
      for (int c = 0; c < 3; ++c) {
        const int d = c == 2 ? 0 : c + 1;
        const bool rises = corners[c] < corners[d];  // the same order for both triangles of an edge
        const Place &p = rises ? place[c] : place[d], &q = rises ? place[d] : place[c];
        if ((p.v <= x.v) == (q.v <= x.v)) continue;
        const int upward = p.v <= x.v ? 1 : -1;
        if (side_of(p, q, x) == upward) winding += rises ? upward : -upward;  // the edge is crossed beyond x
      }
      if (winding == 0) continue;
      double at = low;
      if (area != 0) {
        const double s = ((x.u - place[0].u) * e2v - (x.v - place[0].v) * e2u) / area;
        const double t = (e1u * (x.v - place[0].v) - e1v * (x.u - place[0].u)) / area;
        at = std::clamp(along[0] + s * (along[1] - along[0]) + t * (along[2] - along[0]), low, high);
      }
      if (found_.size() == most_crossings) return false;
      found_.push_back({static_cast<std::uint32_t>(u + std::size_t(grid_.dims[u_]) * v), {at, -winding}});
    }
  }
  return true;
}

void SurfaceCrossings::finish() {
  for (const Found& found : found_) ++starts_[found.line + 1];
  for (std::size_t line = 1; line < starts_.size(); ++line) starts_[line] += starts_[line - 1];
  sorted_.resize(found_.size());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (const Found& found : found_) sorted_[next[found.line]++] = found.crossing;
  found_ = {};
  std::vector<Crossing> line;
  for (std::size_t l = 0; l + 1 < starts_.size(); ++l) {
    Crossing* first = sorted_.data() + starts_[l];
    const std::size_t count = starts_[l + 1] - starts_[l];
    if (count < 2) continue;
    line.assign(first, first + count);
    const Indices order = sorted_indices(
        count, [&](std::uint32_t a, std::uint32_t b) { return line[a].at < line[b].at || (line[a].at == line[b].at && a < b); });
    for (std::size_t k = 0; k < count; ++k) first[k] = line[order[k]];
  }
}

EnclosedVoxels enclosed_voxels(const Grid& grid, const SurfaceCrossings& crossings) {
  EnclosedVoxels inside;
  bool forward = false, backward = false;
  for (std::size_t line = 0; line < crossings.lines(); ++line) {
    const auto* crossing = crossings.begin(line);
    const auto* end = crossings.end(line);
    if (crossing == end) continue;
    int winding = 0, run = 0;  // voxels in a row that it winds around in one direction, counted by its sign
    const std::int64_t first = crossings.first_voxel(line);
    for (int i = 0; i < grid.dims[0]; ++i) {
      for (; crossing != end && crossing->at < i; ++crossing) winding += crossing->sign;
      if (winding != 0) inside.voxels.push_back(static_cast<std::uint32_t>(first + i));
      run = winding > 0 ? std::max(run, 0) + 1 : winding < 0 ? std::min(run, 0) - 1 : 0;
      forward |= run == 3;
      backward |= run == -3;
    }
  }
  inside.both_ways = forward && backward;
  return inside;
}

void crossed_voxels(const Grid& grid, const SurfaceCrossings& crossings, std::vector<std::uint32_t>& voxels) {
  const int last = grid.dims[crossings.axis()] - 1;
  for (std::size_t line = 0; line < crossings.lines(); ++line) {
    const std::int64_t first = crossings.first_voxel(line), stride = crossings.stride();
    for (const auto* c = crossings.begin(line); c != crossings.end(line); ++c) {
      voxels.push_back(
          static_cast<std::uint32_t>(first + stride * static_cast<int>(std::lround(std::clamp(c->at, 0., double(last))))));
    }
  }
}

}  // namespace handlebody
