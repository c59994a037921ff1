#include "core/irbf/skeleton_spheres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handlebody {
namespace {

constexpr double classes_per_octave = 10;  // of radii that are tied
constexpr double shrinking = 0.95;         // between two tries to fit smaller spheres
constexpr double smallest = 0.25;          // of them, in spacings: less than nodes are apart

using Spheres = std::vector<SkeletonSphere>;

class BranchPacking {
 public:
  BranchPacking(double spacing, const CurveSkeleton& skeleton, const SkeletonSphereOptions& options);

  void pack();
  void serve_branches();
  void prune();
  void fill(const VoxelDomain& domain, const std::vector<double>& surface_distance);
  Spheres take();

 private:
  bool too_close(const Sphere& a, const Sphere& b) const;
  bool has_room(const Sphere& sphere) const;
  double radius_at(std::uint32_t node) const { return options_.packing.shrink * skeleton_.nodes[node].radius; }
  std::size_t minimum(std::size_t branch) const;
  Spheres fit(std::size_t branch, double largest) const;
  void serve(std::size_t branch, std::size_t wanted);
  std::vector<Spheres> by_branch() const;

  double spacing_;
  const CurveSkeleton& skeleton_;
  const SkeletonSphereOptions& options_;
  std::vector<std::int32_t> owner_;  // the branch of each node
  std::vector<std::uint8_t> hub_;
  std::vector<std::size_t> minimum_;  // of each branch
  Spheres spheres_;
};

BranchPacking::BranchPacking(double spacing, const CurveSkeleton& skeleton, const SkeletonSphereOptions& options)
    : spacing_(spacing),
      skeleton_(skeleton),
      options_(options),
      owner_(skeleton.nodes.size(), -1),
      hub_(skeleton.nodes.size()),
      minimum_(skeleton.branches.size()) {
  for (const std::uint32_t node : skeleton.hubs) hub_[node] = 1;
  std::vector<std::uint8_t> seen(owner_.size());
  for (std::size_t b = 0; b < skeleton.branches.size(); ++b) {
    const Indices& nodes = skeleton.branches[b].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      // A hub that a branch starts from, and none leads to, is the root's.
      if (!seen[nodes[i]] && !(i == 0 && hub_[nodes[i]])) owner_[nodes[i]] = static_cast<std::int32_t>(b);
      seen[nodes[i]] = 1;
    }
  }
}

bool BranchPacking::too_close(const Sphere& a, const Sphere& b) const {
  const double gap = a.radius + b.radius - options_.packing.max_overlap * std::min(a.radius, b.radius);
  return gap > 0 && (a.center - b.center).squaredNorm() < gap * gap;
}

bool BranchPacking::has_room(const Sphere& sphere) const {
  return std::none_of(spheres_.begin(), spheres_.end(), [&](const Sphere& other) { return too_close(sphere, other); });
}

/** Larger first, each where those before leave room. */
void BranchPacking::pack() {
  std::vector<std::int64_t> sizes;
  for (std::uint32_t n = 0; n < owner_.size(); ++n) {
    const double radius = std::max(radius_at(n) / spacing_, 1e-9);
    sizes.push_back(static_cast<std::int64_t>(std::floor(classes_per_octave * std::log2(radius) + 1e-6)));
  }
  const Indices order = sorted_indices(owner_.size(), [&](std::uint32_t u, std::uint32_t v) {
    if (sizes[u] != sizes[v]) return sizes[u] > sizes[v];
    return hub_[u] != hub_[v] ? hub_[u] > hub_[v] : u < v;
  });
  for (const std::uint32_t n : order) {
    const SkeletonSphere sphere{{skeleton_.nodes[n].place, radius_at(n)}, owner_[n]};
    if (sphere.radius >= options_.packing.min_radius * spacing_ && has_room(sphere)) spheres_.push_back(sphere);
  }
}

