// The native side of the benchmark: the same calls through the same C interface as deform-side.mjs, on the body in the file that
// the first argument names (body-file.mjs). Prints one JSON object of milliseconds.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
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

double milliseconds(const std::function<void()>& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

using Steps = std::vector<std::pair<std::string, std::function<void()>>>;

/** Everything in turns, each `in_a_row` times; the least of all its times, since what disturbs a time only adds to it. */
std::map<std::string, double> in_turns(int turns, int in_a_row, const Steps& steps) {
  std::map<std::string, double> least;
  for (int turn = 0; turn < turns; ++turn) {
    for (const auto& [name, run] : steps) {
      double& time = least.emplace(name, 1e300).first->second;
      for (int i = 0; i < in_a_row; ++i) time = std::min(time, milliseconds(run));
    }
  }
  return least;
}

using Quad = float __attribute__((vector_size(16)));

/** Every number once, in eight sums, so that none waits for another. */
float read_once(const std::vector<Quad>& numbers) {
  Quad sums[8] = {};
  for (std::size_t i = 0; i < numbers.size(); i += 8)
    for (std::size_t lane = 0; lane < 8; ++lane) sums[lane] += numbers[i + lane];
  Quad sum{};
  for (const Quad& part : sums) sum += part;
  return sum[0] + sum[1] + sum[2] + sum[3];
}

}  // namespace

int main(int argc, char** argv) {
  std::FILE* file = argc > 1 ? std::fopen(argv[1], "rb") : nullptr;
  if (file == nullptr) {
    std::fputs("usage: handlebody_bench BODY.bin [turns]\n", stderr);
    return 2;
  }
  const int turns = argc > 2 ? std::atoi(argv[2]) : 9;
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

  hb_irbf_options options{};
  options.anchor_weight = 100, options.edge_exponent = 2, options.poisson_ratio = 0.4, options.support = 4;
  options.kernel = 5, options.order = 2;
  hb_irbf *irbf = nullptr, *floating = nullptr;
  check(hb_irbf_create(&body, &options, &irbf));
  hb_irbf_free(irbf);
  const double prepare = milliseconds([&] { check(hb_irbf_create(&body, &options, &irbf)); });
  options.precision = 1;
  check(hb_irbf_create(&body, &options, &floating));

  const std::vector<std::uint32_t> kinds(counts[5], 0);
  const auto hold = [&](hb_irbf* one) { check(hb_irbf_set_handles(one, handles.data(), kinds.data(), counts[5])); };
  const auto pull = [&](hb_irbf* one) {
    for (std::size_t axis = 0; axis < 3; ++axis) hb_irbf_targets(one)[axis] = handles[axis] + shift[axis];
  };
  auto times = in_turns(5, 1, {{"factor", [&] { hold(irbf); }}});
  hold(floating);
  pull(irbf), pull(floating);
  hb_irbf_report report;
  times.merge(in_turns(5, 2, {{"solve", [&] { check(hb_irbf_solve(irbf, 30, 0, 1, &report)); }}}));
  check(hb_irbf_solve(floating, 30, 0, 1, &report));

  // The kernel works on welded vertices.
  std::set<std::tuple<double, double, double>> places;
  for (std::size_t v = 0; v < positions.size(); v += 3) places.emplace(positions[v], positions[v + 1], positions[v + 2]);
  const std::vector<Quad> matrix((places.size() * centers.size() + 31) / 32 * 8, Quad{1, 1, 1, 1});
  float sum = 0;
  std::vector<float> out(positions.size()), normals(positions.size());
  times.merge(in_turns(turns, 3,
                       {{"read", [&] { sum += read_once(matrix); }},
                        {"deform", [&] { check(hb_irbf_deform(irbf, out.data(), nullptr, nullptr)); }},
                        {"deformFloat", [&] { check(hb_irbf_deform(floating, out.data(), nullptr, nullptr)); }},
                        {"deformNormals", [&] { check(hb_irbf_deform(irbf, out.data(), nullptr, normals.data())); }}}));
  // In a row, what fits stays in the cache. Between two frames of a page there is more than that.
  const std::vector<Quad> other(std::size_t{1} << 23, Quad{1, 1, 1, 1});
  times.merge(in_turns(turns, 1,
                       {{"sweep", [&] { sum += read_once(other); }},
                        {"sweptRead", [&] { sum += read_once(matrix); }},
                        {"sweepAgain", [&] { sum += read_once(other); }},
                        {"sweptDeform", [&] { check(hb_irbf_deform(irbf, out.data(), nullptr, nullptr)); }},
                        {"sweepOnceMore", [&] { sum += read_once(other); }},
                        {"sweptDeformFloat", [&] { check(hb_irbf_deform(floating, out.data(), nullptr, nullptr)); }}}));
  hb_irbf_free(irbf);
  hb_irbf_free(floating);
  std::printf("{\"prepare\":%.4f", prepare);
  for (const auto& [name, time] : times) std::printf(",\"%s\":%.4f", name.c_str(), time);
  std::printf(",\"sum\":%g}\n", static_cast<double>(sum));
}
