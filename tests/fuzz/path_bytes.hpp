#ifndef STRIDE_TESTS_FUZZ_PATH_BYTES_HPP
#define STRIDE_TESTS_FUZZ_PATH_BYTES_HPP
// Numbers out of a fuzzer's bytes, many of them odd ones.

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>

namespace stride::fuzz {

/// Takes bytes as they are needed; zeros after the end.
struct Bytes {
  const uint8_t *data;
  size_t size;

  uint8_t next() {
    if (size == 0)
      return 0;
    --size;
    return *data++;
  }
  uint32_t below(uint32_t most) { return next() % most; }
  double number() {
    constexpr double kStrange[] = {0.0,
                                   -0.0,
                                   1e-300,
                                   1e300,
                                   -1e18,
                                   1e-9,
                                   std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity()};
    const uint8_t kind = next();
    if (kind < std::size(kStrange))
      return kStrange[kind];
    const int value = static_cast<int8_t>(next());
    return kind < 200 ? value : value + kind / 256.0;
  }
};

} // namespace stride::fuzz

#endif // STRIDE_TESTS_FUZZ_PATH_BYTES_HPP
