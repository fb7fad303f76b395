// Files of programs: where they are, that runs with them repeat, what they cost others.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"
#include "tests/system/files/file_program.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class FilesOfAProgram : public ::testing::Test {
protected:
  FilesOfAProgram() {
    fs::create_directory(project());
    writeFile(project() / "stride.toml", kFileProject);
    writeFile(project() / "Main.st", kFileProgram);
  }
  fs::path project() const { return scratch_.path() / "p"; }
  fs::path path(const char *name) const { return scratch_.path() / name; }
  std::string content(const char *name) const { return readFile(path(name)); }

  /// `stride` and $HOST are the programs.
  ProcessResult shell(const std::string &script) {
    return runProcess(
        {"sh", "-c", "stride() { \"$STRIDE\" \"$@\"; }\n" + script}, scratch_.path(),
        {{"STRIDE", STRIDE_BINARY_DIR "/stride"}, {"HOST", STRIDE_BINARY_DIR "/stride-host"}});
  }

  ScratchDirectory scratch_;
};

constexpr const char *kTrace =
    " --trace PLC_PRG.step,PLC_PRG.rounds,PLC_PRG.waits,PLC_PRG.now.ulLow,PLC_PRG.h ";

TEST_F(FilesOfAProgram, SimulationsRepeat) {
  const ProcessResult result =
      shell("for i in 1 2; do stride sim p --for 2s --files f$i --out $i.csv --state-hash"
            " --print PLC_PRG.rounds,PLC_PRG.wrong" +
            std::string(kTrace) + "> $i.txt || exit 1; done");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(content("1.csv"), content("2.csv"));
  EXPECT_EQ(content("1.txt"), content("2.txt"));
  EXPECT_THAT(content("1.txt"), HasSubstr("PLC_PRG.wrong = 0\n"));
  EXPECT_THAT(content("1.txt"), Not(HasSubstr("PLC_PRG.rounds = 0\n")));
  EXPECT_EQ(content("f1/f0"), content("f2/f0"));
}

TEST_F(FilesOfAProgram, ARecordedRunIsRepeatedWithoutTheFiles) {
  const ProcessResult result =
      shell("stride run p --for 1500ms --quiet --record a.rec --out run.csv --print PLC_PRG" +
            std::string(kTrace) + "> run.txt && rm -r p/files && " +
            "stride sim p --replay a.rec --out sim.csv --print PLC_PRG" + std::string(kTrace) +
            "> sim.txt");
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(content("run.csv"), content("sim.csv"));
  EXPECT_EQ(content("run.txt"), content("sim.txt"));
  EXPECT_THAT(content("run.txt"), HasSubstr("PLC_PRG.wrong = 0\n"));
  EXPECT_THAT(content("run.txt"), Not(HasSubstr("PLC_PRG.rounds = 0\n")));
  EXPECT_FALSE(fs::exists(project() / "files"));
}

TEST_F(FilesOfAProgram, NobodyElseHasAThreadForThem) {
  writeFile(project() / "Main.st",
            "PROGRAM PLC_PRG\nVAR n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n");
  const auto threads = [this] {
    return shell("stride build p -o a.so -W off=lints >/dev/null && "
                 "{ \"$HOST\" run a.so --for 1s --quiet & p=$!; sleep 0.5; "
                 "cat /proc/$p/task/*/comm; wait $p; }")
        .out;
  };
  EXPECT_THAT(threads(), Not(HasSubstr("stride files")));
  writeFile(project() / "Main.st", kFileProgram);
  EXPECT_THAT(threads(), HasSubstr("stride files"));
}

