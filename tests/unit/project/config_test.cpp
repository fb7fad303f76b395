#include "compiler/project/config.hpp"

#include "compiler/source/render.hpp"
#include "compiler/syntax/parser.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

namespace stc {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

constexpr const char *kGroup = R"toml([[task]]
name = "BusTask"
interval = "T#3ms"
programs = ["Ipo"]
[[bus]]
name = "Bus"
InterfaceType = "Dummy (simulated drives)"
[[bus.axis_group]]
name = "AxisGroup"
sTask = "BusTask"
[[bus.axis_group.drive]]
name = "Drive"
wDriveId = 1
)toml";

class Config : public ::testing::Test {
protected:
  ProjectConfig read(const std::string &toml) {
    const FileId id = sources_.add("stride.toml", toml);
    return readConfig(sources_.file(id), diagnostics_);
  }

  // Reads and completes a configuration for a program text.
  ProjectConfig resolve(const std::string &toml, const std::string &program,
                        ProgramCheck check = ProgramCheck::Runnable) {
    ProjectConfig config = read(toml);
    const FileId id = sources_.add("Main.st", program);
    files_ = {parse(sources_.file(id), interner_, arena_, diagnostics_)};
    resolveTasks(config, files_, check, diagnostics_);
    declarations_ = plcDeclarations(config, files_, diagnostics_);
    return config;
  }

  // Code and marked text of each diagnostic.
  std::vector<std::pair<std::string, std::string>> found() const {
    std::vector<std::pair<std::string, std::string>> result;
    for (const Diagnostic &d : diagnostics_.all())
      result.emplace_back(codeName(d.code),
                          d.labels.empty() ? "" : std::string(sources_.text(d.labels[0].span)));
    return result;
  }

  std::string rendered() const {
    std::string text;
    for (const Diagnostic &d : diagnostics_.all())
      text += renderText(d, sources_);
    return text;
  }

  Sources sources_;
  Interner interner_;
  Arena arena_;
  Diagnostics diagnostics_;
  std::vector<ast::File *> files_;
  SyntheticSource declarations_{""};
};

TEST_F(Config, ReadsTasksGroupsAndDrives) {
  const ProjectConfig config =
      read(std::string("[project]\nname = \"P\"\nsoftmotion = \"3\"\n") + kGroup);
  EXPECT_THAT(found(), IsEmpty()) << rendered();
  EXPECT_EQ(config.name, "P");
  EXPECT_EQ(config.generation, 3U);
  ASSERT_EQ(config.tasks.size(), 1U);
  EXPECT_EQ(config.tasks[0].intervalNs, 3'000'000);
  ASSERT_EQ(config.axisGroups.size(), 1U);
  EXPECT_EQ(config.axisGroups[0].driver, "Dummy");
  ASSERT_EQ(config.axisGroups[0].drives.size(), 1U);
  EXPECT_THAT(config.axisGroups[0].drives[0].fields, Contains(Pair("wDriveId", "1")));
}

TEST_F(Config, SyntaxErrorHasItsPlace) {
  EXPECT_TRUE(read("[project]\nname = \n").incomplete);
  ASSERT_EQ(found().size(), 1U);
  EXPECT_EQ(found()[0].first, "SE0801");
  EXPECT_THAT(rendered(), HasSubstr("stride.toml:2:"));
}

TEST_F(Config, UnquotedDurationIsExplained) {
  (void)read("[[task]]\ninterval = T#3ms\n");
  EXPECT_THAT(rendered(), HasSubstr("put it in quotes"));
}

TEST_F(Config, DuplicateKeyIsASyntaxError) {
  (void)read("[project]\nname = \"a\"\nname = \"b\"\n");
  EXPECT_EQ(found()[0].first, "SE0801");
}

TEST_F(Config, UnknownParameterIsMarkedExactly) {
  (void)read(std::string(kGroup) + "driveid = 2\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0802", "driveid"))) << rendered();
}

TEST_F(Config, KeyInWrongCaseGetsTheRightSpelling) {
  (void)read(std::string(kGroup) + "fposITIONperiod = 2\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0802", "fposITIONperiod")));
  EXPECT_THAT(rendered(), HasSubstr("write `fPositionPeriod`: upper and lower case count here"));
}

