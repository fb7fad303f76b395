// What a user meets in a day: wrong command lines, the status line of a run, `stride ctl` without
// an address, faults that name what explains them.
#include "tests/system/run_scene.hpp"

#include <gmock/gmock-matchers.h>

namespace stride::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class UserDay : public Run {
protected:
  /// A project `plant` with a counter in a task of 2 ms; `more` stands among its variables.
  void writePlant(const std::string &more) {
    write("plant/stride.toml",
          "[project]\nname = \"plant\"\n[[task]]\nname = \"Fast\"\ninterval = \"2ms\"\n"
          "programs = [\"Main\"]\n");
    write("plant/Main.st",
          "PROGRAM Main\nVAR\n  n : DINT;\n" + more + "END_VAR\nn := n + 1;\nEND_PROGRAM\n");
  }
};

TEST_F(UserDay, ACommandLineThatIsWrongNamesTheWordAndTheNearestOne) {
  const auto wrong = [&](const std::vector<std::string> &arguments) {
    const ProcessResult result = stride(arguments);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  EXPECT_EQ(wrong({"chek"}), "stride: there is no command `chek`; did you mean `check`?\n"
                             "Try: stride --help\n");
  EXPECT_EQ(wrong({"cam", "polt"}), "stride: there is no command `polt`; did you mean `plot`?\n"
                                    "Try: stride cam --help\n");
  EXPECT_EQ(wrong({"sim", "p", "--fro", "5s"}),
            "stride: there is no option `--fro`; did you mean `--for`?\nTry: stride sim --help\n");
  EXPECT_EQ(wrong({"check", "--zzz=1"}),
            "stride: there is no option `--zzz`\nTry: stride check --help\n");
  EXPECT_EQ(wrong({"check", "a", "b"}), "stride: `b` was not expected\nTry: stride check --help\n");
  EXPECT_EQ(wrong({"help", "simm"}),
            "stride: there is no command `simm`; did you mean `sim`?\nTry: stride help --help\n");
  EXPECT_THAT(wrong({"cam"}), StartsWith("stride: name a command: check, bounds, plot, "));
  EXPECT_EQ(wrong({"ctl", "unix:s", "raed", "x"}),
            "error: there is no command 'raed'; did you mean 'read'?\n"
            "  'stride ctl --help' lists the options\n");
  EXPECT_EQ(wrong({"ctl", "unix:s", "watch", "x", "--cuont", "3"}),
            "error: there is no option '--cuont'; did you mean '--count'?\n"
            "  'stride ctl watch --help' lists the options\n");
  EXPECT_THAT(stride({"ctl", "--help"}).out,
              AllOf(HasSubstr("Usage: stride ctl "), Not(HasSubstr("stride-host"))));
}

TEST_F(UserDay, FoldersThatCannotBeWrittenAreNoDefectOfStride) {
  writePlant("");
  // The compilers' temporary files go where Stride compiles.
  const ProcessResult built =
      shell("TMPDIR=/proc XDG_CACHE_HOME=/proc \"$STRIDE\" build plant -o plant.so");
  EXPECT_EQ(built.exitCode, 0) << built.err;
  EXPECT_THAT(built.err, AllOf(HasSubstr("the cache folder `/proc/stride` is not used"),
                               Not(HasSubstr("SE0990"))));
  const ProcessResult elsewhere = stride({"build", "plant", "-o", "/proc/plant.so"});
  EXPECT_EQ(elsewhere.exitCode, 1);
  EXPECT_THAT(elsewhere.err, StartsWith("error[SE0833]: `/proc/plant.so` cannot be written: "));
}

TEST_F(UserDay, AFaultEndsWithWhatExplainsIt) {
  writePlant("  zero : DINT;\n");
  write("plant/Main.st",
        readFile(scratch_.path() / "plant/Main.st") +
            "{attribute 'test'}\nFUNCTION_BLOCK Divides\nVAR n, z : DINT; END_VAR\n"
            "n := 1 / z;\nEND_FUNCTION_BLOCK\n");
  const ProcessResult result = stride({"test", "plant"});
  EXPECT_NE(result.exitCode, 0);
  EXPECT_THAT(result.out + result.err,
              ContainsRegex("division by zero at Main.st:[0-9]+:[0-9]+ .*; "
                            "stride explain SR0001"));
  EXPECT_THAT(stride({"explain", "sr0001"}).out,
              AllOf(StartsWith("SR0001: division by zero\n"), HasSubstr("IF parts <> 0 THEN")));
  EXPECT_EQ(stride({"explain", "SR0014"}).exitCode, 1);
}

TEST_F(UserDay, ARunShowsHowItIsDoingOnATerminalOnly) {
  build("a", kCounter);
  const std::vector<std::string> run = {STRIDE_BINARY_DIR "/stride-host", "run", "a.so", "--for",
                                        "700ms"};
  EXPECT_THAT(runOnTerminal(run, scratch_.path()).out,
              ContainsRegex("running 0\\.[5-7] s \\| Fast: [0-9]+ cycles, [0-9.]+ us \\(at most "
                            "[0-9.]+\\), [0-9]+ overruns?.*\r\033\\[K"));
  const ProcessResult piped = command(run);
  EXPECT_THAT(piped.out + piped.err, Not(HasSubstr("running")));
}

TEST_F(UserDay, CtlFindsTheRunOfItsProject) {
  writePlant("");
  fs::create_directories(scratch_.path() / "plant/parts");
  const ProcessResult result =
      shell("export XDG_RUNTIME_DIR=$PWD/runtime; mkdir -m 700 runtime\n"
            "\"$STRIDE\" ctl state; echo $?\n"
            "(cd plant && exec \"$STRIDE\" run --listen --for 60s --quiet) & run=$!\n"
            "i=0; while ! ls runtime/stride/*.sock >/dev/null 2>&1 && [ $i -lt 400 ]; do "
            "sleep 0.05; i=$((i+1)); done\n"
            "(cd plant/parts && \"$STRIDE\" ctl write Main.n=-100000 && "
            "\"$STRIDE\" ctl watch Main.n --period 20ms --count 2)\n"
            "\"$STRIDE\" ctl ./plant end; wait $run; echo ended with $?\n");
  EXPECT_THAT(result.err,
              ContainsRegex("^stride: no run of `.*` listens: start it with `stride run "
                            "--listen`, or name its socket: stride ctl unix:PATH\n$"));
  EXPECT_THAT(result.out, ContainsRegex("^1\nt\tMain.n\n[0-9.]+\t-[0-9]+\n[0-9.]+\t-[0-9]+\n"
                                        "ended with 0\n$"));
}

/// The rows of a CSV file, without the header.
std::vector<std::string> rowsOf(const std::string &csv) {
  std::vector<std::string> lines = splitLines(csv);
  if (!lines.empty())
    lines.erase(lines.begin());
  return lines;
}

TEST_F(UserDay, ARecordingOutlivesOnlineChanges) {
  writePlant("  extra, gone : DINT := 7;\n");
  const auto change = [](const std::string &line, const std::string &options) {
    return "sed -i 's/  extra, gone.*/" + line + "/; s/  extra :.*/" + line +
           "/' plant/Main.st\n\"$STRIDE\" build plant && \"$STRIDE\" ctl unix:s change " + options +
           " >>changes 2>&1; echo $? >>changes\n";
  };
  const std::string record = "\"$STRIDE\" ctl unix:s record Main.n Main.";
  const ProcessResult result =
      shell("\"$STRIDE\" run plant --listen unix:s --for 60s --quiet & run=$!\n"
            "i=0; while [ ! -S s ] && [ $i -lt 400 ]; do sleep 0.05; i=$((i+1)); done\n" +
            record + "extra --rows 900 --out kept.csv & kept=$!\nsleep 0.2\n" +
            change("  extra : DINT := 7; gone : DINT; more : INT;", "") + "wait $kept\n" + record +
            "gone --rows 1000000 --out cut.csv & cut=$!\nsleep 0.2\n" +
            change("  extra : DINT := 7;", "") + change("  extra : STRING;", "") +
            change("  extra : STRING;", "--accept-losses") +
            "wait $cut\n\"$STRIDE\" ctl unix:s end; wait $run\n");
  EXPECT_EQ(result.exitCode, 0) << result.err;
  const std::vector<std::string> kept = rowsOf(readFile(scratch_.path() / "kept.csv"));
  ASSERT_EQ(kept.size(), 900U);
  const auto counted = [](const std::string &row) {
    return std::stol(row.substr(row.find(',') + 1));
  };
  EXPECT_EQ(counted(kept.back()) - counted(kept.front()), 899) << "cycles are missing";
  const std::vector<std::string> cut = rowsOf(readFile(scratch_.path() / "cut.csv"));
  ASSERT_GT(cut.size(), 50U);
  EXPECT_LT(cut.size(), 1000000U);
  EXPECT_THAT(result.err,
              ContainsRegex("warning: the recording ended at an online change: .*gone"));
  EXPECT_THAT(readFile(scratch_.path() / "changes"),
              AllOf(ContainsRegex("^note: online change done.*\n0\n"),
                    HasSubstr("values would be lost; --accept-losses allows that\n"),
                    ContainsRegex("note: online change done; [^\n]*\n0\n$")));
}

} // namespace
} // namespace stride::test