TEST_F(FilesOfAProgram, LieWhereTheProjectSays) {
  writeFile(project() / "Main.st", "PROGRAM PLC_PRG\nVAR h : DWORD; END_VAR\n"
                                   "IF h = 0 THEN h := SysFileOpen('log.txt', 'w'); END_IF\n"
                                   "END_PROGRAM\n");
  const auto runs = [this](const std::string &settings, const std::string &options = {}) {
    writeFile(project() / "stride.toml", kFileProject + settings);
    const ProcessResult result = shell("stride sim p -W off=lints --for 20ms --quiet " + options);
    EXPECT_EQ(result.exitCode, 0) << result.err;
  };
  runs("");
  EXPECT_TRUE(fs::exists(path("p/files/log.txt")));
  runs("[files]\nroot = \"data/today\"\n");
  EXPECT_TRUE(fs::exists(path("p/data/today/log.txt")));
  runs("[files]\nroot = \"../shared\"\n");
  EXPECT_TRUE(fs::exists(path("shared/log.txt")));
  runs("[files]\nroot = \"" + path("absolute").string() + "\"\n");
  EXPECT_TRUE(fs::exists(path("absolute/log.txt")));
  runs("[files]\nroot = \"data\"\n", "--files elsewhere");
  EXPECT_TRUE(fs::exists(path("elsewhere/log.txt")));
  EXPECT_FALSE(fs::exists(path("p/data/log.txt")));
}

TEST_F(FilesOfAProgram, LieAnywhereIfTheProjectSaysSo) {
  writeFile(project() / "Main.st",
            "PROGRAM PLC_PRG\nVAR h : DWORD; e : SYSFILE_ERROR; END_VAR\n"
            "IF h = 0 THEN h := SysFileOpen('../up.txt', 'w'); e := SysFileGetError(); END_IF\n"
            "END_PROGRAM\n");
  const auto error = [this](const std::string &settings) {
    writeFile(project() / "stride.toml", kFileProject + settings);
    return shell("stride sim p -W off=lints --for 2ms --print PLC_PRG.e").out;
  };
  EXPECT_EQ(error(""), "PLC_PRG.e = OUTSIDE\n");
  EXPECT_FALSE(fs::exists(path("p/up.txt")));
  EXPECT_EQ(error("[files]\nanywhere = true\n"), "PLC_PRG.e = NONE\n");
  EXPECT_TRUE(fs::exists(path("p/up.txt")));
}

TEST_F(FilesOfAProgram, AnswerAfterTheDelayOfTheProject) {
  writeFile(project() / "Main.st", "PROGRAM PLC_PRG\nVAR h : DWORD; n : INT; END_VAR\n"
                                   "IF h = 0 THEN h := SysFileOpen('a', 'w'); n := n + 1; END_IF\n"
                                   "END_PROGRAM\n");
  const auto calls = [this](const std::string &settings) {
    writeFile(project() / "stride.toml", kFileProject + settings);
    return shell("stride sim p -W off=lints --for 100ms --print PLC_PRG.n").out;
  };
  EXPECT_EQ(calls(""), "PLC_PRG.n = 2\n");
  EXPECT_EQ(calls("[files]\ndelay = 0\n"), "PLC_PRG.n = 1\n");
  EXPECT_EQ(calls("[files]\ndelay = 7\n"), "PLC_PRG.n = 8\n");
}

TEST_F(FilesOfAProgram, AreThereInUnitTestsToo) {
  writeFile(project() / "Main.st", R"(PROGRAM PLC_PRG
END_PROGRAM

{attribute 'test'}
FUNCTION_BLOCK WritesALine
VAR_OUTPUT
  Done : BOOL;
END_VAR
VAR
  h : DWORD;
  text : STRING := 'line';
END_VAR
IF h = 0 THEN
  h := SysFileOpen('log.txt', 'w');
ELSE
  ASSERT_EQ(SysFileWrite(h, ADR(text), 4), 4);
  Done := TRUE;
END_IF
END_FUNCTION_BLOCK
)");
  const ProcessResult result = shell("stride test p -W off=lints");
  EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  EXPECT_EQ(content("p/files/log.txt"), "line");
}

} // namespace
} // namespace stride::test
