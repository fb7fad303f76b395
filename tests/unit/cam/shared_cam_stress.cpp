// A shared cam under ThreadSanitizer: two threads that write, two that read, all at once. No copy
// may be torn, and no reader may go back in time.
#include "runtime/numeric/cam/shared_cam.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

using namespace stride::cam;

namespace {

constexpr int32_t kMost = 200;

struct Shared {
  std::vector<Segment> copies = std::vector<Segment>(size_t{2} * kMost);
  SharedHead heads[2] = {};
  uint32_t written = 0;
  uint32_t begun = 0;
  uint32_t writing = 0;
  SharedCam cam = {{copies.data(), copies.data() + kMost}, heads, &written, &begun, &writing};
};

int32_t countOf(uint64_t mark) { return 1 + static_cast<int32_t>(mark * 37 % kMost); }

/// Every number of it says which cam it belongs to.
Segment segmentOf(uint64_t mark, int32_t index) {
  const auto m = static_cast<double>(mark);
  Segment segment = {m + index, m - index, {}, m, m, m, m, m, Law::Polynomial};
  for (int i = 0; i < 8; ++i)
    segment.coefficients[i] = m * (i + 2) + index;
  return segment;
}

bool isSame(const Segment &a, const Segment &b) {
  bool same = a.start == b.start && a.end == b.end && a.stroke == b.stroke &&
              a.lawBegin == b.lawBegin && a.lawEnd == b.lawEnd && a.parameter == b.parameter &&
              a.inflexion == b.inflexion && a.law == b.law;
  for (int i = 0; i < 8; ++i)
    same = same && a.coefficients[i] == b.coefficients[i];
  return same;
}

bool write(const SharedCam &cam, uint64_t mark) {
  SharedWriter writer(cam);
  if (!writer.isOpen())
    return false;
  for (int32_t i = 0; i < countOf(mark); ++i)
    writer.put(i, segmentOf(mark, i));
  writer.finish({static_cast<double>(mark), -static_cast<double>(mark), countOf(mark)});
  return true;
}

TEST(SharedCamStress, NoCopyIsTorn) {
  Shared shared;
  constexpr uint64_t kCams = 4000;
  std::atomic<uint64_t> mark{0};
  std::atomic<bool> done{false};
  std::atomic<int> wrong{0};
  std::atomic<int64_t> good{0};
  std::atomic<int64_t> overtaken{0};
  std::atomic<int64_t> busy{0};
  const auto writer = [&] {
    for (uint64_t own = ++mark; own <= kCams; own = ++mark)
      while (!write(shared.cam, own)) {
        ++busy;
        std::this_thread::yield();
      }
  };
  const auto reader = [&] {
    std::vector<Segment> target(kMost);
    uint32_t last = 0;
    int64_t copies = 0;
    // Until the writers are done, and a last time.
    for (bool goOn = true; goOn || copies == 0;) {
      goOn = !done.load();
      const uint32_t before = __atomic_load_n(&shared.written, __ATOMIC_ACQUIRE);
      SharedHead head = {};
      const SharedResult result = readShared(shared.cam, target.data(), kMost, head);
      if (result == SharedResult::Overtaken) {
        ++overtaken;
        continue;
      }
      if (result != SharedResult::Good) {
        wrong += result != SharedResult::None || before != 0;
        continue;
      }
      ++copies;
      ++good;
      const auto of = static_cast<uint64_t>(head.start);
      bool whole = head.end == -head.start && head.count == countOf(of);
      for (int32_t i = 0; whole && i < head.count; ++i)
        whole = isSame(target[static_cast<size_t>(i)], segmentOf(of, i));
      wrong += !whole;
      wrong += before < last;
      last = before;
    }
  };
  std::vector<std::thread> writers;
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back(reader);
    writers.emplace_back(writer);
  }
  for (std::thread &thread : writers)
    thread.join();
  done = true;
  for (std::thread &thread : readers)
    thread.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_GE(good, 100);
  RecordProperty("good", std::to_string(good));
  RecordProperty("overtaken", std::to_string(overtaken));
  RecordProperty("busy", std::to_string(busy));
}

/// What happens in between, one step at a time.
TEST(SharedCamStress, AReaderIsOvertakenOnlyByTwoCams) {
  Shared shared;
  SharedHead head = {};
  std::vector<Segment> target(kMost);
  EXPECT_EQ(readShared(shared.cam, target.data(), kMost, head), SharedResult::None);
  ASSERT_TRUE(write(shared.cam, 1));
  EXPECT_EQ(shared.written, 1U);
  EXPECT_EQ(readShared(shared.cam, target.data(), 1, head), SharedResult::TooSmall);
  {
    SharedWriter writer(shared.cam); // the second one, half done
    ASSERT_TRUE(writer.isOpen());
    EXPECT_FALSE(write(shared.cam, 3));
    writer.put(0, segmentOf(2, 0));
    ASSERT_EQ(readShared(shared.cam, target.data(), kMost, head), SharedResult::Good);
    EXPECT_EQ(head.start, 1.0);
    EXPECT_TRUE(isSame(target[0], segmentOf(1, 0)));
  }
  EXPECT_EQ(shared.written, 1U); // given up
  ASSERT_TRUE(write(shared.cam, 2));
  ASSERT_EQ(readShared(shared.cam, target.data(), kMost, head), SharedResult::Good);
  EXPECT_EQ(head.start, 2.0);
  shared.begun = 4; // as if a writer were in the middle of the copy that is read
  EXPECT_EQ(readShared(shared.cam, target.data(), kMost, head), SharedResult::Overtaken);
}

TEST(SharedCamStress, TheNumberIsNever0Again) {
  Shared shared;
  shared.written = shared.begun = 0xFFFFFFFFU;
  ASSERT_TRUE(write(shared.cam, 1));
  EXPECT_EQ(shared.written, 2U);
  SharedHead head = {};
  std::vector<Segment> target(kMost);
  EXPECT_EQ(readShared(shared.cam, target.data(), kMost, head), SharedResult::Good);
}

} // namespace
