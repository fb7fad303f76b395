// SDO transfers word by word, as CiA 301 draws them.
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

std::vector<uint8_t> bytesOf(const std::string &hex) {
  std::vector<uint8_t> result;
  for (size_t i = 0; i + 1 < hex.size(); i += 2)
    result.push_back(static_cast<uint8_t>(std::strtoul(hex.substr(i, 2).c_str(), nullptr, 16)));
  return result;
}

std::vector<uint8_t> counting(size_t size) {
  std::vector<uint8_t> result(size);
  std::iota(result.begin(), result.end(), uint8_t{3});
  return result;
}

class Sdo : public ::testing::Test {
protected:
  /// Lines "> 601#…" are what the client must say next, "< 581#…" what it is told.
  void play(const std::string &script) {
    for (const std::string &line : test::lines(script)) {
      const Frame frame = test::frame(line.substr(2));
      if (line[0] == '<') {
        client.received(frame);
        continue;
      }
      ASSERT_TRUE(client.pending()) << line;
      EXPECT_EQ(test::text(client.nextFrame()), test::text(frame));
      client.sent();
    }
  }
  void expectDone(size_t size) {
    EXPECT_EQ(client.state(), SdoClient::State::Done);
    EXPECT_EQ(client.size(), size);
    EXPECT_FALSE(client.pending());
  }
  void expectFailed(uint32_t code) {
    EXPECT_EQ(client.state(), SdoClient::State::Failed);
    EXPECT_EQ(client.abortCode(), code);
  }

  SdoClient client{1, kTimeout};
  std::vector<uint8_t> buffer = std::vector<uint8_t>(64);
};

TEST_F(Sdo, ExpeditedUploadsOfEachSize) {
  const std::array<std::pair<const char *, std::vector<uint8_t>>, 5> answers = {
      {{"< 581# 4F 00 10 02 11 00 00 00", {0x11}},
       {"< 581# 4B 00 10 02 11 22 00 00", {0x11, 0x22}},
       {"< 581# 47 00 10 02 11 22 33 00", {0x11, 0x22, 0x33}},
       {"< 581# 43 00 10 02 11 22 33 44", {0x11, 0x22, 0x33, 0x44}},
       {"< 581# 42 00 10 02 11 22 33 44", {0x11, 0x22, 0x33, 0x44}}}}; // no size
  for (const auto &[answer, bytes] : answers) {
    ASSERT_TRUE(client.upload({0x1000, 2}, buffer));
    EXPECT_FALSE(client.upload({0x1001, 0}, buffer)) << "one at a time";
    EXPECT_FALSE(client.download({0x1001, 0}, buffer));
    play("> 601# 40 00 10 02 00 00 00 00\n" + std::string(answer));
    expectDone(bytes.size());
    EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), buffer.begin()));
  }
}

TEST_F(Sdo, ExpeditedDownloadsOfEachSize) {
  const std::array<const char *, 4> questions = {
      "> 601# 2F 17 10 00 01 00 00 00", "> 601# 2B 17 10 00 01 02 00 00",
      "> 601# 27 17 10 00 01 02 03 00", "> 601# 23 17 10 00 01 02 03 04"};
  const std::array<uint8_t, 4> bytes = {1, 2, 3, 4};
  for (size_t size = 1; size <= 4; ++size) {
    ASSERT_TRUE(client.download({0x1017, 0}, std::span(bytes).first(size)));
    play(std::string(questions[size - 1]) + "\n< 581# 60 17 10 00 00 00 00 00");
    expectDone(size);
  }
  EXPECT_FALSE(client.download({0x1017, 0}, {})) << "nothing to write";
}

