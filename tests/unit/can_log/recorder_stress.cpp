// The recorder between its two threads, under ThreadSanitizer.
#include "drivers/can/log/recorder.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace stride::can::log {
namespace {

TEST(CanRecorderStress, NothingIsMixedUp) {
  constexpr int64_t kFrames = 200'000;
  Recorder recorder(64);
  std::atomic<bool> ends{false};
  std::thread cyclic([&] {
    for (int64_t i = 0; i < kFrames; ++i) {
      Entry entry;
      entry.timeNs = i;
      entry.frame.id = static_cast<uint16_t>(i % 2048);
      recorder.put(entry);
    }
    ends.store(true);
  });
  int64_t taken = 0;
  int64_t last = -1;
  Entry entry;
  for (bool end = false; !end;) {
    end = ends.load();
    while (recorder.take(entry)) {
      ASSERT_GT(entry.timeNs, last);
      ASSERT_EQ(entry.frame.id, entry.timeNs % 2048);
      last = entry.timeNs;
      ++taken;
    }
  }
  cyclic.join();
  EXPECT_EQ(taken + static_cast<int64_t>(recorder.lost()), kFrames);
  EXPECT_GT(taken, 0);
}

} // namespace
} // namespace stride::can::log
