// Ladder and function block diagrams of CoDeSys V2.3.
#include "compiler/import/networks/exp_networks.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <sstream>

namespace stc::import::networks {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<NumberedLine> lines(const std::string &text) {
  std::vector<NumberedLine> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    result.push_back({line + "\r", 100 + result.size()});
  return result;
}

/// One word a line, to keep the tests short: `/` ends a line.
std::string spread(std::string text) {
  for (char &c : text)
    if (c == '/')
      c = '\n';
  return text;
}

Scope scene() {
  Scope scope;
  scope.declare("FUNCTION_BLOCK TON VAR_INPUT IN : BOOL; PT : TIME; END_VAR\n"
                "VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR END_FUNCTION_BLOCK\n"
                "FUNCTION Scale : INT VAR_INPUT a, b : INT; END_VAR END_FUNCTION\n");
  scope.enter("PROGRAM P VAR a, b, c, d, x, y, z : BOOL; n, m : INT; tm : TON; t : TIME; END_VAR");
  return scope;
}

Translation translate(const std::string &text) {
  Scope scope = scene();
  return translatedExpBody(lines(spread(text)), scope);
}

/// A network of a ladder diagram with a rung, what EN boxes it has, and its coils.
std::string ladder(const std::string &rung, const std::string &boxes, const std::string &coils) {
  return "_LD_BODY/_NETWORKS : 1/_NETWORK//_COMMENT/''/_END_COMMENT/_LD_ASSIGN/" + rung +
         "/_EXPRESSION/_POSITIV/ENABLELIST : " + (boxes.empty() ? "0" : "1/" + boxes) +
         "/ENABLELIST_END/" + coils;
}

TEST(ExpLadder, contactsInSeriesAndParallel) {
  const Translation result = translate(
      ladder("_LD_AND/_LD_OPERATOR : 3/_LD_OR/_LD_OPERATOR : 2/_LD_CONTACT/a/_EXPRESSION/_POSITIV/"
             "_LD_CONTACT/x/_EXPRESSION/_POSITIV/_EXPRESSION/_POSITIV/"
             "_LD_CONTACT/b/_EXPRESSION/_NEGATIV/_LD_CONTACT/tm.Q/_EXPRESSION/_POSITIV/"
             "_EXPRESSION/_POSITIV",
             "", "_OUTPUTS : 1/_OUTPUT/_POSITIV/_NO_SET/x"));
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.statements, "x := (a OR x) AND NOT b AND tm.Q;\n");
  EXPECT_EQ(result.declarations, "");
}

TEST(ExpLadder, coilsOfOneRungSeeTheSameValue) {
  const Translation result =
      translate(ladder("_LD_AND/_LD_OPERATOR : 2/_LD_CONTACT/a/_EXPRESSION/_POSITIV/"
                       "_LD_CONTACT/b/_EXPRESSION/_POSITIV/_EXPRESSION/_POSITIV",
                       "",
                       "_OUTPUTS : 4/_OUTPUT/_POSITIV/_NO_SET/a/_OUTPUT/_POSITIV/_SET/x/"
                       "_OUTPUT/_NEGATIV/_SET/y/_OUTPUT/_NEGATIV/_NO_SET/z"));
  EXPECT_EQ(result.declarations, "VAR\n  rung : BOOL;\nEND_VAR\n");
  EXPECT_EQ(result.statements,
            "rung := a AND b;\na := rung;\nx S= rung;\ny R= rung;\nz := NOT rung;\n");
}

TEST(ExpLadder, oneContactIsRepeatedUntilItIsWritten) {
  const Translation result =
      translate(ladder("_LD_CONTACT/a/_EXPRESSION/_POSITIV", "",
                       "_OUTPUTS : 3/_OUTPUT/_POSITIV/_NO_SET/x/_OUTPUT/_NEGATIV/_NO_SET/a/"
                       "_OUTPUT/_POSITIV/_NO_SET/y"));
  EXPECT_EQ(result.statements, "x := a;\nrung := a;\na := NOT a;\ny := rung;\n");
}

