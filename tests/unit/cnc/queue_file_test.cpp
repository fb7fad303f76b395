// Files with queues: the bytes, there and back, and that nothing damaged is taken for a queue.
#include "runtime/numeric/cnc/queue_file.hpp"

#include "runtime/numeric/crc32.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace {

using namespace stride::cnc;

struct Memory {
  std::vector<PathObject> places;
  Queue queue{};
  explicit Memory(size_t count) : places(count) {
    queue.structId = kQueueStructId;
    queue.buffer = reinterpret_cast<uint8_t *>(places.data());
    queue.size = static_cast<uint32_t>(count * sizeof(PathObject));
  }
};

/// An object of which every byte that means something is `byte`.
PathObject objectOf(uint8_t byte) {
  PathObject object;
  std::memset(&object, byte, sizeof object);
  object.planar = 1;
  return object;
}

/// Three objects, which go over the end of the memory.
Memory threeObjects() {
  Memory memory(5);
  memory.queue.readPosition = memory.queue.writePosition = 3 * sizeof(PathObject);
  for (const uint8_t byte : std::array<uint8_t, 3>{0x11, 0x22, 0x33}) {
    const PathObject object = objectOf(byte);
    append(&memory.queue, &object);
  }
  memory.queue.generator = kByCheckVelocities;
  std::strcpy(memory.queue.programName, "Bracket");
  return memory;
}

std::vector<uint8_t> fileOf(const Queue &queue, uint32_t step) {
  std::vector<uint8_t> bytes;
  std::vector<uint8_t> part(step);
  for (;;) {
    const uint32_t count = writeQueueFilePart(&queue, bytes.size(), part.data(), step);
    bytes.insert(bytes.end(), part.begin(), part.begin() + count);
    if (count < step)
      break;
  }
  const uint32_t sum = stride::numeric::crc32(0, bytes.data(), static_cast<int64_t>(bytes.size()));
  for (int i = 0; i < 4; ++i)
    bytes.push_back(static_cast<uint8_t>(sum >> 8 * i));
  return bytes;
}

QueueFileError read(const std::vector<uint8_t> &bytes, Queue &queue) {
  return readQueueFile(bytes.data(), static_cast<int64_t>(bytes.size()), queue);
}

TEST(CncQueueFile, HasTheBytesThatAreDocumented) {
  Memory memory = threeObjects();
  const std::vector<uint8_t> bytes = fileOf(memory.queue, 4096);
  ASSERT_EQ(bytes.size(), 112U + 3 * 872 + 4);
  EXPECT_EQ(queueFileSize(3), 112 + 3 * 872 + 4);
  EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 8), "\x89"
                                                           "CNQ\r\n\x1a\n");
  EXPECT_EQ(std::vector<uint8_t>(bytes.begin() + 8, bytes.begin() + 24),
            (std::vector<uint8_t>{2, 0, 254, 0, 0x68, 3, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_STREQ(reinterpret_cast<const char *>(&bytes[24]), "Bracket");
  EXPECT_EQ(std::count(bytes.begin() + 31, bytes.begin() + 112, 0), 81);
  // Number, line, kind, and two bytes between members, which are 0.
  EXPECT_EQ(
      std::vector<uint8_t>(bytes.begin() + 112, bytes.begin() + 124),
      (std::vector<uint8_t>{0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0x11, 0, 0}));
  EXPECT_EQ(bytes[112 + 872], 0x22);
  EXPECT_EQ(bytes[112 + 2 * 872], 0x33);
}

TEST(CncQueueFile, IsTheSameInPartsOfAnySize) {
  Memory memory = threeObjects();
  const std::vector<uint8_t> whole = fileOf(memory.queue, 100000);
  for (const uint32_t step : {1U, 7U, 111U, 112U, 113U, 872U, 2728U})
    EXPECT_EQ(fileOf(memory.queue, step), whole) << step;
}

TEST(CncQueueFile, GivesTheSameQueueBack) {
  Memory memory = threeObjects();
  const std::vector<uint8_t> bytes = fileOf(memory.queue, 4096);
  for (const size_t places : {3U, 4U, 9U}) { // filled up to its end, and not
    Memory again(places);
    again.queue.readPosition = 1; // whatever was there before
    ASSERT_EQ(read(bytes, again.queue), QueueFileError::None);
    ASSERT_EQ(countOf(&again.queue), 3U);
    EXPECT_EQ(again.queue.endOfList, 1);
    EXPECT_EQ(again.queue.generator, kByCheckVelocities);
    EXPECT_STREQ(again.queue.programName, "Bracket");
    EXPECT_EQ(again.queue.full, isFull(&again.queue));
    EXPECT_EQ(objectAt(&again.queue, 2)->number, 0x33333333);
    EXPECT_EQ(fileOf(again.queue, 4096), bytes);
  }
  Memory small(2);
  EXPECT_EQ(read(bytes, small.queue), QueueFileError::Room);
  Memory empty(4);
  const std::vector<uint8_t> nothing = fileOf(empty.queue, 4096);
  ASSERT_EQ(nothing.size(), 116U);
  ASSERT_EQ(read(nothing, small.queue), QueueFileError::None);
  EXPECT_EQ(countOf(&small.queue), 0U);
}

TEST(CncQueueFile, RefusesWhatIsDamaged) {
  Memory memory = threeObjects();
  const std::vector<uint8_t> bytes = fileOf(memory.queue, 4096);
  for (size_t length = 0; length < bytes.size(); ++length) {
    Memory again(5);
    const std::vector<uint8_t> cut(
        bytes.begin(), bytes.begin() + static_cast<std::vector<uint8_t>::difference_type>(length));
    ASSERT_EQ(read(cut, again.queue), QueueFileError::Truncated) << length;
    ASSERT_EQ(countOf(&again.queue), 0U);
  }
  for (size_t at = 0; at < bytes.size(); at += at < 112 ? 1 : 97) {
    Memory again(5);
    std::vector<uint8_t> spoiled = bytes;
    spoiled[at] ^= 0x40;
    ASSERT_NE(read(spoiled, again.queue), QueueFileError::None) << at;
    ASSERT_EQ(countOf(&again.queue), 0U);
  }
  std::vector<uint8_t> longer = bytes;
  longer.push_back(0);
  Memory again(5);
  EXPECT_EQ(read(longer, again.queue), QueueFileError::Damaged);
}

TEST(CncQueueFile, MendsWhatBytesCanBeButMembersCannot) {
  Memory memory = threeObjects();
  memory.places[3].planar = 0x80;
  memory.queue.generator = 77;
  Memory again(5);
  ASSERT_EQ(read(fileOf(memory.queue, 4096), again.queue), QueueFileError::None);
  EXPECT_EQ(objectAt(&again.queue, 0)->planar, 1);
  EXPECT_EQ(again.queue.generator, kByNobody);
}

TEST(CncQueueFile, WritesNothingOfWhatIsNoQueue) {
  uint8_t bytes[4096];
  EXPECT_EQ(writeQueueFilePart(nullptr, 0, bytes, sizeof bytes), 0U);
  Memory memory = threeObjects();
  memory.queue.readPosition = 5;
  EXPECT_EQ(writeQueueFilePart(&memory.queue, 0, bytes, sizeof bytes), 0U);
}

} // namespace
