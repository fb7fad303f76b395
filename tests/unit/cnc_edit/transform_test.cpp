// Moved CNC programs: their paths, decoded and sampled, are the old ones moved by a formula of
// this test.
#include "compiler/assets/cnc_edit/transform.hpp"

#include "tests/unit/cnc_processors/sampled_path.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace stc {
namespace {

using stride::cnc::MoveType;
using stride::cnc::PathObject;
using Xyz = std::array<double, 3>;
using Formula = std::function<Xyz(Xyz)>;

std::vector<PathObject> pathOf(const std::string &text) {
  Sources sources;
  Diagnostics diagnostics;
  std::vector<PathObject> path;
  const auto program = readCnc(sources.file(sources.add("a.cnc", text)), diagnostics);
  EXPECT_TRUE(program) << text;
  if (program) {
    const CncDecoded decoded = decodeCnc(*program, [&](const PathObject &object) {
      path.push_back(object);
      return true;
    });
    EXPECT_EQ(decoded.end, CncEnd::Complete) << text;
  }
  return path;
}

/// The changed text, or the first message with its code.
std::string changed(const std::string &text, const CncTransform &transform) {
  Sources sources;
  Diagnostics diagnostics;
  const auto result =
      transformCnc(sources.file(sources.add("a.cnc", text)), transform, diagnostics);
  if (result)
    return *result;
  const Diagnostic &first = diagnostics.all().front();
  EXPECT_FALSE(first.helps.empty());
  return codeName(first.code) + ": " + first.message;
}

void expectMoved(const std::string &text, const std::string &after, const Formula &formula,
                 double factor) {
  const std::vector<PathObject> before = pathOf(text);
  const std::vector<PathObject> path = pathOf(after);
  ASSERT_EQ(before.size(), path.size()) << text << after;
  for (size_t i = 0; i < path.size(); ++i) {
    if (path[i].moveType == MoveType::Function)
      continue;
    // Where the path begins does not move.
    for (const double part : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      if (i == 0 && part < 1)
        continue;
      const auto old = stride::cnc::test::placeAt(before[i], part);
      const auto now = stride::cnc::test::placeAt(path[i], part);
      const Xyz wanted = formula({old[0], old[1], old[2]});
      ASSERT_NEAR(now[0], wanted[0], 1e-5) << i << " at " << part << '\n' << text << after;
      ASSERT_NEAR(now[1], wanted[1], 1e-5) << i << " at " << part << '\n' << text << after;
      ASSERT_NEAR(now[2], wanted[2], 1e-5) << i << " at " << part << '\n' << text << after;
    }
    EXPECT_EQ(path[i].sourceLine, before[i].sourceLine);
    EXPECT_EQ(path[i].velocity, before[i].velocity);
    EXPECT_EQ(path[i].end.coordinate[stride::cnc::kAxisP],
              before[i].end.coordinate[stride::cnc::kAxisP]);
    EXPECT_EQ(path[i].switchId[0], before[i].switchId[0]);
    if (i > 0) {
      EXPECT_NEAR(path[i].length, before[i].length * factor, 1e-5);
      EXPECT_NEAR(path[i].switchPosition[0], before[i].switchPosition[0], 1e-6);
    }
  }
}

/// Lines, arcs of all kinds, splines, ellipses, modes.
class RandomProgram {
public:
  explicit RandomProgram(unsigned seed, bool planes) : random_(seed), planes_(planes) {}

  std::string text() {
    std::string text = "% random\nN0 G0 X7 Y8 Z2 F100 (start)\nN1 G0 X3 Y-2 Z1\n";
    for (int i = 2; i < 25; ++i)
      text += fmt::format("N{} {}\n", i, sentence());
    return text;
  }

private:
  int pick(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }
  std::string number() { return fmt::format("{:.3f}", 0.001 * (pick(40000) - 20000) + 0.0005); }
  std::string plus(int value) { return fmt::format("{}", value); }

