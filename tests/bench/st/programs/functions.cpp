#include "tests/bench/st/twin.h"

namespace {

float scale(int16_t raw, float low, float high) {
  return low + static_cast<float>(raw) * (high - low) / 27648.0F;
}

float deadband(float value, float band) {
  return (value < 0 ? -value : value) < band ? 0.0F : value;
}

float limit(float low, float value, float high) {
  return value < low ? low : value > high ? high : value;
}

uint32_t gcd(uint32_t a, uint32_t b) {
  while (b != 0) {
    const uint32_t rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

struct Plc {
  int16_t inputs[256];
  uint32_t seed;
  double checksum;

  void init() { seed = 7; }

  void cycle(int64_t) {
    for (int16_t &input : inputs) {
      seed = seed * 1664525U + 1013904223U;
      input = static_cast<int16_t>(seed >> 18U);
    }
    float sum = 0.0F;
    for (int i = 0; i < 256; ++i) {
      sum += limit(-5.0F, deadband(scale(inputs[i], -10.0F, 10.0F), 0.25F), 5.0F);
      if (((i + 1) & 15) == 0)
        checksum += gcd(seed, static_cast<uint32_t>(inputs[i]) + 1U);
    }
    checksum = checksum / 2.0 + static_cast<double>(sum);
  }
};

} // namespace

STRIDE_TWIN(Plc)