TEST(ExpLadder, boxesWithEnStandInAnIf) {
  const Translation result = translate(
      ladder("_LD_CONTACT/a/_EXPRESSION/_NEGATIV",
             "_ASSIGN/_OPERATOR/_BOX_EXPR: 2/_ENABLED/_OPERAND/_EXPRESSION/_POSITIV/n/"
             "_OPERAND/_EXPRESSION/_POSITIV/1/_EXPRESSION/_POSITIV/ADD/_EXPRESSION/_POSITIV/"
             "_OUTPUTS : 1/_OUTPUT/_POSITIV/_NO_SET/n",
             "_OUTPUTS : 1/_OUTPUT/_POSITIV/_NO_SET/x"));
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.statements, "IF NOT a THEN\n  n := n + 1;\nEND_IF\nx := NOT a;\n");
}

TEST(ExpLadder, anEmptyRungIsTheRail) {
  const Translation result =
      translate(ladder("_EMPTY",
                       "_ASSIGN/_OPERATOR/_BOX_EXPR: 1/_ENABLED/_OPERAND/_EXPRESSION/_POSITIV/t/"
                       "_EXPRESSION/_POSITIV/TIME_TO_INT/_EXPRESSION/_POSITIV/_OUTPUTS : 1/_OUTPUT/"
                       "_POSITIV/_NO_SET/n",
                       "_OUTPUTS : 0"));
  EXPECT_EQ(result.statements, "n := TIME_TO_INT(t);\n");
}

TEST(ExpLadder, aBlockInARung) {
  const Translation result = translate(
      ladder("_FUNCTIONBLOCK/tm/_BOX_EXPR : 2/_LD_CONTACT/a/_EXPRESSION/_POSITIV/_OPERAND/"
             "_EXPRESSION/_POSITIV/T#5s/_EXPRESSION/_POSITIV/TON/_OUTPUTS : 1/_OUTPUT/_POSITIV/"
             "_NO_SET/t",
             "", "_OUTPUTS : 1/_OUTPUT/_POSITIV/_NO_SET/x"));
  EXPECT_EQ(result.statements, "tm(IN := a, PT := T#5s, ET => t);\nx := tm.Q;\n");
}

std::string diagram(const std::string &network) { return "_FBD_BODY/_NETWORKS : 1/" + network; }

TEST(ExpDiagram, treesBecomeExpressionsWithTheNetworksComment) {
  const Translation result = translate(
      diagram("_NETWORK/Start/_COMMENT/'Scaled value/of the input'/_END_COMMENT/_ASSIGN/_OPERATOR/"
              "_BOX_EXPR : 2/_OPERATOR/_BOX_EXPR : 2/_OPERAND/_EXPRESSION/_POSITIV/n/_OPERAND/"
              "_EXPRESSION/_POSITIV/3/_EXPRESSION/_POSITIV/ADD/_FUNCTION/_BOX_EXPR : 2/_OPERAND/"
              "_EXPRESSION/_POSITIV/n/_OPERAND/_EXPRESSION/_POSITIV/m/_EXPRESSION/_POSITIV/Scale/"
              "_EXPRESSION/_POSITIV/MUL/_EXPRESSION/_POSITIV/_OUTPUTS : 2/_OUTPUT/_POSITIV/_NO_SET/"
              "n/_OUTPUT/_POSITIV/_NO_SET/m"));
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.declarations, "VAR\n  mul_out : INT;\nEND_VAR\n");
  EXPECT_EQ(result.statements, "// Scaled value\n// of the input\nStart:\n"
                               "mul_out := (n + 3) * Scale(n, m);\nn := mul_out;\nm := mul_out;\n");
}

TEST(ExpDiagram, aBlockGivesItsFirstOutputToTheNetwork) {
  const Translation result = translate(
      diagram("_NETWORK/_COMMENT/''/_END_COMMENT/_ASSIGN/_FUNCTIONBLOCK/tm/_BOX_EXPR : 2/_OPERAND/"
              "_EXPRESSION/_NEGATIV/a/_OPERAND/_EXPRESSION/_POSITIV/??"
              "?/_EXPRESSION/_POSITIV/TON/"
              "_OUTPUTS : 1/_OUTPUT/_POSITIV/_NO_SET/??"
              "?/_EXPRESSION/_NEGATIV/_OUTPUTS : 1/_OUTPUT/"
              "_POSITIV/_NO_SET/x"));
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.statements, "tm(IN := NOT a);\nx := NOT tm.Q;\n");
}

