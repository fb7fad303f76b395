// Continuous function charts of CoDeSys V2.3.
#include "compiler/import/networks/exp_networks.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sstream>

namespace stc::import::networks {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Translation translate(const std::string &text) {
  std::vector<NumberedLine> lines;
  std::istringstream stream("_CFC_BODY\n" + text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back({line, 1 + lines.size()});
  Scope scope;
  scope.declare("FUNCTION_BLOCK TON VAR_INPUT IN : BOOL; PT : TIME; END_VAR\n"
                "VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR END_FUNCTION_BLOCK\n"
                "PROGRAM Alarm VAR_INPUT on : BOOL; END_VAR END_PROGRAM\n");
  scope.enter("PROGRAM P VAR a, b, x, y : BOOL; n, m : INT; tm : TON; END_VAR");
  return translatedExpBody(lines, scope);
}

std::string input(int id, const std::string &text) {
  return fmt::format("_ELEMENT\n_ID: {}\n_MACROID: -1\n_POS: 3, {}\n_TYPE: _INPUT\n_TEXT: {}\n"
                     "_NEGATE: 0\n_CONNECTOR: \n_END\n",
                     id, id, text);
}

std::string output(int id, const std::string &text, int from, int pin, const std::string &storage) {
  return fmt::format("_ELEMENT\n_ID: {}\n_MACROID: -1\n_POS: 30, {}\n_TYPE: _OUTPUT\n_TEXT: {}\n"
                     "_INPUTID: {}\n_INPUTIDX: {}\n_NEGATE: 0\n_SETRESET: {}\n_END\n",
                     id, id, text, from, pin, storage);
}

std::string box(int id, const std::string &instance, const std::string &type,
                const std::vector<std::pair<int, int>> &inputs, int outputs) {
  std::string text = fmt::format("_ELEMENT\n_ID: {}\n_MACROID: -1\n_POS: 20, 1\n_TYPE: _BOX\n"
                                 "_INSTANCE: {}\n_INSTANCENAME: {}\n_TYPENAME: {}\n_ENENO: 0\n"
                                 "_INPUTS: {}\n",
                                 id, instance.empty() ? 0 : 1, instance, type, inputs.size());
  for (const auto &[from, pin] : inputs)
    text += fmt::format("_IN\n_INPUTID: {}\n_INPUTIDX: {}\n_NEGATE: {}\n_END\n", from, pin,
                        from == 1 ? 1 : 0);
  text += fmt::format("_OUTPUTS: {}\n", outputs);
  for (int i = 0; i < outputs; ++i)
    text += "_OUT\n_NEGATE: 0\n_CONNECTOR: \n_END\n";
  return text + "_PARAMETERS: 0\n_END\n";
}

TEST(ExpChart, elementsAreExecutedInTheFilesOrder) {
  const Translation result =
      translate(input(1, "a") + input(2, "REAL_TO_TIME(1.5 * 1000)") +
                box(3, "tm", "TON", {{1, 0}, {2, 0}}, 2) + output(4, "x", 3, 0, "_SET") +
                input(5, "NOT tm.Q AND b") + output(6, "x", 5, 0, "_RESET"));
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.statements, "tm(IN := NOT a, PT := REAL_TO_TIME(1.5 * 1000));\n"
                               "x S= tm.Q;\nx R= NOT tm.Q AND b;\n");
}

TEST(ExpChart, aValueThatIsReadBeforeItIsComputedIsThatOfTheLastCycle) {
  const Translation result =
      translate(input(2, "n") + box(7, "", "ADD", {{2, 0}, {8, 0}}, 1) + output(4, "m", 7, 0, "") +
                box(8, "", "MUL", {{7, 0}, {2, 0}}, 1));
  EXPECT_THAT(result.problems, IsEmpty());
  EXPECT_EQ(result.declarations, "VAR\n  mul_out : INT;\n  add_out : INT;\nEND_VAR\n");
  EXPECT_EQ(result.statements, "add_out := n + mul_out;\nm := add_out;\nmul_out := add_out * n;\n");
}

TEST(ExpChart, aBlocksOutputBeforeItsCallIsThatOfTheLastCycle) {
  const Translation result = translate(output(4, "x", 3, 0, "") + input(1, "a") + input(2, "T#3s") +
                                       box(3, "tm", "TON", {{1, 0}, {2, 0}}, 2));
  EXPECT_EQ(result.statements, "x := tm.Q;\ntm(IN := NOT a, PT := T#3s);\n");
}

TEST(ExpChart, aWriteInBetweenKeepsTheOldValue) {
  const Translation result =
      translate(input(2, "n") + input(5, "m") + box(7, "", "ADD", {{2, 0}, {5, 0}}, 1) +
                output(4, "n", 5, 0, "") + output(6, "m", 7, 0, ""));
  EXPECT_EQ(result.statements, "add_out := n + m;\nn := m;\nm := add_out;\n");
}

TEST(ExpChart, programsAreCalled) {
  EXPECT_EQ(translate(input(2, "b") + box(1, "", "Alarm", {{2, 0}}, 0)).statements,
            "Alarm(on := b);\n");
  EXPECT_EQ(translate(box(1, "", "Elsewhere", {}, 0)).statements, "Elsewhere();\n");
}

TEST(ExpChart, whatNoExportShowsIsRefusedWithItsLine) {
  const Translation macro =
      translate("_ELEMENT\n_ID: 1\n_MACROID: 4\n_TYPE: _INPUT\n_TEXT: a\n_END\n");
  ASSERT_THAT(macro.problems, SizeIs(1));
  EXPECT_EQ(macro.problems[0].line, 2U);
  EXPECT_THAT(macro.problems[0].text, HasSubstr("macros"));
  EXPECT_THAT(translate("_ELEMENT\n_ID: 1\n_TYPE: _JUMP\n_END\n").problems, SizeIs(1));
  EXPECT_THAT(translate("_ELEMENT\n_ID: 1\n_NEW: 5\n_END\n").problems, SizeIs(1));
  EXPECT_THAT(translate("_ELEMENT\n_ID: 1\n").problems, SizeIs(1));
  EXPECT_THAT(translate(output(4, "x", 9, 0, "")).problems, SizeIs(1));
  EXPECT_THAT(translate(input(1, "a") + output(4, "x", 1, 3, "")).problems, SizeIs(1));
  std::string en = box(3, "tm", "TON", {}, 2);
  en.replace(en.find("_ENENO: 0"), 9, "_ENENO: 1");
  EXPECT_THAT(translate(en).problems, SizeIs(1));
}

} // namespace
} // namespace stc::import::networks
