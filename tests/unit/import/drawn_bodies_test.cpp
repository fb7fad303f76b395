// Statements in the place of bodies that are drawn.
#include "compiler/import/drawn_bodies.hpp"
#include "compiler/import/exp_reader.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <array>

namespace stc::import {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr std::string_view kTimer = "FUNCTION_BLOCK TON\nVAR_INPUT IN : BOOL; PT : TIME; END_VAR\n"
                                    "VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR\nEND_FUNCTION_BLOCK\n";

Model read(std::string_view text) {
  Model model;
  readExp("a.EXP", text, model);
  translateDrawnBodies(model, std::array{kTimer});
  return model;
}

constexpr std::string_view kDiagram =
    "_FBD_BODY\n_NETWORKS : "
    "1\n_NETWORK\n\n_COMMENT\n'Wait'\n_END_COMMENT\n_ASSIGN\n_FUNCTIONBLOCK\n"
    "wait\n_BOX_EXPR : 2\n_OPERAND\n_EXPRESSION\n_POSITIV\ngo\n_OPERAND\n_EXPRESSION\n_POSITIV\n"
    "T#2s\n_EXPRESSION\n_POSITIV\nTON\n_OUTPUTS : 0\n_EXPRESSION\n_POSITIV\n_OUTPUTS : 1\n_OUTPUT\n"
    "_POSITIV\n_NO_SET\ndone\n";
constexpr std::string_view kLadder =
    "_LD_BODY\n_NETWORKS : 1\n_NETWORK\n\n_COMMENT\n''\n_END_COMMENT\n_LD_ASSIGN\n_LD_AND\n"
    "_LD_OPERATOR : 2\n_LD_CONTACT\ngo\n_EXPRESSION\n_POSITIV\n_LD_CONTACT\nstop\n_EXPRESSION\n"
    "_NEGATIV\n_EXPRESSION\n_POSITIV\n_EXPRESSION\n_POSITIV\nENABLELIST : 0\nENABLELIST_END\n"
    "_OUTPUTS : 2\n_OUTPUT\n_POSITIV\n_NO_SET\ndone\n_OUTPUT\n_POSITIV\n_SET\ngo\n";

TEST(DrawnBodies, statementsStandWhereTheDrawingStood) {
  const Model model = read("PROGRAM P\nVAR\n  go, done : BOOL;\n  wait : TON;\nEND_VAR\n"
                           "(* @END_DECLARATION := '0' *)\n" +
                           std::string(kDiagram) + "END_PROGRAM\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_EQ(model.objects[0].text, "PROGRAM P\nVAR\n  go, done : BOOL;\n  wait : TON;\nEND_VAR\n"
                                   "// Wait\nwait(IN := go, PT := T#2s);\ndone := wait.Q;\n"
                                   "END_PROGRAM\n");
  EXPECT_THAT(model.leftOut, IsEmpty());
  ASSERT_THAT(model.changed, SizeIs(1));
  EXPECT_EQ(model.changed[0].text, "its body was drawn (FBD): translated into ST");
}

TEST(DrawnBodies, newVariablesAreDeclaredInThePou) {
  const std::string variables = "VAR\n  go, stop, done : BOOL;\nEND_VAR\n";
  const Model own = read("PROGRAM P\n" + variables + std::string(kLadder) + "END_PROGRAM\n");
  EXPECT_EQ(own.objects[0].text, "PROGRAM P\n" + variables +
                                     "VAR\n  rung : BOOL;\nEND_VAR\nrung := go AND NOT stop;\n"
                                     "done := rung;\ngo S= rung;\nEND_PROGRAM\n");
  // An action's are those of its POU, and two bodies do not share a name.
  const Model action = read("PROGRAM P\n" + variables + std::string(kLadder) +
                            "END_PROGRAM\nACTION Act:\n" + std::string(kLadder) + "END_ACTION\n");
  EXPECT_EQ(
      action.objects[0].text,
      "PROGRAM P\n" + variables +
          "VAR\n  rung : BOOL;\nEND_VAR\nVAR\n  rung_2 : BOOL;\nEND_VAR\nrung := go AND NOT stop;\n"
          "done := rung;\ngo S= rung;\n\nACTION Act:\nrung_2 := go AND NOT stop;\n"
          "done := rung_2;\ngo S= rung_2;\nEND_ACTION\nEND_PROGRAM\n");
  const Model bare =
      read("PROGRAM P\nEND_PROGRAM\nACTION Act:\n" + std::string(kLadder) + "END_ACTION\n");
  EXPECT_THAT(bare.objects[0].text,
              HasSubstr("PROGRAM P\nVAR\n  rung : BOOL;\nEND_VAR\n\nACTION Act:\n"));
}

/// A drawing in place of `@`.
std::string drawnIn(std::string text) {
  Model model;
  const std::string mark = markDrawnBody(model, {"a.xml", 3}, "P", "LD",
                                         [](networks::Scope &) {
                                           networks::Translation result;
                                           result.statements = "x := rung;\n";
                                           result.declarations = "VAR\n  rung : BOOL;\nEND_VAR\n";
                                           return result;
                                         },
                                         {});
  text.replace(text.find('@'), 2, mark);
  model.objects.push_back({ObjectKind::Pou, "P", {}, text, {"a.xml", 1}});
  translateDrawnBodies(model, {});
  return model.objects[0].text;
}

TEST(DrawnBodies, keywordsHaveAnyCaseAndStandInNoComments) {
  const std::string variables = "VAR\n  rung : BOOL;\nEND_VAR\n";
  // The POU of an action, in small letters, without and with variables.
  EXPECT_EQ(drawnIn("// about\nprogram P\nset := 2;\naction Act:\n@\nend_action\nend_program\n"),
            "// about\nprogram P\n" + variables +
                "set := 2;\naction Act:\nx := rung;\nend_action\nend_program\n");
  EXPECT_EQ(drawnIn("Class P\nvar n : INT; end_var // one\n(*\nEND_VAR\nACTION a\n*)\n"
                    "Action Act:\n@\nEnd_Action\nEnd_Class\n"),
            "Class P\nvar n : INT; end_var // one\n" + variables +
                "(*\nEND_VAR\nACTION a\n*)\nAction Act:\nx := rung;\nEnd_Action\nEnd_Class\n");
  EXPECT_EQ(drawnIn("function_block P\nvar n : INT; end_var\nn := 1;\nmethod m : INT\n"
                    "var_input i : INT; end_var\n(*\nEND_METHOD *)\n@\nend_method\n"
                    "end_function_block\n"),
            "function_block P\nvar n : INT; end_var\nn := 1;\nmethod m : INT\n"
            "var_input i : INT; end_var\nVAR_INST\n  rung : BOOL;\nEND_VAR\n(*\nEND_METHOD *)\n"
            "x := rung;\nend_method\nend_function_block\n");
}

TEST(DrawnBodies, aBodyThatCannotBeTranslatedIsAnErrorOfTheCompiler) {
  const Model model =
      read("PROGRAM P\n_FBD_BODY\n_NETWORKS : 1\n_NETWORK\n_MYSTERY\nEND_PROGRAM\n");
  EXPECT_EQ(model.objects[0].text, "PROGRAM P\n{error 'body not imported: FBD'}\nEND_PROGRAM\n");
  ASSERT_THAT(model.leftOut, SizeIs(1));
  EXPECT_EQ(model.leftOut[0].origin.line, 5U);
  EXPECT_THAT(model.leftOut[0].text, HasSubstr("_MYSTERY"));
}

TEST(DrawnBodies, blocksOfOtherObjectsAreKnown) {
  std::string diagram(kDiagram);
  diagram.replace(diagram.find("\nTON\n"), 5, "\nOwn\n");
  const Model model =
      read("PROGRAM P\nVAR wait : Own; go, done : BOOL; END_VAR\n" + diagram +
           "END_PROGRAM\nFUNCTION_BLOCK Own\nVAR_INPUT s : BOOL; t : TIME; END_VAR\n"
           "VAR_OUTPUT r : BOOL; END_VAR\nr := s;\nEND_FUNCTION_BLOCK\n");
  EXPECT_THAT(model.objects[0].text, HasSubstr("wait(s := go, t := T#2s);\ndone := wait.r;\n"));
}

} // namespace
} // namespace stc::import
