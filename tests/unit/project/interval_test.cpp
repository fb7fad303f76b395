#include "compiler/toml/interval.hpp"

#include <gtest/gtest.h>

namespace stc {
namespace {

TEST(Interval, ReadsIecDurations) {
  EXPECT_EQ(parseInterval("T#3ms"), 3'000'000);
  EXPECT_EQ(parseInterval("t#1s500ms"), 1'500'000'000);
  EXPECT_EQ(parseInterval("TIME#1.5s"), 1'500'000'000);
  EXPECT_EQ(parseInterval("LTIME#250us"), 250'000);
  EXPECT_EQ(parseInterval("lt#7ns"), 7);
  EXPECT_EQ(parseInterval("T#1d_2h_3m_4s"), 93'784'000'000'000);
}

TEST(Interval, ReadsDurationsWithoutAPrefix) {
  EXPECT_EQ(parseInterval("2ms"), 2'000'000);
  EXPECT_EQ(parseInterval("1s500MS"), 1'500'000'000);
  EXPECT_EQ(parseInterval("0.25us"), 250);
}

TEST(Interval, RefusesOtherTexts) {
  for (const char *text : {"", "T#", "3", "ms", "T#t#3ms", "T#3", "T#3 ms", "T#ms", "T#5ms1s",
                           "T#1s2s", "T#1.5s3ms", "T#1.s", "T#-3ms", "T#999999999999d"})
    EXPECT_EQ(parseInterval(text), std::nullopt) << text;
}

TEST(Interval, WritesTheShortestForm) {
  EXPECT_EQ(formatInterval(3'000'000), "T#3ms");
  EXPECT_EQ(formatInterval(1'500'000'000), "T#1s500ms");
  EXPECT_EQ(formatInterval(250'000), "LT#250us");
  EXPECT_EQ(formatInterval(0), "T#0ms");
}

TEST(Interval, RoundTrips) {
  for (int64_t value = 1; value > 0 && value < INT64_MAX / 7; value = value * 7 + 3)
    EXPECT_EQ(parseInterval(formatInterval(value)), value);
}

} // namespace
} // namespace stc
