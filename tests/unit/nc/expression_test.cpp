#include "tests/unit/nc/nc_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace stride::nc::test {
namespace {

TEST(NcExpression, BindsAsTheTableOfOperatorsSays) {
  EXPECT_EQ(valueOfText("2 + 3 * 4"), 14);
  EXPECT_EQ(valueOfText("20 - 5 - 3"), 12);
  EXPECT_EQ(valueOfText("7 * 10 MOD 4"), 14); // MOD binds more than *
  EXPECT_EQ(valueOfText("100 / 10 / 5"), 2);
  EXPECT_EQ(valueOfText("{1 + 2) * 3"), 9); // the brackets are of one kind
  EXPECT_EQ(valueOfText("-2 * -3"), 6);
  EXPECT_EQ(valueOfText("-7.5 MOD 2"), -1.5);
  EXPECT_EQ(valueOfText("SEL{1 + 1 = 2 AND 3 < 2 OR TRUE, 5, 6}"), 6);
  EXPECT_EQ(valueOfText("SEL{TRUE OR TRUE XOR TRUE, 5, 6}"), 6); // XOR binds more than OR
  EXPECT_EQ(valueOfText("SEL{FALSE AND TRUE XOR TRUE, 5, 6}"), 6);
  EXPECT_EQ(valueOfText("SEL{NOT FALSE AND FALSE, 5, 6}"), 5);
  EXPECT_EQ(valueOfText("SEL{'ab' = 'ab', 5, 6}"), 6);
  EXPECT_EQ(valueOfText("SEL{concat{'a', 'b'} <> 'ab', 5, 6}"), 5);
}

TEST(NcExpression, FunctionsOfOneArgumentNeedNoBrackets) {
  EXPECT_DOUBLE_EQ(valueOfText("sin 3 + 1"), std::sin(3.0) + 1);
  EXPECT_DOUBLE_EQ(valueOfText("sin{pi / 6} * 2"), std::sin(M_PI / 6) * 2);
  EXPECT_EQ(valueOfText("abs -2"), 2);
  EXPECT_EQ(valueOfText("abs{-2} * 3"), 6);
  EXPECT_EQ(valueOfText("expt{2, 10}"), 1024);
  EXPECT_EQ(valueOfText("SQRT 16 + LOG 100 + TRUNC -2.7"), 4);
  EXPECT_EQ(valueOfText("MIN{3, 2} + MAX(3, 2)"), 5);
}

TEST(NcExpression, EndsWhereTheNextWordBegins) {
  const Ran ran = runText("N1 G1X10Y5 Z3+4 A-2 MOD 3F100\nN2 X sin 0Y.5 Z5.\n");
  ASSERT_EQ(ran.objects.size(), 2U);
  EXPECT_EQ(ran.objects[0].end.coordinate[cnc::kAxisX], 10);
  EXPECT_EQ(ran.objects[0].end.coordinate[cnc::kAxisY], 5);
  EXPECT_EQ(ran.objects[0].end.coordinate[cnc::kAxisZ], 7);
  EXPECT_EQ(ran.objects[0].end.coordinate[cnc::kAxisA], -2);
  EXPECT_EQ(ran.objects[0].velocity, 100);
  EXPECT_EQ(ran.objects[1].end.coordinate[cnc::kAxisX], 0);
  EXPECT_EQ(ran.objects[1].end.coordinate[cnc::kAxisY], 0.5);
  EXPECT_EQ(ran.objects[1].end.coordinate[cnc::kAxisZ], 5);
}

struct Bad {
  const char *text;
  Error error;
  int column;
};

class NcBadExpression : public testing::TestWithParam<Bad> {};

TEST_P(NcBadExpression, IsRefusedWithItsPlace) {
  const Ran ran = runText(std::string("N1 G1 X1 F10\n") + GetParam().text + "\nN3 X3\n");
  EXPECT_FALSE(ran.finished);
  EXPECT_EQ(ran.error, GetParam().error);
  EXPECT_EQ(ran.line, 1);
  EXPECT_EQ(ran.column, GetParam().column);
}

INSTANTIATE_TEST_SUITE_P(
    All, NcBadExpression,
    testing::Values(
        Bad{"X{1 + 2", Error::OpenBracket, 1}, Bad{"X 1 + 2}", Error::AddressExpected, 7},
        Bad{"X 1 +", Error::TermExpected, 5}, Bad{"X * 2", Error::TermExpected, 2},
        Bad{"X{1 2}", Error::SurplusTerms, 4}, Bad{"X foo{2}", Error::UnknownPrefix, 2},
        Bad{"X expt{2}", Error::TooFewArguments, 8},
        Bad{"X expt{2, 3, 4}", Error::TooManyArguments, 11},
        Bad{"X sin 'a'", Error::ArgumentType, 6}, Bad{"X 1 + 'a'", Error::ArgumentType, 4},
        Bad{"X TRUE", Error::BadType, 2}, Bad{"X #none", Error::NoLocal, 2},
        Bad{"X $none$", Error::NoVariable, 2}, Bad{"X $none", Error::UnexpectedEnd, 7},
        Bad{"X 1..2", Error::BadNumber, 2}, Bad{"X1e-05", Error::BadNumber, 1},
        Bad{"X{2 * 1E+02}", Error::BadNumber, 6}, Bad{"X1e-12", Error::BadNumber, 1},
        Bad{"X -1.22464679e-16", Error::BadNumber, 3}, Bad{"X 1 = 1", Error::BadType, 2},
        Bad{"X 1 / 0", Error::DivisionByZero, 0}, Bad{"X 1 MOD 0", Error::DivisionByZero, 0},
        Bad{"X ln -1", Error::NotANumber, 0}, Bad{"X expt{10, 400}", Error::NotANumber, 0},
        Bad{"X ?", Error::TermExpected, 2}, Bad{"X ~", Error::UnknownToken, 2},
        Bad{"SEL{1}", Error::ReservedWord, 0}, Bad{"X", Error::MissingValue, 1},
        Bad{"XY5", Error::UnknownWord, 0}, Bad{"G1 5", Error::AddressExpected, 3}));

/// A word E may stand right after a number.
TEST(NcExpression, TellsWordsFromExponents) {
  for (const char *text :
       {"N1 G1 X1E-50 F10", "n1 g1 x1e-50 f10", "N1 G1 X1 e-05 F10", "N1 G1 X1E-5F10",
        "N1 G1 X1E100E-100 F10", "n1 g1 x-1.123456789e-10 f10"})
    EXPECT_TRUE(runText(text).finished) << text;
  for (const char *text :
       {"N1 G1 X1e-05", "N1 G1 X-1e-05", "n1 g1 x1e-05", "n1 g1 x1.1234567891e-10"})
    EXPECT_FALSE(runText(text).finished) << text;
}

TEST(NcExpression, RefusesBracketsThatAreTooDeep) {
  const std::string deep(60, '{');
  EXPECT_EQ(runText("G1 X" + deep + "1" + std::string(60, '}')).error, Error::TooDeep);
  EXPECT_EQ(valueOfText(std::string(30, '{') + "7" + std::string(30, '}')), 7);
}

TEST(NcExpression, HoldsAHundredValuesAtOnce) {
  // A sum from the right needs a place on the stack for each of its terms.
  const auto nested = [](int terms) {
    std::string text = "1";
    for (int i = 1; i < terms; ++i)
      text = "MAX{1, " + text + "}";
    return text;
  };
  EXPECT_EQ(valueOfText(nested(30)), 1);
  std::string texts = "'" + std::string(200, 'a') + "'";
  std::string sum = texts;
  for (int i = 0; i < 25; ++i)
    sum = "SEL{FALSE, " + sum + ", 'b'}";
  EXPECT_EQ(runText("LET #s : STRING\nG36 O#s D " + sum).error, Error::None);
}

// A second evaluator, over trees: it knows nothing of tokens or instructions.
struct Tree {
  enum class Kind : uint8_t { Number, Bool, Binary, Unary, Call2, Choose };
  Kind kind = Kind::Number;
  bool isBool = false;
  double number = 0;
  std::string name;
  std::vector<Tree> parts;
};

int bindingOf(const std::string &name) {
  static const std::map<std::string, int> kTable = {
      {"MOD", 14}, {"*", 13}, {"/", 13},  {"+", 12},  {"-", 12},  {"=", 10},  {"<>", 10},
      {">", 10},   {"<", 10}, {">=", 10}, {"<=", 10}, {"AND", 6}, {"XOR", 5}, {"OR", 4}};
  return kTable.at(name);
}

class Maker {
public:
  explicit Maker(unsigned seed) : random_(seed) {}

