// New numbers of CNC programs: what stays, where jumps lead, what is refused.
#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/assets/cnc_edit/cnc_edit.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace stc::test {
namespace {

struct Numbered {
  std::optional<std::string> text;
  std::vector<Code> codes;
  LineColumn place;
};

Numbered number(const std::string &text, CncNumbering numbering = {}) {
  Sources sources;
  Diagnostics diagnostics;
  const FileId id = sources.add("a.cnc", text);
  Numbered result{numberCnc(sources.file(id), numbering, diagnostics), {}, {}};
  for (const Diagnostic &diagnostic : diagnostics.all()) {
    result.codes.push_back(diagnostic.code);
    result.place = sources.position(diagnostic.labels.at(0).span);
    EXPECT_FALSE(diagnostic.message.empty());
  }
  EXPECT_EQ(result.text.has_value(), result.codes.empty());
  return result;
}

/// Ends of the objects of the path, in the order in which they are gone to.
std::vector<double> pathOf(const std::string &text) {
  Sources sources;
  Diagnostics diagnostics;
  const auto program = readCnc(sources.file(sources.add("a.cnc", text)), diagnostics);
  std::vector<double> path;
  EXPECT_TRUE(program.has_value());
  if (program)
    (void)decodeCnc(*program, [&path](const stride::cnc::PathObject &object) {
      path.push_back(object.end.coordinate[0]);
      path.push_back(object.end.coordinate[1]);
      return path.size() < 2000;
    });
  return path;
}

TEST(CncNumber, KeepsAllButNumbers) {
  EXPECT_EQ(number("% N1 is no number\r\n"
                   "  n003G1X10 Y$g_rN5$ (N7) F50 // N8\r\n"
                   "\r\n"
                   "(N9)\r\n"
                   "\tX20N4\r\n"
                   "M7")
                .text,
            "% N1 is no number\r\n"
            "  N10G1X10 Y$g_rN5$ (N7) F50 // N8\r\n"
            "\r\n"
            "(N9)\r\n"
            "\tX20N20\r\n"
            "N30 M7");
  EXPECT_EQ(number("").text, "");
  EXPECT_EQ(number("(only this)\n").text, "(only this)\n");
}

TEST(CncNumber, PutsNumbersBehindSlashes) {
  EXPECT_EQ(number("/G1 X1\n/ X2\n/N7 X3\n").text, "/N10 G1 X1\n/N20 X2\n/N30 X3\n");
}

TEST(CncNumber, LeadsJumpsToTheSameSentences) {
  const std::string text =
      "N1 G36 D3\nN20 G91 F10\nN2 G1 X3\nN2 Y5\nG37 D-1\nN3 G20 L2\nN10 X100\n";
  const Numbered result = number(text, {20, 1});
  EXPECT_EQ(result.text, "N20 G36 D3\nN21 G91 F10\nN22 G1 X3\nN23 Y5\nN24 G37 D-1\nN25 G20 L22\n"
                         "N26 X100\n");
  EXPECT_EQ(pathOf(*result.text), pathOf(text));
  // L that is no target: of a switch point, of an M function.
  EXPECT_EQ(number("N1 G1 X10 F5 H1 L1\nN2 M3 L1\nN3 G20 K0 L002 L1\n").text,
            "N10 G1 X10 F5 H1 L1\nN20 M3 L1\nN30 G20 K0 L20 L1\n");
}

TEST(CncNumber, TakesTheLeftOfTwoNumbers) {
  EXPECT_EQ(number("N1 N2 G1 X5 F1\nN2 X7\nN3 G20 K0 L2\n").text,
            "N10 N10 G1 X5 F1\nN20 X7\nN30 G20 K0 L20\n");
}

TEST(CncNumber, RefusesWhatItCannotFollow) {
  Numbered result = number("N1 G1 X1 F1\nN2 G20 L$g_i$ K0\n");
  EXPECT_EQ(result.codes, std::vector{Code::CncJump});
  EXPECT_EQ(result.place.line, 2U);
  EXPECT_EQ(result.place.column, 8U);
  EXPECT_EQ(number("N1 G$g_i$ L1\n").codes, std::vector{Code::CncJump});
  EXPECT_EQ(number("N1 G20 L7 K0\n").codes, std::vector{Code::CncJump});
  EXPECT_EQ(number("N1 G20 L1.5 K0\n").codes, std::vector{Code::CncJump});
  EXPECT_EQ(number("N1 G1 X{1+2}\n").codes, std::vector{Code::CncText});
  EXPECT_EQ(number("N1 G1 X;\n").codes, std::vector{Code::CncText});
  EXPECT_TRUE(number("N1 G$g_i$ X1\nN2 G20 K$g_i$ L1\n").codes.empty());
}

TEST(CncNumber, KnowsTheLargestNumber) {
  EXPECT_EQ(number("X1\nX2\n", {2147483646, 1}).text, "N2147483646 X1\nN2147483647 X2\n");
  EXPECT_EQ(number("X1\nX2\n", {2147483646, 2}).codes, std::vector{Code::CncSentence});
  EXPECT_EQ(number("X1\nX2\n", {0, 2147483647}).text, "N0 X1\nN2147483647 X2\n");
  EXPECT_EQ(number("X1\nX2\nX3\n", {0, 2147483647}).codes, std::vector{Code::CncSentence});
}

TEST(CncNumber, KnowsTheLongestSentence) {
  std::string text = "G1";
  for (int i = 1; i < 127; ++i)
    text += " X" + std::to_string(i);
  EXPECT_EQ(number(text).text, "N10 " + text);
  EXPECT_EQ(number(text + " F3").codes, std::vector{Code::CncSentence});
  EXPECT_EQ(number("N3 " + text).text, "N10 " + text);
}

/// Random programs with loops: the path stays, and numbering again changes nothing.
TEST(CncNumber, KeepsThePathOfRandomPrograms) {
  std::mt19937 random(20261124);
  const auto up = [&random](int most) {
    return static_cast<int>(random() % static_cast<unsigned>(most));
  };
  for (int round = 0; round < 100; ++round) {
    std::string text = "G91 F10\n";
    std::vector<int> known;
    for (int line = 0, lines = 1 + up(30); line < lines; ++line) {
      if (up(3) != 0) {
        known.push_back(up(40));
        text += "N" + std::to_string(known.back()) + " ";
      }
      if (up(4) == 0 && !known.empty()) {
        const int target = known[static_cast<size_t>(up(static_cast<int>(known.size())))];
        text += "G20 L" + std::to_string(target) + (up(2) == 0 ? " (again)\n" : " K0\n");
      } else if (up(4) == 0) {
        text += up(2) == 0 ? "G36 D2\n" : "G37 D-1\n";
      } else {
        text += "G1 X" + std::to_string(up(9)) + " Y" + std::to_string(line) + "\n";
      }
    }
    const Numbered once = number(text, {up(50), 1 + up(12)});
    ASSERT_TRUE(once.text) << text;
    EXPECT_EQ(pathOf(*once.text), pathOf(text)) << text;
    EXPECT_EQ(number(*number(text).text).text, number(text).text) << text;
  }
}

} // namespace
} // namespace stc::test