  std::string sentence() {
    switch (pick(planes_ ? 12 : 11)) {
    case 0:
      return "G1 X" + number() + " H1 O0.25";
    case 1:
      return "G1 Y" + number() + "Z" + number() + " H-2 L0.125";
    case 2:
      return "G0 X" + number() + " P" + number() + " (go)";
    case 3:
      return relative_ ? "G3 X4 Y4 R" + plus(3 + pick(9)) : "G1 Z" + number();
    case 4: // a full circle, then parts of it
      return (pick(2) == 0 ? "G2 " : "G3 ") + std::string(absolute_ ? "T30 I1 J1" : "I2 J-3");
    case 5:
      return fmt::format("G3 T{} I{} J{}", 20 + pick(300), 1 + pick(5), pick(5));
    case 6:
      return relative_ && !absolute_ && !planes_ ? "G8 X-20 Y5 I-10 J0 R0.5 K30" : "M7 K5";
    case 7:
      return (planes_ ? "G1 X" : "G5 X") + number() + " Y" + number();
    case 8:
      relative_ = !relative_;
      return relative_ ? "G91" : "G90";
    case 9:
      absolute_ = !absolute_;
      return absolute_ ? "G98" : "G99";
    case 10:
      return "G92 X" + number();
    default:
      return "G" + plus(17 + pick(3));
    }
  }

  std::mt19937 random_;
  bool planes_;
  bool relative_ = false;
  bool absolute_ = false;
};

TEST(CncTransform, RandomPathsAreTurned) {
  const double about[stride::cnc::kAxes] = {4, -7};
  for (unsigned seed = 0; seed < 300; ++seed) {
    const std::string text = RandomProgram(seed, false).text();
    const double degrees = 1.5 * seed - 90;
    const double c = std::cos(degrees * M_PI / 180);
    const double s = std::sin(degrees * M_PI / 180);
    const auto formula = [=](Xyz p) {
      return Xyz{4 + c * (p[0] - 4) - s * (p[1] + 7), -7 + s * (p[0] - 4) + c * (p[1] + 7), p[2]};
    };
    expectMoved(text, changed(text, cncRotation(degrees, about)), formula, 1);
    if (HasFatalFailure())
      return;
  }
}

TEST(CncTransform, RandomPathsAreScaledMirroredAndShifted) {
  const double about[stride::cnc::kAxes] = {4, -7, 2};
  for (unsigned seed = 1000; seed < 1300; ++seed) {
    const std::string text = RandomProgram(seed, true).text();
    const auto scaled = [](Xyz p) {
      return Xyz{4 + 2.5 * (p[0] - 4), -7 + 2.5 * (p[1] + 7), 2 + 2.5 * (p[2] - 2)};
    };

    expectMoved(text, changed(text, cncScale(2.5, about)), scaled, 2.5);
    const int axis = static_cast<int>(seed % 3);
    const auto mirrored = [axis](Xyz p) {
      p[static_cast<size_t>(axis)] = 6 - p[static_cast<size_t>(axis)];
      return p;
    };
    expectMoved(text, changed(text, cncReflection(axis, 3)), mirrored, 1);
    const auto shifted = [](Xyz p) { return Xyz{p[0] + 4, p[1] - 7, p[2] + 2}; };
    expectMoved(text, changed(text, cncShift(about)), shifted, 1);
    if (HasFatalFailure())
      return;
  }
}

/// Rows and columns of holes, slots and pockets by loops in each other, with what is driven in
/// them: coordinates from where the loop is, or the same places again and again.
class RandomLoops {
public:
  explicit RandomLoops(unsigned seed) : random_(seed) {}

  std::string text() {
    const int rounds = 1 + pick(4);
    std::string text = "N1 G0 X7 Y8 Z2 F100\n";
    text += fmt::format("G36 D{}\nN10 G91\n", rounds);
    for (int i = 2 + pick(5); i > 0; --i)
      text += fmt::format("{} (part {})\n", relative(), i);
    if (pick(2) == 0)
      text += fmt::format("G90\nG0 X{} Y{} Z3\n{}", number(), number(), straight());
    text += "G37 D-1\nG20 L10\n" + straight();
    // A part that is left out, and the same sentence from two places.
    text += "G20 L30 K1\nG1 X$never$ Y5 Z$never$\nN30 G90\n" + straight();
    return text;
  }

private:
  int pick(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }
  std::string number() { return fmt::format("{:.3f}", 0.001 * (pick(40000) - 20000) + 0.0005); }

