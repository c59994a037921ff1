#include "core/irbf/curve_skeleton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "core/distance/inner_depth.hpp"
#include "core/irbf/voxel_paths.hpp"

namespace handlebody {
namespace {

// Lengths of the graph are in spacings.
constexpr double to_corner = 1.75;        // radii from the middle of a box to its corner, and a little
constexpr double rounding_of_ends = 0.8;  // an end is where the radius has fallen to this part of that before
constexpr double margin = 1;              // what a branch must reach beyond the ball that it grows from
// Places where curves meet are one if they are at most this part of the sum of their radii apart: two spheres of 90% would overlap.
// On a hand, spheres at the roots of fingers and thumb would fight for the palm.
constexpr double meeting = 0.9;
constexpr double nearby = 2;  // or this far: thin limbs that cross meet within a voxel or two
constexpr double node_spacing = 0.5;
constexpr int smoothing_steps = 12;  // at half a voxel: staircases of a voxel are gone, and bends of three remain

/** The paths of voxels as a graph, and what is done to it before curves are drawn. */
class PathGraph {
 public:
  PathGraph(const VoxelDomain& domain, const std::vector<double>& depth, const VoxelPaths& paths);

  /** From one node of degree other than 2 to another, both included; a closed one without any starts and ends at one node. */
  using Chain = std::vector<std::int32_t>;

  void trim_ends();
  bool cut_hairs();
  std::vector<Chain> chains() const;
  bool close_together(const Chain& chain) const;

  std::int32_t size() const { return static_cast<std::int32_t>(degree_.size()); }
  const Vector3& place(std::int32_t node) const { return places_[node]; }
  double depth(std::int32_t node) const { return depths_[node]; }
  int degree(std::int32_t node) const { return degree_[node]; }

 private:
  Chain follow(std::int32_t from, std::int32_t to) const;
  void remove(std::int32_t node);
  double distance(std::int32_t a, std::int32_t b) const { return (places_[a] - places_[b]).norm(); }

