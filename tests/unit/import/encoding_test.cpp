// From bytes to UTF-8.
#include "compiler/import/encoding.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>

namespace stc::import {
namespace {

using namespace std::string_literals;
using testing::HasSubstr;

TEST(Encoding, utf8StaysAndItsMarkGoes) {
  EXPECT_EQ(decoded("a\xC3\xA4", "").text, "a\xC3\xA4");
  EXPECT_FALSE(decoded("a\xC3\xA4", "").assumed);
  EXPECT_EQ(decoded("\xEF\xBB\xBFx", "cp1251").text, "x");
}

TEST(Encoding, otherBytesAreWindows1252) {
  const DecodedText text = decoded("a\xE4 \x80\x81 z", "");
  EXPECT_EQ(text.text, "a\xC3\xA4 \xE2\x82\xAC\xC2\x81 z")
      << "16#81 means nothing, and does no harm";
  EXPECT_TRUE(text.assumed);
}

TEST(Encoding, theUserKnowsBetter) {
  EXPECT_EQ(decoded("\xEF\xF0\xE8", "cp1251").text, "\xD0\xBF\xD1\x80\xD0\xB8");
  EXPECT_EQ(decoded("\x84", "cp850").text, "\xC3\xA4");
  EXPECT_FALSE(decoded("\xE4", "latin1").assumed);
  const DecodedText wrong = decoded("a\nb\xE4 c", "utf-8");
  EXPECT_THAT(wrong.problem, HasSubstr("16#E4 is no character of utf-8"));
  EXPECT_EQ(wrong.line, 2U);
  EXPECT_TRUE(isEncoding("cp1251"));
  EXPECT_FALSE(isEncoding("cp12345"));
  EXPECT_THAT(decoded("\xE4", "cp12345").problem, HasSubstr("cp12345"));
}

TEST(Encoding, utf16HasAMark) {
  EXPECT_EQ(decoded("\xFF\xFE"
                    "a\0\xE4\0"s,
                    "")
                .text,
            "a\xC3\xA4");
  EXPECT_EQ(decoded("\xFE\xFF"
                    "\0a"s,
                    "")
                .text,
            "a");
  EXPECT_NE(decoded("\xFF\xFE"
                    "a"s,
                    "")
                .problem,
            "")
      << "half a character";
}

TEST(Encoding, nulIsRefusedWithItsLine) {
  const DecodedText text = decoded("a\nb\n\0c"s, "");
  EXPECT_THAT(text.problem, HasSubstr("NUL"));
  EXPECT_EQ(text.line, 3U);
  EXPECT_EQ(text.text, "");
}

TEST(Encoding, knowsWhatIsNoUtf8) {
  EXPECT_EQ(validUtf8("ab\xC0\x80"), 2U) << "longer than needed";
  EXPECT_EQ(validUtf8("\xED\xA0\x80"), 0U) << "a surrogate";
  EXPECT_EQ(validUtf8("\xED\x9F\xBF"), 3U);
  EXPECT_EQ(validUtf8("\xF4\x90\x80\x80"), 0U) << "beyond U+10FFFF";
  EXPECT_EQ(validUtf8("\xF4\x8F\xBF\xBF"), 4U);
  EXPECT_EQ(validUtf8("x\xE2\x82"), 1U) << "cut";
}

} // namespace
} // namespace stc::import
