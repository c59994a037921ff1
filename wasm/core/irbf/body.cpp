#include "core/irbf/body.hpp"

#include <cmath>

#include "core/numerics/indices.hpp"

namespace handlebody {

namespace {

constexpr Index most_vertices = 4'000'000;
constexpr Index most_triangles = 8'000'000;
constexpr double most_smooth_length = 1e3;  // diagonals: kernels as wide tell places no longer apart
constexpr double most_stretch = 1e6;        // half the long axis of an ellipsoid, in radii
constexpr Index fewest_vertices = 4;        // the corners of the smallest volume

Error invalid_body(std::initializer_list<Word> message) {
  return {HB_ERROR_BODY_INVALID, message, {"Bake the model again with this version."}};
}

}  // namespace

Points Body::solver_positions() const {
  return (positions.rowwise() - normalization.center.transpose()) / normalization.diagonal;
}

Vector3 Body::center_position(Index center) const {
  return normalization.to_solver(positions.row(centers[center]).transpose());
}

Result<Done> check_mesh_size(std::int64_t vertices, std::int64_t triangles) {
  if (vertices <= most_vertices && triangles <= most_triangles) return Done{};
  return Error(
      HB_ERROR_MESH_TOO_LARGE,
      {"The mesh has ", vertices, " vertices and ", triangles, " triangles; the solver takes up to 4 million and 8 million."},
      {"Simplify the mesh first."});
}

Result<Done> check_mesh(const ConstPoints& positions, const ConstTriangles& triangles, bool cloud) {
  if (auto checked = check_mesh_size(positions.rows(), triangles.rows()); !checked) return checked.error();
  if (positions.rows() < fewest_vertices) {
    return Error(
        HB_ERROR_MESH_TOO_FEW_VERTICES,
        {"The mesh has ", positions.rows(), (positions.rows() == 1 ? " vertex" : " vertices"), "; a volume needs at least four."},
        {"Give a closed triangle mesh."});
  }
  for (Index v = 0; v < positions.rows(); ++v) {
    if (positions.row(v).allFinite()) continue;
    return Error(HB_ERROR_MESH_NOT_FINITE, {"Vertex ", v, " has a coordinate that is not a finite number."},
                 {"Repair or remove that vertex and export the model again."}, HB_CULPRIT_VERTEX, v);
  }
  if (triangles.rows() == 0 && !cloud) {
    return Error(HB_ERROR_MESH_NO_TRIANGLES, {"The mesh has no triangles, so it encloses no volume."},
                 {"Give a triangle mesh, or a dense point cloud: positions without a list of triangles."});
  }
  for (Index t = 0; t < triangles.rows(); ++t) {
    const std::uint32_t highest = triangles.row(t).maxCoeff();
    if (in_range(highest, positions.rows())) continue;
    return Error(HB_ERROR_MESH_INDEX_OUT_OF_RANGE,
                 {"Triangle ", t, " uses vertex ", highest, ", but there are only ", positions.rows(), "."},
                 {"Export the model again; its index list does not fit its vertices."}, HB_CULPRIT_TRIANGLE, t);
  }
  return Done{};
}

Result<Done> check_extent(const Normalization& normalization) {
  // Squares of coordinates must neither overflow nor vanish.
  if (!(normalization.diagonal < 1e150)) {
    return Error(HB_ERROR_MESH_NOT_FINITE, {"The model's coordinates are too large to compute with."}, {"Scale the model down."});
  }
  if (!(normalization.diagonal > 1e-150)) {
    return Error(HB_ERROR_MESH_ZERO_EXTENT, {"All vertices of the mesh coincide."}, {"Give a mesh with some extent."});
  }
  return Done{};
}

Normalization normalize(const ConstPoints& positions) {
  const Vector3 low = positions.colwise().minCoeff();
  const Vector3 high = positions.colwise().maxCoeff();
  return {low + (high - low) / 2, (high - low).norm()};
}

Result<Done> check_body(const Body& body) {
  if (auto checked = check_mesh(body.positions, body.triangles, true); !checked) return checked.error();
  if (auto checked = check_extent(normalize(body.positions)); !checked) return checked.error();
  const Normalization& normalization = body.normalization;
  if (!normalization.center.allFinite() || !std::isfinite(normalization.diagonal) || normalization.diagonal <= 0) {
    return invalid_body({"The baked body's normalization is not a finite center and a positive diagonal."});
  }
  if (body.centers.empty() || body.domain.size() == 0 || body.spheres.empty()) {
    return invalid_body({"The baked body has no centers, no voxels or no spheres."});
  }
  for (std::size_t c = 0; c < body.centers.size(); ++c) {
    if (in_range(body.centers[c], body.positions.rows())) continue;
    return invalid_body({"Center ", c, " of the baked body is vertex ", body.centers[c], ", which the mesh does not have."});
  }
  if (body.distances.size() != body.centers.size() * body.domain.voxels().size() || !std::isfinite(body.distance_scale) ||
      body.distance_scale <= 0) {
    return invalid_body({"The baked body's interior distances do not fit its centers and voxels."});
  }
  if (!(body.smooth_length >= 0 && body.smooth_length <= most_smooth_length))
    return invalid_body({"The baked body's smooth length is not a number from 0 to ", most_smooth_length, "."});
  for (std::size_t s = 0; s < body.spheres.size(); ++s) {
    const Sphere& sphere = body.spheres[s];
    if (!(sphere.center.allFinite() && std::isfinite(sphere.radius) && sphere.radius > 0))
      return invalid_body({"Sphere ", s, " of the baked body has no finite center and positive radius."});
    const double half = sphere.axis.norm();
    if (half == 0 || (half >= sphere.radius && half < most_stretch * sphere.radius)) continue;
    return invalid_body({"Sphere ", s, " of the baked body has an axis that is not from 1 to ", most_stretch, " radii long."});
  }
  return Done{};
}

}  // namespace handlebody
