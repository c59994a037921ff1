#include "core/skinning/measure_weights.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace handlebody {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double most_bytes = 1.5e9;
constexpr double around_a_bend = 1.5;  // times the straight distance
constexpr double counts = 0.01;        // a weight above this counts
// Squares of gradients must not overflow. Meshes are larger than 1e-60 and smaller than 1e60.
constexpr double largest_weight = 1e60, shortest_edge = 1e-60;

Result<Done> check(const SimplexMesh& mesh, const HeldVertices& held, const Eigen::Ref<const Matrix>& weights) {
  if (auto checked = check_simplex_mesh(mesh); !checked) return checked.error();
  const Index n = mesh.positions.rows();
  if (held.handle_count <= 0)
    return Error(HB_ERROR_HANDLES_MISSING, {"There is no handle that weights could belong to."}, {"Give one or more."});
  for (std::size_t k = 0; k < held.vertices.size(); ++k) {
    const std::uint32_t vertex = held.vertices[k], owner = held.owners[k];
    if (in_range(owner, held.handle_count) && in_range(vertex, n)) continue;
    return Error(
        HB_ERROR_HANDLE_OUT_OF_RANGE,
        {"Handle ", owner, " of ", held.handle_count, " holds vertex ", vertex, " of ", n, "; one of the two is not there."},
        {"Count handles and vertices from 0."}, HB_CULPRIT_HANDLE, owner);
  }
  if (weights.rows() != n || weights.cols() != held.handle_count) {
    return Error(HB_ERROR_INVALID_SHAPE,
                 {weights.rows(), " × ", weights.cols(), " weights are not one for each of ", n, " vertices and ",
                  held.handle_count, " handles."},
                 {"Give vertices × handles numbers, row-major."});
  }
  for (Index v = 0; v < n; ++v) {
    if (weights.row(v).allFinite() && weights.row(v).cwiseAbs().maxCoeff() <= largest_weight) continue;
    return Error(HB_ERROR_VALUE_NOT_FINITE,
                 {"Vertex ", v, " has a weight that is not a finite number, or too large to compute with."},
                 {"Give finite weights, below 1e60."}, HB_CULPRIT_VERTEX, v);
  }
  const auto corners = static_cast<double>(mesh.simplices.cols());
  const double bytes =
      8.0 * static_cast<double>(weights.size()) +
      static_cast<double>(mesh.simplices.rows()) * (12 * corners * (corners - 1) + 8 * 13 + corners * (4 * corners + 12));
  if (bytes <= most_bytes) return Done{};
  return Error(HB_ERROR_OUT_OF_MEMORY,
               {"Measuring ", held.handle_count, " weights at ", n, " vertices takes ", bytes / 1e6, " MB."},
               {"Measure fewer handles at a time, or a simpler mesh."});
}

/** The edges that leave each vertex; one that several simplices share is there once for each, which does no harm. */
struct EdgeGraph {
  Indices starts, ends;
  std::vector<double> lengths;

  explicit EdgeGraph(const SimplexMesh& mesh) : starts(mesh.positions.rows() + 1, 0) {
    const Index corners = mesh.simplices.cols();
    for (Index i = 0; i < mesh.simplices.size(); ++i)
      starts[mesh.simplices.data()[i] + 1] += static_cast<std::uint32_t>(corners - 1);
    for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
    Indices next = starts;
    ends.resize(starts.back());
    lengths.resize(starts.back());
    for (Index s = 0; s < mesh.simplices.rows(); ++s) {
      for (Index k = 0; k < corners; ++k) {
        for (Index l = 0; l < corners; ++l) {
          if (k == l) continue;
          const std::uint32_t from = mesh.simplices(s, k), to = mesh.simplices(s, l), at = next[from]++;
          ends[at] = to;
          lengths[at] = (mesh.positions.row(from) - mesh.positions.row(to)).norm();
        }
      }
    }
  }

