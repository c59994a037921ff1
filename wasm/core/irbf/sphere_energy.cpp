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
    const StructureEdges& made = structures[b];
    const Matrix3 axes = half_axes(body.spheres[b]);
    const Index count = std::ssize(made.edges);
    // std::pow is 4 kB of tables.
    const double root = std::sqrt(made.share) * std::exp(exponent / 2 * std::log(2 * body.spheres[b].radius));
    // A structure is as symmetric as its axes are: E goes into them, each by itself. Components of edges along them, and their
    // norms.
    Points along(count, 3);
    Vector weights(count);
    Vector3 lengths = Vector3::Zero();
    for (Index i = 0; i < count; ++i) {
      const auto& [from, to, scale] = made.edges[i];
      const Vector3 edge = scale * (made.points[to] - made.points[from]);
      weights(i) = root * scale;
      for (Index axis = 0; axis < 3; ++axis) along(i, axis) = root * edge.dot(axes.col(axis)) / axes.col(axis).norm();
      lengths += along.row(i).transpose().cwiseAbs2();
    }
    lengths = lengths.cwiseSqrt();
    for (Index axis = 0; axis < 3; ++axis) {
      const double half = axes.col(axis).norm();
      energy.edges.row(row + axis) = lengths[axis] / half * axes.col(axis).transpose();
      energy.edge_scale(row + axis) = 2 * half / lengths[axis];
      energy.rows.row(row + axis).head<3>() = energy.edges.row(row + axis);
    }
    // Qᵀ times what the edges' rows are of the coefficients, then what is beside.
    const auto difference = [&](Index i) {
      const auto& edge = made.edges[i];
      return weights(i) * (phi.row(first + Index(edge.to)) - phi.row(first + Index(edge.from)));
    };
    for (Index i = 0; i < count; ++i) {
      for (Index axis = 0; axis < 3; ++axis) {
        const double part = along(i, axis) / lengths[axis];
        if (part != 0) energy.rows.row(row + axis).tail(centers) += part * difference(i);
      }
    }
    for (Index i = 0; count > 3 && i < count; ++i, ++next) {
      energy.beside.row(next).tail(centers) = difference(i);
      for (Index axis = 0; axis < 3; ++axis)
        energy.beside.row(next).tail(centers) -= along(i, axis) / lengths[axis] * energy.rows.row(row + axis).tail(centers);
    }
    first += std::ssize(made.points);
  }
  return energy;
}

double automatic_smoothness(const SphereEnergy& energy) {
  const Index centers = energy.rows.cols() - 4;
  double sum = 0;
  for (Index row = 0; row < energy.rows.rows(); ++row) {
    // As if an ellipsoid were no longer than thick: λ is not to follow from how long bones are.
    const auto sphere = energy.edges.middleRows<3>(row / 3 * 3).rowwise().squaredNorm();
    sum += sphere.minCoeff() / energy.edges.row(row).squaredNorm() * energy.rows.row(row).tail(centers).squaredNorm();
  }
  return automatic_part * sum;
}

}  // namespace handlebody
