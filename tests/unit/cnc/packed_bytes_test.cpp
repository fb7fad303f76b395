// Bytes as text: what the compiler writes, read back.
#include "runtime/numeric/cnc/packed_bytes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace stride::cnc;

/// The text of bytes, written from the description: bits one after the other.
std::string textOf(const std::vector<uint8_t> &bytes) {
  std::vector<uint8_t> runs;
  for (size_t i = 0; i < bytes.size();) {
    if (bytes[i] != 0) {
      runs.push_back(bytes[i++]);
      continue;
    }
    size_t end = i;
    while (end < bytes.size() && bytes[end] == 0 && end - i < 255)
      ++end;
    runs.push_back(0);
    runs.push_back(static_cast<uint8_t>(end - i));
    i = end;
  }
  std::string bits;
  for (const uint8_t byte : runs)
    for (int bit = 7; bit >= 0; --bit)
      bits += static_cast<char>('0' + (byte >> bit & 1));
  while (bits.size() % 6 != 0)
    bits += '0';
  std::string text;
  for (size_t i = 0; i < bits.size(); i += 6)
    text += "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"[std::stoi(
        bits.substr(i, 6), nullptr, 2)];
  return text;
}

/// In pieces of this length, each with a 0 after it.
std::string inPieces(const std::string &text, size_t piece) {
  std::string result;
  for (size_t i = 0; i < text.size(); i += piece)
    result += text.substr(i, piece) + '\0';
  return result;
}

TEST(PackedBytes, BytesComeBack) {
  std::mt19937 engine(7); // NOLINT: the same each time
  const auto random = [&engine] { return static_cast<uint32_t>(engine()); };
  for (int round = 0; round < 200; ++round) {
    std::vector<uint8_t> bytes(random() % 1200 + 1);
    const unsigned zeros = random() % 10;
    for (uint8_t &byte : bytes)
      byte = random() % 10 < zeros ? 0 : static_cast<uint8_t>(random());
    const std::string text = textOf(bytes);
    const size_t piece = round % 2 == 0 ? text.size() : random() % 40 + 1;
    const std::string stored = inPieces(text, piece);
    Unpacker unpacker = startUnpacking(stored.data(), static_cast<uint32_t>(piece));
    std::vector<uint8_t> read(bytes.size(), 0xEE);
    const size_t half = read.size() / 3;
    ASSERT_TRUE(unpack(unpacker, read.data(), static_cast<int64_t>(half)));
    ASSERT_TRUE(unpack(unpacker, read.data() + half, static_cast<int64_t>(read.size() - half)));
    ASSERT_EQ(read, bytes) << "round " << round;
  }
}

TEST(PackedBytes, RunsOf254To256Zeros) {
  for (const size_t count : {1U, 254U, 255U, 256U, 511U}) {
    std::vector<uint8_t> bytes(count, 0);
    bytes.push_back(0x5A);
    const std::string text = textOf(bytes);
    Unpacker unpacker = startUnpacking(text.c_str(), 16000);
    std::vector<uint8_t> read(bytes.size(), 0xEE);
    ASSERT_TRUE(unpack(unpacker, read.data(), static_cast<int64_t>(read.size())));
    EXPECT_EQ(read, bytes) << count;
  }
}

TEST(PackedBytes, ATextThatEndsOrIsNone) {
  const std::string text = textOf({1, 2, 3});
  uint8_t read[4] = {};
  Unpacker unpacker = startUnpacking(text.c_str(), 16000);
  EXPECT_FALSE(unpack(unpacker, read, 4)) << "one byte too many";
  unpacker = startUnpacking("AB*A", 16000);
  EXPECT_FALSE(unpack(unpacker, read, 3)) << "no such character";
  unpacker = startUnpacking("AAAA", 16000);
  EXPECT_FALSE(unpack(unpacker, read, 1)) << "a run of no zeros";
}

} // namespace