TEST(ExpDiagram, aFunctionWithoutAssignmentIsCalled) {
  const Translation result =
      translate(diagram("_NETWORK//_COMMENT/''/_END_COMMENT/_FUNCTION/_BOX_EXPR : 1/_OPERAND/"
                        "_EXPRESSION/_POSITIV/n/_EXPRESSION/_POSITIV/Log"));
  EXPECT_EQ(result.statements, "Log(n);\n");
}

TEST(ExpDiagram, whatNoExportShowsIsRefusedWithItsLine) {
  const Translation jump = translate(diagram("_NETWORK/_COMMENT/''/_END_COMMENT/_JUMP/Start"));
  ASSERT_THAT(jump.problems, SizeIs(1));
  EXPECT_EQ(jump.problems[0].line, 106U);
  EXPECT_THAT(jump.problems[0].text, HasSubstr("`_JUMP`"));
  EXPECT_EQ(jump.statements, "");
  EXPECT_THAT(translate(diagram("_NETWORK/_COMMENT/''/_END_COMMENT/_ASSIGN/_OPERAND")).problems,
              ElementsAre(Field(&Problem::text, HasSubstr("ends in the middle"))));
  EXPECT_THAT(translate("_FBD_BODY/_NETWORKS : x").problems, SizeIs(1));
  EXPECT_THAT(translate("_FBD_BODY").problems, SizeIs(1));
}

TEST(ExpDiagram, outputsOfAnUnknownBlockAreRefused) {
  const Translation result = translate(
      diagram("_NETWORK/_COMMENT/''/_END_COMMENT/_ASSIGN/_FUNCTIONBLOCK/s/_BOX_EXPR : 1/_OPERAND/"
              "_EXPRESSION/_POSITIV/a/_EXPRESSION/_POSITIV/Strange/_OUTPUTS : 0/_EXPRESSION/"
              "_POSITIV/_OUTPUTS : 1/_OUTPUT/_POSITIV/_NO_SET/x"));
  ASSERT_THAT(result.problems, SizeIs(1));
  EXPECT_THAT(result.problems[0].text, HasSubstr("the outputs of `Strange` are not known"));
}

TEST(ExpDiagram, deepTreesAreRefused) {
  std::string text = "_NETWORK/_COMMENT/''/_END_COMMENT/_ASSIGN/";
  for (int i = 0; i < 100000; ++i)
    text += "_OPERATOR/_BOX_EXPR : 1/";
  EXPECT_THAT(translate(diagram(text)).problems,
              ElementsAre(Field(&Problem::text, HasSubstr("too deep"))));
}

TEST(ExpLadder, aBoxIsEnabledOnlyInTheListOfItsRung) {
  const std::string box = "_FUNCTION/_BOX_EXPR : 1/_ENABLED/_OPERAND/_EXPRESSION/_POSITIV/n/"
                          "_EXPRESSION/_POSITIV/Log";
  const std::string rung =
      ladder("_LD_CONTACT/a/_EXPRESSION/_POSITIV", box, "_OUTPUTS : 1/_OUTPUT/_POSITIV/_NO_SET/x");
  EXPECT_THAT(translate(rung).problems, IsEmpty());
  for (const std::string &after : {"/" + box, "/_NETWORK//_COMMENT/''/_END_COMMENT/" + box})
    EXPECT_THAT(translate(rung + after).problems,
                ElementsAre(Field(&Problem::text, HasSubstr("outside the ENABLELIST"))));
  std::string nested = "_LD_BODY/_NETWORKS : 1/_NETWORK//_COMMENT/''/_END_COMMENT";
  for (int i = 0; i < 50000; ++i)
    nested += "/_LD_ASSIGN/_LD_CONTACT/a/_EXPRESSION/_POSITIV/_EXPRESSION/_POSITIV/ENABLELIST : 1";
  EXPECT_THAT(translate(nested).problems,
              ElementsAre(Field(&Problem::text, HasSubstr("inside the ENABLELIST"))));
}

} // namespace
} // namespace stc::import::networks
