// Runs a target's inputs once, without a fuzzer: `program LIST`, a file that names one input a line. For coverage, and in wasm
// under Node.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#ifdef __wasm__
/** For targets that are no host. */
extern "C" __attribute__((weak)) double hb_host_kernel(std::uint32_t, std::uint32_t, double) {
  return 0;
}
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "Give a file that names one input a line.\n"), 2;
  std::ifstream list(argv[1]);
  std::string name, slowest;
  double most = 0;
  unsigned files = 0;
  while (std::getline(list, name)) {
    std::ifstream file(name, std::ios::binary);
    if (!file) return std::fprintf(stderr, "%s cannot be read.\n", name.c_str()), 2;
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    // Said before it is run: where the program ends, this is the input that ended it.
    std::fprintf(stdout, "%s\n", name.c_str());
    std::fflush(stdout);
    const auto start = std::chrono::steady_clock::now();
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds > most) most = seconds, slowest = name;
    ++files;
  }
  std::fprintf(stderr, "replay: %u files, the slowest, %s, took %.3f s\n", files, slowest.c_str(), most);
  return files > 0 ? 0 : 2;
}
