// Values as text and back.
#include "runtime/iec/ops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <string_view>

namespace {

using namespace stride;

template <Kind K> std::string textOf(KindType<K> value) { return toString<K>(value).s; }

TEST(Text, Numbers) {
  EXPECT_EQ(textOf<Kind::INT>(-32768), "-32768");
  EXPECT_EQ(textOf<Kind::LWORD>(~ULINT{0}), "18446744073709551615");
  EXPECT_EQ(textOf<Kind::BYTE>(255), "255");
  EXPECT_EQ(textOf<Kind::BOOL>(1), "TRUE");
  EXPECT_EQ(textOf<Kind::BOOL>(0), "FALSE");
  EXPECT_EQ((toString<Kind::DINT, 3>(12345).s), std::string("123"));
}

TEST(Text, Reals) {
  EXPECT_EQ(textOf<Kind::LREAL>(100), "100.0");
  EXPECT_EQ(textOf<Kind::LREAL>(-0.5), "-0.5");
  EXPECT_EQ(textOf<Kind::LREAL>(0.1), "0.1");
  EXPECT_EQ(textOf<Kind::REAL>(0.1F), "0.1");
  EXPECT_EQ(textOf<Kind::LREAL>(1e20), "1.0e+20");
  EXPECT_EQ(textOf<Kind::LREAL>(1.5e300), "1.5e+300");
  EXPECT_EQ(textOf<Kind::LREAL>(-0.0), "-0.0");
  EXPECT_EQ(textOf<Kind::LREAL>(std::nan("")), "NaN");
  EXPECT_EQ(textOf<Kind::LREAL>(-INFINITY), "-Infinity");
  std::mt19937_64 engine(7);
  for (int i = 0; i < 100000; ++i) {
    const double x = std::bit_cast<double>(engine());
    if (std::isnan(x))
      continue;
    EXPECT_EQ(fromString<Kind::LREAL>(toString<Kind::LREAL>(x)), x);
  }
}

TEST(Text, Durations) {
  EXPECT_EQ(textOf<Kind::TIME>(1500), "T#1s500ms");
  EXPECT_EQ(textOf<Kind::TIME>(0), "T#0ms");
  EXPECT_EQ(textOf<Kind::TIME>(60000), "T#1m");
  EXPECT_EQ(textOf<Kind::TIME>(~TIME{0}), "T#49d17h2m47s295ms");
  EXPECT_EQ(textOf<Kind::LTIME>(-1500002), "LTIME#-1ms500us2ns");
  EXPECT_EQ(textOf<Kind::LTIME>(std::numeric_limits<LTIME>::min()),
            "LTIME#-106751d23h47m16s854ms775us808ns");
}

TEST(Text, Dates) {
  EXPECT_EQ(textOf<Kind::DATE>(0), "D#1970-01-01");
  EXPECT_EQ(textOf<Kind::DATE>(951782400), "D#2000-02-29");
  EXPECT_EQ(textOf<Kind::DT>(951782400 + 3661), "DT#2000-02-29-01:01:01");
  EXPECT_EQ(textOf<Kind::TOD>(47100250), "TOD#13:05:00.250");
  EXPECT_EQ(textOf<Kind::TOD>(86400000 + 3601000), "TOD#01:00:01"); // what is added may go on
  EXPECT_EQ(textOf<Kind::LTOD>(86400000000000 * 2 + 5), "LTOD#00:00:00.000000005");
  EXPECT_EQ(textOf<Kind::LTOD>(1), "LTOD#00:00:00.000000001");
  EXPECT_EQ(textOf<Kind::LDT>(-1), "LDT#1969-12-31-23:59:59.999999999");
  for (DATE day = 0; day < 49000; day += 13)
    EXPECT_EQ(fromString<Kind::DATE>(toString<Kind::DATE>(day * 86400)), day * 86400);
}

TEST(Text, StringToInteger) {
  EXPECT_EQ(fromString<Kind::INT>(lit("  -12xyz")), -12);
  EXPECT_EQ(fromString<Kind::INT>(lit("abc")), 0);
  EXPECT_EQ(fromString<Kind::INT>(lit("")), 0);
  EXPECT_EQ(fromString<Kind::WORD>(lit("16#FFFF")), 65535);
  EXPECT_EQ(fromString<Kind::BYTE>(lit("2#1010_1010")), 170);
  EXPECT_EQ(fromString<Kind::SINT>(lit("200")), -56);
  EXPECT_EQ(fromString<Kind::DINT>(lit("1_000")), 1000);
  EXPECT_EQ(fromString<Kind::BOOL>(lit("true")), 1);
  EXPECT_EQ(fromString<Kind::BOOL>(lit("0")), 0);
}

TEST(Text, StringToRealAndTime) {
  EXPECT_EQ(fromString<Kind::LREAL>(lit("1.5e3 mm")), 1500.0);
  EXPECT_EQ(fromString<Kind::LREAL>(lit("-7")), -7.0);
  EXPECT_EQ(fromString<Kind::LREAL>(lit("1e999")), INFINITY);
  EXPECT_EQ(fromString<Kind::LREAL>(lit("1e-999")), 0.0);
  EXPECT_EQ(fromString<Kind::REAL>(lit("0.1")), 0.1F);
  EXPECT_EQ(fromString<Kind::TIME>(lit("T#1h2m3s4ms")), 3723004U);
  EXPECT_EQ(fromString<Kind::TIME>(lit("t#1.5s")), 1500U);
  EXPECT_EQ(fromString<Kind::TIME>(lit("T#100s_5ms")), 100005U);
  EXPECT_EQ(fromString<Kind::LTIME>(lit("LTIME#-1us")), -1000);
  EXPECT_EQ(fromString<Kind::TOD>(lit("TOD#13:05:00.25")), 47100250U);
  EXPECT_EQ(fromString<Kind::DT>(lit("DT#2000-02-29-01:01:01")), 951786061U);
  EXPECT_EQ(fromString<Kind::DATE>(lit("D#2001-02-29")), 0U); // no such day
}

TEST(Text, DurationsStopWhereUnitsRise) {
  const char *text = "1s1m";
  const text::Scanned scanned = text::scanDuration(text, 4);
  EXPECT_EQ(scanned.used, 2U);
  EXPECT_EQ(scanned.ns, 1000000000);
  EXPECT_TRUE(text::scanDuration("300000d", 7).overflow);
  EXPECT_EQ(text::scanDuration("5", 1).used, 0U);
  EXPECT_EQ(text::scanDuration("", 0).used, 0U);
}

TEST(Text, WideStrings) {
  EXPECT_EQ(std::u16string(toWstring<Kind::INT>(-5).s), u"-5");
  EXPECT_EQ(std::u16string(widen<5>(lit("\xE4z")).s), u"\u00E4z");
  EXPECT_STREQ(narrow<5>(lit(u"a\u20ACz")).s, "a?z");
  EXPECT_EQ(fromString<Kind::INT>(lit(u"42")), 42);
}

/// Digits without end: those that fit count, and nothing is written beyond them.
TEST(Text, RealsOfAnyLength) {
  for (size_t zeros = 490; zeros < 530; ++zeros) {
    const std::string small = "1e" + std::string(zeros, '0');
    EXPECT_EQ(text::scanReal(small.data(), static_cast<uint32_t>(small.size())).real, 1.0) << zeros;
    const std::string last = small + '5'; // the 512th character is the last one that counts
    EXPECT_EQ(text::scanReal(last.data(), static_cast<uint32_t>(last.size())).real,
              zeros < 510 ? 1e5 : 1.0)
        << zeros;
    const std::string leading = std::string(zeros, '0') + ".5";
    const double read = text::scanReal(leading.data(), static_cast<uint32_t>(leading.size())).real;
    EXPECT_TRUE(read == 0.5 || (zeros > 500 && read == 0.0)) << zeros << ' ' << read;
  }
}

/// A value ends where the next character cannot belong to it.
TEST(Text, ScansStopAfterTheValue) {
  const auto used = [](text::Scanned (*scan)(const char *, uint32_t), std::string_view text) {
    return scan(text.data(), static_cast<uint32_t>(text.size())).used;
  };
  EXPECT_EQ(used(text::scanReal, "-7"), 2U);
  EXPECT_EQ(used(text::scanReal, "1.5.5"), 3U);
  EXPECT_EQ(used(text::scanReal, "1."), 1U);
  EXPECT_EQ(used(text::scanReal, "1;5"), 1U);
  EXPECT_EQ(used(text::scanReal, "1x5"), 1U);
  EXPECT_EQ(used(text::scanReal, ".5"), 0U);
  EXPECT_EQ(used(text::scanReal, "1_000.5_"), 7U);
  EXPECT_EQ(used(text::scanReal, "2e-3-"), 4U);
  EXPECT_EQ(used(text::scanReal, "2e"), 1U);
  EXPECT_EQ(used(text::scanReal, "2e+"), 1U);
  EXPECT_EQ(used(text::scanDate, "2000-02-29-"), 10U);
  EXPECT_EQ(used(text::scanDate, "D#2000-02-29"), 12U);
  EXPECT_EQ(used(text::scanTimeOfDay, "01:02:03;"), 8U);
  EXPECT_EQ(used(text::scanTimeOfDay, "LTOD#01:02:03.5"), 15U);
  EXPECT_EQ(used(text::scanDateAndTime, "DATE_AND_TIME#2000-02-29-01:02:03 "), 33U);
  EXPECT_EQ(used(text::scanDateAndTime, "2000-02-29-01:02"), 16U);
}

/// A UNION can leave a text without its end: it has its capacity at most.
TEST(Text, CapacityEndsAText) {
  STRING<3> full{};
  std::copy_n("abcd", 4, full.s);
  EXPECT_EQ(detail::textCompare(full.s, 3, "abc", 3), 0);
  EXPECT_EQ(detail::textCompare("abc", 3, full.s, 3), 0);
  EXPECT_LT(detail::textCompare(full.s, 3, "abcd", 4), 0);
  EXPECT_EQ(detail::textLength(full.s, 3), 3U);
  WSTRING<2> wide{};
  std::copy_n(u"xyz", 3, wide.s);
  EXPECT_EQ(detail::textCompare(wide.s, 2, u"xy", 2), 0);
  EXPECT_EQ(detail::textCompare(u"xy", 2, wide.s, 2), 0);
  EXPECT_GT(detail::textCompare(u"xyz", 3, wide.s, 2), 0);
}

} // namespace
