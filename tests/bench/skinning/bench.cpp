// The native side of the skinning benchmark: the same calls through the same C interface as the wasm side, on made data of the same
// sizes. Prints one JSON object of milliseconds.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "abi/handlebody.h"

namespace {

double now() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void check(int32_t status) {
  if (status == HB_OK) return;
  std::fprintf(stderr, "bench: %s\n", hb_last_error()->message);
  std::exit(1);
}

std::map<std::string, double> times;

void keep_least(const std::string& name, double milliseconds) {
  const auto [at, added] = times.emplace(name, milliseconds);
  if (!added) at->second = std::min(at->second, milliseconds);
}

}  // namespace

int main(int count, char** arguments) {
  const auto number = [&](int i, int otherwise) { return static_cast<uint32_t>(count > i ? std::atoi(arguments[i]) : otherwise); };
  const uint32_t vertices = number(1, 20000), handles = number(2, 10), rounds = number(3, 200);
  double sum = 0;
  for (const uint32_t d : {2U, 3U}) {
    std::vector<double> positions(vertices * d), weights(vertices * handles);
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = std::sin(static_cast<double>(i));
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = 1.0 / handles + 0.05 * (i % handles % 2 ? 1 : -1);
    const std::string tail = ' ' + std::to_string(d) + 'D';
    hb_skin* skins[3] = {};
    check(hb_linear_blend_create(positions.data(), vertices, d, weights.data(), handles, 0, &skins[0]));
    check(hb_linear_blend_create(positions.data(), vertices, d, weights.data(), handles, 1, &skins[1]));
    check(hb_dual_quaternion_create(positions.data(), vertices, d, weights.data(), handles, &skins[2]));
    // Bytes that a form has to read and to write, in floats.
    const std::size_t ends = std::size_t{2} * vertices * d, table = std::size_t{vertices} * handles;
    const std::size_t bytes[3] = {4 * (table + ends), 4 * (table * (d + 1) + ends), 4 * (table + ends)};
    const char* const names[3] = {"direct", "compiled", "dual quaternion"};
    std::vector<float> out(vertices * d);
    std::vector<char> from(bytes[1], 1), to(bytes[1], 2);
    for (uint32_t round = 0; round < rounds; ++round)
      for (int form = 0; form < 3; ++form) {
        double* transforms = hb_skin_transforms(skins[form]);
        for (uint32_t j = 0; j < handles; ++j) transforms[j * d * (d + 1) + d] = 0.001 * round * j;
        for (int twice = 0; twice < 2; ++twice) {
          const double start = now();
          check(hb_skin_deform(skins[form], out.data()));
          keep_least(names[form] + tail, now() - start);
        }
        sum += static_cast<double>(out[round]);
        for (int twice = 0; twice < 2; ++twice) {
          from[round] = static_cast<char>(round);
          const double middle = now();
          std::memcpy(to.data(), from.data(), bytes[form]);
          keep_least(std::string(names[form]) + " copy" + tail, now() - middle);
          sum += to[round];
        }
      }
    for (hb_skin* skin : skins) hb_skin_free(skin);
  }
  std::printf("{");
  for (const auto& [name, milliseconds] : times) std::printf("\"%s\": %.6f, ", name.c_str(), milliseconds);
  std::printf("\"checksum\": %g}\n", sum);
}
