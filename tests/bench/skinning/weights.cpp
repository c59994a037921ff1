// The native side of the skinning weights' benchmark, on the mesh in the file that the first argument names (gingerbread.py says
// how): prints medians of rounds in milliseconds, as many rounds as the second argument says, and the bounded weights' report.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

#include "core/skinning/bounded_weights.hpp"
#include "core/skinning/polyharmonic_weights.hpp"

using namespace handlebody;

namespace {

double milliseconds() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) return 2;
  std::ifstream file(arguments[1]);
  Index n = 0, d = 0, m = 0, corners = 0, held_count = 0;
  HeldVertices held;
  file >> n >> d >> m >> corners >> held_count >> held.handle_count;
  if (!file) return 2;
  SimplexMesh mesh;
  mesh.positions.resize(n, d);
  mesh.simplices.resize(m, corners);
  for (Index i = 0; i < n * d; ++i) file >> mesh.positions.data()[i];
  for (Index i = 0; i < m * corners; ++i) file >> mesh.simplices.data()[i];
  for (Index k = 0; k < held_count; ++k) {
    std::uint32_t vertex = 0, owner = 0;
    file >> vertex >> owner;
    held.vertices.push_back(vertex);
    held.owners.push_back(owner);
  }
  if (!file) return 2;

  const int rounds = count > 2 ? std::atoi(arguments[2]) : 5;
  std::vector<double> biharmonic, bounded, longest;
  BoundedWeightsReport report;
  for (int round = 0; round < rounds; ++round) {
    const double start = milliseconds();
    auto created = PolyharmonicWeights::create(mesh, 2, Mass::voronoi);
    if (!created || !(*created)->set_handles(held)) return 1;
    const PolyharmonicWeights& unbounded = **created;
    const double made = milliseconds();
    auto weights = BoundedWeights::create(unbounded.energy(), unbounded.mass(), unbounded.held(), unbounded.weights());
    if (!weights) return 1;
    double worst = 0;
    for (double before = milliseconds(); !(*weights)->done();) {
      (*weights)->step();
      const double now = milliseconds();
      worst = std::max(worst, now - before);
      before = now;
    }
    const double end = milliseconds();
    biharmonic.push_back(made - start);
    bounded.push_back(end - start);
    longest.push_back(worst);
    report = (*weights)->report();
  }
  std::printf(
      "{\"biharmonic\": %.4g, \"bounded\": %.4g, \"longest step\": %.4g, \"sweeps\": %d, \"newton steps\": %d, \"energy\": %.12g, "
      "\"gap\": %.3g}\n",
      median(biharmonic), median(bounded), median(longest), report.sweeps, report.newton_steps, report.energy, report.gap);
}
