// Numbers and texts in files.
#include "runtime/app/byte_stream.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace stride;
using app::ByteReader;
using app::ByteWriter;

std::vector<std::byte> withCount(uint32_t count, size_t bytesBehind) {
  ByteWriter out;
  out.number(count);
  out.raw(std::vector<std::byte>(bytesBehind));
  return out.take();
}

/// A count that cannot be true is refused before memory is reserved for it.
TEST(ByteStream, ACountIsAtMostWhatCanBeThere) {
  for (const size_t least : {size_t{1}, size_t{3}, size_t{8}}) {
    for (const uint32_t count : {0U, 1U, 2U, 7U}) {
      const std::vector<std::byte> exact = withCount(count, count * least);
      EXPECT_EQ(ByteReader(exact).count(least), count) << least;
      const std::vector<std::byte> more = withCount(count, count * least + least - 1);
      EXPECT_EQ(ByteReader(more).count(least), count) << least;
      const std::vector<std::byte> fewer = withCount(count + 1, (count + 1) * least - 1);
      EXPECT_THROW(ByteReader(fewer).count(least), app::Error) << least << ' ' << count;
    }
    const std::vector<std::byte> huge = withCount(UINT32_MAX, 100);
    EXPECT_THROW(ByteReader(huge).count(least), app::Error);
  }
}

TEST(ByteStream, WhatWasWrittenIsRead) {
  ByteWriter out;
  out.number<uint8_t>(200);
  out.number<int64_t>(-5);
  out.text("");
  out.text("a text");
  out.number<uint16_t>(0x1234);
  EXPECT_EQ(out.size(), 1U + 8 + 4 + 4 + 6 + 2);
  const std::vector<std::byte> bytes = out.take();
  EXPECT_EQ(bytes.end()[-2], std::byte{0x34}) << "the low byte comes first";
  ByteReader in(bytes);
  EXPECT_EQ(in.number<uint8_t>(), 200);
  EXPECT_EQ(in.number<int64_t>(), -5);
  EXPECT_EQ(in.text(), "");
  EXPECT_EQ(in.text(), "a text");
  EXPECT_EQ(in.left(), 2U);
  EXPECT_EQ(in.number<uint16_t>(), 0x1234);
  EXPECT_EQ(in.left(), 0U);
  EXPECT_THROW(in.number<uint8_t>(), app::Error);
  EXPECT_EQ(in.raw(0).size(), 0U);
}

} // namespace
