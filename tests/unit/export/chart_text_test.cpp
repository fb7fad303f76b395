// Textual charts in their parts.
#include "compiler/export/chart_text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stc::exporting {
namespace {

using testing::ElementsAre;

TEST(ChartText, ReadsStepsAndActions) {
  const auto chart = chartText("// First\nINITIAL_STEP A: (* in it *)\n  Work(l, times[1, (2)]); "
                               "Note(); Rest; Store(S0);\nEND_STEP\nstep b: end_step // last\n");
  ASSERT_TRUE(chart);
  ASSERT_EQ(chart->steps.size(), 2U);
  EXPECT_TRUE(chart->steps[0].initial);
  EXPECT_FALSE(chart->steps[1].initial);
  EXPECT_EQ(chart->steps[0].comment, "First\nin it\n");
  EXPECT_EQ(chart->comment, "last\n");
  const std::vector<ChartActionText> &actions = chart->steps[0].actions;
  ASSERT_EQ(actions.size(), 4U);
  EXPECT_EQ(actions[0].qualifier, "L");
  EXPECT_EQ(actions[0].time, "times[1, (2)]");
  EXPECT_EQ(actions[0].indicator, "");
  EXPECT_EQ(actions[1].name, "Note");
  EXPECT_EQ(actions[2].qualifier, "N");
  EXPECT_EQ(actions[3].qualifier, "S");
}

TEST(ChartText, ReadsTimesOfSteps) {
  const auto chart =
      chartText("INITIAL_STEP A (min_time := Least(a := 1, b := 2), MAX_TIME := times[1, 2]): "
                "Work(L, MAX(T#1s, a) (* , *) , done, other); END_STEP\n"
                "STEP B (MAX_TIME := T#5s): END_STEP");
  ASSERT_TRUE(chart);
  EXPECT_EQ(chart->steps[0].minTime, "Least(a := 1, b := 2)");
  EXPECT_EQ(chart->steps[0].maxTime, "times[1, 2]");
  EXPECT_EQ(chart->steps[0].actions[0].indicator, "done, other");
  EXPECT_EQ(chart->steps[1].minTime, "");
  EXPECT_EQ(chart->steps[1].maxTime, "T#5s");
}

TEST(ChartText, ReadsTransitions) {
  const auto chart =
      chartText("STEP A: END_STEP STEP B: END_STEP STEP from: END_STEP\n"
                "TRANSITION FROM (A, B) TO from := t = 'x;y' OR (* or *) c; // why\n"
                "END_TRANSITION\n"
                "TRANSITION from (PRIORITY := 12) FROM from TO (A, B):\n  LD a (* here *)\n"
                "END_TRANSITION\n"
                "TRANSITION FROM FROM A TO B := 'x' = t; END_TRANSITION");
  ASSERT_TRUE(chart);
  ASSERT_EQ(chart->transitions.size(), 3U);
  const ChartTransitionText &first = chart->transitions[0];
  EXPECT_EQ(first.name, "");
  EXPECT_THAT(first.from, ElementsAre("A", "B"));
  EXPECT_THAT(first.to, ElementsAre("from"));
  EXPECT_EQ(first.condition, "t = 'x;y' OR (* or *) c");
  EXPECT_EQ(first.comment, "why\n");
  const ChartTransitionText &second = chart->transitions[1];
  EXPECT_EQ(second.name, "from");
  EXPECT_EQ(second.priority, "12");
  EXPECT_TRUE(second.instructions);
  EXPECT_EQ(second.condition, "LD a (* here *)\n");
  EXPECT_THAT(second.to, ElementsAre("A", "B"));
  EXPECT_EQ(chart->transitions[2].name, "FROM");
  EXPECT_EQ(chart->transitions[2].condition, "'x' = t");
}

/// These stay text in the export.
TEST(ChartText, LeavesWhatItCannotSay) {
  EXPECT_FALSE(chartText(""));
  EXPECT_FALSE(chartText("step := 1;"));
  EXPECT_FALSE(chartText("STEP A: END_STEP x := 1;"));
  EXPECT_FALSE(chartText("STEP A: END_STEP {warning 'after the last part'}"));
  EXPECT_FALSE(chartText("STEP A: Work(L, T#1s"));
  EXPECT_FALSE(chartText("STEP A: END_STEP TRANSITION (PRIORITY := 16#2) FROM A TO A := b; "
                         "END_TRANSITION"));
}

TEST(ChartText, KeepsPragmasBesideTheirParts) {
  const auto chart =
      chartText("{warning 'a } b'}// why\nSTEP A: {info 'in'} w; END_STEP {text 't'}\n"
                "TRANSITION FROM A {text 'u'} TO A := b {text 'c'}; END_TRANSITION");
  ASSERT_TRUE(chart);
  EXPECT_EQ(chart->steps[0].pragmas, "{warning 'a } b'}\n{info 'in'}\n");
  EXPECT_EQ(chart->steps[0].comment, "why\n");
  EXPECT_EQ(chart->transitions[0].pragmas, "{text 't'}\n{text 'u'}\n");
  EXPECT_EQ(chart->transitions[0].condition, "b {text 'c'}");
}

/// A time where the qualifier has one; what follows are indicator variables.
TEST(ChartText, ReadsIndicatorVariables) {
  const auto chart = chartText("INITIAL_STEP A:\n  a(L, f(1, 2), x , y); b(N, done); c(sd, t);\n"
                               "END_STEP\nTRANSITION FROM A TO A := TRUE;\nEND_TRANSITION\n");
  ASSERT_TRUE(chart.has_value());
  ASSERT_EQ(chart->steps.size(), 1U);
  const auto &actions = chart->steps[0].actions;
  ASSERT_EQ(actions.size(), 3U);
  EXPECT_EQ(actions[0].time, "f(1, 2)");
  EXPECT_EQ(actions[0].indicator, "x , y");
  EXPECT_EQ(actions[1].time, "");
  EXPECT_EQ(actions[1].indicator, "done");
  EXPECT_EQ(actions[2].time, "t");
  EXPECT_EQ(actions[2].indicator, "");
}

} // namespace
} // namespace stc::exporting
