// The native side of `npm run bench -- bake`: bakes the mesh in the file named by the first argument (counts of vertices and
// triangles, positions, triangles) with 400 centers at 96 voxels. Prints one JSON object of milliseconds: the whole bake, its phases,
// and a center of fast marching (median of 100).
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "core/distance/fast_marching.hpp"
#include "core/irbf/bake.hpp"

using namespace handlebody;

namespace {

double now() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int main(int argc, char** argv) {
  std::FILE* file = argc > 1 ? std::fopen(argv[1], "rb") : nullptr;
  std::uint32_t counts[2];
  if (file == nullptr || std::fread(counts, sizeof counts, 1, file) != 1) {
    std::fputs("usage: handlebody_bench_bake MESH.bin\n", stderr);
    return 2;
  }
  Points positions(counts[0], 3);
  Triangles triangles(counts[1], 3);
  if (std::fread(positions.data(), sizeof(double), 3 * counts[0], file) != 3 * counts[0] ||
      std::fread(triangles.data(), sizeof(std::uint32_t), 3 * counts[1], file) != 3 * counts[1]) {
    std::fputs("bench: the mesh file is too short\n", stderr);
    return 1;
  }
  std::fclose(file);

  BakeOptions options;
  options.centers = argc > 2 ? std::atoi(argv[2]) : 400;
  const double start = now();
  auto bake = Bake::begin(positions, triangles, options);
  if (!bake) return 1;
  double progress = 0, last = now(), begun = last - start;
  std::vector<std::pair<double, double>> steps;
  while (progress < 1) {
    auto step = bake->step();
    if (!step) return 1;
    progress = *step;
    steps.emplace_back(progress, now() - last);
    last = now();
  }
  const double whole = now() - start;

  const Body& body = bake->body();
  FastMarching marching(body.domain);
  std::vector<double> field(static_cast<std::size_t>(body.domain.size()));
  std::vector<double> times;
  for (const std::uint32_t center : body.centers) {
    const double from = now();
    marching.march(body.normalization.to_solver(body.positions.row(center).transpose()), field.data());
    times.push_back(now() - from);
  }
  std::sort(times.begin(), times.end());
  std::fprintf(stderr, "begin %.0f, voxels %d, spheres %d\n", begun, int(body.domain.size()), int(body.spheres.size()));
  double phase = 0, sum = 0;
  for (auto& [p, t] : steps) {
    sum += t;
    if (p - phase > .05 || p == 1) std::fprintf(stderr, "  to %.2f: %.1f\n", p, sum), phase = p, sum = 0;
  }
  std::printf("{\"whole\": %.3f, \"center\": %.4f}\n", whole, times[times.size() / 2]);
}
