// How many iterations a loop takes from the cycle's budget: as many as it makes, whatever kind of
// loop it is and whatever it is made of in C++.
#include "tests/unit/codegen/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <ostream>
#include <string>

namespace stc::test {
namespace {

/// A loop; Count() counts its rounds, and is called so that nobody knows how long a round takes.
struct Loop {
  const char *name;
  const char *text;
  int rounds; ///< How often Count() is called.
  int taken;  ///< From the budget. A loop that is left early has not completed its last round.
  /// With one less it is ended. Of loops in loops the rounds of the outer one are taken last; those
  /// of a caller when the call ends, so that both need not fit.
  int needed;
  int atOnce = 0; ///< The same in a function block, whose loops may take all rounds at once before
                  ///< the first.
};

/// Bounds that are no constants are `last` = 200 and `stride` = 7.
constexpr Loop kLoops[] = {
    {"OneByOne", "FOR i := 1 TO 600 DO Count(); END_FOR", 600, 600, 600},
    {"FromNegative", "FOR i := -3 TO 3 DO Count(); END_FOR", 7, 7, 7},
    {"Step", "FOR i := 3 TO 1000 BY 7 DO Count(); END_FOR", 143, 143, 143},
    {"StepThatFits", "FOR i := 3 TO 997 BY 7 DO Count(); END_FOR", 143, 143, 143},
    {"StepJustBelow", "FOR i := 3 TO 996 BY 7 DO Count(); END_FOR", 142, 142, 142},
    {"Down", "FOR i := 1000 TO -5 BY -3 DO Count(); END_FOR", 336, 336, 336},
    {"DownJustAbove", "FOR i := 1000 TO -4 BY -3 DO Count(); END_FOR", 335, 335, 335},
    {"Never", "FOR i := 5 TO 4 DO Count(); END_FOR", 0, 0, 0},
    {"FarFromEver", "FOR i := 500 TO 4 DO Count(); END_FOR", 0, 0, 0},
    {"Once", "FOR i := 5 TO 5 DO Count(); END_FOR", 1, 1, 1},
    {"EndOfItsType", "FOR u := 250 TO 255 DO Count(); END_FOR", 6, 6, 6},
    {"VariableEnd", "FOR i := 1 TO last DO Count(); END_FOR", 200, 200, 200},
    {"VariableStep", "FOR i := 1 TO last BY stride DO Count(); END_FOR", 29, 29, 29},
    {"VariableStepDown", "FOR i := last TO 1 BY -stride DO Count(); END_FOR", 29, 29, 29},
    {"ChangedInside", "FOR i := 1 TO 100 DO Count(); i := i + 1; END_FOR", 50, 50, 50},
    {"Exit", "FOR i := 1 TO 600 DO Count(); IF i = 250 THEN EXIT; END_IF END_FOR", 250, 249, 250},
    {"ExitOfVariable", "FOR i := 1 TO last DO Count(); IF i = 20 THEN EXIT; END_IF END_FOR", 20, 19,
     20},
    {"Continue", "FOR i := 1 TO 60 DO IF i MOD 4 = 0 THEN CONTINUE; END_IF Count(); END_FOR", 45,
     60, 60},
    {"While", "i := 0; WHILE i < 40 DO Count(); i := i + 1; END_WHILE", 40, 41, 41},
    {"Repeat", "i := 0; REPEAT Count(); i := i + 1; UNTIL i >= 40 END_REPEAT", 40, 40, 40},
    {"Nested", "FOR i := 1 TO last BY 10 DO FOR k := 1 TO last BY 40 DO Count(); END_FOR END_FOR",
     100, 120, 119, 120},
    {"FewBits", "FOR i := last TO -3 BY -7 DO Count(); END_FOR", 30, 30, 30},
    {"FewBitsThatFit", "FOR i := last TO 4 BY -7 DO Count(); END_FOR", 29, 29, 29},
    {"FewBitsJustAbove", "FOR i := last TO 5 BY -7 DO Count(); END_FOR", 28, 28, 28},
    {"FewBitsUp", "FOR i := 4 TO last BY 7 DO Count(); END_FOR", 29, 29, 29},
    {"FewBitsJustBelow", "FOR i := 5 TO last BY 7 DO Count(); END_FOR", 28, 28, 28},
    {"FewBitsNever", "FOR i := last TO 4 DO Count(); END_FOR", 0, 0, 0},
    {"FewBitsOnce", "FOR i := last TO last DO Count(); END_FOR", 1, 1, 1},
    {"FewBitsToTheEnd", "FOR u := 250 TO INT_TO_USINT(last + 55) DO Count(); END_FOR", 6, 6, 6},
    {"FewBitsToZero", "FOR u := 5 TO INT_TO_USINT(last - 200) BY -1 DO Count(); END_FOR", 6, 6, 6},
    {"WhileThatIsShort", "i := 0; WHILE i < 40 DO counted := counted + 1; i := i + 1; END_WHILE",
     40, 0, 0},
    {"WhileOfSteps", "i := 0; WHILE i < 40 DO counted := counted + 1; i := i + last; END_WHILE", 1,
     2, 2},
    {"WhileOfStepsFromZero",
     "FOR k := 0 TO 1 DO i := 0; WHILE i < 40 AND counted < 50 DO counted := counted + 1; "
     "i := i + k; END_WHILE END_FOR",
     50, 54, 54},
    {"WhileThatMayStay",
     "i := 0; WHILE i < 40 DO counted := counted + 1; IF counted < 10 THEN CONTINUE; END_IF "
     "i := i + 1; END_WHILE",
     49, 50, 50},
    {"WhileDoubling", "i := 1; WHILE i <= 100 DO counted := counted + 1; i := i * 2; END_WHILE", 7,
     0, 0},
    {"WhileHalving", "i := 100; WHILE i >= 1 DO counted := counted + 1; i := i / 2; END_WHILE", 7,
     0, 0},
    {"WhileHalvingZero",
     "i := 100; WHILE i >= 0 AND counted < 20 DO counted := counted + 1; i := i / 2; END_WHILE", 20,
     21, 21},
    {"WhileJustShort",
     "i := 1; WHILE i <= 2048 DO k := 1; WHILE k <= 1024 AND counted < 5 DO "
     "counted := counted + 1; k := k + 1; END_WHILE i := i + 1; END_WHILE",
     5, 0, 0},
    {"WhileJustTooLong",
     "i := 1; WHILE i <= 2049 DO k := 1; WHILE k <= 1024 AND counted < 5 DO "
     "counted := counted + 1; k := k + 1; END_WHILE i := i + 1; END_WHILE",
     5, 2054, 2054},
    {"ForInAShortWhile",
     "i := 1; WHILE i <= 8 DO FOR k := i TO i + 3 DO counted := counted + 1; END_FOR i := i * 2; "
     "END_WHILE",
     16, 0, 0},
    {"NestedConstant", "FOR i := 1 TO 6 DO FOR k := 1 TO 25 DO Count(); END_FOR END_FOR", 150, 156,
     155, 156},
    {"InACall", "FOR i := 1 TO 10 DO Inner(); END_FOR", 300, 310, 300},
    {"OneAfterTheOther",
     "FOR i := 1 TO 30 DO Count(); END_FOR FOR i := 1 TO last DO Count(); END_FOR", 230, 230, 230},
};
constexpr int kAll = sizeof kLoops / sizeof kLoops[0];

/// Each loop three times: in a function and in a block, where nobody knows how long Count() takes,
/// and in a block with a block instead, whose rounds may be taken all at once.
constexpr const char *kWhere[] = {" of a function", " of a block",
                                  " of a block that calls a block"};

std::string withBlock(std::string text) {
  for (size_t at = 0; (at = text.find("Count()", at)) != std::string::npos;)
    text.replace(at, 7, "c()");
  return text;
}

std::string program() {
  std::string text = R"(
VAR_GLOBAL counted : DINT; last : INT := 200; stride : INT := 7; END_VAR
FUNCTION Count : DINT
  counted := counted + 1;
END_FUNCTION
FUNCTION Inner : DINT
VAR k : INT; END_VAR
  FOR k := 1 TO 30 DO Count(); END_FOR
END_FUNCTION
FUNCTION_BLOCK Counter
  counted := counted + 1;
END_FUNCTION_BLOCK
)";
  std::string instances;
  std::string cases;
  for (int n = 0; n < 3 * kAll; ++n) {
    const std::string body = kLoops[n % kAll].text;
    const std::string number = std::to_string(n);
    const std::string variables = "\nVAR i : INT; k : INT; u : USINT; c : Counter; END_VAR\n  ";
    if (n < kAll) {
      text += "FUNCTION Loop" + number + " : DINT" + variables + body + "\nEND_FUNCTION\n";
    } else {
      text += "FUNCTION_BLOCK Block" + number + variables +
              (n < 2 * kAll ? body : withBlock(body)) + "\nEND_FUNCTION_BLOCK\n";
      instances += "Loop" + number + " : Block" + number + "; ";
    }
    cases += "    " + number + ": Loop" + number + "();\n";
  }
  return text + "PROGRAM Main\nVAR mode : INT; " + instances +
         "END_VAR\n  counted := 0;\n  CASE mode OF\n" + cases + "  END_CASE\nEND_PROGRAM\n";
}

class LoopBudget : public ::testing::Test {
protected:
  LoopBudget() : app_(program()) {}