TEST_F(Config, MisplacedParameterIsSentHome) {
  (void)read("[project]\nwDriveId = 1\n");
  EXPECT_THAT(rendered(), HasSubstr("belongs into [[bus.axis_group.drive]]"));
}

TEST_F(Config, UnknownSection) {
  (void)read("[taks]\nname = 1\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0802", "taks")));
  EXPECT_THAT(rendered(), HasSubstr("did you mean `task`?"));
}

TEST_F(Config, WrongTypes) {
  (void)read(std::string(kGroup) +
             "bSWLimitEnable = \"true\"\nfSWMaxVelocity = \"fast\"\nbHWLimitEnable = 1\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0803", "\"true\""), Pair("SE0803", "\"fast\""),
                                   Pair("SE0803", "1")));
}

TEST_F(Config, SingleBracketsForAList) {
  (void)read("[task]\nname = \"T\"\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0803", "task")));
  EXPECT_THAT(rendered(), HasSubstr("write the header as [[task]]"));
}

TEST_F(Config, OutOfRange) {
  (void)read(std::string(kGroup) +
             "dwRatioTechUnitsDenom = 0\niRatioTechUnitsNum = 40000\nfSWMaxVelocity = -1.5\n");
  EXPECT_THAT(found(),
              ElementsAre(Pair("SE0804", "0"), Pair("SE0804", "40000"), Pair("SE0804", "-1.5")));
}

TEST_F(Config, UnknownChoiceOffersTheNearest) {
  (void)read(std::string(kGroup) + "iMovementType = \"linaer\"\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0805", "\"linaer\"")));
  EXPECT_THAT(rendered(), HasSubstr("did you mean \"linear\"?"));
}

TEST_F(Config, ChoicesByNameOrNumber) {
  const ProjectConfig config =
      read(std::string(kGroup) + "wControlType = \"pos,vel->pos,vel\"\niMovementType = 1\n");
  EXPECT_THAT(found(), IsEmpty()) << rendered();
  EXPECT_THAT(config.axisGroups[0].drives[0].fields, Contains(Pair("wControlType", "5")));
  const ProjectConfig seventh =
      read(std::string(kGroup) + "wControlType = 7\nwCyclicDataS1 = 1160\n");
  EXPECT_THAT(seventh.axisGroups[0].drives[0].fields, Contains(Pair("wControlType", "0")));
  EXPECT_THAT(seventh.axisGroups[0].drives[0].fields, Contains(Pair("byControllerMode", "1")));
}

TEST_F(Config, MissingParameters) {
  (void)read("[[task]]\nname = \"T\"\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0806", "task"), Pair("SE0806", "task")));
  EXPECT_THAT(rendered(), HasSubstr("a task needs `interval`"));
  EXPECT_THAT(rendered(), HasSubstr("a task needs `programs`"));
}

TEST_F(Config, RotaryDriveNeedsItsPeriod) {
  (void)read(std::string(kGroup) + "iMovementType = \"rotary\"\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0806", "\"rotary\"")));
}

TEST_F(Config, JerkLimitedRampNeedsItsJerk) {
  (void)read(std::string(kGroup) + "eRampType = \"parabolic\"\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0806", "\"parabolic\"")));
}

TEST_F(Config, NamesAreUniqueWhateverTheirCase) {
  (void)read(std::string(kGroup) + "[[bus.axis_group.drive]]\nname = \"DRIVE\"\nwDriveId = 2\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0807", "\"DRIVE\"")));
}

TEST_F(Config, DriveIdsAreUnique) {
  (void)read(std::string(kGroup) + "[[bus.axis_group.drive]]\nname = \"Other\"\nwDriveId = 1\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0808", "1")));
  EXPECT_EQ(diagnostics_.all()[0].labels.size(), 2U);
}

