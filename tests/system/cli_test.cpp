// The commands of `stride`, from outside: exit codes, files, messages.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char *kCounter =
    "PROGRAM PLC_PRG\nVAR\n  n : INT;\nEND_VAR\nn := n + 1;\nEND_PROGRAM\n";
constexpr const char *kWrong =
    "PROGRAM PLC_PRG\nVAR\n  n : INT;\nEND_VAR\nn := m + 1;\nk := 2;\nEND_PROGRAM\n";

class Cli : public ::testing::Test {
protected:
  using Environment = std::vector<std::pair<std::string, std::string>>;

  ProcessResult stride(std::vector<std::string> arguments, Environment environment = {}) {
    arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
    environment.emplace_back("XDG_CACHE_HOME", (scratch_.path() / "cache").string());
    return runProcess(arguments, scratch_.path(), environment);
  }

  void succeed(const std::vector<std::string> &arguments) {
    const ProcessResult result = stride(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.out << result.err;
  }

  void write(const std::string &name, const std::string &text) {
    fs::create_directories((scratch_.path() / name).parent_path());
    writeFile(scratch_.path() / name, text);
  }

  std::string read(const std::string &name) { return readFile(scratch_.path() / name); }
  bool exists(const std::string &name) { return fs::exists(scratch_.path() / name); }

  size_t countFiles(const std::string &folder, const std::string &suffix) {
    size_t count = 0;
    for (const fs::directory_entry &entry :
         fs::recursive_directory_iterator(scratch_.path() / folder))
      count += entry.path().extension() == suffix ? 1 : 0;
    return count;
  }

  ScratchDirectory scratch_;
};

// --------------------------------------------------------------------------------------------------
// the program

TEST_F(Cli, ShowsItsVersionAndHelp) {
  EXPECT_THAT(stride({"--version"}).out, StartsWith("stride 0."));
  const ProcessResult help = stride({"--help"});
  EXPECT_EQ(help.exitCode, 0);
  for (const char *command : {"new", "check", "build", "sim", "plot", "explain"}) {
    EXPECT_THAT(help.out, HasSubstr(command));
    EXPECT_EQ(stride({command, "--help"}).exitCode, 0) << command;
  }
  EXPECT_EQ(stride({}).exitCode, 0);
}

TEST_F(Cli, RefusesWhatItDoesNotKnow) {
  for (const std::vector<std::string> &arguments :
       std::vector<std::vector<std::string>>{{"chek"},
                                             {"check", "--fast"},
                                             {"check", "a", "b"},
                                             {"plot"},
                                             {"new"},
                                             {"explain"},
                                             {"check", "--color", "blue"},
                                             {"build", "--emit", "rust"},
                                             {"help", "simm"},
                                             {"sim"}}) {
    const ProcessResult result = stride(arguments);
    EXPECT_EQ(result.exitCode, 1) << arguments[0];
    EXPECT_THAT(result.err, StartsWith("stride: "));
    EXPECT_THAT(result.out, IsEmpty());
  }
}

TEST_F(Cli, Help) {
  EXPECT_EQ(stride({"help"}).out, stride({"--help"}).out);
  EXPECT_THAT(stride({"help", "sim"}).out,
              AllOf(StartsWith("Build"), HasSubstr("Usage: stride sim ["), HasSubstr("--replay")));
  EXPECT_THAT(stride({"help", "ctl"}).out, HasSubstr("unforce"));
}

// ---------------------------------------------------------------------------------------------------------
// check

TEST_F(Cli, CheckIsSilentWhenAllIsWell) {
  write("a.st", kCounter);
  const ProcessResult result = stride({"check", "a.st"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_EQ(result.out + result.err, "");
}

TEST_F(Cli, CheckReportsAllErrorsWithASummary) {
  write("a.st", kWrong);
  const ProcessResult result = stride({"check", "a.st"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, AllOf(HasSubstr("a.st:5:6"), HasSubstr("a.st:6:1"),
                                HasSubstr("\nerror: 2 errors\n")));
  EXPECT_THAT(result.err, Not(HasSubstr("\x1b[")));
}

TEST_F(Cli, ColorsOnlyOnATerminalOrOnDemand) {
  write("a.st", kWrong);
  EXPECT_THAT(stride({"check", "a.st", "--color=always"}).err, HasSubstr("\x1b["));
  EXPECT_THAT(stride({"check", "a.st", "--color", "never"}).err, Not(HasSubstr("\x1b[")));
}

TEST_F(Cli, JsonIsAnObjectPerLineOnStandardOutput) {
  write("a.st", kWrong);
  const ProcessResult result = stride({"check", "a.st", "--format=json"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_EQ(result.err, "");
  const std::vector<std::string> lines = splitLines(result.out);
  ASSERT_EQ(lines.size(), 2U);
  for (const std::string &line : lines) {
    const nlohmann::json diagnostic = nlohmann::json::parse(line);
    EXPECT_EQ(diagnostic.at("severity"), "error");
    EXPECT_THAT(diagnostic.at("code").get<std::string>(), StartsWith("SE"));
    EXPECT_EQ(diagnostic.at("labels").at(0).at("file"), "a.st");
    EXPECT_GE(diagnostic.at("labels").at(0).at("line"), 5);
  }
  EXPECT_EQ(stride({"check", "nowhere.st", "--format=json"}).exitCode, 1);
  EXPECT_TRUE(nlohmann::json::accept(stride({"check", "nowhere.st", "--format=json"}).out));
}

TEST_F(Cli, WarningsDoNotFail) {
  write("p/a.st", kCounter);
  write("p/stride.toml",
        "[[task]]\nname = \"T\"\ninterval = \"T#1ms\"\nprograms = [\"PLC_PRG\", \"PLC_PRG\"]\n");
  const ProcessResult result = stride({"check", "p"});
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_THAT(result.err, AllOf(HasSubstr("warning[SE0822]"), HasSubstr("\nwarning: 1 warning\n")));
}

TEST_F(Cli, ABlockAloneCanBeChecked) {
  write("b.st", "FUNCTION_BLOCK B\nEND_FUNCTION_BLOCK\n");
  succeed({"check", "b.st"});
  EXPECT_THAT(stride({"build", "b.st"}).err, HasSubstr("error[SE0815]"));
}

TEST_F(Cli, PathsThatCannotBe) {
  fs::create_directory(scratch_.path() / "empty");
  EXPECT_THAT(stride({"check", "nowhere"}).err, HasSubstr("error[SE0830]"));
  EXPECT_THAT(stride({"check", "empty"}).err, HasSubstr("error[SE0831]"));
  EXPECT_THAT(stride({"check"}).err, HasSubstr("error[SE0831]"));
  write("e.st", "");
  EXPECT_THAT(stride({"check", "e.st"}).err, HasSubstr("error[SE0832]"));
  EXPECT_EQ(stride({"check", "e.st"}).exitCode, 1);
}

// -----------------------------------------------------------------------------------------------
// new, build, sim

TEST_F(Cli, ANewProjectBuildsAndMoves) {
  succeed({"new", "mill"});
  succeed({"check", "mill"});
  succeed({"build", "mill"});
  EXPECT_TRUE(exists("mill/build/app.so"));
  EXPECT_EQ(read("mill/build/.gitignore"), "*\n");
  succeed({"sim", "mill", "--for", "T#1s", "--trace", "Drive.fSetPosition,Drive.fSetVelocity",
           "--out", "t.csv"});
  const std::vector<std::string> rows = splitLines(read("t.csv"));
  ASSERT_EQ(rows.size(), 501U);
  EXPECT_EQ(rows[0], "t,Drive.fSetPosition,Drive.fSetVelocity");
  EXPECT_GT(std::stod(rows[500].substr(rows[500].find(',') + 1)), 10.0);
  succeed({"plot", "t.csv"});
  EXPECT_THAT(read("t.svg"),
              AllOf(HasSubstr("Position [u]"), HasSubstr("Velocity [u/s]"), HasSubstr("</svg>")));
}

TEST_F(Cli, EveryTemplateBuilds) {
  succeed({"new", "sub/plain", "--template", "plain"});
  succeed({"build", "sub/plain"});
  EXPECT_EQ(stride({"new", "x", "--template", "nothing"}).exitCode, 1);
  EXPECT_EQ(stride({"new", "sub/plain"}).exitCode, 1);
  EXPECT_EQ(stride({"new", ".."}).exitCode, 1);
}

TEST_F(Cli, NewSaysHowAShellGetsThere) {
  EXPECT_THAT(stride({"new", "wide mill"}).out, HasSubstr("cd 'wide mill'\n"));
  EXPECT_THAT(stride({"new", "--", "-mill"}).out, HasSubstr("cd ./-mill\n"));
}

TEST_F(Cli, BuildPutsTheApplicationWhereItIsTold) {
  write("a.st", kCounter);
  succeed({"build", "a.st", "-o", "out/x.so"});
  EXPECT_TRUE(exists("out/x.so"));
  succeed({"build", "a.st"});
  EXPECT_TRUE(exists("a.so"));
  EXPECT_FALSE(exists("build"));
}

TEST_F(Cli, BuildEmitsReadableSources) {
  write("a.st", kCounter);
  succeed({"build", "a.st", "--emit", "cpp", "-o", "cpp"});
  EXPECT_THAT(read("cpp/app.cpp"), HasSubstr("\"R\\tPLC_PRG\\t"));
  EXPECT_FALSE(exists("a.so"));
}

TEST_F(Cli, OnlyWhatChangedIsCompiled) {
  write("p/a.st", kCounter);
  write("p/b.st", "FUNCTION F : INT\nF := 1;\nEND_FUNCTION\n");
  succeed({"build", "p"});
  const size_t units = countFiles("cache", ".o");
  succeed({"build", "p"});
  EXPECT_EQ(countFiles("cache", ".o"), units);
  write("p/b.st", "FUNCTION F : INT\nF := 2;\nEND_FUNCTION\n");
  succeed({"build", "p"});
  // The function, and the application, which records the source files' hashes.
  EXPECT_LE(countFiles("cache", ".o"), units + 2);
  EXPECT_GT(countFiles("cache", ".o"), units);
}

TEST_F(Cli, ErrorsStopABuild) {
  write("a.st", kWrong);
  for (const std::vector<std::string> &arguments :
       std::vector<std::vector<std::string>>{{"build", "a.st"}, {"sim", "a.st", "--for", "T#1s"}}) {
    const ProcessResult result = stride(arguments);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_THAT(result.err, HasSubstr("error: 2 errors"));
  }
  EXPECT_FALSE(exists("a.so"));
}

TEST_F(Cli, SimulationReadsWritesAndPrints) {
  write("a.st", kCounter);
  const ProcessResult result = stride(
      {"sim", "a.st", "--for", "T#100ms", "--set", "T#50ms,PLC_PRG.n=100", "--print", "PLC_PRG.n"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out, "PLC_PRG.n = 105\n");
  EXPECT_NE(stride({"sim", "a.st", "--for", "T#100ms", "--print", "PLC_PRG.q"}).exitCode, 0);
  // An option takes one value: what follows is the program.
  EXPECT_EQ(stride({"sim", "--for", "T#30ms", "--print", "PLC_PRG.n", "a.st"}).out,
            "PLC_PRG.n = 3\n");
  EXPECT_NE(stride({"sim", "a.st", "--for", "long"}).exitCode, 0);
}

TEST_F(Cli, UncheckedAndDebugBuildsRunToo) {
  write("a.st", kCounter);
  for (const char *option : {"--unchecked", "--debug"}) {
    const ProcessResult result =
        stride({"sim", "a.st", option, "--for", "T#30ms", "--print", "PLC_PRG.n"});
    EXPECT_EQ(result.out, "PLC_PRG.n = 3\n") << result.err;
  }
}

TEST_F(Cli, ACompilerThatFailsIsOurFault) {
  write("p/a.st", kCounter);
  const ProcessResult result = stride({"build", "p"}, {{"STRIDE_CXX", "false"}});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("error[SE0990]"), HasSubstr("false -std=c++20"), HasSubstr(".cpp")));
}

TEST_F(Cli, AMissingCompilerIsNamed) {
  write("a.st", kCounter);
  const ProcessResult result = stride({"build", "a.st"}, {{"STRIDE_CXX", "no-such-compiler"}});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("error[SE0991]"), HasSubstr("no-such-compiler")));
}

TEST_F(Cli, AnInstalledStrideBuildsAndRuns) {
  const std::string prefix = (scratch_.path() / "usr").string();
  const ProcessResult install =
      runProcess({"cmake", "--install", STRIDE_BINARY_DIR, "--prefix", prefix}, scratch_.path());
  ASSERT_EQ(install.exitCode, 0) << install.err;
  write("a.st", kCounter);
  const ProcessResult result =
      runProcess({prefix + "/bin/stride", "sim", "a.st", "--for", "T#20ms", "--print", "PLC_PRG.n"},
                 scratch_.path(), {{"XDG_CACHE_HOME", (scratch_.path() / "cache").string()}});
  EXPECT_EQ(result.out, "PLC_PRG.n = 2\n") << result.err;
}

// -------------------------------------------------------------------------------------------------
// plot, explain

TEST_F(Cli, PlotSaysWhatIsWrongWithATrace) {
  write("bad.csv", "t,x\n0,1\n1\n");
  const ProcessResult result = stride({"plot", "bad.csv"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr("error[SE0835]"), HasSubstr("line 3")));
  EXPECT_FALSE(exists("bad.svg"));
  EXPECT_THAT(stride({"plot", "nowhere.csv"}).err, HasSubstr("error[SE0101]"));
}

TEST_F(Cli, PlotsColumnsAgainstEachOther) {
  write("t.csv", "t,Main.x,Main.a[1,2],Main.v\n0,0,0,1\n1,3,1,2\n2,3,5,3\n");
  succeed({"plot", "t.csv", "--xy", "Main.x,Main.a[1,2]", "--color", "main.v", "-o", "p.svg"});
  EXPECT_THAT(read("p.svg"), AllOf(HasSubstr("<polyline"), HasSubstr("Main.a[1,2]</text>")));
  succeed({"plot", "t.csv", "--xy", "Main.x,Main.v", "-o", "p.html"});
  EXPECT_THAT(read("p.html"), AllOf(HasSubstr("<svg"), HasSubstr("</script>")));
  EXPECT_THAT(stride({"plot", "t.csv", "--xy", "Main.x,Main.y"}).err,
              AllOf(HasSubstr("error[SE0835]"), HasSubstr("no column `Main.y`")));
  EXPECT_THAT(stride({"plot", "t.csv", "--xy", "Main.x"}).err, HasSubstr("names 1 columns"));
  EXPECT_NE(stride({"plot", "t.csv", "--color", "Main.v"}).exitCode, 0);
  EXPECT_NE(stride({"plot", "t.csv", "--xy", "Main.x,Main.v", "--panel", "Main.x"}).exitCode, 0);
}

TEST_F(Cli, ExplainKnowsCodesAndMotionErrors) {
  EXPECT_THAT(stride({"explain", "se0808"}).out,
              AllOf(StartsWith("SE0808: "), HasSubstr("wDriveId")));
  EXPECT_THAT(stride({"explain", "20"}).out, HasSubstr("SMC_REGULATOR_OR_START_NOT_SET"));
  EXPECT_THAT(stride({"explain", "smc_no_error"}).out, StartsWith("SMC_ERROR 0: SMC_NO_ERROR"));
  EXPECT_EQ(stride({"explain", "SE9999"}).exitCode, 1);
  EXPECT_THAT(stride({"explain", "--list"}).out,
              AllOf(HasSubstr("SE0808 config-duplicate-drive-id "),
                    HasSubstr(" two drives with one wDriveId\n")));
  EXPECT_THAT(stride({"explain", "0808"}).out, StartsWith("SE0808: "));
  EXPECT_THAT(stride({"explain", "Unused-Variable"}).out,
              AllOf(StartsWith("SE0390: "), HasSubstr("name: unused-variable\n"),
                    HasSubstr("severity: warning\n")));
}

// ---------------------------------------------------------------------------------------------
// severities

TEST_F(Cli, SeveritiesAreChosenOnTheCommandLine) {
  write("a.st", "PROGRAM Main\nVAR x : INT; END_VAR\nx := x;\nEND_PROGRAM\n");
  EXPECT_THAT(stride({"check", "a.st"}).err, HasSubstr("warning[SE0616]"));
  const ProcessResult raised = stride({"check", "a.st", "-W", "error=self-assignment"});
  EXPECT_THAT(raised.err, HasSubstr("error[SE0616]"));
  EXPECT_EQ(raised.exitCode, 1);
  EXPECT_EQ(stride({"check", "a.st", "-W", "off=se0616"}).err, "");
  EXPECT_THAT(stride({"check", "a.st", "-W", "error"}).err, HasSubstr("error[SE0616]"));
  EXPECT_THAT(stride({"check", "a.st", "-W", "off=all-warnings", "-W", "note=616"}).exitCode, 0);
}

TEST_F(Cli, WrongSeveritiesAreUsageErrors) {
  write("a.st", "PROGRAM Main\nVAR x : INT; END_VAR\nx := 1;\nEND_PROGRAM\n");
  const ProcessResult name = stride({"check", "a.st", "-W", "off=self-asignment"});
  EXPECT_EQ(name.exitCode, 1);
  EXPECT_THAT(name.err, HasSubstr("did you mean `self-assignment`?"));
  EXPECT_THAT(stride({"check", "a.st", "-W", "of=self-assignment"}).err,
              HasSubstr("none of error, warning, note, off"));
  EXPECT_THAT(stride({"check", "a.st", "-W", "off=unknown-name"}).err,
              HasSubstr("errors cannot be lowered"));
}

TEST_F(Cli, TheCommandLineGoesBeforeTheProject) {
  write("stride.toml", "[diagnostics]\nself-assignment = \"off\"\nall-warnings = \"error\"\n");
  write("a.st", "PROGRAM Main\nVAR x : INT; END_VAR\nx := x;\nIF FALSE THEN x := 1; END_IF\n"
                "END_PROGRAM\n");
  const ProcessResult plain = stride({"check"});
  EXPECT_THAT(plain.err, AllOf(Not(HasSubstr("SE0616")), HasSubstr("error[SE0611]")));
  const ProcessResult changed =
      stride({"check", "-W", "note=self-assignment", "-W", "off=constant-condition"});
  EXPECT_THAT(changed.err, AllOf(HasSubstr("note[SE0616]"), Not(HasSubstr("SE0611"))));
  EXPECT_EQ(changed.exitCode, 0);
}

TEST_F(Cli, JsonHasEditsForEditors) {
  write("a.st", "PROGRAM Main\nVAR i : INT; d : DINT; END_VAR\ni := d;\nEND_PROGRAM\n");
  const ProcessResult result = stride({"check", "a.st", "--format", "json"});
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("name"), "narrowing-conversion");
  const auto &edit = json.at("suggestions").at(0).at("edits").at(0);
  EXPECT_EQ(edit.at("text"), "DINT_TO_INT(d)");
  EXPECT_EQ(edit.at("line"), 3);
  EXPECT_EQ(edit.at("column"), 6);
  EXPECT_EQ(edit.at("endColumn"), 7);
}

} // namespace
} // namespace stride::test
