// Exports of CoDeSys V2.3.
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/exp_reader.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <string>

namespace stc::import {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

Model read(std::string_view text) {
  Model model;
  readExp("a.EXP", text, model);
  return model;
}

TEST(ExpReader, takesAPouWithItsFolderAndDropsAttributes) {
  const Model model =
      read("\r\n(* @NESTEDCOMMENTS := 'Yes' *)\r\n(* @PATH := '\\/Motion\\/Axes' *)\r\n"
           "FUNCTION Twice : INT\r\nVAR_INPUT\r\n\tn : INT;\r\nEND_VAR\r\n"
           "(* @END_DECLARATION := '0' *)\r\nTwice := 2 * n;\r\nEND_FUNCTION\r\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_EQ(model.objects[0].name, "Twice");
  EXPECT_EQ(model.objects[0].origin.line, 4U);
  EXPECT_THAT(model.objects[0].folder, ElementsAre("Motion", "Axes"));
  EXPECT_EQ(model.objects[0].text, "FUNCTION Twice : INT\nVAR_INPUT\n\tn : INT;\nEND_VAR\n"
                                   "Twice := 2 * n;\nEND_FUNCTION\n");
  EXPECT_THAT(model.leftOut, IsEmpty());
}

TEST(ExpReader, anEndInsideACommentOrATextEndsNothing) {
  const Model model =
      read("PROGRAM P\nVAR s : STRING := '(*'; END_VAR\n(*\nEND_PROGRAM\n*)\nEND_PROGRAM\n"
           "PROGRAM Q\nEND_PROGRAM\n");
  ASSERT_THAT(model.objects, SizeIs(2));
  EXPECT_EQ(model.objects[1].name, "Q");
  EXPECT_EQ(model.objects[1].origin.line, 7U);
}

TEST(ExpReader, commentsThatAreNotNestedAreTakenApart) {
  const Model model =
      read("(* @NESTEDCOMMENTS := 'No' *)\nPROGRAM P\n(* a (* b *)\nn := 1;\nEND_PROGRAM\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_THAT(model.objects[0].text, HasSubstr("(* a ( * b *)\nn := 1;"));
  ASSERT_THAT(model.changed, SizeIs(1));
  EXPECT_EQ(model.changed[0].origin.line, 2U);
}

TEST(ExpReader, theAsteriskOfABeginCanBelongToTheEnd) {
  CommentState flat(false);
  EXPECT_EQ(flat.line("(* a (*) n := 1;"), "(* a ( *) n := 1;");
  EXPECT_FALSE(flat.inside());
  CommentState nested(true);
  EXPECT_EQ(nested.line("(* a (* b *) c"), "(* a (* b *) c");
  EXPECT_TRUE(nested.inside());
}

TEST(ExpReader, actionsGoIntoTheirPou) {
  const Model model =
      read("FUNCTION_BLOCK F\nn := 1;\nEND_FUNCTION_BLOCK\n\nACTION Stop:\nn := 0;\nEND_ACTION\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_EQ(model.objects[0].text,
            "FUNCTION_BLOCK F\nn := 1;\n\nACTION Stop:\nn := 0;\nEND_ACTION\n"
            "END_FUNCTION_BLOCK\n");
  EXPECT_THAT(read("ACTION Stop:\nEND_ACTION\n").leftOut, SizeIs(1));
}

TEST(ExpReader, blocksOfAListStayTogether) {
  const Model model =
      read("(* @GLOBAL_VARIABLE_LIST := 'Machine' *)\nVAR_GLOBAL CONSTANT\nk : INT := 3;\nEND_VAR\n"
           "VAR_GLOBAL\nn : INT;\nEND_VAR\nTYPE\nSpeed : REAL;\nEND_TYPE\n");
  ASSERT_THAT(model.objects, SizeIs(2));
  EXPECT_EQ(model.objects[0].name, "Machine");
  EXPECT_THAT(model.objects[0].text, HasSubstr("k : INT := 3;\nEND_VAR\n\nVAR_GLOBAL\nn : INT;"));
  EXPECT_EQ(model.objects[1].name, "Speed");
}

TEST(ExpReader, tasksHaveTheirProgramsAndTimes) {
  const Model model =
      read("RESOURCE\nTASK Fast (PRIORITY := 3, INTERVAL := T#200ms);\nPLC_PRG();\nQ();\n"
           "{Additional_info : 1,0}\nEND_TASK\nTASK Go (PRIORITY := 0, SINGLE := "
           "bGo);\nR();\nEND_TASK\nEND_RESOURCE\n");
  ASSERT_THAT(model.tasks, SizeIs(2));
  EXPECT_EQ(model.tasks[0].interval, "T#200ms");
  EXPECT_EQ(model.tasks[0].priority, "3");
  EXPECT_THAT(model.tasks[0].programs, ElementsAre("PLC_PRG", "Q"));
  EXPECT_EQ(model.tasks[1].event, "bGo");
  EXPECT_EQ(model.tasks[1].origin.line, 7U);
}

TEST(ExpReader, drawnBodiesLeaveAMark) {
  const Model model = read("PROGRAM P\nVAR\nEND_VAR\n_LD_BODY\n_NETWORKS : 1\nEND_PROGRAM\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  ASSERT_THAT(model.drawn, SizeIs(1));
  EXPECT_EQ(model.drawn[0].kind, "LD");
  EXPECT_EQ(model.drawn[0].origin.line, 4U);
  EXPECT_EQ(model.objects[0].text,
            "PROGRAM P\nVAR\nEND_VAR\n" + model.drawn[0].mark + "\nEND_PROGRAM\n");
}

TEST(ExpReader, unknownSectionsAreKeptAsText) {
  const Model model =
      read("_WORKSPACE\n(* PROGRAM X\n_END_WORKSPACE\n_CURVES\n_A\n_END_CURVES\nPROGRAM "
           "P\nEND_PROGRAM\nrubbish\n_OPEN\n_A : 1\nFUNCTION F : INT\nEND_FUNCTION\n");
  EXPECT_THAT(model.objects, SizeIs(2)) << "a section without end takes nothing with it";
  ASSERT_THAT(model.leftOut, SizeIs(2));
  EXPECT_EQ(model.leftOut[0].object, "_CURVES");
  EXPECT_EQ(model.leftOut[1].origin.line, 9U);
  ASSERT_THAT(model.kept, SizeIs(1));
  EXPECT_EQ(model.kept[0].text, "_CURVES\n_A\n_END_CURVES\n");
}

TEST(ExpReader, commentsBetweenObjectsStay) {
  const Model model = read("(* first\n *)\nPROGRAM P\nEND_PROGRAM\n(* of the action *)\nACTION A:\n"
                           "END_ACTION\n(* last *)\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_EQ(model.objects[0].text, "(* first\n *)\nPROGRAM P\n\n(* of the action *)\nACTION A:\n"
                                   "END_ACTION\nEND_PROGRAM\n(* last *)\n");
  EXPECT_THAT(read("(* alone *)").kept, SizeIs(1));
}

TEST(ExpReader, onlyKnownKeysAreAttributes) {
  const Model model = read("(* @WHAT := 'x' *)\nPROGRAM P\n(* @END_DECLARATION := '0' *)\n"
                           "(* @note := 'x' *)\nEND_PROGRAM\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_EQ(model.objects[0].text, "PROGRAM P\n(* @note := 'x' *)\nEND_PROGRAM\n");
  ASSERT_THAT(model.changed, SizeIs(1));
  EXPECT_EQ(model.changed[0].object, "attribute @WHAT");
}

TEST(ExpReader, instructionsAreTheCompilersBusiness) {
  const Model model = read("PROGRAM P\n_IL_BODY\nLD n\nEND_PROGRAM\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_EQ(model.objects[0].text, "PROGRAM P\nLD n\nEND_PROGRAM\n");
}

TEST(ExpReader, kindsOfTasks) {
  const Model model =
      read("RESOURCE\nTASK A (EVENT := MAX(a, b) > 2, PRIORITY := 4);\nP();\nEND_TASK\n"
           "TASK B (INTERVAL := T#7ms, EVENT := x);\nP();\n{Additional_info : 1,0}\n"
           "END_TASK\nTASK C (INTERVAL := T#7ms);\n{Additional_info : 2,3}\nEND_TASK\n"
           "{event_task : 'start','what','Go','x'}\nEND_RESOURCE\n");
  ASSERT_THAT(model.tasks, SizeIs(3));
  EXPECT_EQ(model.tasks[0].event, "MAX(a, b) > 2");
  EXPECT_EQ(model.tasks[0].priority, "4");
  EXPECT_EQ(model.tasks[1].event, "") << "a cyclic task";
  EXPECT_EQ(model.tasks[1].interval, "T#7ms");
  EXPECT_EQ(model.tasks[2].interval, "") << "a freewheeling task";
  EXPECT_THAT(model.changed, SizeIs(2));
  ASSERT_THAT(model.leftOut, SizeIs(2));
  EXPECT_THAT(model.leftOut[0].text, HasSubstr("watchdog"));
  EXPECT_EQ(model.leftOut[1].object, "system event start");
}

TEST(ExpReader, theOldWordForFunctionBlocksIsReplaced) {
  const Model model = read("  FUNCTIONBLOCK F\nEND_FUNCTION_BLOCK\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_EQ(model.objects[0].text, "  FUNCTION_BLOCK F\nEND_FUNCTION_BLOCK\n");
  EXPECT_THAT(model.changed, SizeIs(1));
}

TEST(ExpReader, strayLinesThatFollowEachOtherAreOneLoss) {
  const Model model = read("a\nb\n(* c *)\n\nd\n");
  ASSERT_THAT(model.leftOut, SizeIs(2));
  EXPECT_EQ(model.leftOut[1].origin.line, 5U);
  EXPECT_THAT(model.changed, SizeIs(1));
}

TEST(ExpReader, aTruncatedObjectIsALoss) {
  const Model model = read("PROGRAM P\nn := 1;");
  EXPECT_THAT(model.objects, IsEmpty());
  ASSERT_THAT(model.leftOut, SizeIs(1));
  EXPECT_THAT(model.leftOut[0].text, HasSubstr("END_PROGRAM"));
}

TEST(ExpReader, foldersCannotLeaveTheProject) {
  EXPECT_THAT(foldersOf("\\/..\\/a/b\\/C:\\/ "), ElementsAre("_.", "a_b", "C_"));
  EXPECT_THAT(foldersOf(""), IsEmpty());
}

/// A module of the PLC configuration with what is inside it.
std::string module(const std::string &section, const std::string &name, const std::string &inside) {
  return "_MODULE: '3S'\n_SECTION_NAME: '" + section + "'\n_MODULE_NAME: '" + name + "'\n" +
         inside + "_END_MODULE\n";
}

TEST(ExpReader, aBusInsideAnotherOneIsALoss) {
  const std::string drive = module("Drive", "Ram", "_PARAM 201: 0, '7'\n");
  const Model model =
      read("PLC_CONFIGURATION\n" +
           module("BusInterface", "A",
                  module("AxisGroup", "G",
                         "_PARAM 99: 0, '1'\n" + module("BusInterface", "B", drive) +
                             "_PARAM 100: 0, '2'\n" + drive + module("Encoder", "Belt", ""))) +
           module("BusInterface", "C", module("Drive", "Lone", "")) + "PLC_END\n");
  ASSERT_THAT(model.buses, SizeIs(2));
  ASSERT_THAT(model.buses[0].groups, SizeIs(1));
  EXPECT_THAT(model.buses[0].groups[0].numbered, SizeIs(2));
  EXPECT_THAT(model.buses[0].groups[0].drives, SizeIs(2));
  EXPECT_THAT(model.buses[0].groups[0].encoders, SizeIs(1));
  EXPECT_EQ(model.buses[1].name, "C");
  EXPECT_THAT(model.buses[1].groups, IsEmpty());
  ASSERT_THAT(model.leftOut, SizeIs(1));
  EXPECT_EQ(model.leftOut[0].object, "bus interface `B`");
  EXPECT_EQ(model.leftOut[0].origin.line, 9U);
}

TEST(ExpReader, anAttributeThatIsNotClosedTakesOneLine) {
  const Model model = read("(* a *)\n(* @PATH := '\\/Motion'\nPROGRAM P\nEND_PROGRAM\n");
  ASSERT_THAT(model.objects, SizeIs(1));
  EXPECT_THAT(model.objects[0].folder, ElementsAre("Motion"));
  ASSERT_THAT(model.leftOut, SizeIs(1));
  EXPECT_EQ(model.leftOut[0].object, "attribute @PATH");
  EXPECT_EQ(model.leftOut[0].origin.line, 2U);
  EXPECT_THAT(read("(* @SYMFILEFLAGS := 'a'\n'b' *)\nPROGRAM P\nEND_PROGRAM\n").leftOut, IsEmpty());
}

} // namespace
} // namespace stc::import
