// The native side of `npm run bench`: the same calls through the same C interface as the wasm side, on the body in the file named
// by the first argument (written by body-file.mjs). Prints one JSON object of milliseconds, each the least of its repetitions.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "abi/handlebody.h"

namespace {

template <typename T>
std::vector<T> read(std::FILE* file, std::size_t count) {
  std::vector<T> values(count);
  if (std::fread(values.data(), sizeof(T), count, file) != count) {
    std::fputs("bench: the body file is too short\n", stderr);
    std::exit(1);
  }
  return values;
}

void check(int32_t status) {
  if (status == HB_OK) return;
  std::fprintf(stderr, "bench: %s\n", hb_last_error()->message);
  std::exit(1);
}

double least_milliseconds(int repetitions, const std::function<void()>& run) {
  double least = 1e300;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    run();
    least = std::min(least, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  std::FILE* file = argc > 1 ? std::fopen(argv[1], "rb") : nullptr;
  if (file == nullptr) {
    std::fputs("usage: handlebody_bench BODY.bin\n", stderr);
    return 2;
  }
  // Counts: vertices, triangles, voxels, centers, spheres, handles, then the grid's dimensions.
  const auto counts = read<std::uint32_t>(file, 9);
  const auto numbers = read<double>(file, 9);  // center xyz, diagonal, origin xyz, spacing, distance scale
  const auto positions = read<double>(file, 3 * std::size_t{counts[0]});
  const auto spheres = read<double>(file, 4 * std::size_t{counts[4]});
  const auto handles = read<double>(file, 3 * std::size_t{counts[5]});
  const auto shift = read<double>(file, 3);  // of the first handle's target
  const auto triangles = read<std::uint32_t>(file, 3 * std::size_t{counts[1]});
  const auto voxels = read<std::uint32_t>(file, counts[2]);
  const auto centers = read<std::uint32_t>(file, counts[3]);
  const auto distances = read<std::uint16_t>(file, std::size_t{counts[2]} * counts[3]);
  std::fclose(file);

  hb_body body{};
  std::copy_n(numbers.data(), 3, body.center);
  body.diagonal = numbers[3];
  std::copy_n(numbers.data() + 4, 3, body.origin);
  body.spacing = numbers[7];
  body.distance_scale = numbers[8];
  std::copy_n(counts.data() + 6, 3, body.dims);
  body.vertex_count = counts[0], body.triangle_count = counts[1], body.voxel_count = counts[2];
  body.center_count = counts[3], body.sphere_count = counts[4];
  body.positions = positions.data(), body.triangles = triangles.data(), body.voxels = voxels.data();
  body.centers = centers.data(), body.distances = distances.data(), body.spheres = spheres.data();

  const hb_irbf_options options{2, 0, 100, -1, 4, 5, 0, 2, 0, 0};
  hb_irbf* irbf = nullptr;
  const double prepare = least_milliseconds(3, [&] {
    hb_irbf_free(irbf);
    check(hb_irbf_create(&body, &options, &irbf));
  });
  const std::vector<std::uint32_t> kinds(counts[5], 0);
  const double factor = least_milliseconds(5, [&] { check(hb_irbf_set_handles(irbf, handles.data(), kinds.data(), counts[5])); });
  for (int axis = 0; axis < 3; ++axis) hb_irbf_targets(irbf)[axis] += shift[static_cast<std::size_t>(axis)];
  hb_irbf_report report;
  const double solve = least_milliseconds(20, [&] { check(hb_irbf_solve(irbf, 30, 0, 1, &report)); });
  std::vector<float> out(positions.size()), normals(positions.size());
  const double deform = least_milliseconds(60, [&] { check(hb_irbf_deform(irbf, out.data(), nullptr, nullptr)); });
  const double with_normals = least_milliseconds(60, [&] { check(hb_irbf_deform(irbf, out.data(), nullptr, normals.data())); });
  hb_irbf_free(irbf);
  std::printf("{\"prepare\":%.4f,\"factor\":%.4f,\"solve\":%.4f,\"deform\":%.4f,\"deformNormals\":%.4f}\n", prepare, factor, solve,
              deform, with_normals);
  return 0;
}