  /** Shortest paths from vertices at distance 0 to all others (Dijkstra). */
  void measure(Vector& distances, const Indices& from) const {
    struct Trial {
      double distance;
      std::uint32_t vertex;
    };
    const auto later = [](const Trial& a, const Trial& b) { return a.distance > b.distance; };
    std::vector<Trial> heap;
    distances.setConstant(infinite);
    const auto offer = [&](std::uint32_t vertex, double distance) {
      if (!(distance < distances[vertex])) return;
      distances[vertex] = distance;
      heap.push_back({distance, vertex});
      std::push_heap(heap.begin(), heap.end(), later);
    };
    for (const std::uint32_t vertex : from) offer(vertex, 0);
    while (!heap.empty()) {
      const auto [distance, vertex] = heap.front();
      std::pop_heap(heap.begin(), heap.end(), later);
      heap.pop_back();
      if (distance > distances[vertex]) continue;
      for (std::uint32_t e = starts[vertex]; e < starts[vertex + 1]; ++e) offer(ends[e], distance + lengths[e]);
    }
  }
};

/** Two simplices with a face in common. */
struct Neighbors {
  std::uint32_t one, other;
};

/** Pairs with a common face; where more than two simplices share it, each of the others with the first. */
std::vector<Neighbors> face_neighbors(const Simplices& simplices) {
  const Index corners = simplices.cols();
  // Face k of simplex s, across from its corner k, is number s · corners + k; its vertices in ascending order.
  Simplices faces(simplices.size(), corners - 1);
  for (Index f = 0; f < faces.rows(); ++f) {
    for (Index l = 0; l + 1 < corners; ++l) faces(f, l) = simplices(f / corners, (f + 1 + l) % corners);
    std::sort(&faces(f, 0), &faces(f, 0) + corners - 1);
  }
  const auto before = [&](std::uint32_t f, std::uint32_t g) {
    for (Index l = 0; l + 1 < corners; ++l)
      if (faces(f, l) != faces(g, l)) return faces(f, l) < faces(g, l);
    return f < g;
  };
  const Indices sorted = sorted_indices(static_cast<std::size_t>(faces.rows()), before);
  std::vector<Neighbors> neighbors;
  for (std::size_t first = 0, i = 1; i < sorted.size(); ++i) {
    if (faces.row(sorted[i]) != faces.row(sorted[first])) first = i;
    if (i > first)
      neighbors.push_back({sorted[first] / static_cast<std::uint32_t>(corners), sorted[i] / static_cast<std::uint32_t>(corners)});
  }
  return neighbors;
}

/** What gradients on a simplex need. Edges eⱼ leave its first corner; the duals dᵢ are in their span with dᵢ·eⱼ = δᵢⱼ, so that
 * ∇w = Σᵢ (wᵢ − w₀) dᵢ. */
struct Element {
  Matrix3 duals = Matrix3::Zero();
  double volume = 0;  // or area; 0 where it is too flat for gradients
};

Element element_of(const SimplexMesh& mesh, Index s) {
  const Index d = mesh.positions.cols(), edge_count = mesh.simplices.cols() - 1;
  Matrix3 edges = Matrix3::Zero();
  for (Index k = 0; k < edge_count; ++k)
    edges.col(k).head(d) = (mesh.positions.row(mesh.simplices(s, k + 1)) - mesh.positions.row(mesh.simplices(s, 0))).transpose();
  const double volume = simplex_volume(mesh, s), longest = edges.colwise().norm().maxCoeff();
  Element element;
  if (!(longest > shortest_edge && volume > 1e-14 * std::pow(longest, static_cast<double>(edge_count)))) return element;
  element.volume = volume;
  if (edge_count == 3) {
    element.duals = edges.inverse().transpose();
  } else {
    const Eigen::Matrix<double, 3, 2> e = edges.leftCols<2>();
    element.duals.leftCols<2>() = e * (e.transpose() * e).inverse();
  }
  return element;
}

/** The largest jump of the gradient of `weight` (n) between neighbors, over the largest gradient; adds to `support` the volume
 * where the weight counts. */
