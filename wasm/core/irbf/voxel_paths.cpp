#include "core/irbf/voxel_paths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handlebody {
namespace {

// Lengths are in spacings, or in whole 1024ths of one.
constexpr std::int64_t far = std::numeric_limits<std::int64_t>::max();
constexpr std::array<std::int64_t, 4> step_length{0, 1024, 1448, 1774};  // along a face, an edge, a corner
constexpr double tie = 1e-6;
constexpr double least_depth = 0.25;  // what a voxel on the surface, or a bridge, counts as
// Weights are 16 for the deepest voxel and at most a million times that: 64 million steps then sum to less than 2⁶³.
constexpr double weight_of_deepest = 16, heaviest = 1e6 * weight_of_deepest;
constexpr double covered_beside = 0.5;  // a ball that touches the surface covers the staircase of its voxels too
constexpr double cover_step = 0.25;     // in depths: balls so close together leave nothing of a voxel between them
// A limb reaches beyond the balls of what it grows from by either of these, and a voxel and a half. A cube's corner reaches 0.73
// and 1.73, the flank of a body twice as wide as high 1 and 1.25; an animal's leg 1 and 2, an ear 0.8 and 3 to 4.
constexpr double slender = 2;            // times its own depth there, at most;
constexpr double long_depths = 0.75;     // or times the depth of what it grows from,
constexpr double hardly_slender = 1.25;  // if it is this many times its own
constexpr double beyond = 1.5;
constexpr std::int64_t least_way_around = 8 * 1024;  // of each way around a hole: a smaller one is a slip of the grid

/** What comes out of a heap later: it costs more, or as much and has the higher number. */
struct Trial {
  std::int64_t key;
  std::int32_t voxel;
};
// Lambdas, since a heap does not inline what it gets by a pointer.
constexpr auto nearest_first = [](const Trial& a, const Trial& b) { return a.key != b.key ? a.key > b.key : a.voxel > b.voxel; };
constexpr auto farthest_first = [](const Trial& a, const Trial& b) { return a.key != b.key ? a.key < b.key : a.voxel > b.voxel; };

class PathSearch {
 public:
  PathSearch(const VoxelDomain& domain, const std::vector<double>& depth);
  VoxelPaths find();

 private:
  struct Neighbors {
    std::array<std::int32_t, 26> voxel;
    std::array<std::uint8_t, 26> axes;  // along how many the step goes
    int count = 0;
  };

  Neighbors neighbors(std::int32_t voxel) const;
  std::int32_t enter_part(std::int32_t first);
  void seed(std::int32_t voxel);
  void spread();
  void find_tree(std::int32_t root);
  std::int32_t first_on_paths(std::int32_t voxel) const;
  bool is_limb(std::int32_t end);
  void add_path(std::int32_t end);
  void cover_along(const std::vector<std::int32_t>& path, std::size_t count);
  void cover(std::int32_t center);
  std::int32_t way_around(std::int32_t end);
  void walk(std::int32_t from, std::vector<std::int32_t>& path) const;
  bool leaves_domain(std::int32_t from, std::int32_t to) const;
  double distance(std::int32_t u, std::int32_t v) const;

