#include "core/mesh/polyharmonic_energy.hpp"

#include <algorithm>
#include <limits>

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

}  // namespace handlebody