TEST_F(Sdo, SegmentedUpload) {
  ASSERT_TRUE(client.upload({0x1008, 0}, buffer));
  play(R"(> 601# 40 08 10 00 00 00 00 00
          < 581# 41 08 10 00 09 00 00 00
          > 601# 60 00 00 00 00 00 00 00
          < 581# 00 53 74 72 69 64 65 20
          > 601# 70 00 00 00 00 00 00 00
          < 581# 1B 34 30 00 00 00 00 00)");
  expectDone(9);
  EXPECT_EQ(std::string(buffer.begin(), buffer.begin() + 9), "Stride 40");
  // Without an announced size.
  ASSERT_TRUE(client.upload({0x1008, 0}, buffer));
  play(R"(> 601# 40 08 10 00 00 00 00 00
          < 581# 40 08 10 00 00 00 00 00
          > 601# 60 00 00 00 00 00 00 00
          < 581# 09 41 42 43 00 00 00 00)");
  expectDone(3);
}

TEST_F(Sdo, EmptyObjects) {
  ASSERT_TRUE(client.upload({0x1008, 0}, buffer));
  play(R"(> 601# 40 08 10 00 00 00 00 00
          < 581# 41 08 10 00 00 00 00 00
          > 601# 60 00 00 00 00 00 00 00
          < 581# 0F 00 00 00 00 00 00 00)");
  expectDone(0);
  ASSERT_TRUE(client.upload({0x1008, 0}, buffer));
  play(R"(> 601# 40 08 10 00 00 00 00 00
          < 581# 41 08 10 00 00 00 00 00
          > 601# 60 00 00 00 00 00 00 00
          < 581# 80 08 10 00 01 00 04 05)");
  expectDone(0);
}

TEST_F(Sdo, SegmentedDownload) {
  const std::vector<uint8_t> bytes = bytesOf("0102030405060708090A0B0C0D0E0F");
  ASSERT_TRUE(client.download({0x2000, 3}, bytes));
  play(R"(> 601# 21 00 20 03 0F 00 00 00
          < 581# 60 00 20 03 00 00 00 00
          > 601# 00 01 02 03 04 05 06 07
          < 581# 20 00 00 00 00 00 00 00
          > 601# 10 08 09 0A 0B 0C 0D 0E
          < 581# 30 00 00 00 00 00 00 00
          > 601# 0D 0F 00 00 00 00 00 00
          < 581# 20 00 00 00 00 00 00 00)");
  expectDone(15);
}

TEST_F(Sdo, WrongAnswersEndTheTransfer) {
  struct Case {
    const char *what;
    const char *script;
    uint32_t code;
  };
  const std::array<Case, 9> cases = {{
      {"another index", "< 581# 43 01 10 00 00 00 00 00", abort_code::kCommand},
      {"another subindex", "< 581# 43 00 10 01 00 00 00 00", abort_code::kCommand},
      {"an answer to a download", "< 581# 60 00 10 00 00 00 00 00", abort_code::kCommand},
      {"an unknown command", "< 581# E0 00 10 00 00 00 00 00", abort_code::kCommand},
      {"a short frame", "< 581# 43 00 10 00", abort_code::kCommand},
      {"too long for whoever asks", "< 581# 41 00 10 00 41 00 00 00", abort_code::kMemory},
      {"huge", "< 581# 41 00 10 00 FF FF FF FF", abort_code::kMemory},
      {"the toggle bit",
       "< 581# 41 00 10 00 09 00 00 00\n> 601# 60 00 00 00 00 00 00 00\n"
       "< 581# 10 01 02 03 04 05 06 07",
       abort_code::kToggle},
      {"less than announced",
       "< 581# 41 00 10 00 09 00 00 00\n> 601# 60 00 00 00 00 00 00 00\n"
       "< 581# 01 01 02 03 04 05 06 07",
       abort_code::kTooShort},
  }};
  uint32_t misfits = 0;
  for (const Case &one : cases) {
    SCOPED_TRACE(one.what);
    ASSERT_TRUE(client.upload({0x1000, 0}, buffer));
    play(std::string("> 601# 40 00 10 00 00 00 00 00\n") + one.script);
    expectFailed(one.code);
    char code[16];
    std::snprintf(code, sizeof code, "%02X%02X%02X%02X", one.code & 0xFF, one.code >> 8 & 0xFF,
                  one.code >> 16 & 0xFF, one.code >> 24);
    play("> 601# 80 00 10 00" + std::string(code));
    EXPECT_FALSE(client.pending());
    misfits += one.code == abort_code::kMemory || one.code == abort_code::kTooShort ? 0 : 1;
    EXPECT_EQ(client.misfits(), misfits);
  }
}

TEST_F(Sdo, MoreThanAnnounced) {
  ASSERT_TRUE(client.upload({0x1000, 0}, buffer));
  play(R"(> 601# 40 00 10 00 00 00 00 00
          < 581# 41 00 10 00 06 00 00 00
          > 601# 60 00 00 00 00 00 00 00
          < 581# 00 01 02 03 04 05 06 07)");
  expectFailed(abort_code::kTooLong);
}

TEST_F(Sdo, EmptySegmentsWithoutEndAreRefused) {
  ASSERT_TRUE(client.upload({0x1000, 0}, buffer));
  play(R"(> 601# 40 00 10 00 00 00 00 00
          < 581# 40 00 10 00 00 00 00 00
          > 601# 60 00 00 00 00 00 00 00
          < 581# 0E 00 00 00 00 00 00 00)");
  expectFailed(abort_code::kTooShort);
}

TEST_F(Sdo, AbortsOfTheNode) {
  ASSERT_TRUE(client.upload({0x1000, 0}, buffer));
  play("> 601# 40 00 10 00 00 00 00 00\n< 581# 80 00 10 00 00 00 02 06");
  expectFailed(abort_code::kNoObject);
  EXPECT_FALSE(client.pending()) << "nobody is told what he knows";
  EXPECT_FALSE(client.timedOut());
  ASSERT_TRUE(client.upload({0x1000, 0}, buffer));
  play("> 601# 40 00 10 00 00 00 00 00\n< 581# 80 00 10 00 00 00 00 00");
  expectFailed(abort_code::kGeneral);
}

TEST_F(Sdo, TimesOutAtTheLastCycleAndNotBefore) {
  for (const uint32_t answered : {kTimeout - 1, kTimeout, kTimeout + 1}) {
    SCOPED_TRACE(answered);
    SdoClient one(1, kTimeout);
    ASSERT_TRUE(one.upload({0x1000, 0}, buffer));
    one.sent();
    for (uint32_t i = 0; i < answered; ++i)
      one.cycle();
    one.received(test::frame("581# 4F 00 10 00 07 00 00 00"));
    if (answered < kTimeout) {
      EXPECT_EQ(one.state(), SdoClient::State::Done);
      continue;
    }
    EXPECT_EQ(one.state(), SdoClient::State::Failed);
    EXPECT_TRUE(one.timedOut());
    EXPECT_EQ(one.abortCode(), abort_code::kTimedOut);
    ASSERT_TRUE(one.pending());
    EXPECT_EQ(test::text(one.nextFrame()), "601#8000100000000405");
    EXPECT_EQ(one.unasked(), 0U) << "a late answer is no second node";
    one.received(test::frame("581# 4F 00 10 00 07 00 00 00"));
    EXPECT_EQ(one.unasked(), 1U);
  }
}

TEST_F(Sdo, EachAnswerHasItsTime) {
  ASSERT_TRUE(client.upload({0x1008, 0}, buffer));
  play("> 601# 40 08 10 00 00 00 00 00");
  for (uint32_t i = 0; i + 1 < kTimeout; ++i)
    client.cycle();
  play("< 581# 41 08 10 00 09 00 00 00\n> 601# 60 00 00 00 00 00 00 00");
  for (uint32_t i = 0; i + 1 < kTimeout; ++i)
    client.cycle();
  EXPECT_EQ(client.state(), SdoClient::State::Busy);
  client.cycle();
  expectFailed(abort_code::kTimedOut);
}

TEST_F(Sdo, AFrameThatCannotBeSentTimesOutToo) {
  ASSERT_TRUE(client.upload({0x1000, 0}, buffer));
  for (uint32_t i = 0; i < kTimeout; ++i)
    client.cycle();
  expectFailed(abort_code::kTimedOut);
}

TEST_F(Sdo, TheLateAnswerDoesNotEndTheNextQuestion) {
  ASSERT_TRUE(client.upload({0x1000, 0}, buffer));
  client.sent();
  for (uint32_t i = 0; i < kTimeout; ++i)
    client.cycle();
  client.sent(); // the abort
  ASSERT_TRUE(client.upload({0x1001, 0}, buffer));
  play(R"(> 601# 40 01 10 00 00 00 00 00
          < 581# 43 00 10 00 01 02 03 04
          < 581# 4F 01 10 00 55 00 00 00)");
  expectDone(1);
}

TEST_F(Sdo, CountsAnswersThatNobodyHasAskedFor) {
  play("< 581# 43 00 10 00 01 02 03 04");
  EXPECT_EQ(client.unasked(), 1U);
  ASSERT_TRUE(client.upload({0x1001, 0}, buffer));
  play("< 581# 43 00 10 00 01 02 03 04"); // before the question is on the bus
  EXPECT_EQ(client.unasked(), 2U);
  play("> 601# 40 01 10 00 00 00 00 00\n< 581# 4F 01 10 00 55 00 00 00");
  expectDone(1);
  client.clear();
  EXPECT_EQ(client.unasked(), 0U);
}

TEST_F(Sdo, CancelTellsTheNode) {
  ASSERT_TRUE(client.upload({0x1000, 5}, buffer));
  client.sent();
  client.cancel();
  expectFailed(abort_code::kGeneral);
  play("> 601# 80 00 10 05 00 00 00 08");
  client.cancel();
  EXPECT_FALSE(client.pending());
}

// The example of the polynomial that everybody gives.
TEST(Crc16, OfOneToNine) { EXPECT_EQ(crc16(bytesOf("313233343536373839")), 0x31C3); }

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

TEST(SdoAbort, EveryCodeHasAText) {
  uint32_t before = 0;
  for (const AbortRow &row : abortCodes()) {
    EXPECT_GT(row.code, before) << "ascending";
    before = row.code;
    EXPECT_FALSE(row.text.empty());
    EXPECT_EQ(abortRow(row.code).text, row.text);
    EXPECT_NE(abortRow(row.code + 0x1000).text, row.text);
  }
  EXPECT_EQ(abortCodes().size(), 31U);
  EXPECT_EQ(abortRow(0x06090011).meaning, AbortMeaning::Unknown);
  EXPECT_EQ(abortRow(0x06010002).meaning, AbortMeaning::ReadOnly);
  EXPECT_FALSE(abortRow(0).text.empty());
  EXPECT_FALSE(abortRow(0xFFFFFFFF).text.empty());
}

TEST(Cycles, AtLeastSoLong) {
  EXPECT_EQ(cyclesOf(0.5, 0.001), 500U);
  EXPECT_EQ(cyclesOf(0.5001, 0.001), 501U);
  EXPECT_EQ(cyclesOf(0, 0.001), 1U);
  EXPECT_EQ(cyclesOf(0.0001, 0.001), 1U);
  EXPECT_EQ(cyclesOf(0.0011, 0.001), 2U);
  EXPECT_EQ(cyclesOf(1e300, 0.001), 4000000000U);
}

} // namespace
} // namespace stride::can