  const VoxelDomain& domain_;
  std::vector<double> depth_;  // in spacings
  std::int32_t none_;
  std::vector<std::int32_t> faces_;  // the six face neighbors
  std::vector<std::array<std::int32_t, 3>> cells_;
  std::vector<std::int32_t> weight_;
  std::vector<std::int64_t> cost_, length_;  // of the cheapest way to the paths so far
  std::vector<std::int32_t> next_;           // on it
  std::vector<std::int32_t> place_;          // in the result, −1 for none
  std::vector<std::uint8_t> covered_;
  std::vector<std::int32_t> mark_;  // the last flood that reached a voxel
  std::int32_t floods_ = 0;
  std::vector<std::int32_t> part_, flood_, path_, other_;
  std::vector<Trial> trials_, ends_;
  VoxelPaths paths_;
};

PathSearch::PathSearch(const VoxelDomain& domain, const std::vector<double>& depth)
    : domain_(domain), depth_(depth), none_(static_cast<std::int32_t>(domain.size())), faces_(domain.face_neighbors()) {
  for (double& d : depth_) d = std::max(tie * std::round(d / (tie * domain.grid().spacing)), least_depth);
  const auto count = static_cast<std::size_t>(none_);
  cells_.reserve(count);
  for (const std::uint32_t voxel : domain.voxels()) cells_.push_back(domain.grid().cell(voxel));
  weight_.resize(count), cost_.resize(count, far), length_.resize(count), next_.resize(count, -1), place_.resize(count, -1);
  covered_.resize(count), mark_.resize(count, 0);
}

VoxelPaths PathSearch::find() {
  for (std::int32_t v = 0; v < none_; ++v) {
    if (place_[v] >= 0 || cost_[v] != far) continue;
    find_tree(enter_part(v));
  }
  return std::move(paths_);
}

/** The 26 neighbors that a chain of face neighbors leads to within the 2³ voxels between: others touch, but are not joined. */
PathSearch::Neighbors PathSearch::neighbors(std::int32_t voxel) const {
  Neighbors found;
  std::uint32_t seen = 0;
  constexpr std::array<int, 6> offset{-1, 1, -3, 3, -9, 9};
  const auto take = [&](std::int32_t v, int at, std::uint8_t axes) {
    if (seen >> at & 1) return;
    seen |= 1u << at;
    found.voxel[found.count] = v;
    found.axes[found.count++] = axes;
  };
  for (int a = 0; a < 6; ++a) {
    const std::int32_t u = faces_[6 * std::size_t(voxel) + a];
    if (u == none_) continue;
    take(u, 13 + offset[a], 1);
    for (int b = 0; b < 6; ++b) {
      if (b / 2 == a / 2) continue;
      const std::int32_t v = faces_[6 * std::size_t(u) + b];
      if (v == none_) continue;
      take(v, 13 + offset[a] + offset[b], 2);
      const int third = 2 * (3 - a / 2 - b / 2);
      for (int c = third; c < third + 2; ++c) {
        const std::int32_t w = faces_[6 * std::size_t(v) + c];
        if (w != none_) take(w, 13 + offset[a] + offset[b] + offset[c], 3);
      }
    }
  }
  return found;
}

/** Gathers a face-connected part and weighs its voxels. Returns the deepest. */
std::int32_t PathSearch::enter_part(std::int32_t first) {
  part_.assign(1, first);
  mark_[first] = ++floods_;
  std::int32_t deepest = first;
  for (std::size_t head = 0; head < part_.size(); ++head) {
    const std::int32_t v = part_[head];
    if (depth_[v] > depth_[deepest] || (depth_[v] == depth_[deepest] && v < deepest)) deepest = v;
    for (int side = 0; side < 6; ++side) {
      const std::int32_t u = faces_[6 * std::size_t(v) + side];
      if (u == none_ || mark_[u] == floods_) continue;
      mark_[u] = floods_;
      part_.push_back(u);
    }
  }
  for (const std::int32_t v : part_) {
    const double ratio = depth_[deepest] / depth_[v];
    weight_[v] = static_cast<std::int32_t>(std::lround(std::min(weight_of_deepest * ratio * ratio * ratio, heaviest)));
  }
  return deepest;
}

void PathSearch::seed(std::int32_t voxel) {
  cost_[voxel] = length_[voxel] = 0;
  trials_.push_back({0, voxel});
  std::push_heap(trials_.begin(), trials_.end(), nearest_first);
}

/** Dijkstra's algorithm from the seeds, over the voxels to which they are nearer than what was there before. */
void PathSearch::spread() {
  while (!trials_.empty()) {
    const Trial trial = trials_.front();
    std::pop_heap(trials_.begin(), trials_.end(), nearest_first);
    trials_.pop_back();
    const std::int32_t v = trial.voxel;
    if (trial.key != cost_[v]) continue;
    const Neighbors around = neighbors(v);
    for (int n = 0; n < around.count; ++n) {
      const std::int32_t u = around.voxel[n];
      const std::int64_t step = step_length[around.axes[n]];
      const std::int64_t cost = trial.key + step * (weight_[u] + weight_[v]) / 2;
      if (cost >= cost_[u]) continue;
      cost_[u] = cost, length_[u] = length_[v] + step, next_[u] = v;
      trials_.push_back({cost, u});
      std::push_heap(trials_.begin(), trials_.end(), nearest_first);
    }
  }
}

void PathSearch::find_tree(std::int32_t root) {
  next_[root] = -1;
  place_[root] = static_cast<std::int32_t>(paths_.voxels.size());
  paths_.voxels.push_back(root);
  paths_.toward.push_back(-1);
  seed(root);
  spread();
  cover(root);
  ends_.clear();
  for (const std::int32_t v : part_) {
    if (!covered_[v]) ends_.push_back({length_[v], v});
  }
  std::make_heap(ends_.begin(), ends_.end(), farthest_first);
  int ways_from_root = 0;
  while (!ends_.empty()) {
    const Trial end = ends_.front();
    std::pop_heap(ends_.begin(), ends_.end(), farthest_first);
    ends_.pop_back();
    if (covered_[end.voxel]) continue;
    if (end.key != length_[end.voxel]) {  // a path has come nearer since
      ends_.push_back({length_[end.voxel], end.voxel});
      std::push_heap(ends_.begin(), ends_.end(), farthest_first);
      continue;
    }
    const std::int32_t other = way_around(end.voxel);
    // From the root, which may be close to an end of the part, ways lead to both sides.
    const bool from_root = ways_from_root < 2 && first_on_paths(end.voxel) == root;
    if (other < 0 && !from_root && !is_limb(end.voxel)) continue;
    if (from_root) ways_from_root += other < 0 ? 1 : 2;
    add_path(end.voxel);
    if (other >= 0) {
      if (place_[other] < 0) add_path(other);
      paths_.loops.push_back({place_[end.voxel], place_[other]});
    }
    spread();
  }
}

/** Voxels from one to the paths, the first that is on them included. */
void PathSearch::walk(std::int32_t from, std::vector<std::int32_t>& path) const {
  path.assign(1, from);
  while (place_[path.back()] < 0) path.push_back(next_[path.back()]);
}

/** Whether a way to the paths, given by its end, leads along a limb. If not, it covers what it leads along. */
bool PathSearch::is_limb(std::int32_t end) {
  walk(end, path_);
  std::size_t exit = 0;
  double thick = 0;
  while (!covered_[path_[exit]]) thick = std::max(thick, depth_[path_[exit++]]);
  const double reach = distance(end, path_[exit]) - beyond;
  if (reach >= slender * thick) return true;
  if (reach >= long_depths * depth_[path_.back()] && reach >= hardly_slender * thick) return true;
  cover_along(path_, exit);
  return false;
}

std::int32_t PathSearch::first_on_paths(std::int32_t voxel) const {
  while (place_[voxel] < 0) voxel = next_[voxel];
  return voxel;
}

void PathSearch::add_path(std::int32_t end) {
  walk(end, path_);
  for (std::size_t i = path_.size() - 1; i-- > 0;) {
    place_[path_[i]] = static_cast<std::int32_t>(paths_.voxels.size());
    paths_.voxels.push_back(path_[i]);
    paths_.toward.push_back(place_[path_[i + 1]]);
    seed(path_[i]);
  }
  cover_along(path_, path_.size());
}

void PathSearch::cover_along(const std::vector<std::int32_t>& path, std::size_t count) {
  std::int32_t last = -1;
  for (std::size_t i = 0; i < count; ++i) {
    if (last >= 0 && distance(path[i], last) < cover_step * depth_[path[i]]) continue;
    cover(path[i]);
    last = path[i];
  }
}

/** Marks what lies around a voxel of a path and is joined to it there: not the limb beside. */
void PathSearch::cover(std::int32_t center) {
  const double radius = depth_[center] + covered_beside;
  flood_.assign(1, center);
  mark_[center] = ++floods_;
  for (std::size_t head = 0; head < flood_.size(); ++head) {
    covered_[flood_[head]] = 1;
    for (int side = 0; side < 6; ++side) {
      const std::int32_t u = faces_[6 * std::size_t(flood_[head]) + side];
      if (u == none_ || mark_[u] == floods_ || distance(center, u) > radius) continue;
      mark_[u] = floods_;
      flood_.push_back(u);
    }
  }
}

/** The neighbor of a path's end whose own way to the paths leads around the other side of a hole, or −1. At the middle between, the
 * two ways are apart, and between them lies what is outside. */
std::int32_t PathSearch::way_around(std::int32_t end) {
  if (length_[end] < least_way_around) return -1;
  walk(end, path_);
  const Neighbors around = neighbors(end);
  for (int n = 0; n < around.count; ++n) {
    if (length_[around.voxel[n]] < least_way_around) continue;
    walk(around.voxel[n], other_);
    const std::size_t a = path_.size() / 2, b = other_.size() / 2;
    const std::int32_t here = path_[a], there = other_[b];
    if (distance(here, there) < depth_[here] + depth_[there] + beyond) continue;
    const std::int32_t late_here = path_[3 * path_.size() / 4], late_there = other_[3 * other_.size() / 4];
    if (leaves_domain(here, there) || leaves_domain(late_here, late_there)) return around.voxel[n];
  }
  return -1;
}

/** Whether the straight way between two voxels is outside for more than a step. */
bool PathSearch::leaves_domain(std::int32_t from, std::int32_t to) const {
  const auto &a = cells_[from], &b = cells_[to];
  const int steps = 2 * std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]), 1});
  int outside = 0;
  for (int s = 1; s < steps; ++s) {
    std::array<int, 3> at{};
    for (int i = 0; i < 3; ++i) at[i] = static_cast<int>(std::lround(a[i] + double(b[i] - a[i]) * s / steps));
    if (domain_.number(at[0], at[1], at[2]) < 0 && ++outside > 2) return true;
  }
  return false;
}

double PathSearch::distance(std::int32_t u, std::int32_t v) const {
  const auto &a = cells_[u], &b = cells_[v];
  return std::sqrt(double(a[0] - b[0]) * (a[0] - b[0]) + double(a[1] - b[1]) * (a[1] - b[1]) + double(a[2] - b[2]) * (a[2] - b[2]));
}

}  // namespace

VoxelPaths voxel_paths(const VoxelDomain& domain, const std::vector<double>& depth) {
  return PathSearch(domain, depth).find();
}

}  // namespace handlebody