  std::vector<Vector3> places_;  // in spacings
  std::vector<double> depths_;
  std::vector<std::int32_t> first_, linked_;  // the neighbors of node n: linked_[first_[n]] … linked_[first_[n + 1] − 1]
  std::vector<int> degree_;                   // −1 for a node that was removed
};

PathGraph::PathGraph(const VoxelDomain& domain, const std::vector<double>& depth, const VoxelPaths& paths)
    : first_(paths.voxels.size() + 1), degree_(paths.voxels.size()) {
  for (const std::int32_t v : paths.voxels) {
    const auto cell = domain.grid().cell(domain.voxels()[v]);
    places_.emplace_back(cell[0], cell[1], cell[2]);
    depths_.push_back(depth[v] / domain.grid().spacing);
  }
  std::vector<std::array<std::int32_t, 2>> links = paths.loops;
  for (std::int32_t n = 0; n < size(); ++n) {
    if (paths.toward[n] >= 0) links.push_back({n, paths.toward[n]});
  }
  for (const auto& link : links) ++degree_[link[0]], ++degree_[link[1]];
  for (std::int32_t n = 0; n < size(); ++n) first_[n + 1] = first_[n] + degree_[n];
  linked_.resize(2 * links.size());
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (const auto& link : links) {
    linked_[next[link[0]]++] = link[1];
    linked_[next[link[1]]++] = link[0];
  }
}

void PathGraph::remove(std::int32_t node) {
  degree_[node] = -1;
  for (std::int32_t l = first_[node]; l < first_[node + 1]; ++l) {
    if (degree_[linked_[l]] >= 0) --degree_[linked_[l]];
  }
}

/** The chain that starts with the link between two nodes. */
PathGraph::Chain PathGraph::follow(std::int32_t from, std::int32_t to) const {
  Chain chain{from, to};
  while (degree_[to] == 2 && to != chain.front()) {
    std::int32_t next = -1;
    for (std::int32_t l = first_[to]; l < first_[to + 1]; ++l) {
      if (linked_[l] != from && degree_[linked_[l]] >= 0) next = linked_[l];
    }
    if (next < 0) break;  // two links between the same two nodes
    from = to, to = next;
    chain.push_back(to);
  }
  return chain;
}

std::vector<PathGraph::Chain> PathGraph::chains() const {
  std::vector<Chain> found;
  std::vector<std::uint8_t> done(degree_.size());
  for (const bool closed : {false, true}) {
    for (std::int32_t n = 0; n < size(); ++n) {
      if (degree_[n] < 0 || done[n] || (degree_[n] == 2) != closed) continue;
      if (degree_[n] == 0) found.push_back({n});
      for (std::int32_t l = first_[n]; l < first_[n + 1]; ++l) {
        const std::int32_t to = linked_[l];
        if (degree_[to] < 0 || (degree_[to] == 2 && done[to])) continue;
        if (degree_[to] != 2 && to < n) continue;  // it has come from there
        found.push_back(follow(n, to));
        for (const std::int32_t m : found.back()) {
          if (degree_[m] == 2) done[m] = 1;
        }
      }
    }
  }
  return found;
}

/** Paths start at the skin. Shortens each to where the ball that touches the skin there is a large one: over the nodes whose balls
 * reach the end, as far as a box's corner, to the first that is nearly as large as any. */
void PathGraph::trim_ends() {
  for (std::int32_t end = 0; end < size(); ++end) {
    if (degree_[end] != 1) continue;
    std::int32_t to = -1;
    for (std::int32_t l = first_[end]; l < first_[end + 1]; ++l) {
      if (degree_[linked_[l]] >= 0) to = linked_[l];
    }
    const Chain chain = follow(end, to);
    double largest = 0;
    for (const std::int32_t n : chain) {
      if (distance(n, end) > to_corner * depths_[n] + 0.5) break;
      largest = std::max(largest, depths_[n]);
    }
    for (std::size_t i = 0; i + 1 < chain.size() && depths_[chain[i]] < rounding_of_ends * largest; ++i) remove(chain[i]);
  }
}

/** Removes branches that hardly leave the ball at the place where they start. True if there were any; then others may now be one.
 */
bool PathGraph::cut_hairs() {
  bool any = false;
  for (Chain& chain : chains()) {
    if (degree_[chain.front()] != 1) std::reverse(chain.begin(), chain.end());
    const std::int32_t tip = chain.front(), root = chain.back();
    if (degree_[tip] != 1 || degree_[root] < 3) continue;
    if (distance(tip, root) > depths_[root] + margin) continue;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) remove(chain[i]);
    any = true;
  }
  return any;
}

bool PathGraph::close_together(const Chain& chain) const {
  const std::int32_t a = chain.front(), b = chain.back();
  if (degree_[a] < 3 || degree_[b] < 3) return false;
  double length = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) length += distance(chain[i - 1], chain[i]);
  return length <= std::max(meeting * (depths_[a] + depths_[b]), nearby);
}

/** A curve through places, in spacings, at even steps and smooth; its ends stay. */
class Curve {
 public:
  explicit Curve(std::vector<Vector3> places) : places_(std::move(places)) {}

  void resample() {
    double length = 0;
    for (std::size_t i = 1; i < places_.size(); ++i) length += (places_[i] - places_[i - 1]).norm();
    const auto steps = static_cast<std::size_t>(std::max(1., std::round(length / node_spacing)));
    std::vector<Vector3> even{places_.front()};
    double passed = 0;
    for (std::size_t i = 1; i < places_.size(); ++i) {
      const double step = (places_[i] - places_[i - 1]).norm();
      while (even.size() < steps) {
        const double wanted = length * static_cast<double>(even.size()) / static_cast<double>(steps) - passed;
        if (wanted > step) break;
        even.push_back(places_[i - 1] + wanted / step * (places_[i] - places_[i - 1]));
      }
      passed += step;
    }
    even.push_back(places_.back());
    places_ = std::move(even);
  }

  /** Moves every place to the middle of its neighbors, unless `inside` says that it must not be there. */
  template <typename Inside>
  void smooth(const Inside& inside) {
    std::vector<Vector3> before;
    for (int step = 0; step < smoothing_steps; ++step) {
      before = places_;
      for (std::size_t i = 1; i + 1 < places_.size(); ++i) {
        const Vector3 moved = 0.25 * (before[i - 1] + 2 * before[i] + before[i + 1]);
        if (inside(moved)) places_[i] = moved;
      }
    }
  }

  const std::vector<Vector3>& places() const { return places_; }

 private:
  std::vector<Vector3> places_;
};

std::int32_t root_of(std::vector<std::int32_t>& above, std::int32_t node) {
  while (above[node] != node) node = above[node] = above[above[node]];
  return node;
}

/** Draws the curves, branch after branch from the root of each part. */
class Drawing {
 public:
  Drawing(const VoxelDomain& domain, const std::vector<double>& depth, const PathGraph& graph);
  CurveSkeleton draw();

