// Service data objects by hand: expedited, segmented, in blocks, and all that a client can do
// wrong.
#include "tests/unit/can_simulation/can_master.hpp"

#include "drivers/can/simulation/canopen_node.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace stride::can::simulation {
namespace {

constexpr size_t kRoom = 2000;

DeviceRows testDevice() {
  DeviceRows device;
  device.objects = {{.index = 0x2000,
                     .type = DataType::VisibleString,
                     .text = "a text of 21 bytes ok",
                     .room = 64},
                    {.index = 0x2001, .type = DataType::Domain, .room = kRoom},
                    {.index = 0x2002, .type = DataType::Unsigned64},
                    {.index = 0x2003, .type = DataType::Integer16, .low = -100, .high = 250},
                    {.index = 0x2004, .access = Access::WriteOnly},
                    {.index = 0x2005, .access = Access::ReadOnly, .value = 42},
                    {.index = 0x2006, .sub = 1, .type = DataType::Unsigned8, .value = 7},
                    {.index = 0x2007, .type = DataType::VisibleString, .room = 8}};
  return device;
}

struct SdoScene : ::testing::Test {
  SdoScene() : SdoScene(NodeSetup{.id = 9}) {}
  explicit SdoScene(const NodeSetup &setup) : node(setup, testDevice()) {
    master.bus.attach(node);
    master.cycle(25);
  }

  /// The answer to one request as text.
  std::string say(std::initializer_list<unsigned> bytes) {
    const auto answer = master.ask(9, bytes);
    if (!answer)
      return "nothing";
    std::string text;
    for (const uint8_t byte : answer->bytes()) {
      const char *digits = "0123456789ABCDEF";
      text += digits[byte >> 4U];
      text += digits[byte & 15U];
    }
    return text;
  }

  std::vector<uint8_t> random(size_t size) {
    std::vector<uint8_t> bytes(size);
    for (uint8_t &byte : bytes)
      byte = static_cast<uint8_t>(generator());
    return bytes;
  }

  void sendBytes(std::array<uint8_t, 8> bytes) {
    Frame frame;
    frame.id = 0x609;
    frame.length = 8;
    frame.data = bytes;
    master.port().send(frame, SendClass::Service);
    master.cycle();
  }

