// `stride import` on small projects of other tools, then their simulation.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class ImportProjects : public ::testing::Test {
protected:
  ProcessResult stride(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    return runProcess(arguments, scratch_.path());
  }
  ProcessResult import(const std::string &file) {
    return stride({"import", (fs::path(STRIDE_SOURCE_DIR "/tests/system/import") / file).string(),
                   "-o", "project"});
  }
  std::string simulated(const std::string &time, const std::string &values) {
    const ProcessResult result = stride({"sim", "project", "--for", time, "--print", values});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return result.out;
  }
  std::string read(const std::string &name) { return readFile(scratch_.path() / "project" / name); }

  ScratchDirectory scratch_;
};

TEST_F(ImportProjects, RunsATwinCatProjectWithAnAxis) {
  const ProcessResult result = import("twincat/Machine.tsproj");
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("Imported 5 objects from 9 files into project: 0 left out"));
  EXPECT_THAT(result.out, HasSubstr("0 errors in the check"));
  const std::string toml = read("stride.toml");
  EXPECT_THAT(toml, HasSubstr("[[library]]\nname = \"Tc2_MC2\"\n"));
  EXPECT_THAT(toml, HasSubstr("interval = \"T#2000us\""));
  EXPECT_THAT(toml, HasSubstr("name = \"Feed_Axis\""));
  EXPECT_THAT(toml, HasSubstr("dwRatioTechUnitsDenom = 1000\n"));
  EXPECT_THAT(toml, HasSubstr("fSWLimitPositive = 75.5\n"));
  EXPECT_THAT(read("Axis_Links.st"),
              HasSubstr("GVL_Machine.FeedAxis.pDrive : POINTER TO SM_DriveBasic.AXIS_REF := "
                        "ADR(Feed_Axis);"));
  EXPECT_THAT(read("POUs/FB_Feeder.st"), HasSubstr("METHOD MoveTo : BOOL"));
  // The linked axis goes to 12.5 and back to 4, with a drive; the other one to -3, without.
  EXPECT_EQ(simulated("T#2s", "MAIN.farthest,MAIN.lineAt,MAIN.step,MAIN.feeder.nMoves,"
                              "MAIN.feeder.nErrorId,MAIN.line.nErrorId,Feed_Axis.fActPosition"),
            "MAIN.farthest = 12.5\nMAIN.lineAt = -3.0\nMAIN.step = Back\nMAIN.feeder.nMoves = 2\n"
            "MAIN.feeder.nErrorId = 0\nMAIN.line.nErrorId = 0\nFeed_Axis.fActPosition = 4.0\n");
}

TEST_F(ImportProjects, RunsAnExportOfCodesys) {
  const ProcessResult result = import("Mixer.export");
  EXPECT_EQ(result.exitCode, 1) << "the visualization is lost";
  EXPECT_THAT(result.out, HasSubstr("Imported 4 objects from 1 file into project: 1 left out"));
  EXPECT_THAT(result.out, HasSubstr("0 errors in the check"));
  EXPECT_THAT(read("import-report.md"), HasSubstr("visualization Screen"));
  EXPECT_TRUE(fs::exists(scratch_.path() / "project/Mixing/Mixer.st"));
  // 20 cycles of 0.5 until it is full, which is counted once.
  EXPECT_EQ(simulated("T#1s", "Plant.Level,PLC_PRG.mixer.nFull"),
            "Plant.Level = 10.0\nPLC_PRG.mixer.nFull = 1\n");
}

TEST_F(ImportProjects, RunsASourceOfScl) {
  const ProcessResult result = import("Tank.scl");
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("Imported 9 objects from 1 file into project: 0 left out"));
  // What the source says, as far as the simulation got.
  const std::string out = simulated("T#1s", "Tank.Cycles,Filling_DB.Values.Pump.Starts,Tank.Level");
  const size_t begin = out.find("= ") + 2;
  const int cycles = std::stoi(out.substr(begin));
  EXPECT_GT(cycles, 50);
  double level = 3.0;
  int starts = 0;
  bool on = false;
  for (int i = 0; i < cycles; ++i) {
    const bool before = on;
    on = level < 2.0 || (on && level <= 7.5);
    starts += on && !before ? 1 : 0;
    level += on ? 0.25 : -0.125;
  }
  EXPECT_GT(starts, 1);
  std::string text = std::to_string(level);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.')
    text += '0';
  EXPECT_EQ(out, "Tank.Cycles = " + std::to_string(cycles) + "\nFilling_DB.Values.Pump.Starts = " +
                     std::to_string(starts) + "\nTank.Level = " + text + "\n");
  // -1.5 has the bits 16#BFC0_0000, which are 3217031168; 2024-02-29 was a Thursday.
  EXPECT_EQ(simulated("T#100ms", "Stamp_DB.Bits,Stamp_DB.Sign,Stamp_DB.At.WEEKDAY,"
                                 "Stamp_DB.At.NANOSECOND"),
            "Stamp_DB.Bits = 3217031168\nStamp_DB.Sign = TRUE\nStamp_DB.At.WEEKDAY = 5\n"
            "Stamp_DB.At.NANOSECOND = 250000000\n");
}

} // namespace
} // namespace stride::test
