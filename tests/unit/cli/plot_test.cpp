#include "compiler/plot/plot.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <limits>

namespace stc::plot {
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

size_t count(std::string_view text, std::string_view part) {
  size_t result = 0;
  for (size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
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

TEST(Trace, ANumberThatIsAlwaysZeroIsNoTruthValue) {
  const Trace trace = read("t,Main.level,Main.Move.Done,Main.bRun,Main.x\n0,0,0,0,1\n1,0,0,0,1\n");
  EXPECT_FALSE(trace.series[0].isBool);
  EXPECT_TRUE(trace.series[1].isBool);
  EXPECT_TRUE(trace.series[2].isBool);
  EXPECT_FALSE(trace.series[3].isBool);
}

TEST(Trace, TakesOverTypesAndUnits) {
  Trace trace = read("t,a,b,X.fSetVelocity,c\n0,0,1,0,1\n1,1,2,0,0\n");
  describeColumns(
      trace,
      [](const std::string &name) -> std::optional<ColumnType> {
        if (name == "b")
          return ColumnType{ColumnType::Kind::State, {{1, "one"}, {3, "three"}}};
        return name == "c" ? std::nullopt : std::optional(ColumnType{});
      },
      [](const std::string &name) { return std::string(name == "X.fSetVelocity" ? "mm" : ""); });
  EXPECT_FALSE(trace.series[0].isBool);
  EXPECT_TRUE(trace.series[1].isLane());
  EXPECT_EQ(stateName(trace.series[1], 1), "one");
  EXPECT_EQ(stateName(trace.series[1], 2), "2");
  EXPECT_EQ(labelOf(*trace.series[2].quantity), "Velocity [mm/s]");
  EXPECT_TRUE(trace.series[3].isBool) << "nothing is known of it";
}

TEST(Trace, IsCutAtTheFirstAndTheLastRowThatAreWanted) {
  Trace trace = read("t,a\n0,5\n1,6\n2,7\n3,8\n");
  EXPECT_TRUE(cut(trace, 1, 2));
  EXPECT_THAT(trace.time, ElementsAre(1, 2));
  EXPECT_THAT(trace.series[0].values, ElementsAre(6, 7));
  EXPECT_FALSE(cut(trace, 2.5, 9));
}

TEST(Panels, AreThoseThatAreChosen) {
  Trace trace = read("t,A.fSetPosition,A.fActPosition,Main.bOn,Main.n\n0,0,0,0,5\n1,1,1,1,6\n");
  trace.panels = {{"", {"Main.b*"}}, {"Where", {"Main.n", "*Position", "A.f*"}}, {"", {"Z*"}}};
  const std::vector<Panel> panels = arrange(trace);
  ASSERT_EQ(panels.size(), 2U);
  EXPECT_TRUE(panels[0].lanes);
  EXPECT_FALSE(panels[1].lanes);
  EXPECT_EQ(panels[1].quantity, (Quantity{"Where", ""}));
  ASSERT_EQ(panels[1].series.size(), 3U);
  EXPECT_EQ(panels[1].series[0]->name, "Main.n");
  EXPECT_EQ(panels[1].series[2]->name, "A.fActPosition");
}

TEST(Page, HoldsTheTraceAndNothingEndsItsScript) {
  Trace trace = read("t,\"a</script>\",Main.bOn\n0,0.5,0\n0.25,1e300,1\n");
  trace.series[0].values[1] = std::numeric_limits<double>::quiet_NaN();
  trace.title = "A & B @DATA@";
  const std::string page = drawPage(trace);
  EXPECT_EQ(count(page, "</script>"), 2U);
  EXPECT_THAT(page, HasSubstr("<title>A &amp; B @DATA@</title>"));
  EXPECT_THAT(page, HasSubstr(R"("time":[0,0.25])"));
  EXPECT_THAT(page, HasSubstr(R"("name":"a\u003c/script\u003e","bool":false,"values":[0.5,null])"));
  EXPECT_THAT(
      page, HasSubstr(R"("lanes":true,"series":[{"name":"Main.bOn","bool":true,"values":[0,1]})"));
}

TEST(Trace, OutputsAboutAVelocityAreTruthValues) {
  const Trace trace =
      read("t,M.Move.InVelocity,M.Status.ConstantVelocity,M.Move.Velocity,InitialVelocity\n"
           "0,0,0,0,0\n1,1,1,1,1\n");
  EXPECT_TRUE(trace.series[0].isBool);
  EXPECT_TRUE(trace.series[1].isBool);
  EXPECT_FALSE(trace.series[2].isBool);
  EXPECT_FALSE(trace.series[3].isBool);
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

// Where the text stands; a fault if it stands there not exactly once.
double heightOf(std::string_view svg, std::string_view content) {
  const std::string element = ">" + std::string(content) + "<";
  EXPECT_EQ(count(svg, element), 1U) << content;
  const size_t begin = svg.rfind("<text", svg.find(element));
  return std::stod(std::string(svg.substr(svg.find(" y=\"", begin) + 4, 12)));
}

TEST(Svg, KeepsTheOrderOfTheTrace) {
  const std::string svg = drawSvg(read("t,P.First.Done,D.fSetVelocity,P.Go,D.fSetPosition\n"
                                       "0,FALSE,0,FALSE,0\n1,TRUE,1,TRUE,5\n2,TRUE,0,FALSE,6\n"));
  EXPECT_LT(heightOf(svg, "First.Done"), heightOf(svg, "Go"));
  EXPECT_LT(heightOf(svg, "Go"), heightOf(svg, "D.fSetVelocity"));
  EXPECT_LT(heightOf(svg, "D.fSetVelocity"), heightOf(svg, "D.fSetPosition"));
}

TEST(Svg, DrawsTruthValuesAsLanes) {
  // The plot area is 852 px wide, 84 to 936: 213 px for a second.
  const std::string svg =
      drawSvg(read("t,a.b,c\n0,FALSE,TRUE\n1,TRUE,TRUE\n3,FALSE,TRUE\n4,FALSE,TRUE\n"));
  // TRUE from 1 s to 3 s; always TRUE. Above the base line they are filled.
  EXPECT_THAT(svg, HasSubstr("<path d=\"M84 32H297V19H723V32H936\" fill=\"none\""));
  EXPECT_THAT(svg, HasSubstr("<path d=\"M84 41H936\" fill=\"none\""));
  EXPECT_THAT(svg, HasSubstr("<path d=\"M84 54V41H936V54\" fill=\"#d55e00\""));
  EXPECT_EQ(count(svg, "stroke-dasharray"), 0U); // there is no other panel
}

TEST(Svg, LeadsFromLanesThroughAllPanels) {
  const std::string csv = "t,a,b,D.fSetPosition\n0,FALSE,FALSE,0\n1,TRUE,TRUE,1\n2,FALSE,TRUE,2\n";
  EXPECT_EQ(count(drawSvg(read(csv)), "stroke-dasharray"), 2U); // at 1 s and 2 s
  std::string busy = "t,a,D.fSetPosition\n";
  for (int i = 0; i < 100; ++i)
    busy += std::to_string(i) + (i % 2 != 0 ? ",TRUE,0\n" : ",FALSE,0\n");
  EXPECT_EQ(count(drawSvg(read(busy)), "stroke-dasharray"), 0U);
}

TEST(Svg, LeavesOutTheProgramOfLanesWithinItsBlocks) {
  const std::string row = "\n0,FALSE,FALSE\n1,TRUE,TRUE\n";
  EXPECT_THAT(drawSvg(read("t,Main.First.Done,Main.Go" + row)), HasSubstr(">First.Done<"));
  EXPECT_THAT(drawSvg(read("t,Main.First.Done,Other.Go" + row)), HasSubstr(">Main.First.Done<"));
  EXPECT_THAT(drawSvg(read("t,Main.Ready,Main.Go" + row)), HasSubstr(">Main.Ready<"));
  EXPECT_THAT(drawSvg(read("t,Main.First.Done,Go" + row)), HasSubstr(">Main.First.Done<"));
}

TEST(Svg, GivesLongNamesOfLanesRoom) {
  const std::string name(40, 'n');
  const std::string svg = drawSvg(read("t," + name + "\n0,FALSE\n1,TRUE\n"));
  EXPECT_THAT(svg, HasSubstr("<path d=\"M276 32")); // 20 + 40 * 6.4
}

TEST(Svg, BreaksLongLegends) {
  std::string header = "t";
  std::string row = "0";
  for (int i = 0; i < 5; ++i) {
    header += ",D.aLongNameOfSomeVariable" + std::to_string(i) + "fSetVelocity";
    row += ",1.5";
  }
  const std::string svg = drawSvg(read(header + "\n" + row + "\n"));
  const auto place = [&](int i) {
    return heightOf(svg, "D.aLongNameOfSomeVariable" + std::to_string(i) + "fSetVelocity");
  };
  // 275 px each, with 22 px between them: two in a row of 852 px.
  EXPECT_EQ(place(0), place(1));
  EXPECT_EQ(place(2), place(0) + 17);
  EXPECT_EQ(place(2), place(3));
  EXPECT_EQ(place(4), place(2) + 17);
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
} // namespace stc::plot