  Master master;
  CanopenNode node;
  std::mt19937 generator{11}; // NOLINT: the same bytes each time
};

TEST_F(SdoScene, Expedited) {
  EXPECT_EQ(say({0x40, 0x05, 0x20, 0, 0, 0, 0, 0}), "430520002A000000");
  EXPECT_EQ(say({0x2B, 0x03, 0x20, 0, 0x9C, 0xFF, 0, 0}), "6003200000000000"); // -100
  EXPECT_EQ(say({0x40, 0x03, 0x20, 0, 0, 0, 0, 0}), "4B0320009CFF0000");
  EXPECT_EQ(say({0x22, 0x03, 0x20, 0, 0x05, 0, 0, 0}), "6003200000000000") << "without a size";
  EXPECT_EQ(say({0x40, 0x06, 0x20, 1, 0, 0, 0, 0}), "4F06200107000000");
}

TEST_F(SdoScene, WhatIsWrongIsAborted) {
  EXPECT_EQ(say({0x40, 0x00, 0x30, 0, 0, 0, 0, 0}), "8000300000000206") << "no object";
  EXPECT_EQ(say({0x40, 0x06, 0x20, 5, 0, 0, 0, 0}), "8006200511000906") << "no subindex";
  EXPECT_EQ(say({0x40, 0x04, 0x20, 0, 0, 0, 0, 0}), "8004200001000106") << "write only";
  EXPECT_EQ(say({0x23, 0x05, 0x20, 0, 1, 0, 0, 0}), "8005200002000106") << "read only";
  EXPECT_EQ(say({0x23, 0x03, 0x20, 0, 1, 0, 0, 0}), "8003200012000706") << "four bytes for two";
  EXPECT_EQ(say({0x2F, 0x03, 0x20, 0, 1, 0, 0, 0}), "8003200013000706") << "one byte for two";
  EXPECT_EQ(say({0x2B, 0x03, 0x20, 0, 0xFB, 0, 0, 0}), "8003200031000906") << "251";
  EXPECT_EQ(say({0x2B, 0x03, 0x20, 0, 0x9B, 0xFF, 0, 0}), "8003200032000906") << "-101";
  EXPECT_EQ(say({0x60, 0, 0, 0, 0, 0, 0, 0}), "8003200001000405") << "a segment of nothing";
  EXPECT_EQ(say({0xE0, 0, 0, 0, 0, 0, 0, 0}).substr(8), "01000405") << "no such command";
  EXPECT_EQ(say({0x40, 0x05, 0x20, 0, 0, 0, 0}), "nothing") << "seven bytes are no request";
  EXPECT_EQ(say({0x80, 0x05, 0x20, 0, 0, 0, 0, 0}), "nothing") << "an abort has no answer";
}

TEST_F(SdoScene, SegmentedUpload) {
  EXPECT_EQ(say({0x40, 0x00, 0x20, 0, 0, 0, 0, 0}), "4100200015000000");
  EXPECT_EQ(say({0x60, 0, 0, 0, 0, 0, 0, 0}), "0061207465787420"); // "a text "
  EXPECT_EQ(say({0x70, 0, 0, 0, 0, 0, 0, 0}), "106F662032312062");
  EXPECT_EQ(say({0x60, 0, 0, 0, 0, 0, 0, 0}), "0179746573206F6B");
  EXPECT_EQ(say({0x70, 0, 0, 0, 0, 0, 0, 0}).substr(8), "01000405") << "there was the end";
  EXPECT_EQ(say({0x40, 0x07, 0x20, 0, 0, 0, 0, 0}), "4107200000000000") << "an empty text";
  EXPECT_EQ(say({0x60, 0, 0, 0, 0, 0, 0, 0}), "0F00000000000000");
}

TEST_F(SdoScene, TheToggleBitMustToggle) {
  say({0x40, 0x00, 0x20, 0, 0, 0, 0, 0});
  say({0x60, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(say({0x60, 0, 0, 0, 0, 0, 0, 0}), "8000200000000305");
  EXPECT_EQ(say({0x21, 0x02, 0x20, 0, 8, 0, 0, 0}), "6002200000000000");
  EXPECT_EQ(say({0x10, 1, 2, 3, 4, 5, 6, 7}), "8002200000000305");
}

TEST_F(SdoScene, SegmentedDownload) {
  EXPECT_EQ(say({0x21, 0x02, 0x20, 0, 8, 0, 0, 0}), "6002200000000000");
  EXPECT_EQ(say({0x00, 1, 2, 3, 4, 5, 6, 7}), "2000000000000000");
  EXPECT_EQ(say({0x1D, 8, 0, 0, 0, 0, 0, 0}), "3000000000000000");
  EXPECT_EQ(node.objects().value(0x2002), 0x0807060504030201U);
  EXPECT_EQ(say({0x21, 0x02, 0x20, 0, 9, 0, 0, 0}), "8002200012000706") << "nine bytes for eight";
  say({0x21, 0x02, 0x20, 0, 8, 0, 0, 0});
  EXPECT_EQ(say({0x01, 1, 2, 3, 4, 5, 6, 7}), "8002200010000706") << "seven, eight were announced";
  say({0x20, 0x07, 0x20, 0, 0, 0, 0, 0}); // without a size
  EXPECT_EQ(say({0x00, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}), "2000000000000000");
  EXPECT_EQ(say({0x10, 'h', 'i', 'j', 'k', 'l', 'm', 'n'}), "8007200012000706") << "no more room";
  EXPECT_EQ(node.objects().value(0x2002), 0x0807060504030201U);
}

TEST_F(SdoScene, AnUnfinishedTransferTimesOut) {
  say({0x21, 0x02, 0x20, 0, 8, 0, 0, 0});
  master.seen.clear();
  master.cycle(995);
  EXPECT_FALSE(master.last(0x589));
  master.cycle(10);
  const auto abort = master.last(0x589);
  ASSERT_TRUE(abort);
  EXPECT_EQ(wordAt(*abort, 4, 4), 0x05040000U);
}

/// A client of block downloads that loses segments on the way.
TEST_F(SdoScene, BlockDownload) {
  EXPECT_EQ(blockChecksum(std::span(reinterpret_cast<const uint8_t *>("123456789"), 9)), 0x31C3);
  for (const size_t size : {1U, 7U, 8U, 889U, 890U, 2000U}) {
    const std::vector<uint8_t> bytes = random(size);
    const auto word = static_cast<unsigned>(size);
    ASSERT_EQ(say({0xC6, 0x01, 0x20, 0, word & 0xFFU, word >> 8U, 0, 0}), "A40120007F000000");
    size_t done = 0;
    int lost = 0;
    while (done < size) {
      uint8_t number = 0;
      size_t at = done;
      bool last = false;
      while (number < 127 && !last) {
        std::array<uint8_t, 8> segment{};
        const size_t count = std::min<size_t>(7, size - at);
        last = at + count == size;
        segment[0] = static_cast<uint8_t>(++number | (last ? 0x80 : 0));
        std::copy_n(bytes.begin() + static_cast<ptrdiff_t>(at), count, segment.begin() + 1);
        at += count;
        if (generator() % 40 != 0 || lost > 20 || size < 100)
          sendBytes(segment);
        else
          ++lost;
      }
      master.cycle(2);
      const auto answer = master.last(0x589);
      if (!answer) { // the last one of the block was lost: it waits for more
        master.send(0x609, {0x80, 1, 0x20, 0, 0, 0, 0x04, 0x05});
        master.cycle(2);
        break;
      }
      ASSERT_EQ(answer->data[0], 0xA2);
      done = std::min(size, done + answer->data[1] * 7U);
    }
    if (done < size)
      continue;
    const uint16_t crc = blockChecksum(bytes);
    const auto unused = static_cast<unsigned>((7 - size % 7) % 7);
    ASSERT_EQ(
        say({0xC1U | unused << 2U, crc & 0xFFU, static_cast<unsigned>(crc >> 8U), 0, 0, 0, 0, 0}),
        "A100000000000000")
        << size;
    EXPECT_EQ(node.objects().at(0x2001).text, bytes);
  }
}

TEST_F(SdoScene, BlockDownloadWithAWrongChecksumChangesNothing) {
  say({0xC6, 0x01, 0x20, 0, 3, 0, 0, 0});
  sendBytes({0x81, 1, 2, 3, 0, 0, 0, 0});
  EXPECT_EQ(say({0xD1, 0x34, 0x12, 0, 0, 0, 0, 0}), "8001200004000405");
  EXPECT_TRUE(node.objects().at(0x2001).text.empty());
  say({0xC6, 0x01, 0x20, 0, 3, 0, 0, 0});
  EXPECT_EQ(say({0x00, 1, 2, 3, 0, 0, 0, 0}), "8001200003000405") << "segment 0";
  EXPECT_EQ(say({0xC6, 0x01, 0x20, 0, 0xD1, 0x07, 0, 0}), "8001200012000706") << "2001 bytes";
}

TEST_F(SdoScene, BlockUpload) {
  for (const size_t size : {5U, 7U, 15U, 889U, 1999U}) {
    const std::vector<uint8_t> bytes = random(size);
    node.objects().at(0x2001).text = bytes;
    const auto begin = master.ask(9, {0xA4, 0x01, 0x20, 0, 20, 0, 0, 0});
    ASSERT_TRUE(begin);
    ASSERT_EQ(begin->data[0], 0xC6);
    ASSERT_EQ(wordAt(*begin, 4, 4), size);
    std::vector<uint8_t> got;
    std::array<uint8_t, 8> next = {0xA3};
    bool end = false;
    while (!end) {
      master.seen.clear();
      sendBytes(next);
      master.cycle(20);
      uint8_t expected = 0;
      for (const Received &received : master.seen) {
        ASSERT_EQ(received.frame.data[0] & 0x7F, ++expected);
        end = end || (received.frame.data[0] & 0x80) != 0;
        got.insert(got.end(), received.frame.data.begin() + 1, received.frame.data.end());
      }
      uint8_t taken = expected;
      if (generator() % 3 == 0 && expected > 2) { // the last ones did not come
        taken = static_cast<uint8_t>(expected - 1 - generator() % 2);
        got.resize(got.size() - (expected - taken) * 7U);
        end = false;
      }
      next = {0xA2, taken, static_cast<uint8_t>(1 + generator() % 100)};
    }
    master.seen.clear();
    sendBytes(next);
    master.cycle(2);
    const auto finish = master.last(0x589);
    ASSERT_TRUE(finish);
    ASSERT_EQ(finish->data[0] & 0xE3, 0xC1);
    got.resize(got.size() - (finish->data[0] >> 2U & 7U));
    EXPECT_EQ(got, bytes);
    EXPECT_EQ(wordAt(*finish, 1, 2), blockChecksum(bytes));
    sendBytes({0xA1});
  }
  EXPECT_EQ(say({0xA4, 0x01, 0x20, 0, 0, 0, 0, 0}).substr(8), "02000405") << "blocks of nothing";
  EXPECT_EQ(say({0xA4, 0x05, 0x20, 0, 10, 20, 0, 0}), "430520002A000000") << "expedited is better";
}

TEST(SdoServerSetup, WithoutBlocksTheyAreUnknown) {
  Master master;
  NodeSetup setup{.id = 9};
  setup.sdo.blocks = false;
  CanopenNode node(setup, testDevice());
  master.bus.attach(node);
  master.cycle(25);
  for (const unsigned command : {0xA4U, 0xC6U}) {
    const auto answer = master.ask(9, {command, 0x01, 0x20, 0, 20, 0, 0, 0});
    ASSERT_TRUE(answer);
    EXPECT_EQ(wordAt(*answer, 4, 4), 0x05040001U);
  }
}

} // namespace
} // namespace stride::can::simulation