  int below(int most) { return static_cast<int>(random_() % static_cast<unsigned>(most)); }

  Tree real(int depth) {
    Tree tree;
    const int choice = depth == 0 ? 0 : below(8);
    if (choice < 2) {
      tree.number = below(2000) / 8.0;
      return tree;
    }
    if (choice < 6) {
      static const char *const kNames[] = {"+", "-", "*", "/", "MOD"};
      tree = {Tree::Kind::Binary, false, 0, kNames[below(5)], {real(depth - 1), real(depth - 1)}};
    } else if (choice == 6) {
      static const char *const kNames[] = {"-", "abs", "sin"};
      tree = {Tree::Kind::Unary, false, 0, kNames[below(3)], {real(depth - 1)}};
    } else {
      tree = {Tree::Kind::Choose,
              false,
              0,
              "SEL",
              {truth(depth - 1), real(depth - 1), real(depth - 1)}};
    }
    return tree;
  }

  Tree truth(int depth) {
    if (depth == 0 || below(6) == 0)
      return {Tree::Kind::Bool, true, static_cast<double>(below(2)), "", {}};
    if (below(5) == 0)
      return {Tree::Kind::Unary, true, 0, "NOT", {truth(depth - 1)}};
    if (below(2) == 0) {
      static const char *const kNames[] = {"AND", "OR", "XOR", "=", "<>"};
      return {Tree::Kind::Binary, true, 0, kNames[below(5)], {truth(depth - 1), truth(depth - 1)}};
    }
    static const char *const kNames[] = {"=", "<>", "<", ">", "<=", ">="};
    return {Tree::Kind::Binary, true, 0, kNames[below(6)], {real(depth - 1), real(depth - 1)}};
  }