/** How many spheres a branch is to keep, by how thick it is where no other's spheres are. */
std::size_t BranchPacking::minimum(std::size_t branch) const {
  const Indices& nodes = skeleton_.branches[branch].nodes;
  if (nodes.size() == 1) return 1;
  for (const std::uint32_t n : nodes) {
    if (owner_[n] != static_cast<std::int32_t>(branch) || skeleton_.nodes[n].radius <= spacing_) continue;
    const bool apart = std::none_of(spheres_.begin(), spheres_.end(), [&](const SkeletonSphere& s) {
      return s.branch != static_cast<std::int32_t>(branch) && (s.center - skeleton_.nodes[n].place).norm() < s.radius;
    });
    if (apart) return static_cast<std::size_t>(std::max(options_.least_per_branch, 1));
  }
  return 1;
}

void BranchPacking::serve_branches() {
  std::vector<std::size_t> count(minimum_.size());
  for (const SkeletonSphere& sphere : spheres_) {
    if (sphere.branch >= 0) ++count[sphere.branch];
  }
  for (std::size_t b = 0; b < minimum_.size(); ++b) {
    minimum_[b] = minimum(b);
    if (count[b] < minimum_[b]) serve(b, minimum_[b]);
  }
}

/** Spheres of a branch up to a largest radius, one after the other from its end, where those of others leave room. */
Spheres BranchPacking::fit(std::size_t branch, double largest) const {
  Spheres row;
  const Indices& nodes = skeleton_.branches[branch].nodes;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const SkeletonSphere sphere{{skeleton_.nodes[nodes[i]].place, std::min(radius_at(nodes[i]), largest)},
                                static_cast<std::int32_t>(branch)};
    if (owner_[nodes[i]] != sphere.branch || sphere.radius <= 0 || !has_room(sphere)) continue;
    if (std::none_of(row.begin(), row.end(), [&](const Sphere& other) { return too_close(sphere, other); })) row.push_back(sphere);
  }
  return row;
}

/** Gives a branch as many spheres as are wanted, or as fit, all as large as that allows. */
void BranchPacking::serve(std::size_t branch, std::size_t wanted) {
  std::erase_if(spheres_, [&](const SkeletonSphere& s) { return s.branch == static_cast<std::int32_t>(branch); });
  double largest = 0, most_room = -std::numeric_limits<double>::infinity();
  SkeletonSphere alone{{Vector3::Zero(), 0}, static_cast<std::int32_t>(branch)};
  for (const std::uint32_t n : skeleton_.branches[branch].nodes) {
    if (owner_[n] != alone.branch) continue;
    largest = std::max(largest, radius_at(n));
    double room = radius_at(n);
    for (const Sphere& s : spheres_) room = std::min(room, (s.center - skeleton_.nodes[n].place).norm() - s.radius);
    if (room <= most_room) continue;
    most_room = room;
    alone.center = skeleton_.nodes[n].place, alone.radius = std::min(radius_at(n), std::max(room, smallest * spacing_));
  }
  Spheres best;
  for (double radius = largest; radius > smallest * spacing_ && best.size() < wanted; radius *= shrinking) {
    Spheres row = fit(branch, radius);
    if (row.size() > best.size()) best.swap(row);
  }
  if (best.empty()) best.push_back(alone);
  spheres_.insert(spheres_.end(), best.begin(), best.end());
}

/** The spheres of each branch, then those of none: the largest, then those farthest from all before. */
std::vector<Spheres> BranchPacking::by_branch() const {
  std::vector<Spheres> lists(minimum_.size() + 1);
  for (const SkeletonSphere& sphere : spheres_) lists[sphere.branch < 0 ? minimum_.size() : sphere.branch].push_back(sphere);
  const double step = 1e-6 * spacing_;  // what is less is a tie
  for (Spheres& list : lists) {
    std::vector<double> away(list.size(), std::numeric_limits<double>::infinity());
    for (std::size_t placed = 0; placed < list.size(); ++placed) {
      std::size_t next = placed;
      for (std::size_t s = placed + 1; s < list.size(); ++s) {
        const double gain = placed == 0 ? list[s].radius - list[next].radius : away[s] - away[next];
        if (gain > step) next = s;
      }
      std::rotate(list.begin() + Index(placed), list.begin() + Index(next), list.begin() + Index(next) + 1);
      std::rotate(away.begin() + Index(placed), away.begin() + Index(next), away.begin() + Index(next) + 1);
      for (std::size_t s = placed + 1; s < list.size(); ++s)
        away[s] = std::min(away[s], (list[s].center - list[placed].center).norm());
    }
  }
  return lists;
}

