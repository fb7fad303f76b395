// Queues of path objects that somebody fills by hand, or wrongly.
#include "runtime/numeric/cnc/queue.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace stride::cnc;

constexpr uint32_t kSize = sizeof(PathObject);

/// Six places with the objects 1 to 6 in them; nothing in the queue.
struct Filled {
  std::vector<PathObject> memory = std::vector<PathObject>(6);
  Queue queue{};

  Filled() {
    for (int32_t i = 0; i < 6; ++i)
      memory[static_cast<size_t>(i)].number = i + 1;
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(memory.data());
    queue.size = 6 * kSize;
  }
};

TEST(CncQueue, ReadsObjectsUpToTheVeryEndOfTheMemory) {
  Filled f;
  f.queue.writePosition = 6 * kSize; // as a compiler leaves it, or a program that copies
  f.queue.endOfList = 1;
  ASSERT_EQ(countOf(&f.queue), 6U);
  EXPECT_TRUE(isFull(&f.queue));
  EXPECT_EQ(objectFromEnd(&f.queue, 0)->number, 6);
  const PathObject more{};
  EXPECT_EQ(append(&f.queue, &more), nullptr);
  for (int32_t i = 1; i <= 6; ++i) {
    ASSERT_EQ(objectAt(&f.queue, 0)->number, i);
    ASSERT_EQ(historyOf(&f.queue), static_cast<uint32_t>(i - 1));
    ASSERT_TRUE(removeAt(&f.queue, 0));
    ASSERT_EQ(objectOfHistory(&f.queue, 0)->number, i);
  }
  EXPECT_EQ(countOf(&f.queue), 0U);
  EXPECT_EQ(checkQueue(&f.queue), QueueError::None);

  ASSERT_TRUE(restore(&f.queue));
  ASSERT_EQ(countOf(&f.queue), 6U);
  EXPECT_EQ(objectAt(&f.queue, 0)->number, 1);
  EXPECT_EQ(objectAt(&f.queue, 5)->number, 6);
}

TEST(CncQueue, GoesOnAtTheBeginningOfTheMemoryWhenItsEndHasBeenReached) {
  Filled f;
  f.queue.writePosition = 6 * kSize;
  ASSERT_TRUE(removeAt(&f.queue, 0));
  PathObject more{};
  more.number = 7;
  EXPECT_EQ(append(&f.queue, &more), nullptr); // the one free place stays free
  ASSERT_TRUE(removeAt(&f.queue, 0));
  EXPECT_EQ(append(&f.queue, &more), f.memory.data());
  EXPECT_EQ(countOf(&f.queue), 5U);
  EXPECT_EQ(objectFromEnd(&f.queue, 0)->number, 7);
  EXPECT_EQ(objectFromEnd(&f.queue, 1)->number, 6);
}

TEST(CncQueue, IsFullWhenOnlyTheReserveIsFree) {
  for (const uint32_t reserved : {0U, 2U, 3U, 4U}) {
    Filled f;
    f.queue.reserved = reserved;
    const PathObject object{};
    const uint32_t least = reserved < 3 ? 3 : reserved;
    for (uint32_t count = 1; count <= 5; ++count) {
      ASSERT_NE(append(&f.queue, &object), nullptr);
      ASSERT_EQ(f.queue.full, 6 - count <= least) << reserved << " " << count;
      ASSERT_EQ(isFull(&f.queue), 6 - count <= least);
    }
    for (uint32_t count = 5; count-- > 0;) {
      ASSERT_TRUE(removeAt(&f.queue, 0));
      ASSERT_EQ(f.queue.full, 6 - count <= least) << reserved << " " << count;
    }
  }
}

TEST(CncQueue, AnEmptyQueueIsNeverFull) {
  Filled f;
  f.queue.reserved = 1000;
  EXPECT_FALSE(isFull(&f.queue));
  f.queue.size = 2 * kSize;
  EXPECT_FALSE(isFull(&f.queue));
  const PathObject object{};
  ASSERT_NE(append(&f.queue, &object), nullptr);
  EXPECT_TRUE(isFull(&f.queue));
}

