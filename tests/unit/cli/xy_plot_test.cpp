// Columns of a trace against each other.
#include "compiler/plot/xy_plot.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stc::plot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A flat ellipse, gone over once.
Trace ellipse(size_t rows) {
  Trace trace;
  trace.series.resize(3);
  trace.series[0].name = "X.fSetPosition";
  trace.series[1].name = "Y.fSetPosition";
  trace.series[2].name = "Main.fWay";
  for (size_t i = 0; i < rows; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(rows - 1);
    trace.time.push_back(part);
    trace.series[0].values.push_back(30 * std::cos(2 * M_PI * part));
    trace.series[1].values.push_back(5 + 10 * std::sin(2 * M_PI * part));
    trace.series[2].values.push_back(3 * part);
  }
  return trace;
}

XyPicture pictureOf(const Trace &trace, bool color) {
  return {{{&trace.series[0], &trace.series[1]}}, color ? &trace.series[2] : nullptr};
}

size_t count(std::string_view text, std::string_view part) {
  size_t result = 0;
  for (size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1))
    ++result;
  return result;
}

TEST(Xy, BothAxesHaveOneScale) {
  const Trace trace = ellipse(100);
  const XyFrame frame = frameOf(trace, pictureOf(trace, false));
  EXPECT_EQ(frame.scaleX, frame.scaleY);
  EXPECT_GT(frame.scaleX, 10);
  // All of it is seen, and the middle is in the middle.
  EXPECT_GT(frame.x(-30), frame.left);
  EXPECT_LT(frame.x(30), frame.left + frame.width);
  EXPECT_GT(frame.y(15), frame.top);
  EXPECT_LT(frame.y(-5), frame.top + frame.height);
  EXPECT_NEAR(frame.y(5), frame.top + frame.height / 2, 0.1);
}

TEST(Xy, TallPathsStayOnThePage) {
  Trace trace = ellipse(100);
  std::swap(trace.series[0].values, trace.series[1].values);
  const XyFrame frame = frameOf(trace, pictureOf(trace, false));
  EXPECT_EQ(frame.scaleX, frame.scaleY);
  EXPECT_LT(frame.height, 800);
  EXPECT_NEAR(frame.x(5), frame.left + frame.width / 2, 0.1);
}

TEST(Xy, OtherUnitsHaveTheirOwnScale) {
  Trace trace = ellipse(100);
  trace.series[1].name = "Y.fSetVelocity";
  const XyFrame frame = frameOf(trace, pictureOf(trace, false));
  EXPECT_NE(frame.scaleX, frame.scaleY);
}

TEST(Xy, DrawsACurveInOneColourOrByAColumn) {
  const Trace trace = ellipse(2000);
  const std::string plain = drawXySvg(trace, pictureOf(trace, false));
  EXPECT_EQ(count(plain, "<polyline"), 1U);
  EXPECT_EQ(count(plain, "<circle"), 1U);
  EXPECT_THAT(plain, HasSubstr(">X.fSetPosition [u]</text>"));
  EXPECT_THAT(plain, HasSubstr(">Y.fSetPosition [u]</text>"));
  const std::string colored = drawXySvg(trace, pictureOf(trace, true));
  EXPECT_EQ(count(colored, "<polyline"), 24U);
  EXPECT_THAT(colored, HasSubstr(">Main.fWay"));
  EXPECT_THAT(colored, HasSubstr("text-anchor=\"end\">3</text>"));
}

TEST(Xy, DrawsSeveralCurvesWithALegend) {
  const Trace trace = ellipse(50);
  XyPicture picture = pictureOf(trace, false);
  picture.curves.push_back({&trace.series[0], &trace.series[2]});
  const std::string svg = drawXySvg(trace, picture);
  EXPECT_EQ(count(svg, "<polyline"), 2U);
  EXPECT_THAT(svg, HasSubstr(">X.fSetPosition, Main.fWay</text>"));
}

TEST(Xy, LeavesGapsAndSurvivesOddValues) {
  Trace trace = ellipse(50);
  trace.title = "a < b";
  trace.series[0].values[20] = std::numeric_limits<double>::quiet_NaN();
  trace.series[1].values[30] = std::numeric_limits<double>::infinity();
  const std::string svg = drawXySvg(trace, pictureOf(trace, true));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_EQ(count(drawXySvg(trace, pictureOf(trace, false)), "<polyline"), 3U);
  Trace still = ellipse(2);
  still.series[0].values = still.series[1].values = {4, 4};
  EXPECT_THAT(drawXySvg(still, pictureOf(still, true)), HasSubstr("<circle"));
  still.series[0].values = {NAN, NAN};
  EXPECT_THAT(drawXySvg(still, pictureOf(still, false)), Not(HasSubstr("nan")));
}

TEST(Xy, ThePageHoldsTheRows) {
  Trace trace = ellipse(5);
  trace.series[2].name = "</script>";
  const std::string page = drawXyPage(trace, pictureOf(trace, true));
  EXPECT_EQ(count(page, "</script>"), 2U);
  EXPECT_THAT(page, HasSubstr("<svg "));
  EXPECT_THAT(page, HasSubstr("\"time\":[0,0.25,0.5,0.75,1]"));
  EXPECT_THAT(page, HasSubstr("\"across\":[30,"));
}

} // namespace
} // namespace stc::plot
