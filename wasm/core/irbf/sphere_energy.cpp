#include "core/irbf/sphere_energy.hpp"

#include <cmath>

#include "core/irbf/handle_constraints.hpp"

namespace handlebody {

namespace {

constexpr double automatic_part = 3e-4;

}  // namespace

Result<SphereEnergy> make_sphere_energy(const Body& body, const Basis& basis, double exponent) {
  const Index rows = 3 * std::ssize(body.spheres), centers = basis.size();
  InteriorSamples samples;
  for (const Sphere& sphere : body.spheres)
    for (Index i = 0; i < 6; ++i) samples.add(body.domain, structure_point(sphere.center, sphere.radius, i));
  Matrix phi = Matrix::Zero(samples.size(), centers);
  if (auto done = basis.evaluate<double>(samples, phi); !done) return done.error();

  SphereEnergy energy;
  energy.edges.resize(rows, 3);
  energy.edge_scale.resize(rows);
  energy.rows = MatrixXd::Zero(rows, 4 + centers);
  for (Index row = 0; row < rows; ++row) {
    const Vector3 edge = samples.point(2 * row + 1) - samples.point(2 * row);
    const double root = std::exp(exponent / 2 * std::log(edge.norm()));  // std::pow is 4 kB of tables
    energy.edges.row(row) = root * edge;
    energy.edge_scale(row) = 1 / root;
    energy.rows.row(row).head<3>() = root * edge;
    energy.rows.row(row).tail(centers) = root * (phi.row(2 * row + 1) - phi.row(2 * row));
  }
  return energy;
}

double automatic_smoothness(const SphereEnergy& energy) {
  return automatic_part * energy.rows.rightCols(energy.rows.cols() - 4).squaredNorm();
}

}  // namespace handlebody
