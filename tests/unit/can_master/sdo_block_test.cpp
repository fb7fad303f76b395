// Block transfers, and answers of any kind.
#include "drivers/can/master/crc16.hpp"
#include "drivers/can/master/frames.hpp"
#include "drivers/can/master/sdo_client.hpp"
#include "tests/unit/can_master/script.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace stride::can {
namespace {

constexpr uint32_t kTimeout = 20;

std::vector<uint8_t> counting(size_t size) {
  std::vector<uint8_t> result(size);
  std::iota(result.begin(), result.end(), uint8_t{3});
  return result;
}

// The example of the polynomial that everybody gives.
TEST(Crc16, OfOneToNine) {
  EXPECT_EQ(crc16(std::array<uint8_t, 9>{0x31, 0x32, 0x33, 0x34, 0x35, 0x36, 0x37, 0x38, 0x39}),
            0x31C3);
}

/// A node that takes and gives blocks, as far as a test needs it.
class BlockNode {
public:
  std::vector<uint8_t> data;
  uint8_t blockSize = 5;
  int loseSegment = -1; ///< The one with this number since the beginning …
  bool damage = false;  ///< … and the check sum is wrong.

  /// The answers to a frame.
  std::vector<std::string> download(const Frame &frame) {
    if (!running_) {
      running_ = true;
      size_ = readNumber(frame, 4, 4);
      return {answer(0xA4, blockSize, true)};
    }
    if (ended_) {
      const size_t unused = frame.data[0] >> 2U & 7U;
      data.resize(data.size() - unused);
      const bool right = readNumber(frame, 1, 2) == crc16(data) && data.size() == size_;
      return {right ? "A100000000000000" : "8000200004000405"};
    }
    const unsigned number = frame.data[0] & 0x7FU;
    const bool last = (frame.data[0] & 0x80U) != 0;
    if (seen_++ != loseSegment && number == arrived_ + 1) {
      data.insert(data.end(), frame.data.begin() + 1, frame.data.end());
      ++arrived_;
      ended_ = last;
    }
    if (number != blockSize && !last)
      return {};
    char text[32];
    std::snprintf(text, sizeof text, "A2%02X%02X0000000000", arrived_, blockSize);
    arrived_ = 0;
    return {text};
  }

