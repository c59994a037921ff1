#include "core/mesh/polyharmonic_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/mesh/cotangent_laplacian.hpp"

namespace handlebody {

namespace {

constexpr double most_entries = std::numeric_limits<std::int32_t>::max();

/** An upper bound on the number of entries of A B: entries that coincide are counted more than once. */
double most_product_entries(const SparseMatrix& a, const SparseMatrix& b) {
  const std::int32_t* const starts = b.outerIndexPtr();
  double total = 0;
  for (Index row = 0; row < a.rows(); ++row) {
    double entries = 0;
    for (SparseMatrix::InnerIterator entry(a, row); entry; ++entry) entries += starts[entry.col() + 1] - starts[entry.col()];
    total += std::min(entries, static_cast<double>(b.cols()));
  }
  return total;
}

}  // namespace

Result<SparseMatrix> polyharmonic_energy(const SparseMatrix& laplacian, const Vector& mass, int order) {
  // Vertices in no simplex have no mass and no neighbors: 0 stands for the inverse of their mass.
  const Vector inverse_mass = mass.unaryExpr([](double m) { return m > 0 ? 1 / m : 0.0; });
  SparseMatrix q = laplacian;
  for (int k = 1; k < order; ++k) {
    if (!(most_product_entries(laplacian, q) < most_entries)) {
      return Error(
          HB_ERROR_OUT_OF_MEMORY,
          {"The energy of order ", order, " on ", mass.size(), " vertices would have more than two thousand million entries."},
          {"Use a coarser mesh, or one whose vertices have fewer neighbors."});
    }
    q = laplacian * inverse_mass.asDiagonal() * q;
  }
  return q;
}

Result<SparseMatrix> polyharmonic_energy(const SimplexMesh& mesh, const Vector& mass, int order, double thinnest) {
  Vector least = Vector::Zero(mass.size());
  const Index corners = mesh.simplices.cols();
  for (Index s = 0; s < mesh.simplices.rows(); ++s) {
    const double part = thinnest * std::pow(longest_edge(mesh, s), static_cast<double>(corners - 1)) / static_cast<double>(corners);
    for (Index k = 0; k < corners; ++k) least[mesh.simplices(s, k)] += part;
  }
  return polyharmonic_energy(cotangent_laplacian(mesh, thinnest), mass.cwiseMax(least), order);
}

double thinnest_simplex(const SimplexMesh& mesh) {
  double least = 1;
  for (Index s = 0; s < mesh.simplices.rows(); ++s) {
    const double cube = std::pow(longest_edge(mesh, s), static_cast<double>(mesh.simplices.cols() - 1));
    least = std::min(least, simplex_volume(mesh, s) / cube);
  }
  return least;
}

// A needle of 1e-3 to 1e-13 of its length in a grid of 128 triangles, and the largest change of a weight for it:
//   biharmonic    as it is 3e-5 to 7e-2, or not to be factored; at least 1e-7 thick 4e-2, 1e-6: 8e-4, 1e-5: 2e-5, 1e-4: 2e-6
//   triharmonic   as it is 5e-5 to 3e-2, or not to be factored; at least 1e-5 thick 4e-2, 1e-4: 4e-2, 1e-3: 3e-5, 3e-3: 9e-5
double thicker(double thinnest, int order, double of_mesh) {
  constexpr double first[] = {1e-8, 1e-6, 1e-4}, last = 1.5e-3;
  double next = thinnest > 0 ? 10 * thinnest : first[order - 1];
  while (next <= of_mesh) next *= 10;
  return next < last ? next : 0;
}

}  // namespace handlebody
