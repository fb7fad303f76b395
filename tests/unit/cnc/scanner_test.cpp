// Words of texts.
#include "tests/unit/cnc/gcode_text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

using namespace stride::cnc;
using namespace stride::cnc::test;

namespace {

/// Words as `X1.5`, the ends of sentences as `;line`.
std::string shown(const Scanned &scanned) {
  std::string text;
  for (size_t i = 0; i < scanned.words.size(); ++i) {
    const GCodeWord &word = scanned.words[i];
    if (!text.empty())
      text += ' ';
    if (word.letter == kEndOfSentence) {
      text += ";" + std::to_string(word.integer);
      continue;
    }
    char letters[kMostLetters];
    text.append(letters, static_cast<size_t>(lettersOf(word.letter, letters)));
    if (word.letter == kSkip)
      continue;
    char number[32];
    std::snprintf(number, sizeof number, "%.17g", word.value);
    text += scanned.variables[i].empty() ? number : "$" + scanned.variables[i] + "$";
  }
  return text;
}

std::string words(std::string_view text) { return shown(scanText(text)); }

std::vector<std::pair<GCodeError, int64_t>> errors(std::string_view text) {
  return scanText(text).errors;
}

} // namespace

TEST(Scanner, WordsLettersAndNumbers) {
  EXPECT_EQ(words("N010 g01 x-1.5\ty+.25 Z3. E-200 E0100"), "N10 G1 X-1.5 Y0.25 Z3 E-200 E100 ;1");
  EXPECT_EQ(words("G1X10Y-20E5"), "G1 X10 Y-20 E5 ;1");
  EXPECT_EQ(words("X 7 Y\t-8"), "X7 Y-8 ;1");
  EXPECT_EQ(words("ff100 EF-3 fz2 EP10 ew-4 pa360 PW5 probe 2"),
            "FF100 EF-3 FZ2 EP10 EW-4 PA360 PW5 PROBE2 ;1");
  EXPECT_EQ(words("X0.1 Y123456.789012 Z9007199254740993 A0.12345678901234567890123"),
            "X0.10000000000000001 Y123456.78901199999 Z9007199254740992 A0.12345678901234568 ;1");
}

TEST(Scanner, VariablesKeepTheirNames) {
  EXPECT_EQ(words("N0 G$g_byCommand$ X $GVL.aPlace[2, 3].r$"),
            "N0 G$g_byCommand$ X$GVL.aPlace[2, 3].r$ ;1");
}

TEST(Scanner, LinesOfAllKindsAndComments) {
  const Scanned scanned = scanText("\xEF\xBB\xBF%\t the name \r\n"
                                   "(all of it)\r\n"
                                   "\r\n"
                                   "/N1 (in (between) G1 // X7\r"
                                   "G2 X1\n"
                                   " / G3");
  EXPECT_EQ(scanned.name, "the name");
  EXPECT_TRUE(scanned.errors.empty());
  EXPECT_EQ(shown(scanned), "/ N1 G1 ;4 G2 X1 ;5 / G3 ;6");
}

TEST(Scanner, TheSecondPercentEndsTheProgram) {
  EXPECT_EQ(words("%\nG1\n%\n$%&! G2\n"), "G1 ;2");
  EXPECT_EQ(words("G1\n%\nG2\n"), "G1 ;1");
}

