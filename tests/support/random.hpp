// Random numbers for property tests; the same seed gives the same numbers.
#ifndef STRIDE_TESTS_SUPPORT_RANDOM_HPP
#define STRIDE_TESTS_SUPPORT_RANDOM_HPP

#include <cmath>
#include <cstdint>
#include <random>

namespace stride::test {

class Random {
public:
  explicit Random(uint64_t seed) : engine_(seed) {}
  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(engine_);
  }
  /// Of any size between the powers of ten.
  double magnitude(double loExponent, double hiExponent) {
    return std::pow(10.0, uniform(loExponent, hiExponent));
  }
  bool chance(double p) { return uniform(0, 1) < p; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  /// 0 to n - 1.
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }

private:
  std::mt19937_64 engine_;
};

} // namespace stride::test

#endif
