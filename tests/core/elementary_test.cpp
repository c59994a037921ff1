// Against the C library's functions, over all orders of magnitude.
#include "core/numerics/elementary.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace handlebody;

TEST_CASE("logarithms are the C library's to 3 units in the last place (seed 71)") {
  std::mt19937 random(71);
  std::uniform_real_distribution<double> exponent(-300, 300), near(-1e-3, 1e-3);
  std::vector<double> x;
  for (int i = 0; i < 20000; ++i) x.push_back(std::pow(10.0, exponent(random)));
  for (int i = 0; i < 20000; ++i) x.push_back(1 + near(random));
  for (const double special : {1.0, 0.5, 2.0, 0.70710678118654752, 1.4142135623730951, 1e308, 3e-308}) x.push_back(special);
  std::vector<double> logs = x;
  logarithms(logs.data(), std::ssize(logs));
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double expected = std::log(x[i]);
    worst = std::max(worst, std::abs(logs[i] - expected) / std::max(std::abs(expected), 1e-3 * std::abs(x[i] - 1)));
  }
  CHECK(worst < 7e-16);
  MESSAGE("largest relative error " << worst);
  double zero = 0;
  logarithms(&zero, 1);
  CHECK(std::isfinite(zero));
}

TEST_CASE("decaying exponentials are the C library's to a relative error of 1e-15 (seed 72)") {
  std::mt19937 random(72);
  std::uniform_real_distribution<double> wide(0, 707), narrow(0, 2);
  std::vector<double> x;
  for (int i = 0; i < 20000; ++i) x.push_back(wide(random));
  for (int i = 0; i < 20000; ++i) x.push_back(narrow(random));
  for (const double special : {0.0, 1e-300, 1e-17, 0.34657359027997264, 0.3465735902799727, 707.9}) x.push_back(special);
  std::vector<double> values = x;
  decaying_exponentials(values.data(), std::ssize(values));
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(values[i] / std::exp(-x[i]) - 1));
  CHECK(worst < 1e-15);
  MESSAGE("largest relative error " << worst);
  double far[3] = {708, 1e300, std::numeric_limits<double>::infinity()};
  decaying_exponentials(far, 3);
  for (const double value : far) CHECK(value == 0);
  double at_zero = 0;
  decaying_exponentials(&at_zero, 1);
  CHECK(at_zero == 1);
}

TEST_CASE("inverse powers, whole and broken, agree with the C library's") {
  for (const double p : {0.3, 1.0, 2.0, 2.5, 4.0, 7.0, 16.0, 16.5, 300.0, 1e308}) {
    const double least = 3e-7;
    std::vector<double> x = {least, least * 1.0000001, 4e-7, 1e-6, 0.1, 1, 77, 1e9, 1e300}, expected;
    for (const double value : x) expected.push_back(std::pow(least / value, p));
    std::vector<double> found = x;
    inverse_powers(found.data(), std::ssize(found), least, p);
    for (std::size_t i = 0; i < x.size(); ++i) {
      CAPTURE(p);
      CAPTURE(x[i]);
      if (expected[i] < 1e-300)
        CHECK(found[i] < 1e-299);
      else
        CHECK(std::abs(found[i] / expected[i] - 1) < 1e-15 * (1 + p + p * std::log(x[i] / least)));
    }
  }
}

TEST_CASE("logarithms and exponentials are those of Eigen's packets, which take longer (seed 74)") {
  std::mt19937 random(74);
  std::uniform_real_distribution<double> uniform(1e-3, 50);
  const Eigen::ArrayXd x = Eigen::ArrayXd::NullaryExpr(4001, [&] { return uniform(random); });
  Eigen::ArrayXd logs = x, decays = x;
  logarithms(logs.data(), logs.size());
  decaying_exponentials(decays.data(), decays.size());
  CHECK((logs - x.log()).abs().maxCoeff() < 2e-15);
  CHECK(((decays - (-x).exp()) / decays).abs().maxCoeff() < 2e-15);
}
