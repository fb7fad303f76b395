// New projects, saving a file while something watches, pictures that know their project.
#include "tests/system/run_scene.hpp"

#include <gmock/gmock.h>

namespace stride::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Projects : public Run {};

/// Checked without a word, formatted, tested; with a README whose commands are those of the test of
/// pages.
class Template : public Projects, public ::testing::WithParamInterface<const char *> {};

TEST_P(Template, IsTestedFormattedAndSaysWhatItIs) {
  const std::string name = GetParam();
  const ProcessResult made = stride({"new", "made", "--template", name});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  EXPECT_THAT(made.out, StartsWith("Created made. Try:\n"));
  const ProcessResult check = stride({"check", "made"});
  EXPECT_EQ(check.out + check.err, "") << name;
  const ProcessResult format = stride({"fmt", "made", "--check"});
  EXPECT_EQ(format.exitCode, 0) << format.out << format.err;
  const ProcessResult test = stride({"test", "made"});
  EXPECT_EQ(test.exitCode, 0) << test.out << test.err;
  EXPECT_THAT(test.out, ContainsRegex("test result: ok. [12] passed; 0 failed")) << name;
  EXPECT_THAT(readFile(scratch_.path() / "made/README.md"),
              AllOf(StartsWith("# made\n"), HasSubstr("stride test\n")));
  EXPECT_THAT(readFile(scratch_.path() / "made/.gitignore"), HasSubstr("/build/\n"));
  EXPECT_THAT(readFile(scratch_.path() / "made/stride.toml"), HasSubstr("name = \"made\""));
}
INSTANTIATE_TEST_SUITE_P(All, Template,
                         ::testing::Values("axis", "two-axes", "cam", "io", "tests", "plain"));

TEST_F(Projects, TheCamOfTheTemplateIsThatOfANewEditor) {
  ASSERT_EQ(stride({"new", "made", "--template", "cam"}).exitCode, 0);
  EXPECT_THAT(stride({"cam", "check", "made/Cam.cam.toml"}).out,
              AllOf(HasSubstr("0 … 360 °, periodic"), HasSubstr("position      0 … 360 °")));
  ASSERT_EQ(stride({"cam", "export", "made/Cam.cam.toml", "--points", "4", "-o", "t.txt"}).exitCode,
            0);
  EXPECT_EQ(readFile(scratch_.path() / "t.txt"), "0;0\r\n120;120\r\n240;240\r\n360;360\r\n");
}

TEST_F(Projects, ARunThatWatchesTakesOverWhatIsSavedAndOutlivesMistakes) {
  write("p/stride.toml", "[[task]]\nname = \"Fast\"\ninterval = \"2ms\"\nprograms = [\"Main\"]\n");
  write("p/Main.st", "PROGRAM Main\nVAR n, step : DINT; END_VAR\nn := n + ;\nEND_PROGRAM\n");
  const auto waitFor = [](const std::string &text) {
    return "i=0; while ! grep -q '" + text +
           "' log && [ $i -lt 400 ]; do sleep 0.05; i=$((i+1)); done\n";
  };
  const ProcessResult result = shell(
      "\"$STRIDE\" run p --watch --listen unix:s --for 60s --quiet >log 2>&1 & run=$!\n" +
      waitFor("waiting for changes") + "sed -i 's/n := n + ;/n := n + 1;/' p/Main.st\n" +
      "i=0; while [ ! -S s ] && [ $i -lt 400 ]; do sleep 0.05; i=$((i+1)); done\n"
      "sed -i 's/n := n + 1;/step := 7; n := n + x;/' p/Main.st\n" +
      waitFor("the old program goes on") +
      "\"$STRIDE\" ctl unix:s read Main.step\n"
      "sed -i 's/n + x;/n + 1;/' p/Main.st\n" +
      waitFor("online change done") +
      "sleep 0.1; \"$STRIDE\" ctl unix:s read Main.step\nkill -TERM $run; wait $run; echo $?\n");
  EXPECT_EQ(result.out, "Main.step = 0\nMain.step = 7\n0\n") << result.err;
  EXPECT_THAT(readFile(scratch_.path() / "log"),
              AllOf(ContainsRegex("^error\\[SE[0-9]+\\](.*\n)*stride: waiting for changes\n"),
                    ContainsRegex("cannot find `x`|unknown|`x`")));
}

TEST_F(Projects, ACheckThatWatchesChecksAgain) {
  write("p/sub/a.st", "PROGRAM Main\nVAR n : DINT; END_VAR\nn := n + 1;\nEND_PROGRAM\n");
  const ProcessResult result = shell(
      "\"$STRIDE\" check p --watch 2>log & check=$!\n"
      "i=0; while ! grep -q 'no errors' log && [ $i -lt 400 ]; do sleep 0.05; i=$((i+1)); done\n"
      "echo 'no source' >p/sub/notes.txt; sleep 0.3; cp log before\n"
      "echo 'x' >>p/sub/a.st\n"
      "i=0; while ! grep -q 'error: 1 error' log && [ $i -lt 400 ]; do sleep 0.05; i=$((i+1)); "
      "done\nkill $check; wait $check\n");
  EXPECT_EQ(readFile(scratch_.path() / "before"), "stride: no errors; waiting for changes\n");
  EXPECT_THAT(readFile(scratch_.path() / "log"), HasSubstr("error[SE0209]"));
}