  void run(int loop, int64_t budget, int64_t more = 0, int times = 0) {
    const auto mode = static_cast<int16_t>(loop);
    std::memcpy(app_.at("Main.mode"), &mode, sizeof mode);
    app_.setLoopBudget(budget, more, times);
    app_.run();
  }
  [[nodiscard]] int counted() const { return std::stoi(app_["counted"]); }

  App app_;
};

TEST_F(LoopBudget, IsTakenForEveryRound) {
  for (int n = 0; n < 3 * kAll; ++n) {
    const Loop &loop = kLoops[n % kAll];
    SCOPED_TRACE(std::string(loop.name) + kWhere[n / kAll]);
    run(n, 10'000);
    EXPECT_EQ(app_.exception(), "");
    EXPECT_EQ(counted(), loop.rounds);
    EXPECT_EQ(10'000 - app_.loopBudgetLeft(), loop.taken);
  }
}

TEST_F(LoopBudget, EndsTheLoopThatNeedsOneRoundMore) {
  for (int n = 0; n < 3 * kAll; ++n) {
    const Loop &loop = kLoops[n % kAll];
    SCOPED_TRACE(std::string(loop.name) + kWhere[n / kAll]);
    const int needed = n < 2 * kAll ? loop.needed : std::max(loop.needed, loop.atOnce);
    for (const int spare : {0, 1}) {
      run(n, needed + spare);
      EXPECT_EQ(app_.exception(), "") << spare;
      EXPECT_EQ(app_.refills(), 0) << spare;
      EXPECT_EQ(counted(), loop.rounds) << spare;
    }
    if (needed == 0)
      continue;
    run(n, needed - 1);
    EXPECT_EQ(app_.exception().substr(0, 11), "EndlessLoop");
    EXPECT_LE(counted(), loop.rounds);
  }
}

/// The round in which the host is asked may count for the budget that it gives.
TEST_F(LoopBudget, LastsAsLongAsTheHostAddsToIt) {
  constexpr int kMore = 13;
  for (int n = 0; n < 3 * kAll; ++n) {
    const Loop &loop = kLoops[n % kAll];
    SCOPED_TRACE(std::string(loop.name) + kWhere[n / kAll]);
    run(n, 10, kMore, 1000);
    EXPECT_EQ(app_.exception(), "");
    EXPECT_EQ(counted(), loop.rounds);
    EXPECT_GE(app_.loopBudgetLeft(), 0);
    EXPECT_LE(app_.loopBudgetLeft(), loop.taken < 10 ? 10 : kMore);
    // A loop that takes all its rounds at once asks once.
    EXPECT_LE(10 + (app_.refills() - 1) * (kMore - 1), std::max(loop.taken, 10)) << app_.refills();
  }
}

} // namespace
} // namespace stc::test
