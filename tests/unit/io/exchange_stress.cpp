// Bytes between the driver of a bus and the tasks that use them, under ThreadSanitizer: no value of
// up to 8 bytes at an aligned place is seen in halves.
#include "runtime/common/io_exchange.hpp"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace stride::common {
namespace {

TEST(IoExchangeStress, AlignedValuesAreWhole) {
  constexpr uint32_t kRounds = 100'000;
  IoExchange exchange(24, 24);
  std::atomic<bool> ends{false};
  std::thread bus([&] {
    std::array<uint8_t, 24> bytes{};
    for (uint32_t i = 0; i < kRounds; ++i) {
      bytes.fill(static_cast<uint8_t>(i));
      exchange.inputs.write(0, bytes);
      exchange.works.store(i % 2 == 0, std::memory_order_release);
    }
    ends.store(true);
  });
  const auto isOne = [](std::span<const uint8_t> bytes) {
    for (const uint8_t one : bytes)
      if (one != bytes[0])
        return false;
    return true;
  };
  for (bool end = false; !end;) {
    end = ends.load();
    std::array<uint8_t, 8> eight{};
    exchange.inputs.read(8, eight);
    ASSERT_TRUE(isOne(eight));
    std::array<uint8_t, 4> four{};
    exchange.inputs.read(20, four);
    ASSERT_TRUE(isOne(four));
    std::array<uint8_t, 2> two{};
    exchange.inputs.read(6, two);
    ASSERT_TRUE(isOne(two));
    (void)exchange.works.load(std::memory_order_acquire);
  }
  bus.join();
}

} // namespace
} // namespace stride::common
