#include "tests/unit/syntax/print_ast.hpp"

#include <gtest/gtest.h>

namespace stc::test {
namespace {

std::string error(const std::string &literal) { return bodyErrors("x := " + literal + ";"); }

TEST(Literal, Integers) {
  EXPECT_EQ(printExpression("1_000_000"), "1000000");
  EXPECT_EQ(printExpression("16#FF_ff + 2#1010_1010 + 8#777"), "(+ (+ 65535 170) 511)");
  EXPECT_EQ(printExpression("16#FFFF_FFFF_FFFF_FFFF"), "18446744073709551615");
  EXPECT_EQ(printExpression("INT#5 + BYTE#16#FF"), "(+ INT#5 BYTE#255)");
  EXPECT_EQ(printExpression("INT#-5"), "INT#-5");
  EXPECT_EQ(printExpression("BOOL#TRUE OR BOOL#0 OR TRUE"), "(OR (OR BOOL#TRUE BOOL#0) TRUE)");
  EXPECT_EQ(error("16#FG"), "SE0108 1:20 the number `16#FG` is malformed\n");
  EXPECT_EQ(error("2#102"), "SE0108 1:20 the number `2#102` is malformed\n");
  EXPECT_EQ(error("7#1"), "SE0108 1:16 a number cannot have this base\n");
  EXPECT_EQ(error("16#"), "SE0108 1:16 the number `16#` is incomplete\n");
  EXPECT_EQ(error("1__0"), "SE0108 1:18 misplaced underscore in a number\n");
  EXPECT_EQ(error("12abc"), "SE0108 1:18 the number `12abc` is malformed\n");
  EXPECT_EQ(error("18446744073709551616"),
            "SE0109 1:16 the number `18446744073709551616` does not fit into 64 bits\n");
}

TEST(Literal, Reals) {
  EXPECT_EQ(printExpression("1.5e-3"), "0.0015");
  EXPECT_EQ(printExpression("1_0.2_5 + 1E3 + 2e+2"), "(+ (+ 10.25 1000) 200)");
  EXPECT_EQ(printExpression("REAL#-1.5 + LREAL#2"), "(+ REAL#-1.5 LREAL#2)");
  EXPECT_EQ(printExpression("1e-400"), "0");
  EXPECT_EQ(error("1e400"), "SE0109 1:16 the number `1e400` does not fit into an LREAL\n");
  EXPECT_EQ(error("5."), "SE0108 1:16 a decimal point needs a digit after it\n");
}

TEST(Literal, Strings) {
  EXPECT_EQ(printExpression("''"), "''");
  EXPECT_EQ(printExpression("'a$$b$'c$\"d$41$e4'"), "'a$b'c\"dAä'");
  EXPECT_EQ(printExpression("'$L$n$P$r$T'"), "'\n\n\f\r\t'");
  EXPECT_EQ(printExpression("\"grün$20AC'\""), "\"grün€'\"");
  EXPECT_EQ(printExpression("STRING#'x' + WSTRING#\"y\""), "(+ STRING#'x' WSTRING#\"y\")");
  EXPECT_EQ(error("'5 $ each'"), "SE0107 1:19 unknown escape in a string\n");
  EXPECT_EQ(error("'$4'"), "SE0107 1:17 unknown escape in a string\n");
  EXPECT_EQ(error("\"$123\""), "SE0107 1:17 unknown escape in a string\n");
}

TEST(Literal, Durations) {
  EXPECT_EQ(printExpression("T#1d2h3m4s5ms"), "93784005ms");
  EXPECT_EQ(printExpression("TIME#1.5s"), "1500ms");
  EXPECT_EQ(printExpression("t#90m"), "5400000ms");
  EXPECT_EQ(printExpression("T#1h_30m"), "5400000ms");
  EXPECT_EQ(printExpression("T#0s"), "0ms");
  EXPECT_EQ(printExpression("T#49d17h2m47s295ms"), "4294967295ms");
  EXPECT_EQ(printExpression("LTIME#1d1us1.5ns"), "86400000001001ns");
  EXPECT_EQ(printExpression("LT#-5ms"), "-5000000ns");
  EXPECT_EQ(error("T#5s2m"), "SE0110 1:16 malformed duration\n");
  EXPECT_EQ(error("T#5s5s"), "SE0110 1:16 malformed duration\n");
  EXPECT_EQ(error("T#5"), "SE0110 1:16 malformed duration\n");
  EXPECT_EQ(error("T#5x"), "SE0110 1:16 malformed duration\n");
  EXPECT_EQ(error("T#1.5h30m"), "SE0110 1:16 malformed duration\n");
  EXPECT_EQ(error("T#5us"), "SE0720 1:16 a TIME counts whole milliseconds\n");
  EXPECT_EQ(printExpression("T#2000us"), "2ms");
  EXPECT_EQ(printExpression("LTIME#-106751d23h47m16s854ms775us808ns"), "-9223372036854775808ns");
  EXPECT_EQ(error("LTIME#106751d23h47m16s854ms775us808ns"),
            "SE0109 1:16 the duration does not fit into 64 bits of nanoseconds\n");
  EXPECT_EQ(error("LTIME#-106751d23h47m16s854ms775us809ns"),
            "SE0109 1:16 the duration does not fit into 64 bits of nanoseconds\n");
  EXPECT_EQ(error("T#50d"), "SE0109 1:16 the duration does not fit into a TIME\n");
  EXPECT_EQ(error("LTIME#200000d"),
            "SE0109 1:16 the duration does not fit into 64 bits of nanoseconds\n");
  EXPECT_EQ(error("T#99999999999999999999999d"), "SE0109 1:16 the duration is too large\n");
}

TEST(Literal, DatesAndTimes) {
  EXPECT_EQ(printExpression("D#1970-01-02"), "86400s(date)");
  EXPECT_EQ(printExpression("DATE#2024-02-29"), "1709164800s(date)");
  EXPECT_EQ(printExpression("LDATE#1970-1-2"), "86400000000000ns(ldate)");
  EXPECT_EQ(printExpression("TOD#12:30:15.5"), "45015500ms(tod)");
  EXPECT_EQ(printExpression("TIME_OF_DAY#1:00"), "3600000ms(tod)");
  EXPECT_EQ(printExpression("LTOD#00:00:00.000000001"), "1ns(ltod)");
  EXPECT_EQ(printExpression("DT#1970-01-01-00:01:00"), "60s(dt)");
  EXPECT_EQ(printExpression("DATE_AND_TIME#2024-02-29-12:30:15"), "1709209815s(dt)");
  EXPECT_EQ(printExpression("LDT#1970-01-01-00:00:01.5"), "1500000000ns(ldt)");
  EXPECT_EQ(error("D#2023-02-29"), "SE0111 1:16 malformed date\n");
  EXPECT_EQ(error("D#1969-12-31"),
            "SE0109 1:16 the date is before 1970-01-01, the first one of 32 bits\n");
  EXPECT_EQ(error("LDATE#1677-09-22"), "");
  EXPECT_EQ(error("LDT#1677-09-21-00:12:43.145224192"), "");
  EXPECT_EQ(error("LDT#1677-09-21-00:12:43.145224191"),
            "SE0109 1:16 the date is too far in the past\n");
  EXPECT_EQ(error("LDT#2262-04-11-23:47:16.854775807"), "");
  EXPECT_EQ(error("LDT#2262-04-11-23:47:16.854775808"),
            "SE0109 1:16 the date is too far in the future\n");
  EXPECT_EQ(error("TOD#24:00:00"), "SE0111 1:16 malformed time of day\n");
  EXPECT_EQ(error("DT#2024-01-01"), "SE0111 1:16 malformed date and time\n");
  EXPECT_EQ(error("D#2107-01-01"),
            "SE0109 1:16 the date is after 2106-02-07, the last one of 32 bits\n");
}

TEST(Literal, PrefixesAreOnlyPrefixesInFrontOfTheSign) {
  EXPECT_EQ(printExpression("t + d + TIME() + dt.x"), "(+ (+ (+ t d) (call TIME)) (. dt x))");
  EXPECT_EQ(error("INT#"), "SE0116 1:16 there is no value after `INT#`\n");
}

TEST(Literal, RangesAreNotReals) {
  EXPECT_EQ(printBody("CASE a OF 1..5: f(); END_CASE"), "(case a 1..5 { (call f) })");
  EXPECT_EQ(printBody("CASE a OF T#1s..T#5s: f(); END_CASE"),
            "(case a 1000ms..5000ms { (call f) })");
}

} // namespace
} // namespace stc::test
