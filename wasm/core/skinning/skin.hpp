// What every deformation of a shape by a few moving handles has in common: n rest positions vᵢ in the plane or in space (d = 2, 3),
// and h handles, each with an affine transform Tⱼ. How the handles deform the shape is up to the method.
#pragma once

#include <memory>
#include <vector>

#include "core/errors/result.hpp"
#include "core/numerics/types.hpp"

namespace handlebody {

class Skin {
 public:
  virtual ~Skin() = default;

  Index vertices() const { return vertices_; }
  Index dimension() const { return dimension_; }
  Index handles() const { return handles_; }

  /** h transforms, each d × (d + 1) row-major, that take [v; 1] to its image. The identity at first; write them in place. */
  double* transforms() { return transforms_.data(); }

  /** The deformed positions (n×d) under the present transforms. Allocates nothing. Fails with TARGET_NOT_FINITE (culprit: the
   * handle) and writes nothing where a transform has a number that single precision cannot hold. */
  Result<Done> deform(float* out);

 protected:
  Skin(Index vertices, Index dimension, Index handles);

  /** deform() with transforms that were checked. */
  virtual void move(float* out) = 0;

  Index vertices_, dimension_, handles_;
  std::vector<double> transforms_;
};

/** The input of blending, row-major: `positions` vertices × dimension, `weights` vertices × handles. */
struct WeightedShape {
  const double *positions, *weights;
  Index vertices, dimension, handles;
};

/** Fails with INVALID_SHAPE (a dimension other than 2 and 3, no vertex, no handle), MESH_NOT_FINITE or VALUE_NOT_FINITE (culprits:
 * the vertex) where a number is NaN, infinite or too large for single precision, or OUT_OF_MEMORY where `floats`, which the method
 * is going to keep, are more than a GiB. */
Result<Done> check_shape(const WeightedShape& shape, double floats);

/** The middle of the bounding box, rounded to floats: the origin for coordinates in single precision. */
void box_center(const double* positions, Index vertices, Index dimension, double* center);

}  // namespace handlebody
