// Reversed CNC programs: their paths, decoded and sampled, are the old ones from the end to the
// start.
#include "compiler/assets/cnc_edit/reverse.hpp"

#include "tests/unit/cnc_edit/edit_support.hpp"

#include <algorithm>
#include <cmath>

namespace stc::test {
namespace {

using stride::cnc::isMotion;
using stride::cnc::kAxisP;
using stride::cnc::test::placeAt;

std::string reversed(const std::string &text, const CncStart &start = {}) {
  return edited(text, [&](const SourceFile &file, Diagnostics &diagnostics) {
    return reverseCnc(file, start, diagnostics);
  });
}

std::vector<PathObject> motionsOf(const std::string &text) {
  std::vector<PathObject> path = pathOf(text);
  std::erase_if(path, [](const PathObject &object) { return !isMotion(object); });
  return path;
}

std::vector<int> functionsOf(const std::string &text) {
  std::vector<int> functions;
  for (const PathObject &object : pathOf(text))
    if (object.moveType == MoveType::Function)
      functions.push_back(object.switchId[0]);
  return functions;
}

void expectSwitches(const PathObject &old, const PathObject &now, const std::string &text) {
  for (int i = 0; i < stride::cnc::kMostSwitches; ++i) {
    EXPECT_EQ(old.switchId[i], now.switchId[i]) << text;
    if (old.switchId[i] != 0) {
      EXPECT_NEAR(old.switchPosition[i], 1 - now.switchPosition[i], 1e-9) << text;
    }
  }
}

/// The first motion of both leads to the path.
void expectReversed(const std::string &text, const std::string &after) {
  const std::vector<PathObject> old = motionsOf(text);
  const std::vector<PathObject> now = motionsOf(after);
  ASSERT_EQ(old.size(), now.size()) << text << after;
  for (size_t i = 1; i < old.size(); ++i) {
    const PathObject &a = old[old.size() - i];
    const PathObject &b = now[i];
    for (const double part : {0.0, 0.1, 0.35, 0.5, 0.8, 1.0})
      ASSERT_LT(between(placeAt(a, 1 - part), placeAt(b, part)), 1e-9)
          << i << " at " << part << '\n'
          << text << after;
    EXPECT_EQ(b.sourceLine >= 1000 ? b.sourceLine : 0, a.sourceLine >= 1000 ? a.sourceLine : 0);
    EXPECT_EQ(a.velocity, b.velocity) << text << after;
    EXPECT_EQ(a.acceleration, b.acceleration) << text << after;
    EXPECT_EQ(a.deceleration, b.deceleration) << text << after;
    EXPECT_EQ(a.features, b.features) << text << after;
    EXPECT_NEAR(a.end.coordinate[kAxisP], b.start.coordinate[kAxisP], 1e-9);
    EXPECT_NEAR(a.start.coordinate[kAxisP], b.end.coordinate[kAxisP], 1e-9);
    expectSwitches(a, b, text + after);
  }
}

TEST(CncReverse, RandomPathsGoBack) {
  for (unsigned seed = 0; seed < 250; ++seed) {
    const std::string text = RandomProgram(seed, false).text();
    const std::string after = reversed(text);
    ASSERT_FALSE(after.starts_with("SE")) << text << after;
    expectReversed(text, after);
    std::vector<int> functions = functionsOf(text);
    std::vector<int> then = functionsOf(after);
    std::sort(functions.begin(), functions.end());
    std::sort(then.begin(), then.end());
    EXPECT_EQ(functions, then) << text << after;
    const std::string twice = reversed(after);
    expectReversed(after, twice);
    for (const char *stays : {"% random\n(top)\n", "\n(bottom)\n"})
      EXPECT_NE(after.find(stays), std::string::npos) << after;
    EXPECT_EQ(std::count(text.begin(), text.end(), '('),
              std::count(after.begin(), after.end(), '('));
    if (HasFatalFailure())
      return;
  }
}

TEST(CncReverse, SwitchPointsStayWhereTheyAre) {
  EXPECT_EQ(reversed("N1 G0 X10 F9\nN2 G1 X30 H1 L5 H2 O0.25 H-1 L-2 (c)\n"),
            "N1 G0 X30 F9\nN2 G1 X10 H1 L-5 H2 O0.75 H-1 L2 (c)\n");
  // From the start on: there is no way from the end that is 0.
  EXPECT_EQ(reversed("G0 X10 F9\nG1 X30 H1 L0\n"), "G0 X30 F9\nG1 X10 H1 O1\n");
}

TEST(CncReverse, ModesAndWordsHoldForTheSameMotions) {
  EXPECT_EQ(reversed("G0 X1 F10\nG1 X2 (a)\nF20 (between)\nX3 E500 E-400\n"),
            "SE0892 2:1: no word says what holds for this motion");
  EXPECT_EQ(reversed("F5 E100 E-100\nG0 X1 F10\nG1 X2 (a)\nF20 (between)\nX3 E500\n"),
            "F5 E100 E-100\nG0 X3 F10\nG1 X2 E500 F20\nF10 (between)\nG1 X1 E100 (a)\n");
  EXPECT_EQ(reversed("G90\nG0 X5 F1\nG91\nN3 G1 X2\nN4 Y3\n"),
            "G90\nG0 X7 Y3 F1\nG91\nN4 G1 Y-3\nN3 G1 X-2\nG90\n");
  EXPECT_EQ(reversed("G0 X5 F1\nG41 D2\nN1 G1 X9\nN2 Y9\nG40\nN3 X3\n"),
            "G0 X3 Y9 F1\nN3 G1 X9\nG42 D2\nN2 Y0\nN1 G1 X5\nG40\n");
  // Nobody has ended it.
  EXPECT_EQ(reversed("G0 X5 F1\nG52 D2\nG1 X9\nY9\n"), "G0 X9 Y9 F1\nG52 D2\nG1 Y0\nG1 X5\nG50\n");
  CncStart three;
  three.softMotion3 = true;
  EXPECT_EQ(reversed("G0 X5 F1\nG41 D2\nG1 X9 D7\nG51\nY9\nG50\nG40\nX3\n", three),
            "G0 X3 Y9 F1\nG1 X9\nG42 D2\nG51 D7\nY0\nG50\nG1 X5 D7\nG40\n");
}

TEST(CncReverse, FunctionsStayAtTheirEndOfAContour) {
  EXPECT_EQ(reversed("M6\nG0 X5 F1\nM3\nM8\nG1 X9\nM7 (here)\nY9\nM5\nM30\n"),
            "M6\nG0 X9 Y9 F1\nM3\nM8\nG1 Y0\nM7 (here)\nG1 X5\nM5\nM30\n");
  EXPECT_EQ(reversed("G0 X5 F1\nM3\nG1 X9\nM5\nG0 X20\nM3\nG1 X30\nM5\n"),
            "G0 X30 F1\nM3\nG1 X20\nM5\nG0 X9\nM3\nG1 X5\nM5\n");
}

TEST(CncReverse, APathMayBeginWithoutAWayToIt) {
  EXPECT_EQ(reversed("M3\nG1 X5 F7\nY2\n"), "M3\nG0 X5 Y2 F7\nG1 Y0\nG1 X0 F7\n");
  CncStart start;
  start.position.coordinate[1] = -4;
  EXPECT_EQ(reversed("G1 X5 F7\nY2\n", start), "G0 X5 Y2 F7\nG1 Y-4\nG1 X0 F7\n");
  EXPECT_EQ(reversed("G92 X5 Y1\nG1 X7 F7\n"), "G92 X7 Y1\nG1 X5 F7\n");
  EXPECT_EQ(reversed("G3 I5 F7\n"), "G2 I5 F7\n"); // closed
  EXPECT_EQ(reversed("G0 X3 F2\n"), "G0 X3 F2\n");
  EXPECT_EQ(reversed("(nothing)\n"), "(nothing)\n");
  EXPECT_EQ(reversed(""), "");
}

TEST(CncReverse, LinesAndEndsStay) {
  EXPECT_EQ(reversed("% a\r\n(1)\r\n\r\nN1 G0 X1 F1\r\n(2)\r\n  n02 g01  x2.50(c)\r\nY1"),
            "% a\r\n(1)\r\n\r\nN1 G0 X2.5 Y1 F1\r\nG1 Y0\r\n(2)\r\n  n02 g01  x1(c)");
  EXPECT_EQ(reversed("%a\nG0 X1 F1\nG1 X2\n%\nG1 X3\n"), "%a\nG0 X2 F1\nG1 X1\n%\nG1 X3\n");
}

TEST(CncReverse, WhatHasNoOtherWayRoundIsRefused) {
  const auto says = [](const char *text, const char *what) {
    EXPECT_EQ(reversed(std::string("G0 X1 F1\nG1 X2\n") + text), std::string("SE0892 3:") + what);
  };
  says("G1 X$a$\n", "4: a variable says this value, which would have to change");
  says("G20 L1 K0\nN1 X2\n", "1: a program with jumps cannot be reversed");
  says("G20 L1 K$k$\nN1 X2\n", "8: a variable decides about this jump");
  says("G37 D1\n", "1: a program that sets variables cannot be reversed");
  says("G54 X1\n", "1: the program moves its coordinates itself");
  says("G31 X1\n", "1: a motion that a probe ends cannot be reversed");
  says("/X5\n", "2: this sentence may be suppressed, and others depend on it");
  says("G2 X5 Y5 I1\n", "1: a line is made of this curve");
  says("E$e$ X5\n", "1: a variable says which of two this is");
  EXPECT_EQ(reversed("G0 X1 F1\nG16 I1\nG1 X7\n"),
            "SE0892 3:1: this motion needs a plane that is given by its normal");
  EXPECT_EQ(reversed("G16 I1\nG0 X1 F1\nG1 X7\n"), "G16 I1\nG0 X7 F1\nG1 X1\n");
  says("G38 O2 I5\nG1 X7\n", "1: what held before this sentence cannot be written by it");
  EXPECT_EQ(reversed("G0 X1 H1 O0.5 F1\nG1 X2\n"),
            "SE0892 1:1: the motion to the path has switch points");
  EXPECT_EQ(reversed("G1 X{1}\n"),
            "SE0892 1:1: programs with expressions and subprograms cannot be "
            "changed");
  EXPECT_EQ(reversed("G1 X;\n").substr(0, 6), "SE0880");
}

} // namespace
} // namespace stc::test