  std::string straight() {
    return "G90\nG1 X" + number() + " Y" + number() + " Z" + number() + "\n";
  }

  std::string relative() {
    switch (pick(6)) {
    case 0:
      return "G1 X" + number() + " Y" + number();
    case 1:
      return fmt::format("G{} X4 Y4 R{}", 2 + pick(2), 3 + pick(9));
    case 2:
      return fmt::format("G3 T{} I{} J{}", 20 + pick(300), 1 + pick(5), pick(5));
    case 3:
      return "G1 Z" + number() + " H1 O0.25";
    case 4:
      return fmt::format("G2 I{} J-3", 1 + pick(4));
    default:
      return "G0 Y" + number();
    }
  }

  std::mt19937 random_;
};

TEST(CncTransform, RandomLoopsAreMoved) {
  const double about[stride::cnc::kAxes] = {4, -7, 2};
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::string text = RandomLoops(seed).text();
    const double degrees = 1.5 * seed - 90;
    const double c = std::cos(degrees * M_PI / 180);
    const double s = std::sin(degrees * M_PI / 180);
    const auto turned = [=](Xyz p) {
      return Xyz{4 + c * (p[0] - 4) - s * (p[1] + 7), -7 + s * (p[0] - 4) + c * (p[1] + 7), p[2]};
    };
    expectMoved(text, changed(text, cncRotation(degrees, about)), turned, 1);
    const auto scaled = [](Xyz p) {
      return Xyz{4 + 2.5 * (p[0] - 4), -7 + 2.5 * (p[1] + 7), 2 + 2.5 * (p[2] - 2)};
    };
    expectMoved(text, changed(text, cncScale(2.5, about)), scaled, 2.5);
    const auto mirrored = [](Xyz p) { return Xyz{6 - p[0], p[1], p[2]}; };
    expectMoved(text, changed(text, cncReflection(0, 3)), mirrored, 1);
    const auto shifted = [](Xyz p) { return Xyz{p[0] + 4, p[1] - 7, p[2] + 2}; };
    expectMoved(text, changed(text, cncShift(about)), shifted, 1);
    if (HasFatalFailure())
      return;
  }
}

TEST(CncTransform, ASentenceThatIsReachedInSeveralWaysHasOneText) {
  const double by[stride::cnc::kAxes] = {5};
  const double zero[stride::cnc::kAxes] = {};
  const auto turned = [&](const std::string &text) { return changed(text, cncRotation(90, zero)); };
  EXPECT_EQ(turned("G36 D2\nG0 X1 Y2 F1\nN5 G91\nG1 X3\nG37 D-1\nG20 L5\n"),
            "G36 D2\nG0 X-2 Y1 F1\nN5 G91\nG1 X0 Y3\nG37 D-1\nG20 L5\n");
  // Y of where the sentence begins is in its new X: 2 the first time, then 9.
  EXPECT_EQ(turned("G36 D2\nG0 X1 Y2 F1\nN5 G1 X3\nY9\nG37 D-1\nG20 L5\n"),
            "SE0892: jumps lead here in several ways, and each needs another text");
  // The first line of a path begins elsewhere, and needs Z only then.
  const double up[stride::cnc::kAxes] = {0, 0, 5};
  EXPECT_EQ(changed("G36 D2\nG91\nN5 G1 X3 F1\nG37 D-1\nG20 L5\n", cncShift(up)),
            "SE0892: jumps lead here in several ways, and each needs another text");
  EXPECT_EQ(changed("G36 D2\nN5 G1 X3 F1\nG37 D-1\nG20 L5\n", cncShift(up)),
            "G36 D2\nN5 G1 X3 Z5 F1\nG37 D-1\nG20 L5\n");
  // An arc that stays from before, in one plane and in another.
  EXPECT_EQ(changed("G36 D2\nG17\nG2 I1 F1\nN5 J1\nG37 D-1\nG18\nG20 L5\n", cncReflection(1, 0)),
            "SE0892: jumps lead here in several ways, and each needs another text");
  // For ever.
  EXPECT_EQ(changed("N5 G1 X3 F1\nX7\nG20 L5 K1\n", cncShift(by)), "N5 G1 X8 F1\nX12\nG20 L5 K1\n");
  // What is never carried out stays.
  EXPECT_EQ(changed("G1 X3 F1\nG20 L5 K1\nX$a$\nN5 X4\n", cncShift(by)),
            "G1 X8 F1\nG20 L5 K1\nX$a$\nN5 X9\n");
}

