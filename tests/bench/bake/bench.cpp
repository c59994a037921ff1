// The native side of `npm run bench -- bake`: bakes the mesh in the file named by the first argument (numbers of vertices and
// triangles, positions, triangles) with 400 centers at 96 voxels, through the C interface. Prints one JSON object of milliseconds:
// the whole bake, and the median of its centers' steps (distances to all voxels, their codes, the choice of the next center).
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "abi/handlebody.h"

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
  std::vector<double> positions(3 * std::size_t{counts[0]});
  std::vector<std::uint32_t> triangles(3 * std::size_t{counts[1]});
  if (std::fread(positions.data(), sizeof(double), positions.size(), file) != positions.size() ||
      std::fread(triangles.data(), sizeof(std::uint32_t), triangles.size(), file) != triangles.size()) {
    std::fputs("bench: the mesh file is too short\n", stderr);
    return 1;
  }
  std::fclose(file);

  hb_bake_options options{};
  options.center_count = 400, options.resolution = 96, options.max_spheres = 120;
  const double start = now();
  hb_bake* bake = nullptr;
  double progress = 0;
  std::vector<double> centers;
  int32_t status = hb_bake_begin(positions.data(), counts[0], triangles.data(), counts[1], &options, &bake);
  while (status == HB_OK && progress < 1) {
    const bool center = progress >= 0.40 && progress < 0.985;
    const double from = now();
    status = hb_bake_step(bake, &progress);
    if (center) centers.push_back(now() - from);
  }
  const double whole = now() - start;
  if (status != HB_OK) {
    std::fprintf(stderr, "bench: %s\n", hb_last_error()->message);
    return 1;
  }
  hb_bake_free(bake);
  std::sort(centers.begin(), centers.end());
  std::printf("{\"whole\": %.3f, \"center\": %.4f}\n", whole, centers[centers.size() / 2]);
}
