#include "compiler/cli/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stc::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Trace read(std::string_view csv) {
  TraceError error;
  const std::optional<Trace> trace = readTrace(csv, error);
  EXPECT_TRUE(trace) << error.line << ": " << error.message;
  return trace.value_or(Trace{});
}

TraceError fail(std::string_view csv) {
  TraceError error;
  EXPECT_FALSE(readTrace(csv, error));
  return error;
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t result = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
    ++result;
  return result;
}

TEST(Trace, ReadsNumbersAndTruthValues) {
  const Trace trace = read("t,a,Main.bRun,c[1,2]\r\n0,1.5,0,TRUE\r\n0.003,-2e3,1,FALSE\r\n");
  EXPECT_THAT(trace.time, ElementsAre(0, 0.003));
  ASSERT_EQ(trace.series.size(), 3U);
  EXPECT_THAT(trace.series[0].values, ElementsAre(1.5, -2000));
  EXPECT_FALSE(trace.series[0].isBool);
  EXPECT_TRUE(trace.series[1].isBool);
  EXPECT_TRUE(trace.series[2].isBool);
  EXPECT_EQ(trace.series[2].name, "c[1,2]");
}

TEST(Trace, ZeroAndOneWithoutAUnitAreTruthValues) {
  const Trace trace = read("t,Main.Done,Drive.fSetPosition,Main.n\n0,0,0,0\n1,1,1,2\n");
  EXPECT_TRUE(trace.series[0].isBool);
  EXPECT_FALSE(trace.series[1].isBool);
  EXPECT_FALSE(trace.series[2].isBool);
}

TEST(Trace, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(fail("").line, 1U);
  EXPECT_EQ(fail("x,y\n1,2\n").line, 1U);
  EXPECT_EQ(fail("t\n1\n").line, 1U);
  EXPECT_EQ(fail("t,a\n").line, 0U);
  EXPECT_EQ(fail("t,a\n0,1\n1\n").line, 3U);
  EXPECT_THAT(fail("t,a\n0,x1\n").message, HasSubstr("`x1` in column `a`"));
}

TEST(Quantities, AreGuessedFromNames) {
  EXPECT_EQ(quantityOf("Drive.fSetPosition"), (Quantity{"Position", "u"}));
  EXPECT_EQ(quantityOf("X.fActVelocity"), (Quantity{"Velocity", "u/s"}));
  EXPECT_EQ(quantityOf("Main.Move.Deceleration"), (Quantity{"Acceleration", "u/s²"}));
  EXPECT_EQ(quantityOf("Drive.fSetJerk").unit, "u/s³");
  EXPECT_EQ(quantityOf("Main.n"), (Quantity{"Main.n", ""}));
}

TEST(TickMarks, AreRound) {
  EXPECT_THAT(niceTicks(0, 5, 5).values, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(niceTicks(-106, 106, 5).values, ElementsAre(-100, -50, 0, 50, 100));
  EXPECT_EQ(niceTicks(0, 0.01, 5).decimals, 3);
  EXPECT_TRUE(niceTicks(1, 1, 5).values.empty());
}

TEST(Svg, HasAPanelPerQuantity) {
  const Trace trace =
      read("t,D.fSetPosition,D.fActPosition,D.fSetVelocity,D.bError\n0,0,0,0,0\n1,1,2,3,1\n");
  const std::string svg = drawSvg(trace);
  EXPECT_EQ(count(svg, "Position [u]"), 1U);
  EXPECT_EQ(count(svg, "Velocity [u/s]"), 1U);
  EXPECT_EQ(count(svg, "Time [s]"), 1U);
  EXPECT_EQ(count(svg, ">D.fActPosition<"), 1U);
  EXPECT_EQ(count(svg, "fill=\"none\" stroke=\"#9ca3af\""), 3U); // frames
  EXPECT_THAT(svg, HasSubstr("</svg>"));
}

TEST(Svg, SurvivesOddValues) {
  const std::string svg = drawSvg(read("t,a<b>&,c\n0,nan,5\n0,inf,5\n0,1,5\n"));
  EXPECT_THAT(svg, HasSubstr("a&lt;b&gt;&amp;"));
  EXPECT_EQ(count(svg, "nan"), 0U);
  EXPECT_EQ(count(svg, "inf"), 0U);
}

TEST(Svg, LongTracesStaySmall) {
  std::string csv = "t,Drive.fSetPosition\n";
  for (int i = 0; i < 100'000; ++i)
    csv += std::to_string(i * 0.001) + "," + std::to_string(i * 37 % 1000) + "\n";
  EXPECT_LT(drawSvg(read(csv)).size(), 100'000U);
}

} // namespace
} // namespace stc::cli
