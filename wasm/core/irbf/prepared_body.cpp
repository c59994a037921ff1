#include "core/irbf/prepared_body.hpp"

#include <cmath>
#include <utility>

#include "core/irbf/sphere_energy.hpp"
#include "core/mesh/vertex_normals.hpp"

namespace handlebody {

namespace {

constexpr double most_bytes = 1.5e9;

/** Vertices farther than this from the middle, in diagonals, are none that triangles use. They move as the place at this distance
 * on their way to the middle does: wherever they are, kernels and floats can hold it. */
constexpr double farthest_place = 4;

Error invalid_option(const char* name, double value, const char* remedy) {
  return {HB_ERROR_INVALID_OPTION, {"IRBF's ", name, " is ", value, "."}, {remedy}, HB_CULPRIT_OPTION};
}

Result<Done> check_options(const IrbfOptions& options) {
  const double width = options.kernel.width;
  if (!(width >= 0) || !std::isfinite(width))
    return invalid_option("relative width", width, "Use a positive number, such as 2, or have it chosen.");
  if (options.kernel.kind > KernelKind::custom || options.kernel.kind == KernelKind::clamped_plate)
    return invalid_option("kernel", static_cast<double>(options.kernel.kind), "Use a radial kernel of the list.");
  if (options.smoothness != 0 && !(options.smoothness >= 1e-12 && options.smoothness <= 1e6))
    return invalid_option("smoothness", options.smoothness, "Use a number from 1e-12 to 1e6, such as 1e-6, or have it chosen.");
  if (!(options.anchor_weight > 0) || !(options.anchor_weight <= 1e6))
    return invalid_option("anchor weight", options.anchor_weight, "Use a positive number up to 1e6, such as 100.");
  if (!std::isfinite(options.edge_exponent) || std::abs(options.edge_exponent) > 4)
    return invalid_option("edge exponent", options.edge_exponent, "Use a number from -4 to 4, such as 2.");
  if (!(options.poisson_ratio >= 0 && options.poisson_ratio <= 0.499))
    return invalid_option("Poisson ratio", options.poisson_ratio, "Use a number from 0 to 0.499, such as 0.4.");
  return Done{};
}

}  // namespace

PreparedBody::PreparedBody(Body from, const IrbfOptions& given)
    : options(given), body(std::move(from)), basis(body, given.kernel) {}

Result<std::shared_ptr<const PreparedBody>> PreparedBody::create(Body body, const IrbfOptions& options) {
  if (auto checked = check_options(options); !checked) return checked.error();
  if (auto checked = check_body(body); !checked) return checked.error();
  const auto centers = static_cast<double>(body.centers.size());
  const auto spheres = static_cast<double>(body.spheres.size());
  // The float matrix while the 16-bit one is made from it, the matrices of the unknowns, the hat matrix.
  double rows = 0;  // of points and edges, while matrices are made
  for (const Sphere& sphere : body.spheres)
    rows += is_long(sphere) ? 68 : options.structure == SphereStructure::octahedron ? 9 : 28;
  const double bytes = 6 * centers * static_cast<double>(body.positions.rows()) + 8 * (centers + 4) * (centers + 4 + rows) +
                       8 * 9 * spheres * spheres;
  if (bytes > most_bytes) {
    return Error(HB_ERROR_OUT_OF_MEMORY,
                 {"This body, with ", body.centers.size(), " centers, ", body.spheres.size(), " spheres and ",
                  body.positions.rows(), " vertices, would take ", bytes / 1e6, " MB."},
                 {"Bake it with fewer centers or spheres, or simplify the mesh."});
  }
  auto prepared = std::make_shared<PreparedBody>(std::move(body), options);
  if (auto done = prepared->prepare_spheres(); !done) return done.error();
  if (auto done = prepared->prepare_vertices(); !done) return done.error();
  return std::shared_ptr<const PreparedBody>(std::move(prepared));
}

Result<Done> PreparedBody::prepare_spheres() {
  const Index centers = basis.size();
  auto energy = make_sphere_energy(body, basis, options.edge_exponent, options.structure);
  if (!energy) return energy.error();
  smoothness = options.smoothness > 0 ? options.smoothness : automatic_smoothness(*energy);
  edge_rows = std::move(energy->rows);
  gram = MatrixXd::Zero(4 + centers, 4 + centers);
  gram.selfadjointView<Eigen::Lower>().rankUpdate(edge_rows.transpose());
  if (energy->beside.rows() > 0) gram.selfadjointView<Eigen::Lower>().rankUpdate(energy->beside.transpose());
  gram.diagonal().tail(centers).array() += smoothness;
  const Vector lengths = energy->edges.rowwise().norm().cwiseProduct(energy->edge_scale);
  anchor_weight = options.anchor_weight * std::sqrt(lengths.cwiseQuotient(energy->edge_scale.cwiseAbs2()).mean());
  edges = std::move(energy->edges);
  edge_scale = std::move(energy->edge_scale);

  // A rotation handle grips a ball about as large as the smaller spheres.
  double radii = 0;
  for (const Sphere& sphere : body.spheres) radii += sphere.radius;
  structure_radius = 0.5 * radii / static_cast<double>(body.spheres.size());
  return Done{};
}

Result<Done> PreparedBody::prepare_vertices() {
  weld = weld_vertices(body.positions);
  triangles = weld_triangles(weld, body.triangles);
  stored = body.positions.cast<float>();
  const Points solver = body.solver_positions();
  const Index count = std::ssize(weld.unique);
  InteriorSamples samples;
  rest.resize(count, 3);
  for (Index u = 0; u < count; ++u) {
    Vector3 point = solver.row(weld.unique[u]);
    const double away = point.norm();
    if (away > farthest_place) point *= farthest_place / away;
    samples.add(body.domain, point);
    rest.row(u) = point.cast<float>();
  }
  MatrixF matrix(count, basis.size());
  if (auto done = basis.evaluate<float>(samples, matrix); !done) return done.error();
  surface_ranges = ColumnRanges::of(matrix);
  kernel = std::make_unique<FrameKernel>(rest, matrix, options.precision);
  const double products = static_cast<double>(count) * static_cast<double>(edge_rows.size());
  if (edge_rows.rows() < basis.size() && products < most_handle_products) psi = std::move(matrix);
  rest_normals.resize(count, 3);
  vertex_normals(rest, triangles, rest_normals);
  return Done{};
}

}  // namespace handlebody
