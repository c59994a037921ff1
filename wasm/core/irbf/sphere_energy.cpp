#include "core/irbf/sphere_energy.hpp"

#include <cmath>

namespace handlebody {

namespace {

constexpr double automatic_part = 3e-4;

}  // namespace

Result<SphereEnergy> make_sphere_energy(const Body& body, const Basis& basis, double exponent, SphereStructure structure) {
  const Index centers = basis.size();
  InteriorSamples samples;
  std::vector<StructureEdges> structures;
  Index beside = 0;
  for (const Sphere& sphere : body.spheres) {
    structures.push_back(structure_edges(sphere, structure));
    for (const Vector3& point : structures.back().points) samples.add(body.domain, point);
    const Index edges = std::ssize(structures.back().edges);
    beside += edges > 3 ? edges : 0;
  }
  Matrix phi = Matrix::Zero(samples.size(), centers);
  if (auto done = basis.evaluate<double>(samples, phi); !done) return done.error();

  SphereEnergy energy;
  const Index rows = 3 * std::ssize(body.spheres);
  energy.edges.resize(rows, 3);
  energy.edge_scale.resize(rows);
  energy.rows = MatrixXd::Zero(rows, 4 + centers);
  energy.beside = MatrixXd::Zero(beside, 4 + centers);
  Index row = 0, first = 0, next = 0;
  for (std::size_t b = 0; b < structures.size(); ++b, row += 3) {
    const Sphere& sphere = body.spheres[b];
    const StructureEdges& made = structures[b];
    const Matrix3 axes = half_axes(sphere);
    const Index count = std::ssize(made.edges);
    // A structure is as symmetric as its axes are, so that E goes into them, each by itself. Of n points as evenly spread as these,
    // a component along an axis squares to n/3 of half the axis squared. std::pow is 4 kB of tables.
    const double spread = std::sqrt(static_cast<double>(count) / 3);
    const double root = std::sqrt(made.share) * std::exp(exponent / 2 * std::log(2 * sphere.radius));
    const auto difference = [&](const StructureEdges::Edge& edge) {
      return root * edge.scale * (phi.row(first + Index(edge.to)) - phi.row(first + Index(edge.from)));
    };
    Points part(count, 3);  // Q
    for (Index axis = 0; axis < 3; ++axis) {
      const double half = axis == 0 && is_long(sphere) ? sphere.axis.norm() : sphere.radius;
      const Vector3 along = axes.col(axis) / half;
      for (Index i = 0; i < count; ++i) {
        const auto& [from, to, scale] = made.edges[i];
        part(i, axis) = scale * (made.points[to] - made.points[from]).dot(along) / (2 * half * spread);
      }
      energy.edges.row(row + axis) = 2 * root * spread * axes.col(axis).transpose();
      energy.edge_scale(row + axis) = 1 / (root * spread);
      energy.rows.row(row + axis).head<3>() = energy.edges.row(row + axis);
      auto coefficients = energy.rows.row(row + axis).tail(centers);
      for (Index i = 0; i < count; ++i) {
        if (part(i, axis) != 0) coefficients += part(i, axis) * difference(made.edges[i]);
      }
      energy.curvature += sphere.radius / half * (sphere.radius / half) * coefficients.squaredNorm();
    }
    for (Index i = 0; count > 3 && i < count; ++i, ++next) {
      energy.beside.row(next).tail(centers) = difference(made.edges[i]);
      for (Index axis = 0; axis < 3; ++axis)
        energy.beside.row(next).tail(centers) -= part(i, axis) * energy.rows.row(row + axis).tail(centers);
    }
    first += std::ssize(made.points);
  }
  return energy;
}

double automatic_smoothness(const SphereEnergy& energy) {
  return automatic_part * energy.curvature;
}

}  // namespace handlebody
