// Recordings: what is read of lines as candump and others write them, and what is written.
#include "drivers/can/log/candump.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

namespace stride::can::log {
namespace {

Frame frameOf(uint16_t id, std::initializer_list<unsigned> bytes) {
  Frame frame;
  frame.id = id;
  for (const unsigned byte : bytes)
    frame.data[frame.length++] = static_cast<uint8_t>(byte);
  return frame;
}

TEST(Candump, ReadsLinesOfManyKinds) {
  const Recording r = readRecording("(1436509052.249713) can0 182#2700\n"
                                    "(1436509052.3) can0 080#\r\n"
                                    "\n"
                                    "  (1436509053.000000001)\tcan0 7FF#11.22.33 T\n"
                                    "(0.5) can0 705#R\n"
                                    "(0.5) can0 705#R1 R\n"
                                    "# a comment\n"
                                    "(2.0) can0 123#1122334455667788_F");
  EXPECT_EQ(r.interface, "can0");
  EXPECT_TRUE(r.problems.empty());
  ASSERT_EQ(r.entries.size(), 6U);
  EXPECT_EQ(r.entries[0].timeNs, 1'436'509'052'249'713'000);
  EXPECT_EQ(r.entries[0].frame, frameOf(0x182, {0x27, 0}));
  EXPECT_EQ(r.entries[1].timeNs, 1'436'509'052'300'000'000);
  EXPECT_EQ(r.entries[1].frame, frameOf(0x80, {}));
  EXPECT_EQ(r.entries[2].timeNs, 1'436'509'053'000'000'001);
  EXPECT_EQ(r.entries[2].frame, frameOf(0x7FF, {0x11, 0x22, 0x33}));
  EXPECT_EQ(r.entries[2].direction, Direction::Sent);
  EXPECT_EQ(r.entries[2].line, 4U);
  EXPECT_TRUE(r.entries[3].frame.remote);
  EXPECT_EQ(r.entries[3].direction, Direction::Unknown);
  EXPECT_EQ(r.entries[4].frame.length, 1);
  EXPECT_EQ(r.entries[4].direction, Direction::Received);
  EXPECT_EQ(r.entries[5].frame.length, 8);
}

TEST(Candump, PassesOverWhatIsNotForUs) {
  const Recording r = readRecording("(1.0) can1 00000182#11\n"
                                    "(1.0) can1 20000004#0000000000000000\n"
                                    "(1.0) can1 123##311223344\n"
                                    "(1.0) can0 123#11\n"
                                    "(1.0) can1 124#11\n");
  EXPECT_EQ(r.interface, "can1");
  EXPECT_EQ(r.skipped, 4U);
  ASSERT_EQ(r.entries.size(), 1U);
  EXPECT_EQ(r.entries[0].frame.id, 0x124);
  EXPECT_EQ(readRecording("(1.0) can1 123#\n(1.0) can0 124#\n", "can0").entries[0].frame.id, 0x124);
}

TEST(Candump, SaysWhichLinesAreNone) {
  const struct {
    const char *line;
    const char *problem;
  } cases[] = {
      {"hello", "a line begins with the time, as (1436509052.249713)"},
      {"(1.x) can0 123#", "a line begins with the time, as (1436509052.249713)"},
      {"(-1.0) can0 123#", "a line begins with the time, as (1436509052.249713)"},
      {"(99999999999.0) can0 123#", "a line begins with the time, as (1436509052.249713)"},
      {"(1.0) can0", "after the time come the interface and a frame"},
      {"(1.0) 0123456789abcdef 123#", "the name of an interface has 15 characters at most"},
      {"(1.0) can0 123", "a frame looks like 182#2700"},
      {"(1.0) can0 12#", "an identifier has 3 or 8 hexadecimal digits"},
      {"(1.0) can0 12g#", "an identifier has 3 or 8 hexadecimal digits"},
      {"(1.0) can0 800#", "an identifier with 3 digits is 7FF at most"},
      {"(1.0) can0 123#1", "bytes have two hexadecimal digits each"},
      {"(1.0) can0 123#1x", "bytes have two hexadecimal digits each"},
      {"(1.0) can0 123#112233445566778899", "more than 8 bytes"},
      {"(1.0) can0 123#R9", "a remote frame has a length of 0 to 8"}};
  std::string all = "(0.1) can0 001#\n";
  for (const auto &[line, problem] : cases) {
    const Recording r = readRecording(std::string("\n") + line + "\n");
    ASSERT_EQ(r.problems.size(), 1U) << line;
    EXPECT_EQ(r.problems[0].line, 2U);
    EXPECT_EQ(r.problems[0].text, problem) << line;
    all += std::string(line) + "\n" + line + "\n";
  }
  const Recording r = readRecording(all + "(0.2) can0 002#\n");
  EXPECT_EQ(r.badLines, 28U);
  EXPECT_EQ(r.problems.size(), Recording::kMostProblems);
  ASSERT_EQ(r.entries.size(), 2U) << "the good ones are there";
}

TEST(Candump, WhatIsWrittenIsRead) {
  std::mt19937_64 random(4); // NOLINT: the same lines each time
  std::string text;
  std::vector<Entry> entries;
  for (size_t i = 0; i < 2000; ++i) {
    Entry entry;
    entry.timeNs = static_cast<int64_t>(random() % 4'000'000'000'000'000) * 1000;
    entry.frame.id = static_cast<uint16_t>(random() % 2048);
    entry.frame.length = static_cast<uint8_t>(random() % 9);
    entry.frame.remote = random() % 10 == 0;
    for (uint8_t k = 0; k < entry.frame.length && !entry.frame.remote; ++k)
      entry.frame.data[k] = static_cast<uint8_t>(random());
    entry.direction = static_cast<Direction>(random() % 3);
    std::array<char, kLongestLine> line{};
    const size_t size = formatLine(entry, "vcan12", line.data(), line.size());
    text.append(line.data(), size);
    entries.push_back(entry);
  }
  const Recording r = readRecording(text);
  ASSERT_EQ(r.entries.size(), entries.size());
  EXPECT_EQ(r.badLines, 0U);
  for (size_t i = 0; i < entries.size(); ++i) {
    ASSERT_EQ(r.entries[i].frame, entries[i].frame);
    ASSERT_EQ(r.entries[i].timeNs, entries[i].timeNs);
    ASSERT_EQ(r.entries[i].direction, entries[i].direction);
    ASSERT_EQ(r.entries[i].line, i + 1);
  }
  std::array<char, 10> small{};
  EXPECT_EQ(formatLine(entries[0], "can0", small.data(), small.size()), 0U);
}

TEST(Candump, TheLongestLineFits) {
  Entry entry;
  entry.timeNs = INT64_MAX;
  entry.frame = frameOf(0x7FF, {1, 2, 3, 4, 5, 6, 7, 8});
  entry.direction = Direction::Sent;
  std::array<char, kLongestLine> line{};
  EXPECT_EQ(std::string(line.data(),
                        formatLine(entry, "a_very_long_interface", line.data(), line.size())),
            "(9223372036.854775) a_very_long_int 7FF#0102030405060708 T\n");
}

} // namespace
} // namespace stride::can::log