TEST(Scanner, ErrorsWithTheirPlace) {
  using testing::ElementsAre;
  using testing::Pair;
  EXPECT_THAT(errors("G1 XY5"), ElementsAre(Pair(GCodeError::UnknownWord, 3)));
  EXPECT_THAT(errors("G1 X\nG1 X Y5"),
              ElementsAre(Pair(GCodeError::MissingValue, 3), Pair(GCodeError::MissingValue, 8)));
  EXPECT_THAT(errors("G1.5 X1\nX-"),
              ElementsAre(Pair(GCodeError::NotWhole, 0), Pair(GCodeError::BadNumber, 8)));
  EXPECT_THAT(errors("X1.2.3\nX1-2\nX+.\n"),
              ElementsAre(Pair(GCodeError::BadNumber, 0), Pair(GCodeError::BadNumber, 7),
                          Pair(GCodeError::BadNumber, 12)));
  EXPECT_THAT(errors("G1 ; X\nG1 \x80\n12"),
              ElementsAre(Pair(GCodeError::UnexpectedCharacter, 3),
                          Pair(GCodeError::UnexpectedCharacter, 10),
                          Pair(GCodeError::UnexpectedCharacter, 12)));
  EXPECT_THAT(errors("G1 (open\nG1 X$open\nX$$"),
              ElementsAre(Pair(GCodeError::UnclosedComment, 3),
                          Pair(GCodeError::UnclosedVariable, 12),
                          Pair(GCodeError::BadVariable, 19)));
  EXPECT_THAT(errors("G1 / X1\nPZ1 FX1 QQ1\n/"),
              ElementsAre(Pair(GCodeError::UnexpectedCharacter, 3),
                          Pair(GCodeError::UnknownWord, 8),
                          Pair(GCodeError::UnexpectedCharacter, 21)));
  EXPECT_THAT(errors("X" + std::string(kMostDigits, '1')), ElementsAre());
  EXPECT_THAT(errors("X" + std::string(kMostDigits + 1, '1')),
              ElementsAre(Pair(GCodeError::BadNumber, 0)));
  EXPECT_THAT(errors("X$" + std::string(kMostName, 'a') + "$"), ElementsAre());
  EXPECT_THAT(errors("X$" + std::string(kMostName + 1, 'a') + "$"),
              ElementsAre(Pair(GCodeError::BadVariable, 0)));
}

/// As other programs write small numbers: two words of a path would be made of each.
TEST(Scanner, RefusesExponents) {
  using testing::ElementsAre;
  using testing::Pair;
  for (const char *text : {"G1 X1e-05", "G1 X1E-05", "g1 x1e+00", "G1 X2e-012", "G1 X1.5e-16",
                           "g1 x1.2246467991e-16", "G1 X1.2246467991E+16", "G1 X-.5E-07Y1"}) {
    const size_t at = std::string(text).find_first_of("eE");
    EXPECT_THAT(errors(text), ElementsAre(Pair(GCodeError::Exponent, at))) << text;
  }
  EXPECT_THAT(errors("G1 X1e-05\nY2e-05 Z7"),
              ElementsAre(Pair(GCodeError::Exponent, 5), Pair(GCodeError::Exponent, 12)));
  // Words E, also without blanks between words, and after another number than that of the line.
  for (const char *text :
       {"G1 X1 E-05", "G1X10E100E-100", "g1x10e-10", "G1X1.2E-10", "G1X1E-5", "G1X1E05",
        "G1X1E-0500", "G1X1E-05.5", "X12345678901\nE-10", "X$a$E-05", "G1 X1.23456789 e-12",
        "G1(X1)E-05", "g1 x1.234567891E100", "G1X10EZ-050", "G1X10EF-05", "g1 x-1.123456789e-10"})
    EXPECT_TRUE(errors(text).empty()) << text;
}

TEST(Scanner, EveryWordHasLettersOfItsOwn) {
  int known = 0;
  for (int code = 0; code < 256; ++code) {
    if (!isWord(static_cast<uint8_t>(code)))
      continue;
    ++known;
    char letters[kMostLetters];
    const int32_t count = lettersOf(static_cast<uint8_t>(code), letters);
    EXPECT_EQ(codeOf(letters, count), code);
  }
  EXPECT_EQ(known, 26 + 9 + 9 + 8 + 3);
}

TEST(Words, VariablesOfAllTypes) {
  int8_t sint = -128;
  uint16_t word = 0;
  double lreal = 0;
  const auto store = [](void *address, VariableType type, double value) {
    GCodeWord target{};
    target.address = static_cast<uint8_t *>(address);
    target.variables = static_cast<uint8_t>(type);
    EXPECT_TRUE(assignTo(target, value));
    return valueOf(target);
  };
  EXPECT_EQ(store(&sint, VariableType::Sint, -2.5), -3);
  EXPECT_EQ(store(&sint, VariableType::Sint, 127.6), 127);
  EXPECT_EQ(store(&sint, VariableType::Sint, -1e300), -128);
  EXPECT_EQ(store(&word, VariableType::Uint, 65535.4), 65535);
  EXPECT_EQ(store(&word, VariableType::Word, -1), 0);
  EXPECT_EQ(store(&lreal, VariableType::Lreal, 0.1), 0.1);
  int32_t dint = 0;
  EXPECT_EQ(store(&dint, VariableType::Dint, 2147483647.0), 2147483647);
  uint32_t dword = 0;
  EXPECT_EQ(store(&dword, VariableType::Dword, 4294967296.0), 4294967295.0);
  EXPECT_FALSE(assignTo(GCodeWord{}, 1));
}