TEST_F(Projects, UnitsAndStatesOfTheProjectAreInPicturesAndInTheMonitor) {
  ASSERT_EQ(stride({"new", "p"}).exitCode, 0);
  write("p/State.st",
        "TYPE Going : (idle, there, back); END_TYPE\nVAR_GLOBAL state : Going; zero : "
        "LREAL; END_VAR\nPROGRAM States\nstate := SEL(Main.Target > 50, Going.back, "
        "Going.there);\nzero := 0;\nEND_PROGRAM\n");
  std::string toml = readFile(scratch_.path() / "p/stride.toml");
  toml.replace(toml.find("[\"Main\"]"), 8, "[\"Main\", \"States\"]");
  write("p/stride.toml", toml);
  const ProcessResult sim =
      stride({"sim", "p", "--for", "3s", "--trace",
              "Drive.fSetPosition,Main.Move.Velocity,state,zero", "--out", "p/t.csv"});
  ASSERT_EQ(sim.exitCode, 0) << sim.err;
  const auto draw = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"plot", "p/t.csv"});
    return stride(options);
  };
  ASSERT_EQ(draw({"-o", "t.svg"}).exitCode, 0);
  EXPECT_THAT(readFile(scratch_.path() / "t.svg"),
              AllOf(HasSubstr(">Position [mm]<"), HasSubstr(">Velocity [mm/s]<"),
                    HasSubstr(">there<"), HasSubstr(">back<"), Not(HasSubstr(">idle<"))));
  ASSERT_EQ(draw({"--from", "500ms", "--to", "T#1s", "--title", "Once <more>", "--panel",
                  "All=Drive.*,zero", "-o", "t.html"})
                .exitCode,
            0);
  const std::string page = readFile(scratch_.path() / "t.html");
  EXPECT_THAT(page, AllOf(HasSubstr("<h1>Once &lt;more&gt;</h1>"), HasSubstr("\"title\":\"All\""),
                          HasSubstr("\"time\":[0.5,0.502,"), HasSubstr("0.998,1]"),
                          Not(HasSubstr("\"name\":\"state\"")), Not(HasSubstr("http"))));
  EXPECT_THAT(draw({"-o", "t.png"}).err,
              AllOf(HasSubstr("drawn as .svg or .html"), HasSubstr("rsvg-convert")));
  EXPECT_THAT(draw({"--panel", "nothing*"}).err, HasSubstr("has no column `nothing*`"));
  EXPECT_THAT(draw({"--from", "9s"}).err, HasSubstr("no rows between --from and --to"));
  EXPECT_THAT(draw({"--to", "soon"}).err, HasSubstr("`soon` is no duration"));
  ASSERT_EQ(stride({"new", "c", "--template", "cam"}).exitCode, 0);
  EXPECT_THAT(stride({"cam", "plot", "c/Cam.cam.toml", "-o", "cam.png"}).err,
              HasSubstr("a cam is drawn as .svg"));
  std::string wrong = toml;
  wrong.replace(wrong.find("\"mm\""), 4, "\"m m\"");
  write("wrong/stride.toml", wrong);
  write("wrong/Main.st", "PROGRAM Main\n;\nEND_PROGRAM\nPROGRAM States\n;\nEND_PROGRAM\n");
  EXPECT_THAT(stride({"check", "wrong"}).err,
              AllOf(HasSubstr("`unit` must be a word of at most 16 bytes"), HasSubstr("21:12")));
  const ProcessResult doc = stride({"doc", "p", "-o", "doc"});
  ASSERT_EQ(doc.exitCode, 0) << doc.err;
  EXPECT_EQ(shell("grep -rqF 'One technical unit is one mm.' doc").exitCode, 0);
  const ProcessResult read = shell(
      "\"$STRIDE\" run p --listen unix:s --for 60s --quiet & run=$!\n"
      "i=0; while [ ! -S s ] && [ $i -lt 400 ]; do sleep 0.05; i=$((i+1)); done\n"
      "\"$STRIDE\" ctl unix:s read Drive.fSetVelocity Main.Target; \"$STRIDE\" ctl unix:s stop; "
      "wait $run\n");
  EXPECT_THAT(read.out,
              ContainsRegex("^Drive.fSetVelocity = .* \\[mm/s\\]\nMain.Target = [0-9.]+\n"));
}

} // namespace
} // namespace stride::test
