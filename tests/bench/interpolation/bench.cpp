// The native side of the interpolation benchmark: the same calls through the same C interface as the wasm side, on the arrays in
// the file that the first argument names. Prints one JSON object of milliseconds.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "abi/handlebody.h"
#include "core/numerics/products.hpp"

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

hb_rbf_options options_of(uint32_t kernel, int32_t degree) {
  hb_rbf_options options{};
  options.width = 0.05;
  options.support = 4;
  options.kernel = kernel;
  options.degree = degree;
  options.order = 2;
  return options;
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<double> numbers(800 + 400 + 10000 + 60 + 1560 + 2000);
  std::FILE* file = count > 1 ? std::fopen(arguments[1], "rb") : nullptr;
  if (!file || std::fread(numbers.data(), sizeof(double), numbers.size(), file) != numbers.size()) {
    std::fputs("bench: the data file is missing or too short\n", stderr);
    return 1;
  }
  std::fclose(file);
  const double *points = numbers.data(), *values = points + 800, *queries = values + 400, *examples = queries + 10000,
               *shapes = examples + 60, *poses = shapes + 1560;

  std::vector<double> out(5000);
  const std::pair<const char*, uint32_t> kernels[] = {{"thin-plate", 2}, {"gaussian", 3}, {"multiquadric", 4}};
  for (const auto& [name, kernel] : kernels) {
    const hb_rbf_options options = options_of(kernel, 1);
    for (int round = 0; round < 20; ++round) {
      hb_interpolant* rbf = nullptr;
      const double start = now();
      check(hb_rbf_create(points, values, 400, 2, 1, &options, &rbf));
      hb_rbf_report report;
      check(hb_rbf_get_report(rbf, &report));  // as the TypeScript class does when it is made
      const double made = now();
      check(hb_interpolant_evaluate(rbf, queries, 5000, out.data()));
      keep_least(std::string(name) + " evaluate", now() - made);
      keep_least(std::string(name) + " fit", made - start);
      hb_interpolant_free(rbf);
    }
  }

  hb_rbf_options options = options_of(4, 0);
  options.width_choice = 1;
  hb_interpolant* rbf = nullptr;
  check(hb_rbf_create(examples, shapes, 30, 2, 52, &options, &rbf));
  std::vector<double> posed(52 * 1000);
  const handlebody::MatrixXd by_output = Eigen::Map<const handlebody::MatrixXd>(shapes, 52, 30);
  handlebody::Vector weights = Eigen::Map<const handlebody::Vector>(values, 30);
  double sum = 0;
  for (int round = 0; round < 40; ++round) {
    const double start = now();
    check(hb_interpolant_evaluate(rbf, poses, 1000, posed.data()));
    const double middle = now();
    for (int pose = 0; pose < 1000; ++pose) {
      weights[0] = pose;
      handlebody::multiply(by_output, weights, Eigen::Map<handlebody::Vector>(posed.data() + static_cast<long>(52) * pose, 52));
      sum += posed[52 * pose];
    }
    keep_least("products", now() - middle);
    keep_least("poses", middle - start);
  }
  hb_interpolant_free(rbf);
  std::printf("{");
  for (const auto& [name, milliseconds] : times) std::printf("\"%s\": %.6f, ", name.c_str(), milliseconds);
  std::printf("\"checksum\": %g}\n", sum);
}
