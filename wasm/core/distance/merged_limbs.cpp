#include "core/distance/merged_limbs.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/indices.hpp"

namespace handlebody {
namespace {

constexpr int detour = 8;  // voxels; the paper's geodesics around a crotch are shorter
constexpr std::size_t most_links = 4000;

}  // namespace

void find_crossed_links(const VoxelDomain& domain, const SurfaceCrossings& crossings, bool closed,
                        std::vector<CrossedLink>& links) {
  const int count = domain.grid().dims[crossings.axis()];
  for (std::size_t line = 0; line < crossings.lines(); ++line) {
    const auto* crossing = crossings.begin(line);
    const auto* end = crossings.end(line);
    const std::int64_t first = crossings.first_voxel(line), stride = crossings.stride();
    int winding = 0;
    for (int i = 0; i + 1 < count && crossing != end; ++i) {
      for (; crossing != end && crossing->at < i; ++crossing) winding += crossing->sign;
      const std::int32_t from = domain.number(first + stride * i), to = domain.number(first + stride * (i + 1));
      if (from < 0 || to < 0) continue;
      double gap = -1;
      int around = winding;
      for (const auto* c = crossing; c != end && c->at < i + 1; ++c) {
        around += c->sign;
        if (c + 1 == end || c[1].at >= i + 1) break;
        if (!closed || around == 0) gap = std::max(gap, c[1].at - c->at);
      }
      if (gap >= 0) links.push_back({from, to, gap});
    }
  }
}

MergedLimbs find_merged_limbs(const VoxelDomain& domain, const std::vector<CrossedLink>& links) {
  MergedLimbs merged;
  if (links.empty()) return merged;
  const std::vector<std::int32_t> neighbors = domain.face_neighbors();
  const auto none = static_cast<std::int32_t>(domain.size());
  // A bit for each side of a voxel that is a crossed link.
  std::vector<std::uint8_t> cut(static_cast<std::size_t>(none) + 1);
  for (const CrossedLink& link : links) {
    for (int side = 0; side < 6; ++side) {
      if (neighbors[6 * std::size_t(link.from) + side] == link.to) cut[link.from] |= 1u << side, cut[link.to] |= 1u << (side ^ 1);
    }
  }

  std::vector<std::int32_t> seen(cut.size(), -1), queue;
  const auto near = [&](std::int32_t number, std::int32_t from, std::int32_t to) {
    queue.assign(1, from);
    seen[from] = number;
    std::size_t head = 0;
    for (int step = 0; step < detour; ++step) {
      for (const std::size_t layer = queue.size(); head < layer; ++head) {
        for (int side = 0; side < 6; ++side) {
          const std::int32_t u = neighbors[6 * std::size_t(queue[head]) + side];
          if (u == none || seen[u] == number || (cut[queue[head]] >> side & 1)) continue;
          if (u == to) return true;
          seen[u] = number;
          queue.push_back(u);
        }
      }
    }
    return false;
  };
  const std::size_t stride = (links.size() + most_links - 1) / most_links;
  Indices matter;
  for (std::size_t k = 0; k < links.size(); k += stride) {
    if (!near(static_cast<std::int32_t>(k), links[k].from, links[k].to)) matter.push_back(static_cast<std::uint32_t>(k));
  }
  merged.links = static_cast<Index>(matter.size() * stride);
  if (matter.empty()) return merged;

  // Clusters: links whose first voxels touch, by corners too.
  std::vector<std::int32_t> link_at(cut.size(), -1), next(matter.size(), -1);
  for (std::size_t k = 0; k < matter.size(); ++k) {
    std::int32_t& at = link_at[links[matter[k]].from];
    next[k] = at, at = static_cast<std::int32_t>(k);
  }
  std::vector<std::uint8_t> taken(matter.size());
  Indices cluster, largest;
  const int reach = stride > 1 ? 3 : 1;
  for (std::uint32_t seed = 0; seed < matter.size(); ++seed) {
    if (taken[seed]) continue;
    taken[seed] = true;
    cluster.assign(1, seed);
    for (std::size_t head = 0; head < cluster.size(); ++head) {
      const auto at = domain.grid().cell(domain.voxels()[links[matter[cluster[head]]].from]);
      for (int k = -reach; k <= reach; ++k) {
        for (int j = -reach; j <= reach; ++j) {
          for (int i = -reach; i <= reach; ++i) {
            const std::int32_t u = domain.number(at[0] + i, at[1] + j, at[2] + k);
            for (std::int32_t l = u < 0 ? -1 : link_at[u]; l >= 0; l = next[l]) {
              if (!taken[l]) taken[l] = true, cluster.push_back(static_cast<std::uint32_t>(l));
            }
          }
        }
      }
    }
    if (cluster.size() > largest.size()) largest.swap(cluster);
  }

  const auto middle = [&](std::uint32_t k) {
    return Vector3((domain.center(links[matter[k]].from) + domain.center(links[matter[k]].to)) / 2);
  };
  Vector3 mean = Vector3::Zero();
  for (const std::uint32_t k : largest) mean += middle(k) / static_cast<double>(largest.size());
  double best = -1;
  for (const std::uint32_t k : largest) {
    const double distance = (middle(k) - mean).norm();
    if (best < 0 || distance < best) best = distance, merged.place = middle(k);
  }
  sort(largest, [&](std::uint32_t a, std::uint32_t b) {
    const double u = links[matter[a]].gap, v = links[matter[b]].gap;
    return u < v || (u == v && a < b);
  });
  merged.gap = links[matter[largest[largest.size() / 10]]].gap;
  return merged;
}

}  // namespace handlebody