TEST_F(Config, PeriodTimesRatioHasALimit) {
  const std::string rotary =
      std::string(kGroup) + "iMovementType = \"rotary\"\nfPositionPeriod = 360.0\n";
  (void)read(rotary + "dwRatioTechUnitsDenom = 2147483648\niRatioTechUnitsNum = 360\n");
  EXPECT_THAT(found(), IsEmpty()) << rendered();
  (void)read(rotary + "dwRatioTechUnitsDenom = 2147483649\niRatioTechUnitsNum = 360\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0811", "360.0")));
}

TEST_F(Config, BadInterval) {
  (void)read("[[task]]\nname = \"T\"\ninterval = \"3 ms\"\nprograms = [\"A\"]\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0814", "\"3 ms\"")));
}

TEST_F(Config, NamesMustBeIdentifiers) {
  (void)read(
      "[[bus]]\nname = \"A bus\"\nInterfaceType = \"Dummy\"\n[[bus.axis_group]]\nname = \"IF\"\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0817", "\"A bus\""), Pair("SE0817", "\"IF\"")));
}

TEST_F(Config, LimitsMustBeInOrderAndComplete) {
  (void)read(std::string(kGroup) +
             "bSWLimitEnable = true\nfSWLimitNegative = 5\nfSWLimitPositive = -5\n");
  (void)read(std::string(kGroup) + "bSWLimitEnable = true\nfSWLimitNegative = 5\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0819", "5"), Pair("SE0819", "true")));
}

TEST_F(Config, ParametersWithoutEffectAreWarnings) {
  (void)read(std::string(kGroup) + "fPositionPeriod = 360\nfJerk = 5.0\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0820", "fPositionPeriod"), Pair("SE0820", "fJerk")));
  EXPECT_FALSE(diagnostics_.hasErrors());
}

TEST_F(Config, UnknownDriver) {
  (void)read("[[bus]]\nname = \"B\"\nInterfaceType = \"Dumy (x)\"\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0821", "\"Dumy (x)\"")));
  EXPECT_THAT(rendered(), HasSubstr("did you mean `Dummy`?"));
}

// ------------------------------------------------------------------------------------------ with
// the program

constexpr const char *kIpo = "PROGRAM Ipo\nEND_PROGRAM\n";

TEST_F(Config, TaskInSTaskMustExist) {
  std::string toml = kGroup;
  toml.replace(toml.find("sTask = \"BusTask\""), 17, "sTask = \"BusTsk\"");
  resolve(toml, kIpo);
  EXPECT_THAT(found(), ElementsAre(Pair("SE0809", "\"BusTsk\""))) << rendered();
  EXPECT_THAT(rendered(), HasSubstr("did you mean `BusTask`?"));
}

TEST_F(Config, OneTaskNeedsNoSTask) {
  std::string toml = kGroup;
  toml.replace(toml.find("sTask = \"BusTask\""), 17, "");
  const ProjectConfig config = resolve(toml, kIpo);
  EXPECT_THAT(found(), IsEmpty()) << rendered();
  EXPECT_EQ(config.axisGroups[0].task.text, "BusTask");
  EXPECT_EQ(config.axisGroups[0].cycleUs, 3000U);
}

TEST_F(Config, SeveralTasksNeedSTask) {
  std::string toml = kGroup;
  toml.replace(toml.find("sTask = \"BusTask\""), 17, "");
  toml = "[[task]]\nname = \"Slow\"\ninterval = \"T#1s\"\nprograms = [\"Other\"]\n" + toml;
  resolve(toml, std::string(kIpo) + "PROGRAM Other\nEND_PROGRAM\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0809", "axis_group"))) << rendered();
}

TEST_F(Config, CycleMustFitTheTask) {
  std::string toml = kGroup;
  toml.insert(toml.find("[[bus.axis_group.drive]]"), "dwCycle = 3\n");
  resolve(toml, kIpo);
  EXPECT_THAT(found(), ElementsAre(Pair("SE0810", "3")));
  EXPECT_THAT(rendered(), HasSubstr("dwCycle = 3000"));
}

TEST_F(Config, UnknownProgram) {
  resolve(kGroup, "PROGRAM Ipu\nEND_PROGRAM\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0812", "\"Ipo\"")));
  EXPECT_THAT(rendered(), HasSubstr("did you mean `Ipu`?"));
}

