// Expressions with as few brackets as possible.
#include "compiler/import/networks/expression.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

namespace stc::import::networks {
namespace {

using testing::ElementsAre;

std::vector<Expression> texts(const std::vector<std::string> &each) {
  std::vector<Expression> result;
  for (const std::string &text : each)
    result.push_back(textOf(text));
  return result;
}

TEST(Expression, printsOnlyBracketsThatAreNeeded) {
  const Expression sum = operation("ADD", texts({"a", "b"}));
  EXPECT_EQ(printed(operation("MUL", {sum, textOf("c")})), "(a + b) * c");
  EXPECT_EQ(printed(operation("SUB", {sum, textOf("c")})), "a + b - c");
  EXPECT_EQ(printed(operation("SUB", {textOf("c"), sum})), "c - (a + b)");
  EXPECT_EQ(printed(operation("GT", {sum, textOf("5")})), "a + b > 5");
  EXPECT_EQ(printed(negation(operation("GT", texts({"a", "b"})))), "NOT (a > b)");
  EXPECT_EQ(printed(negation(textOf("x OR y"))), "NOT (x OR y)");
  EXPECT_EQ(printed(operation("AND", texts({"x OR y", "z", "u AND v"}))),
            "(x OR y) AND z AND u AND v");
  EXPECT_EQ(printed(operation("EQ", {operation("GT", texts({"a", "b"})), textOf("c")})),
            "(a > b) = c");
}

TEST(Expression, joinsNestedOperatorsAndCancelsNegations) {
  const Expression inner = operation("AND", texts({"b", "c"}));
  EXPECT_EQ(printed(operation("AND", {textOf("a"), inner})), "a AND b AND c");
  EXPECT_EQ(printed(operation("OR", {inner, textOf("a")})), "b AND c OR a");
  EXPECT_EQ(printed(operation("AND", {operation("OR", texts({"a", "b"})), textOf("c")})),
            "(a OR b) AND c");
  EXPECT_EQ(printed(negation(negation(textOf("a")))), "a");
  EXPECT_EQ(printed(operation("SEL", texts({"g", "a + 1", "b"}))), "SEL(g, a + 1, b)");
  EXPECT_EQ(printed(operation("MOVE", texts({"a"}))), "a");
}

TEST(Expression, takesCommonContactsOutOfBranches) {
  const auto series = [](const std::vector<std::string> &each) { return conjunction(texts(each)); };
  EXPECT_EQ(printed(disjunction({series({"a", "b"}), series({"a", "c"})})), "a AND (b OR c)");
  EXPECT_EQ(printed(disjunction({series({"a", "b", "d"}), series({"a", "c", "d"})})),
            "a AND (b OR c) AND d");
  EXPECT_EQ(printed(disjunction({series({"a", "b"}), series({"a", "c"}), series({"d"})})),
            "a AND (b OR c) OR d");
  // A wire beside a contact.
  EXPECT_EQ(printed(disjunction({series({"a"}), series({"a", "c"})})), "a");
  EXPECT_EQ(printed(disjunction({series({"a", "b"}), truth()})), "TRUE");
  EXPECT_EQ(printed(conjunction({truth(), textOf("a")})), "a");
  EXPECT_EQ(printed(conjunction({})), "TRUE");
}

TEST(Text, findsTheWeakestOperatorOutsideBrackets) {
  EXPECT_EQ(precedenceOf("a.b[i + 1]"), kPrimary);
  EXPECT_EQ(precedenceOf("SEL(a OR b, c, d)"), kPrimary);
  EXPECT_EQ(precedenceOf("-5"), kUnary);
  EXPECT_EQ(precedenceOf("a - -5"), kSum);
  EXPECT_EQ(precedenceOf("NOT a AND b"), kAnd);
  EXPECT_EQ(precedenceOf("a = b OR c"), kOr);
  EXPECT_EQ(precedenceOf("1.5E-3"), kPrimary);
  EXPECT_EQ(precedenceOf("'a OR b'"), kPrimary);
  EXPECT_EQ(precedenceOf("D#2026-11-28"), kPrimary);
  EXPECT_EQ(precedenceOf("a (* OR *)"), kPrimary);
}

TEST(Text, namesTheVariablesThatAreRead) {
  EXPECT_THAT(rootsOf("Axis.Pos + T#5s + arr[Idx].x + 'it OR is'"),
              ElementsAre("arr", "axis", "idx"));
  EXPECT_TRUE(isVariable("a.b[i, 2].c^"));
  EXPECT_TRUE(isVariable("%QX0.1"));
  EXPECT_FALSE(isVariable("a + b"));
  EXPECT_FALSE(isVariable("TRUE"));
  EXPECT_FALSE(isVariable("f(a)"));
  EXPECT_FALSE(isVariable("5"));
}

} // namespace
} // namespace stc::import::networks