 private:
  void join_hubs();
  void draw_chain(std::int32_t chain, std::int32_t from, std::int32_t parent);
  std::uint32_t add_node(const Vector3& place);
  std::uint32_t hub_node(std::int32_t hub);

  const VoxelDomain& domain_;
  const std::vector<double>& depth_;
  const PathGraph& graph_;
  std::vector<PathGraph::Chain> chains_;
  std::vector<std::int32_t> above_;              // joins the nodes of a hub
  std::vector<std::int32_t> deepest_;            // of a hub, by its root
  std::vector<std::uint32_t> nodes_;             // that were made for ends, by root
  std::vector<std::vector<std::int32_t>> at_;    // the chains that end there, by root
  std::vector<std::vector<std::int32_t>> hubs_;  // that are joined, by root
  std::vector<std::uint8_t> joined_, drawn_;
  CurveSkeleton skeleton_;
};

Drawing::Drawing(const VoxelDomain& domain, const std::vector<double>& depth, const PathGraph& graph)
    : domain_(domain), depth_(depth), graph_(graph), chains_(graph.chains()) {}

/** Short chains between hubs become part of one. */
void Drawing::join_hubs() {
  const auto count = static_cast<std::size_t>(graph_.size());
  above_.resize(count), deepest_.resize(count), nodes_.assign(count, no_index), at_.resize(count), hubs_.resize(count);
  for (std::int32_t n = 0; n < graph_.size(); ++n) {
    above_[n] = deepest_[n] = n;
    if (graph_.degree(n) > 2) hubs_[n].assign(1, n);
  }
  joined_.resize(chains_.size()), drawn_.resize(chains_.size());
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    if (!graph_.close_together(chains_[c])) continue;
    const std::int32_t a = root_of(above_, chains_[c].front()), b = root_of(above_, chains_[c].back());
    if (a == b) {
      joined_[c] = 1;
      continue;
    }
    // The deepest place along, and of what is joined there already; from all of it, the straight way there is inside.
    std::int32_t best = deepest_[a];
    const auto deeper = [&](std::int32_t n) {
      const double more = graph_.depth(n) - graph_.depth(best);
      return more > 1e-6 || (more > -1e-6 && n < best);
    };
    if (deeper(deepest_[b])) best = deepest_[b];
    for (const std::int32_t n : chains_[c]) {
      if (deeper(n)) best = n;
    }
    const auto near = [&](std::int32_t n) {
      return (graph_.place(n) - graph_.place(best)).norm() <= std::max(meeting * (graph_.depth(n) + graph_.depth(best)), nearby);
    };
    if (!std::all_of(hubs_[a].begin(), hubs_[a].end(), near) || !std::all_of(hubs_[b].begin(), hubs_[b].end(), near)) continue;
    joined_[c] = 1;
    above_[b] = a;
    deepest_[a] = best;
    hubs_[a].insert(hubs_[a].end(), hubs_[b].begin(), hubs_[b].end());
    hubs_[b].clear();
  }
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    if (joined_[c]) continue;
    const std::int32_t a = root_of(above_, chains_[c].front()), b = root_of(above_, chains_[c].back());
    at_[a].push_back(static_cast<std::int32_t>(c));
    if (b != a) at_[b].push_back(static_cast<std::int32_t>(c));
  }
}

CurveSkeleton Drawing::draw() {
  join_hubs();
  // Deepest hub first, and ends after hubs: each part is drawn from the first that it has.
  const Indices roots = sorted_indices(at_.size(), [&](std::uint32_t u, std::uint32_t v) {
    const auto a = static_cast<std::int32_t>(u), b = static_cast<std::int32_t>(v);
    const bool hub_a = at_[a].size() > 1, hub_b = at_[b].size() > 1;
    if (hub_a != hub_b) return hub_a;
    const auto key = [&](std::int32_t n) { return std::llround(graph_.depth(deepest_[n]) * 1e6); };
    return key(a) != key(b) ? key(a) > key(b) : a < b;
  });
  std::vector<std::array<std::int32_t, 2>> waiting;  // an end, and the branch that leads to it
  for (const std::uint32_t root : roots) {
    waiting.assign(1, {static_cast<std::int32_t>(root), -1});
    for (std::size_t head = 0; head < waiting.size(); ++head) {
      const auto [end, parent] = waiting[head];
      for (const std::int32_t c : at_[end]) {
        if (drawn_[c]) continue;
        const auto before = skeleton_.branches.size();
        draw_chain(c, end, parent);
        if (skeleton_.branches.size() == before) continue;
        const std::int32_t a = root_of(above_, chains_[c].front()), b = root_of(above_, chains_[c].back());
        waiting.push_back({a == end ? b : a, static_cast<std::int32_t>(before)});
      }
    }
  }
  return std::move(skeleton_);
}

