#include "tests/unit/nc/nc_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace stride::nc::test {
namespace {

double xOf(const Ran &ran, size_t i) { return ran.objects.at(i).end.coordinate[cnc::kAxisX]; }
double yOf(const Ran &ran, size_t i) { return ran.objects.at(i).end.coordinate[cnc::kAxisY]; }

TEST(NcProgram, LocalVariablesOfAllTypes) {
  const Ran ran = runText("% the title \n"
                          "LET #a : LREAL := 3\n"
                          "let #A2:LREAL := #a * 2 + 1\n"
                          "LET #yes : BOOL := #a2 > 6\n"
                          "LET #text : STRING := 'ab'\n"
                          "LET #zero : LREAL\n"
                          "N10 G1 X#A2 Y#zero F100\n"
                          "N20 G36 O#a D#a + 10\n"
                          "N30 G37 O#A D 1\n"
                          "N40 G36 O#text D concat{#text, 'cd'}\n"
                          "N50 G36 O#yes D #text = 'abcd'\n"
                          "N60 G1 X#a Y SEL{#yes, 1, 2}\n");
  EXPECT_EQ(ran.error, Error::None);
  ASSERT_TRUE(ran.finished);
  EXPECT_EQ(ran.title, "the title");
  ASSERT_EQ(ran.objects.size(), 2U);
  EXPECT_EQ(xOf(ran, 0), 7);
  EXPECT_EQ(yOf(ran, 0), 0);
  EXPECT_EQ(xOf(ran, 1), 14);
  EXPECT_EQ(yOf(ran, 1), 2);
}

TEST(NcProgram, VariablesAreReadWhenTheirSentenceIsCarriedOut) {
  double width = 4;
  int16_t count = 7;
  uint8_t flag = 0;
  char text[81] = "old";
  Context setup;
  setup.variables = {variable("g_width", 22, &width), variable("COUNT", 1, &count),
                     variable("flag", 23, &flag), variable("text", 24, text)};
  cnc::NamedVariable own{};
  std::snprintf(own.name, sizeof own.name, "own");
  own.type = 22;
  own.real = 2.5F;
  setup.variables.push_back(own);
  const Ran ran = runText("N1 G1 X$G_Width$*2 Y$count$ F10\n"
                          "N2 G36 O$g_width$ D$g_width$ + 0.5\n"
                          "N3 G36 O$flag$ D $text$ = 'old'\n"
                          "N4 G36 O$text$ D concat{$text$, '!'}\n"
                          "N5 G37 O$count$ D 3\n"
                          "N6 X $g_width$ Y SEL{$flag$, 1, 2} Z $own$\n",
                          setup);
  ASSERT_TRUE(ran.finished) << static_cast<int>(ran.error);
  EXPECT_EQ(xOf(ran, 0), 8);
  EXPECT_EQ(yOf(ran, 0), 7);
  EXPECT_EQ(xOf(ran, 1), 4.5);
  EXPECT_EQ(yOf(ran, 1), 2);
  EXPECT_EQ(ran.objects[1].end.coordinate[cnc::kAxisZ], 2.5);
  EXPECT_EQ(count, 10);
  EXPECT_EQ(flag, 1);
  EXPECT_STREQ(text, "old!");
}

TEST(NcProgram, JumpsToNumbersAndLabels) {
  const Ran ran = runText("LET #i : LREAL\n"
                          "N5 G91\n"
                          "N10 G36 O#i D#i + 1\n"
                          "N20 G1 X1 F10\n"
                          "N30 G20 L10 K #i < 4\n"
                          "N40 G20 L?7 K TRUE\n"
                          "N50 G1 X100\n"
                          "N60 L!6 G1 X200\n"
                          "N70 L!{3 + 4} G1 X1000\n"
                          "N80 G20 L?99 K FALSE\n"
                          "N90 G1 X10000\n"
                          "N95 G20 L?99 K1\n"
                          "N99 G1 X5\n");
  ASSERT_TRUE(ran.finished) << static_cast<int>(ran.error) << " line " << ran.line;
  ASSERT_EQ(ran.objects.size(), 6U);
  EXPECT_EQ(xOf(ran, 3), 4);
  EXPECT_EQ(xOf(ran, 4), 1004);
  EXPECT_EQ(xOf(ran, 5), 11004);
}

TEST(NcProgram, JumpsThatNeverEndTakeOneSentenceACall) {
  Context setup;
  setup.most = 5000;
  const Ran ran = runText("N1 G1 X1 F1\nN2 G20 L1 K1\n", setup);
  EXPECT_FALSE(ran.finished);
  EXPECT_EQ(ran.error, Error::None);
  EXPECT_GT(ran.carried, 5000);
  EXPECT_EQ(runText("N1 G20 L5 K1\nN2 G1 X1\n").error, Error::UnknownJump);
}

TEST(NcProgram, CommentsOfBothKinds) {
  EXPECT_EQ(runText("N1 G1 (* a\n (b) X9 *) X1 // X5\nN2 X(1 + 2) F1 (**)\n").objects.size(), 2U);
  Context setup;
  setup.parentheses = true;
  const Ran ran = runText("N1 G1 (X5 ' $) X1 F1 // X7\nN2 X{1+2}(c)\n", setup);
  ASSERT_EQ(ran.objects.size(), 2U);
  EXPECT_EQ(xOf(ran, 1), 3);
  EXPECT_EQ(runText("N1 G1 X1 (open\n", setup).error, Error::UnexpectedEnd);
  EXPECT_EQ(runText("N1 G1 X1 (* open\n").error, Error::UnexpectedEnd);
}

TEST(NcProgram, SuppressesSentences) {
  Context setup;
  const std::string text = "N1 G1 X1 F1\n/N2 X2\n / N3 X3\n";
  EXPECT_EQ(runText(text, setup).objects.size(), 3U);
  setup.suppress = true;
  EXPECT_EQ(runText(text, setup).objects.size(), 1U);
}

TEST(NcProgram, CallsSubprograms) {
  Context setup;
  setup.files["cnc2"] = "% sub\nSUBPROGRAM CNC2{#RADIUS : LREAL}\n"
                        "N010 G91\n"
                        "N020 G02 X#RADIUS*2 Y0 R#RADIUS Z2.5 F100 E-100 E100\n"
                        "N030 G02 X-#RADIUS*2 Y0 R#RADIUS Z7.5\n"
                        "END_SUBPROGRAM\n\n// a comment is no text\n";
  const Ran ran = runText("N0 G01 X10 Y0 F50 E30 E-30\n"
                          "N10 G01 X0 Y5\n"
                          "N20 CNC2{25}\n"
                          "N30 G01 X0 Y-200\n",
                          setup);
  ASSERT_TRUE(ran.finished) << static_cast<int>(ran.error) << " line " << ran.line;
  ASSERT_EQ(ran.objects.size(), 5U);
  EXPECT_EQ(ran.objects[2].moveType, cnc::MoveType::Clockwise);
  EXPECT_EQ(xOf(ran, 2), 50);
  EXPECT_EQ(xOf(ran, 3), 0);
  EXPECT_EQ(ran.objects[3].end.coordinate[cnc::kAxisZ], 10);
  EXPECT_EQ(yOf(ran, 4), -195); // G91 stays
}

TEST(NcProgram, SubprogramsHaveTheirOwnVariablesAndReturn) {
  Context setup;
  setup.files["outer"] = "SUBPROGRAM Outer{#a : LREAL, #b : BOOL, #c : STRING}\n"
                         "LET #x : LREAL := #a * 10\n"
                         "N1 G1 X#x\n"
                         "N2 inner{#x, #c}\n"
                         "N3 G1 X#x + 1\n"
                         "N4 RETURN\n"
                         "N5 G1 X99999\n"
                         "END_SUBPROGRAM";
  setup.files["inner"] = "SUBPROGRAM INNER{#x : LREAL, #name : STRING}\n"
                         "LET #a : LREAL := 5\n"
                         "N1 G1 Y#x + #a Z SEL{#name = 'abc', 1, 2}\n"
                         "END_SUBPROGRAM";
  const Ran ran = runText("LET #a : LREAL := 1\n"
                          "LET #name : STRING := 'out'\n"
                          "N1 G1 X#a F5\n"
                          "N2 OUTER{#a + 1, TRUE, 'abc'}\n"
                          "N3 DYNCALL{concat{#name, 'er'}, 4, FALSE, ''}\n"
                          "N4 G1 X#a\n",
                          setup);
  ASSERT_TRUE(ran.finished) << static_cast<int>(ran.error) << " line " << ran.line;
  ASSERT_EQ(ran.objects.size(), 8U);
  EXPECT_EQ(xOf(ran, 1), 20);
  EXPECT_EQ(yOf(ran, 2), 25);
  EXPECT_EQ(ran.objects[2].end.coordinate[cnc::kAxisZ], 2);
  EXPECT_EQ(xOf(ran, 3), 21);
  EXPECT_EQ(xOf(ran, 4), 40);
  EXPECT_EQ(yOf(ran, 5), 45);
  EXPECT_EQ(ran.objects[5].end.coordinate[cnc::kAxisZ], 1);
  EXPECT_EQ(xOf(ran, 6), 41);
  EXPECT_EQ(xOf(ran, 7), 1);
}

TEST(NcProgram, NestsFourteenDeep) {
  Context setup;
  setup.files["deep"] = "SUBPROGRAM DEEP{#n : LREAL}\n"
                        "N1 G1 X#n\n"
                        "N2 G20 L9 K #n <= 1\n"
                        "N3 DEEP{#n - 1}\n"
                        "N9 G1 Y#n\n"
                        "END_SUBPROGRAM";
  const Ran good = runText("N1 G1 X0 F1\nN2 DEEP{14}\nN3 X5\n", setup);
  ASSERT_TRUE(good.finished) << static_cast<int>(good.error);
  EXPECT_EQ(good.objects.size(), 2U + 28U);
  EXPECT_EQ(yOf(good, 28), 14);
  EXPECT_EQ(runText("N1 G1 X0 F1\nN2 DEEP{15}\n", setup).error, Error::Nesting);
}

struct BadProgram {
  const char *text;
  const char *sub;
  Error error;
  int line;
  int column;
};

class NcBadProgram : public testing::TestWithParam<BadProgram> {};

TEST_P(NcBadProgram, IsRefusedWithItsPlace) {
  Context setup;
  setup.files["sub"] = GetParam().sub;
  const Ran ran = runText(GetParam().text, setup);
  EXPECT_FALSE(ran.finished);
  EXPECT_EQ(ran.error, GetParam().error);
  EXPECT_EQ(ran.line, GetParam().line);
  EXPECT_EQ(ran.column, GetParam().column);
}

constexpr const char *kCall = "G1 X1 F1\nN2 SUB{1}";
constexpr const char *kGood = "SUBPROGRAM sub{#a:LREAL}\nEND_SUBPROGRAM";

INSTANTIATE_TEST_SUITE_P(
    All, NcBadProgram,
    testing::Values(
        BadProgram{"LET #a : LREAL\nLET #A : BOOL", "", Error::Conflict, 1, 4},
        BadProgram{"LET #a : LREAL := TRUE", "", Error::InitialType, 0, 18},
        BadProgram{"LET #a : INT", "", Error::BadType, 0, 9},
        BadProgram{"LET #a", "", Error::Incomplete, 0, 6},
        BadProgram{"LET a : LREAL", "", Error::WrongToken, 0, 4},
        BadProgram{"N1 G1 X1\nLET #a : LREAL", "", Error::LateLet, 1, 0},
        BadProgram{"SUBPROGRAM Sub{}", "", Error::NotDeclaredHere, 0, 0},
        BadProgram{"END_SUBPROGRAM", "", Error::EndWithoutSubprogram, 0, 0},
        BadProgram{"G1 X1\nN5 RETURN", "", Error::ReturnInMain, 1, 3},
        BadProgram{"N5 AB{1}", "", Error::NameTooShort, 0, 3},
        BadProgram{"N5 SUB{1} X1", "", Error::WrongToken, 0, 10},
        BadProgram{"N5 SUB{1", "", Error::OpenBracket, 0, 6},
        BadProgram{"N1.5 G1 X1", "", Error::NumberRange, 0, 1},
        BadProgram{"N4294967296 G1 X1", "", Error::NumberRange, 0, 1},
        BadProgram{"N{1} G1 X1", "", Error::NumberLiteral, 0, 1},
        BadProgram{"N-1 G1 X1", "", Error::NumberLiteral, 0, 1},
        BadProgram{"LET #b : BOOL\nG36 O#b D1", "", Error::WriteType, 1, 0},
        BadProgram{"LET #b : LREAL\nG36 O#b D'a'", "", Error::WriteType, 1, 0},
        BadProgram{"LET #b : LREAL\nG20 L?#b", "", Error::WrongToken, 1, 6},
        BadProgram{"N5 DYNCALL{1}", "", Error::ArgumentType, 0, 3},
        BadProgram{"N5 DYNCALL{}", "", Error::TooFewArguments, 0, 3},
        BadProgram{"N5 DYNCALL{'a/../b'}", "", Error::WrongToken, 0, 0},
        BadProgram{"N2 SUB{}", kGood, Error::TooFewArguments, 0, 0},
        BadProgram{"N2 SUB{1, 2}", kGood, Error::TooManyArguments, 0, 0},
        BadProgram{"N2 SUB{TRUE}", kGood, Error::ArgumentType, 0, 0},
        BadProgram{kCall, "N1 G1 X1", Error::DeclarationFirst, 0, 0},
        BadProgram{kCall, "", Error::NotDeclaredHere, 0, 0},
        BadProgram{kCall, "SUBPROGRAM Other{#a:LREAL}\nEND_SUBPROGRAM", Error::NotDeclaredHere, 0,
                   11},
        BadProgram{kCall, "SUBPROGRAM sub{#a:LREAL, #A:BOOL}", Error::DuplicateParameter, 0, 25},
        BadProgram{kCall, "SUBPROGRAM sub{#a:LREAL}\nG1 X2", Error::EndMissing, 2, 0},
        BadProgram{kCall, "SUBPROGRAM sub{#a:LREAL}\nSUBPROGRAM t{}", Error::OneSubprogram, 1, 0},
        BadProgram{kCall, "SUBPROGRAM sub{#a:LREAL}\nEND_SUBPROGRAM\nG1", Error::TextAfterEnd, 2,
                   0},
        BadProgram{kCall, "SUBPROGRAM sub{#a:LREAL} RESTORE\nEND_SUBPROGRAM", Error::WrongToken, 0,
                   25}));

TEST(NcProgram, HasTwentyOneLocalsAndParameters) {
  std::string text;
  for (int i = 0; i < 21; ++i)
    text += "LET #v" + std::to_string(i) + " : STRING := 'x'\n";
  EXPECT_TRUE(runText(text + "N1 G1 X1 F1").finished);
  EXPECT_EQ(runText(text + "LET #more : LREAL\n").error, Error::TooManyLocals);
  std::string header = "SUBPROGRAM sub{#p0 : LREAL";
  for (int i = 1; i < 22; ++i)
    header += ", #p" + std::to_string(i) + " : LREAL";
  Context setup;
  setup.files["sub"] = header + "}\nEND_SUBPROGRAM";
  EXPECT_EQ(runText("N1 SUB{1}", setup).error, Error::TooManyParameters);
}

TEST(NcProgram, ErrorsOfSentencesHaveTheirPlace) {
  const Ran ran = runText("N1 G1 X1 F1\nN2 G1 X2 G2\n");
  EXPECT_FALSE(ran.finished);
  EXPECT_EQ(ran.sentence, cnc::GCodeError::TwoInstructions);
  EXPECT_EQ(ran.line, 1);
  EXPECT_EQ(ran.column, 3);
  ASSERT_EQ(ran.objects.size(), 0U); // the first one is held back
}

TEST(NcProgram, LinesThatAreTooLongAreRefused) {
  EXPECT_EQ(runText("G1 X1 " + std::string(3000, ' ') + "F1").error, Error::BufferTooSmall);
  EXPECT_TRUE(runText("G1 X1 F1 // " + std::string(3000, 'c') + "\n").finished);
  std::string words;
  for (int i = 0; i < 130; ++i)
    words += "F1";
  EXPECT_EQ(runText("G1 X1 " + words).error, Error::BufferTooSmall);
}

// A program with loops, expressions and subprograms, and what somebody would have written without.
struct Pair {
  std::string program;
  std::string expanded;
  std::map<std::string, std::string> files;
};

Pair makePair(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&random](int most) {
    return static_cast<int>(random() % static_cast<unsigned>(most));
  };
  Pair pair;
  pair.program = "LET #i : LREAL\nN1 G91\nN2 F100 E500 E-300\n";
  pair.expanded = "N1 G91\nN2 F100 E500 E-300\n";
  pair.files["leg"] = "SUBPROGRAM Leg{#x : LREAL, #y : LREAL, #arc : BOOL}\n"
                      "LET #r : LREAL := #x * 2\n"
                      "N1 G20 L30 K #arc\n"
                      "N10 G1 X#x Y-#y*2\n"
                      "N20 RETURN\n"
                      "N30 G2 X#r Y0 R#r\n"
                      "END_SUBPROGRAM\n";
  const auto line = [](const char *format, auto... values) {
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    return std::string(text);
  };
  for (int block = 1; block <= 12; ++block) {
    const double x = 1 + below(40) / 4.0;
    const double y = below(40) / 4.0 - 5;
    const int number = block * 100;
    switch (below(3)) {
    case 0:
      pair.program += line("N%d G1 X{%g + %g} Y-%g * -2 / 2 (* %d *)\n", number, x, y, y, block);
      pair.expanded += line("N%d G1 X%.17g Y%.17g\n", number, x + y, y);
      break;
    case 1: {
      const bool arc = below(2) == 0;
      pair.program += line("N%d LEG{%g, %g, %s}\n", number, x, y, arc ? "1 < 2" : "NOT TRUE");
      pair.expanded +=
          arc ? line("G2 X%.17g Y0 R%.17g\n", x * 2, x * 2) : line("G1 X%.17g Y%.17g\n", x, -y * 2);
      break;
    }
    default: {
      const int times = 1 + below(5);
      pair.program += line("N%d G36 O#i D0\nN%d G36 O#i D#i + 1\nN%d G1 X#i * %g Y%g\n"
                           "N%d G20 L%d K #i < %d\n",
                           number, number + 1, number + 2, x, y, number + 3, number + 1, times);
      for (int i = 1; i <= times; ++i)
        pair.expanded += line("N%d G1 X%.17g Y%.17g\n", number + 2, i * x, y);
    }
    }
  }
  return pair;
}

