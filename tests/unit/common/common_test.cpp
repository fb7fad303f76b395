#include "runtime/common/edit_distance.hpp"
#include "runtime/common/fnv.hpp"
#include "runtime/common/text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace stride::common {
namespace {

TEST(LowerCase, OnlyOfAsciiLetters) {
  EXPECT_EQ(lowerCase("@AMZ[`az{_09"), "@amz[`az{_09");
  EXPECT_EQ(lowerCase("\xC3\x84"), "\xC3\x84"); // Ä
}

TEST(HideControls, AtTheirLimits) {
  const auto hidden = [](std::string text, std::string_view kept = {}, size_t from = 0) {
    hideControls(text, kept, from);
    return text;
  };
  EXPECT_EQ(hidden(std::string("\0\x1f\x20\x7e\x7f", 5)), "??\x20\x7e?");
  EXPECT_EQ(hidden("a\n\t\rb", "\n\t"), "a\n\t?b");
  EXPECT_EQ(hidden("\xC2\x7f|\xC2\x80|\xC2\x9f|\xC2\xA0"), "\xC2?|??|??|\xC2\xA0");
  EXPECT_EQ(hidden("\x80\x9f\xC3\x9f"), "\x80\x9f\xC3\x9f"); // no characters; ß
  EXPECT_EQ(hidden("\x1b\x1b", {}, 1), "\x1b?");
}

TEST(EscapedMarkup, LeavesNoMarkup) {
  EXPECT_EQ(escapedMarkup("a<b>&\"c'\n\t\x1b"), "a&lt;b&gt;&amp;&quot;c'\n\t?");
}

TEST(EditDistance, CountsEachKindOfEdit) {
  EXPECT_EQ(editDistance("abcd", "ABCD", 3), 0U);
  EXPECT_EQ(editDistance("abcd", "abxcd", 3), 1U);
  EXPECT_EQ(editDistance("abcd", "acd", 3), 1U);
  EXPECT_EQ(editDistance("abcd", "abxd", 3), 1U);
  EXPECT_EQ(editDistance("abcd", "abdc", 3), 1U);
  EXPECT_EQ(editDistance("", "abc", 3), 3U);
  EXPECT_EQ(editDistance("kitten", "sitting", 3), 3U);
}

TEST(EditDistance, SaysMoreThanTheLimit) {
  EXPECT_EQ(editDistance("kitten", "sitting", 2), 3U);
  EXPECT_EQ(editDistance("kitten", "sitting", 0), 1U);
  EXPECT_EQ(editDistance("abcdefgh", "zyxwvuts", 2), 3U);
  EXPECT_EQ(editDistance(std::string(255, 'a'), std::string(254, 'a'), 5), 1U);
  EXPECT_EQ(editDistance(std::string(256, 'a'), std::string(256, 'a'), 5), 6U);
}

// The vectors of RFC 9923.
TEST(Fnv1a, KnownValues) {
  EXPECT_EQ(Fnv1a<uint32_t>().value(), 0x811c9dc5U);
  EXPECT_EQ(Fnv1a<uint32_t>().add("a").value(), 0xe40c292cU);
  EXPECT_EQ(Fnv1a<uint32_t>().add("foobar").value(), 0xbf9cf968U);
  EXPECT_EQ(Fnv1a<uint64_t>().value(), 0xcbf29ce484222325U);
  EXPECT_EQ(Fnv1a<uint64_t>().add("a").value(), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(Fnv1a<uint64_t>().add("foobar").value(), 0x85944171f73967e8U);
  const std::array<std::byte, 2> bytes = {std::byte{'f'}, std::byte{'o'}};
  EXPECT_EQ(Fnv1a<uint64_t>().add(bytes).value(), Fnv1a<uint64_t>().add("fo").value());
}

} // namespace
} // namespace stride::common