void BranchPacking::prune() {
  const auto most = static_cast<std::size_t>(std::max(options_.packing.max_spheres, 0));
  if (spheres_.size() <= most) return;
  const std::vector<Spheres> lists = by_branch();
  std::vector<std::size_t> kept(lists.size());
  std::size_t all = 0;
  for (std::size_t b = 0; b < minimum_.size(); ++b) all += kept[b] = std::min(lists[b].size(), minimum_[b]);
  for (; all < most; ++all) {
    std::size_t best = lists.size();
    for (std::size_t b = 0; b < lists.size(); ++b) {
      if (kept[b] == lists[b].size()) continue;
      if (best == lists.size() || lists[b][kept[b]].radius > lists[best][kept[best]].radius + 1e-6 * spacing_) best = b;
    }
    if (best == lists.size()) break;
    ++kept[best];
  }
  spheres_.clear();
  for (std::size_t b = 0; b < lists.size(); ++b)
    spheres_.insert(spheres_.end(), lists[b].begin(), lists[b].begin() + Index(kept[b]));
}

/** Adds medial spheres where there is room. */
void BranchPacking::fill(const VoxelDomain& domain, const std::vector<double>& surface_distance) {
  SpherePackingOptions packing = options_.packing;
  const std::int64_t room = std::int64_t{packing.max_spheres} - std::ssize(spheres_);
  if (room <= 0) return;
  packing.min_radius = std::max(packing.min_radius, options_.fill_radius);
  const auto at = [&](std::size_t v) {
    return SkeletonSphere{{domain.center(static_cast<Index>(v)), packing.shrink * surface_distance[v]}, -1};
  };
  std::vector<std::uint8_t> free = medial_voxels(domain, surface_distance, packing.medial_slope);
  for (std::size_t v = 0; v < free.size(); ++v) {
    if (free[v]) free[v] = at(v).radius >= packing.min_radius * spacing_ && has_room(at(v));
  }
  // It gives every part a first sphere, whether it may be there or not: those are asked for besides, and left out again.
  const std::vector<std::int32_t> component = face_components(domain);
  const std::int64_t parts = component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + std::int64_t{1};
  packing.max_spheres = static_cast<int>(std::min<std::int64_t>(packing.max_spheres + parts, std::numeric_limits<int>::max()));
  for (const Sphere& sphere : pack_candidates(domain, surface_distance, packing, free)) {
    if (std::ssize(spheres_) >= options_.packing.max_spheres) break;
    const SkeletonSphere added{sphere, -1};
    if (sphere.radius >= packing.min_radius * spacing_ && has_room(added)) spheres_.push_back(added);
  }
}

Spheres BranchPacking::take() {
  const Indices order = sorted_indices(spheres_.size(), [&](std::uint32_t u, std::uint32_t v) {
    const auto key = [&](std::uint32_t s) { return std::llround(spheres_[s].radius / (1e-6 * spacing_)); };
    return key(u) != key(v) ? key(u) > key(v) : u < v;
  });
  Spheres sorted;
  for (const std::uint32_t s : order) sorted.push_back(spheres_[s]);
  return sorted;
}

}  // namespace

std::vector<SkeletonSphere> skeleton_spheres(const VoxelDomain& domain, const std::vector<double>& surface_distance,
                                             const CurveSkeleton& skeleton, const SkeletonSphereOptions& options) {
  BranchPacking packing(domain.grid().spacing, skeleton, options);
  packing.pack();
  packing.serve_branches();
  packing.prune();
  if (options.fill) packing.fill(domain, surface_distance);
  return packing.take();
}

}  // namespace handlebody