TEST_F(Config, TasksCallProgramsOnly) {
  resolve(kGroup, "FUNCTION_BLOCK Ipo\nEND_FUNCTION_BLOCK\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0813", "\"Ipo\"")));
}

TEST_F(Config, ProgramCalledTwiceIsAWarning) {
  std::string toml = kGroup;
  toml.replace(toml.find("[\"Ipo\"]"), 7, "[\"Ipo\", \"ipo\"]");
  resolve(toml, kIpo);
  EXPECT_THAT(found(), ElementsAre(Pair("SE0822", "\"ipo\"")));
  EXPECT_FALSE(diagnostics_.hasErrors());
}

TEST_F(Config, WithoutTasksPlcPrgIsCalled) {
  const ProjectConfig config =
      resolve("", "PROGRAM A\nEND_PROGRAM\nPROGRAM plc_prg\nEND_PROGRAM\n");
  EXPECT_THAT(found(), IsEmpty()) << rendered();
  ASSERT_EQ(config.tasks.size(), 1U);
  EXPECT_EQ(config.tasks[0].name.text, "Task");
  EXPECT_EQ(config.tasks[0].intervalNs, 10'000'000);
  ASSERT_EQ(config.tasks[0].programs.size(), 1U);
  EXPECT_EQ(config.tasks[0].programs[0].text, "plc_prg");
}

TEST_F(Config, WithoutTasksTheOnlyProgramIsCalled) {
  const ProjectConfig config = resolve("", kIpo);
  EXPECT_THAT(found(), IsEmpty()) << rendered();
  EXPECT_EQ(config.tasks[0].programs[0].text, "Ipo");
}

TEST_F(Config, SeveralProgramsNeedATask) {
  resolve("", "PROGRAM A\nEND_PROGRAM\nPROGRAM B\nEND_PROGRAM\n");
  EXPECT_THAT(found(), ElementsAre(Pair("SE0816", "A")));
}

TEST_F(Config, ACheckNeedsNoProgram) {
  const std::string block = "FUNCTION_BLOCK B\nEND_FUNCTION_BLOCK\n";
  resolve("", block, ProgramCheck::Existing);
  EXPECT_THAT(found(), IsEmpty());
  resolve("", block);
  EXPECT_THAT(found(), ElementsAre(Pair("SE0815", "")));
}

TEST_F(Config, AfterSyntaxErrorsProgramsAreNotMissed) {
  resolve(kGroup, "PROGRAM Other\nEND_PROGRAM\n", ProgramCheck::Skip);
  EXPECT_THAT(found(), IsEmpty());
}

TEST_F(Config, DrivesBecomeGlobalVariables) {
  resolve(kGroup, kIpo);
  const std::string &text = declarations_.text();
  EXPECT_THAT(text, HasSubstr("Drive : SM_DriveBasic.AXIS_REF := (wDriveId := 1"));
  EXPECT_THAT(text, HasSubstr("fTaskCycle := 0.003000000"));
  EXPECT_THAT(text,
              HasSubstr("AxisGroup : SM_DriveBasic.SMC_AXISGROUP_REF := (sTask := 'BusTask'"));
  const FileId id = sources_.add(declarations_);
  const auto originOf = [&](std::string_view what) {
    const auto at = static_cast<uint32_t>(text.find(what));
    return sources_.text(sources_.origin({id, at, at + 1}));
  };
  EXPECT_EQ(originOf("SM_DriveBasic.AXIS_REF"), "\"Drive\"");
  EXPECT_EQ(originOf("SM_DriveBasic.SMC_AXISGROUP_REF"), "\"AxisGroup\"");
  EXPECT_EQ(originOf("VAR_GLOBAL"), "");
  EXPECT_EQ(originOf("END_VAR"), "");
}

TEST_F(Config, DriveNamedLikeAProgram) {
  std::string toml = kGroup;
  toml.replace(toml.find("\"Drive\""), 7, "\"IPO\"");
  resolve(toml, kIpo);
  EXPECT_THAT(found(), ElementsAre(Pair("SE0818", "\"IPO\"")));
  EXPECT_THAT(declarations_.text(), ::testing::Not(HasSubstr("IPO")));
}

} // namespace
} // namespace stc