  /// As a text, with as few brackets as it needs, and some more.
  std::string text(const Tree &tree, int least = 0) {
    switch (tree.kind) {
    case Tree::Kind::Number: {
      char digits[40];
      std::snprintf(digits, sizeof digits, "%.3f", tree.number);
      return digits;
    }
    case Tree::Kind::Bool:
      return tree.number != 0 ? "TRUE" : "false";
    case Tree::Kind::Binary: {
      const int binding = bindingOf(tree.name);
      const std::string gap = below(2) == 0 || std::isalpha(tree.name[0]) ? " " : "";
      const std::string inner =
          text(tree.parts[0], binding) + gap + tree.name + gap + text(tree.parts[1], binding + 1);
      return binding < least || below(8) == 0 ? "{" + inner + ")" : inner;
    }
    case Tree::Kind::Unary: {
      const bool simple =
          tree.parts[0].kind == Tree::Kind::Number || tree.parts[0].kind == Tree::Kind::Bool;
      return tree.name + (simple && below(2) == 0 ? " " + text(tree.parts[0])
                                                  : "{" + text(tree.parts[0]) + "}");
    }
    default:
      return tree.name + "(" + text(tree.parts[0]) + ", " + text(tree.parts[1]) + "," +
             text(tree.parts[2]) + "}";
    }
  }

private:
  std::mt19937 random_;
};

double valueOf(const Tree &tree, bool &bad) {
  std::vector<double> parts;
  parts.reserve(tree.parts.size());
  for (const Tree &part : tree.parts)
    parts.push_back(valueOf(part, bad));
  const std::string &n = tree.name;
  double result = tree.number;
  if (tree.kind == Tree::Kind::Unary)
    result = n == "-"     ? -parts[0]
             : n == "abs" ? std::fabs(parts[0])
             : n == "sin" ? std::sin(parts[0])
                          : parts[0] == 0;
  if (tree.kind == Tree::Kind::Choose)
    result = parts[0] != 0 ? parts[2] : parts[1];
  if (tree.kind == Tree::Kind::Binary) {
    const double a = parts[0];
    const double b = parts[1];
    bad = bad || ((n == "/" || n == "MOD") && b == 0);
    result = n == "+"     ? a + b
             : n == "-"   ? a - b
             : n == "*"   ? a * b
             : n == "/"   ? a / b
             : n == "MOD" ? std::fmod(a, b)
             : n == "AND" ? a != 0 && b != 0
             : n == "OR"  ? a != 0 || b != 0
             : n == "XOR" ? (a != 0) != (b != 0)
             : n == "="   ? a == b
             : n == "<>"  ? a != b
             : n == "<"   ? a < b
             : n == ">"   ? a > b
             : n == "<="  ? a <= b
                          : a >= b;
  }
  bad = bad || !std::isfinite(result);
  return result;
}

bool usesSine(const Tree &tree) {
  return tree.name == "sin" || std::any_of(tree.parts.begin(), tree.parts.end(),
                                           [](const Tree &t) { return usesSine(t); });
}

TEST(NcExpression, RandomOnesHaveTheValueOfTheirTree) {
  int compared = 0;
  for (unsigned seed = 1; seed <= 1500; ++seed) {
    Maker maker(seed);
    const Tree tree = maker.real(1 + maker.below(5));
    bool bad = false;
    const double wanted = valueOf(tree, bad);
    const std::string text = maker.text(tree);
    if (text.size() > 1900)
      continue;
    const Ran ran = runText("G1 X " + text + " F1 Y99");
    if (bad) {
      EXPECT_FALSE(ran.finished) << text;
      continue;
    }
    ASSERT_TRUE(ran.finished) << seed << ": " << text << " " << static_cast<int>(ran.error);
    const double value = ran.objects.at(0).end.coordinate[cnc::kAxisX];
    // The last bit of a sine is the C library's own.
    if (usesSine(tree))
      continue;
    ASSERT_EQ(value, wanted) << seed << ": " << text;
    ++compared;
  }
  EXPECT_GT(compared, 700);
}

} // namespace
} // namespace stride::nc::test
