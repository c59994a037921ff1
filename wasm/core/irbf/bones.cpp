#include "core/irbf/bones.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace handlebody {
namespace {

constexpr double slack = 0.5;       // radii by which a straight run may leave its line
constexpr double least_length = 4;  // of a run, in radii
constexpr int places = 64;          // along a bone where its thickness is bounded

/** How far a place is from a line of two ends. */
double away_from(const Vector3& place, const Vector3& from, const Vector3& to) {
  const Vector3 along = to - from;
  const double part = along.isZero(0) ? 0 : std::clamp((place - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (place - from - part * along).norm();
}

class Runs {
 public:
  Runs(const CurveSkeleton& skeleton, const Indices& nodes) : skeleton_(skeleton), nodes_(nodes) {}

  void cut(std::size_t first, std::size_t last, std::vector<Bone>& bones) const {
    if (last <= first) return;
    std::size_t farthest = first;
    double most = slack, radii = 0;
    for (std::size_t i = first; i <= last; ++i) {
      radii += node(i).radius;
      const double away = away_from(node(i).place, node(first).place, node(last).place) / std::max(node(i).radius, tiny);
      if (i > first && i < last && away > most) most = away, farthest = i;
    }
    if (farthest > first) {
      cut(first, farthest, bones);
      cut(farthest, last, bones);
      return;
    }
    const double mean = radii / static_cast<double>(last - first + 1);
    if ((node(last).place - node(first).place).norm() >= least_length * mean)
      bones.push_back({node(first).place, node(last).place});
  }

  const SkeletonNode& node(std::size_t i) const { return skeleton_.nodes[nodes_[i]]; }

 private:
  static constexpr double tiny = 1e-300;
  const CurveSkeleton& skeleton_;
  const Indices& nodes_;
};

/** Whether a sphere reaches into an ellipsoid: its center into one that is larger by its radius, which is nearly the same. */
bool reaches(const Vector3& center, double radius, const Sphere& ellipsoid) {
  const double half = ellipsoid.axis.norm(), along = (center - ellipsoid.center).dot(ellipsoid.axis) / half;
  const double across = (center - ellipsoid.center - along / half * ellipsoid.axis).norm();
  const double a = along / (half + radius), b = across / (ellipsoid.radius + radius);
  return a * a + b * b < 0.999;
}

/** Of two ellipsoids, whether the middle half of the first reaches into the other: bones meet at their ends. */
bool overlap(const Sphere& sphere, const Sphere& ellipsoid) {
  if (!is_long(sphere)) return reaches(sphere.center, sphere.radius, ellipsoid);
  for (const double part : {-0.5, -0.25, 0.0, 0.25, 0.5})
    if (reaches(sphere.center + part * sphere.axis, sphere.radius * std::sqrt(1 - part * part), ellipsoid)) return true;
  return false;
}

std::int32_t nearest_branch(const CurveSkeleton& skeleton, const Vector3& place) {
  std::int32_t best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < skeleton.branches.size(); ++b) {
    for (const std::uint32_t node : skeleton.branches[b].nodes) {
      const double away = (skeleton.nodes[node].place - place).norm();
      if (away < least) least = away, best = static_cast<std::int32_t>(b);
    }
  }
  return best;
}

}  // namespace

std::vector<Bone> straight_bones(const CurveSkeleton& skeleton) {
  std::vector<Bone> bones;
  for (const SkeletonBranch& branch : skeleton.branches) {
    const Runs runs(skeleton, branch.nodes);
    // What lies within the ball at the branch's start belongs to what it grows from.
    std::size_t first = 0;
    const std::size_t count = branch.nodes.size();
    if (!branch.starts_free)
      while (first < count && (runs.node(first).place - runs.node(0).place).norm() < runs.node(0).radius) ++first;
    if (first < count) runs.cut(first, count - 1, bones);
  }
  return bones;
}

std::optional<Sphere> bone_ellipsoid(const VoxelDomain& domain, const std::vector<double>& depth, const Bone& bone, double shrink) {
  const Grid& grid = domain.grid();
  const Vector3 center = (bone.from + bone.to) / 2, axis = (bone.to - bone.from) / 2;
  double radius = axis.norm();
  if (!(radius > 0)) return std::nullopt;
  for (int i = -places; i <= places; ++i) {
    const double part = static_cast<double>(i) / places;
    const Vector3 place = center + part * axis;
    const std::int32_t voxel = domain.nearest(place);
    if (voxel < 0 || (domain.center(voxel) - place).norm() > grid.spacing) return std::nullopt;
    const double across = std::sqrt(1 - part * part);
    if (across > 0) radius = std::min(radius, shrink * depth[voxel] / across);
  }
  // A bone through voxels on the surface still has an extent.
  return Sphere{center, std::min(std::max(radius, 0.05 * grid.spacing), axis.norm()), axis};
}

void add_bones(const std::vector<Sphere>& ellipsoids, const CurveSkeleton& skeleton, std::vector<Sphere>& spheres,
               std::vector<std::int32_t>& branches) {
  std::vector<Sphere> bones;
  std::vector<std::int32_t> on;
  const auto free = [&](const Sphere& sphere) {
    return std::none_of(bones.begin(), bones.end(), [&](const Sphere& bone) { return overlap(sphere, bone); });
  };
  for (const Sphere& ellipsoid : ellipsoids) {
    if (!free(ellipsoid)) continue;
    bones.push_back(ellipsoid);
    on.push_back(nearest_branch(skeleton, ellipsoid.center));
  }
  std::vector<Sphere> all = bones;
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    if (!free(spheres[s])) continue;
    all.push_back(spheres[s]);
    on.push_back(branches[s]);
  }
  spheres.swap(all);
  branches.swap(on);
}

}  // namespace handlebody