TEST(CncTransform, WhatIsNoWordOfTheChangeStays) {
  const double by[stride::cnc::kAxes] = {5};
  EXPECT_EQ(changed("%  a\r\n\r\n n010 g01  x1.50(c)Y$a.b$ F100//d\r\n M3 K5 X7\r\n", cncShift(by)),
            "%  a\r\n\r\n n010 g01  x6.5(c)Y$a.b$ F100//d\r\n M3 K5 X7\r\n");
  EXPECT_EQ(changed("G1 x 2 F1", cncShift(by)), "G1 x 7 F1");
}

TEST(CncTransform, APathBeginsWhereTheApplicationSays) {
  const double by[stride::cnc::kAxes] = {5, 0, 2};
  EXPECT_EQ(changed("G1 Y3 F1\nX1\n", cncShift(by)), "G1 Y3 X5 Z2 F1\nX6\n");
  EXPECT_EQ(changed("G91\nG1 Y3 F1\nX1\n", cncShift(by)), "G91\nG1 Y3 X5 Z2 F1\nX1\n");
}

TEST(CncTransform, ToolsChangeSidesInAMirror) {
  EXPECT_EQ(changed("G41 D2\nG1 X3 F1\nG40\n", cncReflection(0, 0)), "G42 D2\nG1 X-3 F1\nG40\n");
  EXPECT_EQ(changed("G42 D2\nG1 X3 F1\nG40\n", cncReflection(2, 0)), "G42 D2\nG1 X3 F1\nG40\n");
  // A function that stays over a change of the plane.
  EXPECT_EQ(changed("G2 I1 F1\nG19\nJ1\n", cncReflection(0, 0)), "G3 I-1 F1\nG19\nJ1 G2\n");
}

TEST(CncTransform, WhatCannotBeMovedIsSaid) {
  const double zero[stride::cnc::kAxes] = {};
  const double by[stride::cnc::kAxes] = {5};
  const auto turned = [&](const std::string &text) { return changed(text, cncRotation(30, zero)); };
  EXPECT_EQ(turned("G1 X$a$ F1\n"),
            "SE0892: a variable says this value, which would have to change");
  EXPECT_EQ(turned("N1 G1 X1 F1\nG20 L1 K$k$\n"), "SE0892: a variable decides about this jump");
  EXPECT_EQ(turned("G36 D$d$\nN1 G1 X1 F1\nG37 D-1\nG20 L1\n"),
            "SE0892: a variable decides about this jump");
  EXPECT_EQ(turned("G36 D2\nN1 G1 X1 F1\nG37 D-1\n/G20 L1\n"),
            "SE0892: this jump may be suppressed, and others depend on it");
  EXPECT_EQ(turned("G54 X1\n"), "SE0892: the program moves its coordinates itself");
  EXPECT_EQ(turned("G16 I1\n"), "SE0892: a plane that is given by its normal cannot be turned");
  EXPECT_EQ(turned("G18\nG2 I5 F1\n"), "SE0892: an arc in this plane cannot be turned about Z");
  EXPECT_EQ(turned("G1 X5 F1\n/X7\n"),
            "SE0892: this sentence may be suppressed, and others depend on it");
  EXPECT_EQ(turned("G2 I1 T$t$ F1\n"), "SE0892: a variable says where this arc ends");
  EXPECT_EQ(turned("G1 X{1+2}\n"),
            "SE0892: programs with expressions and subprograms cannot be changed");
  EXPECT_EQ(changed("G2 I1 F1\n", cncShift(by)),
            "SE0892: the path begins with a curve, and its start does not move along");
  EXPECT_EQ(changed("G1 X999999999999 F1\n", cncScale(10, zero)),
            "SE0892: the new value of this word is too large");
  EXPECT_EQ(turned("G1 X5 F1\nG99 G1\n"), "SE0881: a sentence has one G or M function");
}

} // namespace
} // namespace stc
