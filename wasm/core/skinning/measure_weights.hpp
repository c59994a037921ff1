// How well skinning weights do what is asked of them (lecture, "Requirements on weights"): smooth, local, shape-aware, bounded, a
// partition of unity. Each measure is the worst number over the mesh. Weights may come from anywhere.
//
// Distances inside the shape, d(v, j) of a vertex from a handle, are lengths of shortest paths along edges (Dijkstra), a little
// longer than the true ones, and infinite between separate parts; straight distances may lead outside the shape.
#pragma once

#include "core/skinning/held_vertices.hpp"

namespace handlebody {

struct WeightMeasures {
  /** The largest jump of ∇wⱼ across a face between two simplices, over the largest |∇wⱼ|; the worst j. */
  double gradient_jump = 0;
  /** The largest |wⱼ| at a vertex where d(v, j) is more than twice the distance inside to the nearest handle. */
  double far_weight = 0;
  /** The largest |wⱼ| where handle j is the nearest in a straight line, but inside it is half as far again, and another handle is
   * nearer. NaN where the shape has no such place. */
  double leaked_weight = 0;
  double sum_error = 0;  // the largest |Σⱼ wⱼ − 1|
  double least = 0, largest = 0;
  Vector support;  // h: the part of the area or volume where |wⱼ| > 0.01 in the mean of a simplex's corners
};

/** Measures `weights` (n×h) of the handles on a mesh. Handles may share vertices, or hold none. Simplices without volume have no
 * gradient and are left out. Takes O(h (n + m) log n). Fails with the codes of check_simplex_mesh(), HANDLES_MISSING,
 * HANDLE_OUT_OF_RANGE, INVALID_SHAPE, VALUE_NOT_FINITE (a weight beyond 1e60; culprit: the vertex) or OUT_OF_MEMORY. */
Result<WeightMeasures> measure_weights(const SimplexMesh& mesh, const HeldVertices& held, const Eigen::Ref<const Matrix>& weights);

}  // namespace handlebody