/// Objects without the numbers that tell where they come from.
std::vector<cnc::PathObject> bare(std::vector<cnc::PathObject> objects) {
  for (cnc::PathObject &object : objects)
    object.sourceLine = object.sentence = 0;
  return objects;
}

bool sameObjects(const std::vector<cnc::PathObject> &a, const std::vector<cnc::PathObject> &b) {
  if (a.size() != b.size())
    return false;
  for (size_t i = 0; i < a.size(); ++i)
    if (!std::ranges::equal(a[i].end.coordinate, b[i].end.coordinate) ||
        !std::ranges::equal(a[i].start.coordinate, b[i].start.coordinate) ||
        !std::ranges::equal(a[i].shape, b[i].shape) || a[i].moveType != b[i].moveType ||
        a[i].velocity != b[i].velocity || a[i].acceleration != b[i].acceleration ||
        a[i].length != b[i].length || a[i].marks != b[i].marks || a[i].number != b[i].number)
      return false;
  return true;
}

TEST(NcProgram, IsWhatItsExpansionIs) {
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const Pair pair = makePair(seed);
    Context setup;
    setup.files = pair.files;
    const Ran wanted = runText(pair.expanded);
    ASSERT_TRUE(wanted.finished) << seed << "\n" << pair.expanded;
    const Ran ran = runText(pair.program, setup);
    ASSERT_TRUE(ran.finished) << seed << " line " << ran.line << "\n" << pair.program;
    ASSERT_TRUE(sameObjects(bare(ran.objects), bare(wanted.objects))) << seed << "\n"
                                                                      << pair.program;
    setup.piece = 1 + seed % 17;
    setup.sentences = 1 + static_cast<int>(seed % 3);
    const Ran pieces = runText(pair.program, setup);
    ASSERT_TRUE(pieces.finished) << seed;
    ASSERT_TRUE(sameObjects(pieces.objects, ran.objects)) << seed;
  }
}

TEST(NcProgram, LongProgramsJumpBackThoughTheQueueForgets) {
  std::string text = "LET #i : LREAL\nN1 G91\nN2 G36 O#i D#i + 1\n";
  for (int i = 0; i < 3000; ++i)
    text += "G1 X0.5 Y#i F100\r\n";
  text += "N9 G20 L2 K #i < 3\n";
  Context setup;
  setup.piece = 333;
  setup.sentences = 4;
  const Ran ran = runText(text, setup);
  ASSERT_TRUE(ran.finished) << static_cast<int>(ran.error);
  EXPECT_EQ(ran.objects.size(), 9000U);
  EXPECT_EQ(xOf(ran, 8999), 4500);
  EXPECT_EQ(yOf(ran, 8999), 18000);
}

} // namespace
} // namespace stride::nc::test