double gradient_jump(const Simplices& simplices, const std::vector<Element>& elements, const std::vector<Neighbors>& neighbors,
                     const Vector& weight, Points& gradients, double& support) {
  double steepest = 0, jump = 0;
  for (Index s = 0; s < simplices.rows(); ++s) {
    const Element& element = elements[s];
    const double first = weight[simplices(s, 0)];
    Vector3 gradient = Vector3::Zero();
    double sum = first;
    for (Index k = 1; k < simplices.cols(); ++k) {
      gradient += (weight[simplices(s, k)] - first) * element.duals.col(k - 1);
      sum += weight[simplices(s, k)];
    }
    gradients.row(s) = gradient;
    steepest = std::max(steepest, gradient.norm());
    if (std::abs(sum / static_cast<double>(simplices.cols())) > counts) support += element.volume;
  }
  for (const auto& [one, other] : neighbors)
    if (elements[one].volume > 0 && elements[other].volume > 0)
      jump = std::max(jump, (gradients.row(one) - gradients.row(other)).norm());
  return steepest > 0 ? jump / steepest : 0;
}

/** n×h: lengths of the shortest paths along edges to any vertex of the handle. */
Matrix distances_inside(const SimplexMesh& mesh, const HeldVertices& held) {
  const EdgeGraph graph(mesh);
  Matrix inside(mesh.positions.rows(), held.handle_count);
  Vector distances(inside.rows());
  for (Index j = 0; j < held.handle_count; ++j) {
    Indices from;
    for (std::size_t k = 0; k < held.vertices.size(); ++k)
      if (static_cast<Index>(held.owners[k]) == j) from.push_back(held.vertices[k]);
    graph.measure(distances, from);
    inside.col(j) = distances;
  }
  return inside;
}

struct Direct {
  Index handle;
  double distance;
};

/** The handle that is nearest to a vertex in a straight line; of two at the same distance, the first. */
Direct nearest_straight(const SimplexMesh& mesh, const HeldVertices& held, Index v) {
  Direct nearest{0, infinite};
  for (std::size_t k = 0; k < held.vertices.size(); ++k) {
    const double distance = (mesh.positions.row(v) - mesh.positions.row(held.vertices[k])).norm();
    const auto owner = static_cast<Index>(held.owners[k]);
    if (distance < nearest.distance || (distance == nearest.distance && owner < nearest.handle)) nearest = {owner, distance};
  }
  return nearest;
}

}  // namespace

Result<WeightMeasures> measure_weights(const SimplexMesh& mesh, const HeldVertices& held, const Eigen::Ref<const Matrix>& weights) {
  if (auto checked = check(mesh, held, weights); !checked) return checked.error();
  const Index n = weights.rows(), h = weights.cols();
  WeightMeasures measures;
  measures.leaked_weight = std::numeric_limits<double>::quiet_NaN();
  measures.least = weights.minCoeff();
  measures.largest = weights.maxCoeff();
  const Matrix inside = distances_inside(mesh, held);
  for (Index v = 0; v < n; ++v) {
    const double nearest = inside.row(v).minCoeff();
    for (Index j = 0; j < h; ++j)
      if (inside(v, j) > 2 * nearest) measures.far_weight = std::max(measures.far_weight, std::abs(weights(v, j)));
    measures.sum_error = std::max(measures.sum_error, std::abs(weights.row(v).sum() - 1));
    const Direct direct = nearest_straight(mesh, held, v);
    const double around = inside(v, direct.handle), leaked = std::abs(weights(v, direct.handle));
    if (around > around_a_bend * direct.distance && around > nearest && !(measures.leaked_weight >= leaked))
      measures.leaked_weight = leaked;
  }

  const auto simplex_count = static_cast<std::size_t>(mesh.simplices.rows());
  std::vector<Element> elements(simplex_count);
  double whole = 0;
  for (std::size_t s = 0; s < simplex_count; ++s) {
    elements[s] = element_of(mesh, static_cast<Index>(s));
    whole += elements[s].volume;
  }
  const std::vector<Neighbors> neighbors = face_neighbors(mesh.simplices);
  Points gradients(mesh.simplices.rows(), 3);
  measures.support = Vector::Zero(h);
  for (Index j = 0; j < h; ++j) {
    const double jump = gradient_jump(mesh.simplices, elements, neighbors, weights.col(j), gradients, measures.support[j]);
    measures.gradient_jump = std::max(measures.gradient_jump, jump);
  }
  if (whole > 0) measures.support /= whole;
  return measures;
}

}  // namespace handlebody