  std::vector<std::string> upload(const Frame &frame) {
    std::vector<std::string> answers;
    char text[32];
    switch (frame.data[0]) {
    case 0xA4:
      std::snprintf(text, sizeof text, "C6002003%02X%02X0000",
                    static_cast<unsigned>(data.size() & 0xFFU),
                    static_cast<unsigned>(data.size() >> 8U));
      return {text};
    case 0xA2:
      at_ += size_t{frame.data[1]} * 7;
      [[fallthrough]];
    case 0xA3: {
      if (at_ >= data.size()) {
        const size_t rest = data.size() % 7;
        const unsigned crc = crc16(data) + (damage ? 1U : 0U);
        std::snprintf(text, sizeof text, "%02X%02X%02X0000000000",
                      static_cast<unsigned>(0xC1U | (rest == 0 ? 0 : 7 - rest) << 2U), crc & 0xFFU,
                      crc >> 8U & 0xFFU);
        return {text};
      }
      for (unsigned number = 1; number <= 127 && at_ + (number - 1) * 7 < data.size(); ++number) {
        std::string one;
        const size_t first = at_ + (number - 1) * 7;
        const bool last = first + 7 >= data.size();
        std::snprintf(text, sizeof text, "%02X", number | (last ? 0x80U : 0U));
        one = text;
        for (size_t i = first; i < first + 7; ++i) {
          std::snprintf(text, sizeof text, "%02X", i < data.size() ? data[i] : 0U);
          one += text;
        }
        if (seen_++ != loseSegment)
          answers.push_back(one);
      }
      return answers;
    }
    default:
      return {};
    }
  }

private:
  static std::string answer(unsigned first, unsigned fourth, bool object) {
    char text[32];
    std::snprintf(text, sizeof text, "%02X%s%02X000000", first, object ? "002003" : "000000",
                  fourth);
    return text;
  }
  bool running_ = false;
  bool ended_ = false;
  size_t size_ = 0;
  size_t at_ = 0;
  unsigned arrived_ = 0;
  int seen_ = 0;
};

/// Lets client and node talk until nobody says anything more.
template <class Answer> void talk(SdoClient &client, Answer answer) {
  for (int i = 0; i < 5000 && client.pending(); ++i) {
    const Frame frame = client.nextFrame();
    client.sent();
    for (const std::string &one : answer(frame))
      client.received(test::frame("581#" + one));
  }
}

TEST(SdoBlock, DownloadsOfManySizes) {
  for (const size_t size : {65U, 69U, 70U, 71U, 77U, 255U, 888U, 889U, 890U, 2000U})
    for (const uint8_t block : {uint8_t{1}, uint8_t{2}, uint8_t{5}, uint8_t{127}})
      for (const int lost : {-1, 0, 3, 9}) {
        SdoClient client(1, kTimeout);
        BlockNode node;
        node.blockSize = block;
        node.loseSegment = lost;
        const std::vector<uint8_t> bytes = counting(size);
        ASSERT_TRUE(client.download({0x2000, 3}, bytes));
        talk(client, [&](const Frame &frame) { return node.download(frame); });
        ASSERT_EQ(client.state(), SdoClient::State::Done)
            << size << ' ' << int{block} << ' ' << lost;
        EXPECT_EQ(node.data, bytes);
      }
}

TEST(SdoBlock, UploadsOfManySizes) {
  for (const size_t size : {1U, 6U, 7U, 8U, 65U, 70U, 71U, 888U, 889U, 890U, 2000U})
    for (const int lost : {-1, 0, 3, 126, 130}) {
      SdoClient client(1, kTimeout);
      BlockNode node;
      node.loseSegment = lost;
      node.data = counting(size);
      std::vector<uint8_t> buffer(2000);
      ASSERT_TRUE(client.upload({0x2000, 3}, buffer));
      talk(client, [&](const Frame &frame) { return node.upload(frame); });
      // The last segment of a block is missed by nobody but the clock.
      const size_t segments = (size + 6) / 7;
      if (lost >= 0 && (static_cast<size_t>(lost) == segments - 1 || lost == 126) &&
          static_cast<size_t>(lost) < segments) {
        EXPECT_EQ(client.state(), SdoClient::State::Busy);
        for (uint32_t i = 0; i < kTimeout; ++i)
          client.cycle();
        EXPECT_EQ(client.abortCode(), abort_code::kTimedOut);
        continue;
      }
      ASSERT_EQ(client.state(), SdoClient::State::Done) << size << ' ' << lost;
      ASSERT_EQ(client.size(), size);
      EXPECT_TRUE(std::equal(node.data.begin(), node.data.end(), buffer.begin()));
    }
}

TEST(SdoBlock, AWrongCheckSumFails) {
  SdoClient client(1, kTimeout);
  BlockNode node;
  node.damage = true;
  node.data = counting(100);
  std::vector<uint8_t> buffer(100);
  ASSERT_TRUE(client.upload({0x2000, 3}, buffer));
  talk(client, [&](const Frame &frame) { return node.upload(frame); });
  EXPECT_EQ(client.state(), SdoClient::State::Failed);
  EXPECT_EQ(client.abortCode(), abort_code::kCrc);
}

TEST(SdoBlock, MoreThanTheBufferHolds) {
  SdoClient client(1, kTimeout);
  BlockNode node;
  node.data = counting(101);
  std::vector<uint8_t> buffer(100);
  ASSERT_TRUE(client.upload({0x2000, 3}, buffer));
  talk(client, [&](const Frame &frame) { return node.upload(frame); });
  EXPECT_EQ(client.abortCode(), abort_code::kMemory);
}

TEST(SdoBlock, ANodeMayAnswerAnotherWay) {
  for (const char *answer : {"4300200311223344", "4100200302000000"}) {
    SdoClient client(1, kTimeout);
    std::vector<uint8_t> buffer(100);
    ASSERT_TRUE(client.upload({0x2000, 3}, buffer));
    EXPECT_EQ(test::text(client.nextFrame()), "601#A40020037F400000");
    client.sent();
    client.received(test::frame(std::string("581#") + answer));
    if (client.pending()) {
      EXPECT_EQ(test::text(client.nextFrame()), "601#6000000000000000");
      client.sent();
      client.received(test::frame("581#0B11220000000000"));
    }
    EXPECT_EQ(client.state(), SdoClient::State::Done);
    EXPECT_EQ(buffer[1], 0x22);
  }
}

TEST(SdoBlock, ANodeWithoutBlocksIsAskedInSegmentsForGood) {
  SdoClient client(1, kTimeout);
  std::vector<uint8_t> buffer(100);
  ASSERT_TRUE(client.upload({0x2000, 3}, buffer));
  client.sent();
  client.received(test::frame("581#8000200301000405"));
  EXPECT_EQ(test::text(client.nextFrame()), "601#4000200300000000");
  client.sent();
  client.received(test::frame("581#4300200311223344"));
  EXPECT_EQ(client.state(), SdoClient::State::Done);
  const std::vector<uint8_t> bytes = counting(80);
  ASSERT_TRUE(client.download({0x2000, 3}, bytes));
  EXPECT_EQ(test::text(client.nextFrame()), "601#2100200350000000");
}

TEST(SdoBlock, ANodeThatTakesNothingIsGivenUp) {
  SdoClient client(1, kTimeout);
  const std::vector<uint8_t> bytes = counting(100);
  ASSERT_TRUE(client.download({0x2000, 3}, bytes));
  int blocks = 0;
  talk(client, [&](const Frame &frame) -> std::vector<std::string> {
    if (frame.data[0] == 0xC6)
      return {"A400200302000000"};
    if (frame.data[0] == 2) {
      ++blocks;
      return {"A200020000000000"};
    }
    return {};
  });
  EXPECT_EQ(client.abortCode(), abort_code::kSequence);
  EXPECT_EQ(blocks, 3);
}

TEST(SdoBlock, BlockSizesOfZeroAndMoreThan127AreRefused) {
  for (const char *answer : {"A400200300000000", "A400200380000000"}) {
    SdoClient client(1, kTimeout);
    const std::vector<uint8_t> bytes = counting(100);
    ASSERT_TRUE(client.download({0x2000, 3}, bytes));
    client.sent();
    client.received(test::frame(std::string("581#") + answer));
    EXPECT_EQ(client.abortCode(), abort_code::kBlockSize);
  }
}

// Whatever comes, a transfer ends, and nothing is written beside the buffer.
TEST(SdoFuzz, RandomAnswers) {
  std::mt19937 random(11);
  for (int run = 0; run < 20000; ++run) {
    SdoClient client(1, kTimeout);
    std::vector<uint8_t> buffer(random() % 3 == 0 ? random() % 300 : random() % 70);
    const std::vector<uint8_t> bytes = counting(1 + random() % 300);
    if (random() % 2 != 0)
      ASSERT_TRUE(client.upload({0x2000, 3}, buffer));
    else
      ASSERT_TRUE(client.download({0x2000, 3}, bytes));
    int cycles = 0;
    for (; client.state() == SdoClient::State::Busy && cycles < 20000; ++cycles) {
      for (int i = 0; i < 4 && client.pending(); ++i) {
        (void)client.nextFrame();
        client.sent();
      }
      static constexpr std::array<uint8_t, 16> kFirst = {0x60, 0x20, 0x30, 0x00, 0x10, 0x41,
                                                         0x40, 0x43, 0xA4, 0xA2, 0xA1, 0xC6,
                                                         0xC1, 0x01, 0x02, 0x81};
      Frame frame = test::frame("581#0000200300000000");
      frame.data[0] = random() % 8 == 0 ? static_cast<uint8_t>(random() & 0xFF)
                                        : kFirst[random() % kFirst.size()];
      if (random() % 2 == 0)
        for (size_t i = 1; i < 8; ++i)
          frame.data[i] = static_cast<uint8_t>(random() & (random() % 2 != 0 ? 0xFF : 0x07));
      if (random() % 50 == 0)
        frame.length = static_cast<uint8_t>(random() % 8);
      if (random() % 4 != 0)
        client.received(frame);
      client.cycle();
    }
    ASSERT_NE(client.state(), SdoClient::State::Busy) << run;
  }
}

} // namespace
} // namespace stride::can