std::uint32_t Drawing::add_node(const Vector3& place) {
  const Vector3 at = domain_.grid().origin + domain_.grid().spacing * place;
  skeleton_.nodes.push_back({at, inner_depth(domain_, depth_, at)});
  return static_cast<std::uint32_t>(skeleton_.nodes.size() - 1);
}

std::uint32_t Drawing::hub_node(std::int32_t hub) {
  if (nodes_[hub] == no_index) {
    nodes_[hub] = add_node(graph_.place(deepest_[hub]));
    if (at_[hub].size() > 1) skeleton_.hubs.push_back(nodes_[hub]);
  }
  return nodes_[hub];
}

void Drawing::draw_chain(std::int32_t c, std::int32_t from, std::int32_t parent) {
  drawn_[c] = 1;
  PathGraph::Chain chain = chains_[c];
  if (root_of(above_, chain.front()) != from) std::reverse(chain.begin(), chain.end());
  const std::int32_t to = root_of(above_, chain.back());
  SkeletonBranch branch;
  branch.parent = parent;
  branch.starts_free = graph_.degree(chain.front()) < 2;
  branch.ends_free = graph_.degree(chain.back()) < 2;

  std::vector<Vector3> places;
  for (const std::int32_t n : chain) places.push_back(graph_.place(n));
  places.front() = graph_.place(deepest_[from]), places.back() = graph_.place(deepest_[to]);
  if (branch.starts_free && branch.ends_free) {
    // A part that is hardly longer than thick: a ball, of which the paths see some diameter.
    const std::int32_t middle = *std::max_element(
        chain.begin(), chain.end(), [&](std::int32_t a, std::int32_t b) { return graph_.depth(a) < graph_.depth(b) - 1e-6; });
    if ((places.back() - places.front()).norm() < std::max(graph_.depth(middle), 1.)) {
      branch.nodes.push_back(add_node(graph_.place(middle)));
      skeleton_.branches.push_back(std::move(branch));
      return;
    }
  }
  Curve curve(std::move(places));
  curve.resample();
  curve.smooth([&](const Vector3& place) {
    return domain_.number(int(std::lround(place[0])), int(std::lround(place[1])), int(std::lround(place[2]))) >= 0;
  });
  curve.resample();
  const auto& drawn = curve.places();
  branch.nodes.push_back(hub_node(from));
  for (std::size_t i = 1; i + 1 < drawn.size(); ++i) branch.nodes.push_back(add_node(drawn[i]));
  branch.nodes.push_back(hub_node(to));
  skeleton_.branches.push_back(std::move(branch));
}

}  // namespace

CurveSkeleton curve_skeleton(const VoxelDomain& domain, const std::vector<double>& depth) {
  PathGraph graph(domain, depth, voxel_paths(domain, depth));
  graph.trim_ends();
  while (graph.cut_hairs()) {
  }
  return Drawing(domain, depth, graph).draw();
}

double smooth_length(const CurveSkeleton& skeleton) {
  double sum = 0, squares = 0, longest = 0;
  for (const SkeletonBranch& branch : skeleton.branches) {
    double length = 0;
    for (std::size_t i = 1; i < branch.nodes.size(); ++i)
      length += (skeleton.nodes[branch.nodes[i]].place - skeleton.nodes[branch.nodes[i - 1]].place).norm();
    sum += length;
    squares += length * length;
    longest = std::max(longest, length + skeleton.nodes[branch.nodes.front()].radius + skeleton.nodes[branch.nodes.back()].radius);
  }
  return skeleton.hubs.empty() || !(sum > 0) ? longest : 0.5 * squares / sum;
}

Indices tips(const CurveSkeleton& skeleton) {
  Indices found;
  for (const SkeletonBranch& branch : skeleton.branches) {
    if (branch.starts_free) found.push_back(branch.nodes.front());
    if (branch.ends_free) found.push_back(branch.nodes.back());
  }
  sort(found, [](std::uint32_t u, std::uint32_t v) { return u < v; });
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace handlebody
