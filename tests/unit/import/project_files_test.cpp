// The project folder of an import.
#include "compiler/import/project_files.hpp"
#include "compiler/import/report.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>

namespace stc::import {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

TEST(ProjectFiles, everyObjectGetsAFileOfItsOwn) {
  Model model;
  model.objects = {
      {ObjectKind::Pou, "Main", {"Motion"}, "PROGRAM Main\nEND_PROGRAM\n", {"a.EXP", 4}},
      {ObjectKind::Pou, "MAIN", {"motion"}, "x", {"b.EXP", 7}},
      {ObjectKind::GlobalList, "../My List", {}, "y", {"b.EXP", 9}}};
  const std::vector<ProjectFile> files = projectFiles(model, {"Line", false});
  ASSERT_THAT(files, SizeIs(4));
  EXPECT_EQ(files[0].path, "Motion/Main.st");
  EXPECT_EQ(files[0].text, "PROGRAM Main\nEND_PROGRAM\n");
  EXPECT_EQ(files[1].path, "motion/MAIN_2.st");
  EXPECT_EQ(files[2].path, "___My_List.st");
  EXPECT_EQ(files[3].text, "[project]\nname = \"Line\"\n");
  EXPECT_THAT(reportOf(model, {"Line", false}, files, {}),
              HasSubstr("## Converted: 3\n\n- a.EXP:4: Main: Motion/Main.st\n"));
}

TEST(ProjectFiles, tasksAreThoseOfTheProjectFile) {
  Model model;
  model.tasks = {{"Fast", "3", "T#5ms", "", {"P", "Q"}, {"a.EXP", 2}, {}},
                 {"Go", "0", "", "s = \"a\"", {"R"}, {"a.EXP", 5}, {}},
                 {"Free", "", "", "", {}, {"a.EXP", 8}, {}},
                 {"While", "1", "", "on", {"S"}, {"a.EXP", 9}, "T#7ms", 3, true}};
  EXPECT_EQ(
      projectFiles(model, {"a\"b", false})[0].text,
      "[project]\nname = \"a\\\"b\"\n"
      "\n[[task]]\nname = \"Fast\"\ninterval = \"T#5ms\"\npriority = 3\nprograms = [\"P\", \"Q\"]\n"
      "\n[[task]]\nname = \"Go\"\nkind = \"event\"\nevent = \"s = \\\"a\\\"\"\npriority = "
      "0\nprograms = [\"R\"]\n"
      "\n[[task]]\nname = \"Free\"\nkind = \"freewheeling\"\nprograms = []\n"
      "\n[[task]]\nname = \"While\"\nkind = \"status\"\nevent = \"on\"\npriority = 1\n"
      "watchdog = \"T#7ms\"\nwatchdog_sensitivity = 3\nprograms = [\"S\"]\n");
}

TEST(ProjectFiles, numbersOfOtherToolsBecomeThoseOfToml) {
  EXPECT_EQ(tomlNumber("007"), "7");
  EXPECT_EQ(tomlNumber("-12"), "-12");
  EXPECT_EQ(tomlNumber(".5"), "0.5");
  EXPECT_EQ(tomlNumber("5."), "5.0");
  EXPECT_EQ(tomlNumber("1E3"), "1000.0");
  EXPECT_EQ(tomlNumber("9223372036854775807"), "9223372036854775807");
  EXPECT_EQ(tomlNumber("9223372036854775808"), "9.223372036854776e+18");
  for (const char *text : {"", ".", "5 ", "5a", "inf", "nan", "1e999", "16#1F"})
    EXPECT_EQ(tomlNumber(text), std::nullopt) << text;
  Model model;
  model.tasks = {{"T", "007", "", "", {"P"}, {"a.EXP", 2}, {}}};
  EXPECT_THAT(projectFiles(model, {"a", false})[0].text, HasSubstr("\npriority = 7\n"));
}

TEST(ProjectFiles, theReportNamesLossesFirst) {
  Model model;
  model.leftOut = {{{"a.EXP", 12}, "VISUALISATION Pic", "not imported"}};
  model.changed = {{{"a.EXP", 3}, "PROGRAM P", "comments"}};
  EXPECT_EQ(reportOf(model, {"Line", false}, projectFiles(model, {"Line", false}), {}),
            "# Import of Line\n\n## Left out: 1\n\n- a.EXP:12: VISUALISATION Pic: not imported\n"
            "\n## Check: no errors\n"
            "\n## Changed: 1\n\n- a.EXP:3: PROGRAM P: comments\n\n## Converted: 0\n\n");
}

} // namespace
} // namespace stc::import