TEST(CncQueue, CountsPlacesWhereTheSizeIsNotSaid) {
  Filled f;
  f.queue.size = 0;
  f.queue.capacity = 6;
  EXPECT_EQ(capacityOf(&f.queue), 5U);
  EXPECT_TRUE(setSize(&f.queue, 4 * kSize + 17));
  EXPECT_EQ(capacityOf(&f.queue), 3U);
  EXPECT_EQ(f.queue.capacity, 4U);
  const PathObject object{};
  ASSERT_NE(append(&f.queue, &object), nullptr);
  EXPECT_FALSE(setSize(&f.queue, 6 * kSize));
  EXPECT_TRUE(setSize(&f.queue, 4 * kSize + 17));
  EXPECT_EQ(countOf(&f.queue), 1U);
}

TEST(CncQueue, RefusesWhatIsNone) {
  EXPECT_EQ(checkQueue(nullptr), QueueError::NoQueue);
  Filled other;
  other.queue.structId = 0x9879;
  EXPECT_EQ(checkQueue(&other.queue), QueueError::NoQueue);
  EXPECT_FALSE(clear(&other.queue));
  EXPECT_FALSE(setSize(&other.queue, 100));

  Filled none;
  none.queue.buffer = nullptr;
  EXPECT_EQ(checkQueue(&none.queue), QueueError::NoBuffer);
  Filled small;
  small.queue.size = 2 * kSize - 1;
  EXPECT_EQ(checkQueue(&small.queue), QueueError::NoBuffer);
  small.queue.size = 2 * kSize;
  EXPECT_EQ(checkQueue(&small.queue), QueueError::None);
  small.queue.buffer += 1; // and 7 bytes to where an object may begin
  EXPECT_EQ(checkQueue(&small.queue), QueueError::NoBuffer);
}

TEST(CncQueue, RefusesPositionsThatAreNone) {
  for (const uint32_t wrong : {1U, kSize - 1, 7 * kSize, 0xFFFFFFFFU}) {
    Filled f;
    f.queue.readPosition = wrong;
    ASSERT_EQ(checkQueue(&f.queue), QueueError::Positions) << wrong;
    EXPECT_EQ(countOf(&f.queue), 0U);
    EXPECT_EQ(objectAt(&f.queue, 0), nullptr);
    EXPECT_FALSE(removeAt(&f.queue, 0));
    EXPECT_FALSE(restore(&f.queue));
    EXPECT_EQ(historyOf(&f.queue), 0U);
    EXPECT_TRUE(isFull(&f.queue)); // so that nobody goes on filling it
    const PathObject object{};
    f.queue.readPosition = 0;
    f.queue.writePosition = wrong;
    ASSERT_EQ(append(&f.queue, &object), nullptr) << wrong;
  }
}

TEST(CncQueue, ForgetsWhatWasRemovedWhenSomebodyElseMovesTheFirstObject) {
  Filled f;
  f.queue.writePosition = 5 * kSize;
  ASSERT_TRUE(removeAt(&f.queue, 0));
  ASSERT_TRUE(removeAt(&f.queue, 0));
  EXPECT_EQ(historyOf(&f.queue), 2U);
  f.queue.readPosition = 0;
  EXPECT_EQ(historyOf(&f.queue), 0U);
  ASSERT_TRUE(removeAt(&f.queue, 0));
  EXPECT_EQ(historyOf(&f.queue), 1U);
  ASSERT_TRUE(restore(&f.queue));
  EXPECT_EQ(objectAt(&f.queue, 0)->number, 1);
}

TEST(CncQueue, SyncsWhereAnObjectSaysSo) {
  Filled f;
  PathObject object{};
  object.moveType = MoveType::Function;
  object.switchId[0] = 2;
  append(&f.queue, &object);
  EXPECT_FALSE(isSyncing(&f.queue));
  object.switchId[0] = kSynchronise;
  append(&f.queue, &object);
  EXPECT_TRUE(isSyncing(&f.queue));
  removeAt(&f.queue, 1);
  object.moveType = MoveType::Line; // there it is a switch
  append(&f.queue, &object);
  EXPECT_FALSE(isSyncing(&f.queue));
}

} // namespace
