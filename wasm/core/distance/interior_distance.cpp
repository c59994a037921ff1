#include "core/distance/interior_distance.hpp"

#include "core/distance/fast_marching.hpp"

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

}  // namespace

std::unique_ptr<InteriorDistance> make_interior_distance(DistanceMethod method, const VoxelDomain& domain) {
  switch (method) {
    case DistanceMethod::fast_marching:
      return std::make_unique<Marching>(domain);
    case DistanceMethod::euclidean:
      break;
  }
  return std::make_unique<Straight>(domain);
}

}  // namespace handlebody
