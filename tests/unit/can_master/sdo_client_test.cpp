// SDO transfers word by word, as CiA 301 draws them.
#include "drivers/can/master/frames.hpp"
#include "drivers/can/master/sdo_client.hpp"
#include "tests/unit/can_master/script.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace stride::can {
namespace {

constexpr uint32_t kTimeout = 20;

std::vector<uint8_t> bytesOf(const std::string &hex) {
  std::vector<uint8_t> result;
  for (size_t i = 0; i + 1 < hex.size(); i += 2)
    result.push_back(static_cast<uint8_t>(std::strtoul(hex.substr(i, 2).c_str(), nullptr, 16)));
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
