#include "core/distance/interior_distance.hpp"

#include <utility>

#include "core/distance/fast_marching.hpp"
#include "core/distance/heat_distance.hpp"
#include "core/distance/mean_value_distance.hpp"

namespace handlebody {
namespace {

class Straight final : public InteriorDistance {
 public:
  explicit Straight(const VoxelDomain& domain) : domain_(&domain) {}
  void measure(const Vector3& source, double* distances) override {
    for (Index v = 0; v < domain_->size(); ++v) distances[v] = (domain_->center(v) - source).norm();
  }

 private:
  const VoxelDomain* domain_;
};

class Marching final : public InteriorDistance {
 public:
  explicit Marching(const VoxelDomain& domain) : marching_(domain) {}
  void measure(const Vector3& source, double* distances) override { marching_.march(source, distances); }

 private:
  FastMarching marching_;
};

class Heat final : public InteriorDistance {
 public:
  explicit Heat(const VoxelDomain& domain) : heat_(domain) {}
  Result<double> step() override { return heat_.step(); }
  void measure(const Vector3& source, double* distances) override { heat_.measure(source, distances); }

 private:
  HeatDistance heat_;
};

class MeanValue final : public InteriorDistance {
 public:
  explicit MeanValue(MeanValueDistance begun) : distance_(std::move(begun)) {}
  Result<double> step() override { return distance_.step(); }
  void measure(const Vector3& source, double* distances) override { distance_.measure(source, distances); }

 private:
  MeanValueDistance distance_;
};

}  // namespace

Result<std::unique_ptr<InteriorDistance>> make_interior_distance(DistanceMethod method, const VoxelDomain& domain,
                                                                 const Points& positions, const Triangles& triangles) {
  std::unique_ptr<InteriorDistance> made;
  switch (method) {
    case DistanceMethod::fast_marching:
      made = std::make_unique<Marching>(domain);
      break;
    case DistanceMethod::euclidean:
      made = std::make_unique<Straight>(domain);
      break;
    case DistanceMethod::heat:
      made = std::make_unique<Heat>(domain);
      break;
    case DistanceMethod::mean_value: {
      auto begun = MeanValueDistance::begin(positions, triangles, domain);
      if (!begun) return begun.error();
      made = std::make_unique<MeanValue>(std::move(*begun));
      break;
    }
  }
  return made;
}

}  // namespace handlebody
