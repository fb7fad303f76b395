// New projects, saving a file while something watches, pictures that know their project.
#include "tests/system/run_scene.hpp"

#include <gmock/gmock-matchers.h>

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
                         ::testing::Values("axis", "two-axes", "cam", "io", "tests", "library",
                                           "plain"));

TEST_F(Projects, TheLibraryOfTheTemplateIsDocumentedAndUsedByAProject) {
  ASSERT_EQ(stride({"new", "my-parts", "--template", "library"}).exitCode, 0);
  const ProcessResult doc = stride({"doc", "my-parts", "-o", "pages"});
  EXPECT_EQ(doc.exitCode, 0) << doc.err;
  EXPECT_THAT(readFile(scratch_.path() / "pages/my_parts.html"),
              AllOf(HasSubstr("kept its value for a time"), HasSubstr("tTime")));
  write("plant/stride.toml", "[[library]]\nname = \"my_parts\"\npath = \"../my-parts\"\n"
                             "parameters = { DefaultTime = \"T#30ms\" }\n"
                             "[[task]]\nname = \"T\"\ninterval = \"10ms\"\nprograms = "
                             "[\"Main\"]\n");
  write("plant/Main.st", "PROGRAM Main\nVAR a : Debounce; b : my_parts.Debounce := (tTime := "
                         "T#50ms); END_VAR\na(bIn := TRUE);\nb(bIn := TRUE);\nEND_PROGRAM\n");
  const ProcessResult run =
      stride({"sim", "plant", "--for", "40ms", "--print", "Main.a.bOut,Main.b.bOut"});
  EXPECT_EQ(run.out, "Main.a.bOut = TRUE\nMain.b.bOut = FALSE\n") << run.err;
}

TEST_F(Projects, ALibraryHasANameThatStKnows) {
  const std::pair<const char *, const char *> names[] = {
      {"2d--parts", "Lib_2d_parts"}, {"type", "Lib_type"}, {"\xC3\x84", "Lib"}, {"_x", "x"}};
  for (const auto &[folder, name] : names) {
    ASSERT_EQ(stride({"new", folder, "--template", "library"}).exitCode, 0);
    EXPECT_THAT(readFile(scratch_.path() / folder / "stride.toml"),
                HasSubstr("\nname = \"" + std::string(name) + "\"\n"));
    const ProcessResult check = stride({"check", folder});
    EXPECT_EQ(check.out + check.err, "") << folder;
  }
}

TEST_F(Projects, TheCamOfTheTemplateIsThatOfANewEditor) {
  ASSERT_EQ(stride({"new", "made", "--template", "cam"}).exitCode, 0);
  EXPECT_THAT(stride({"cam", "check", "made/Cam.cam.toml"}).out,
              AllOf(HasSubstr("0 … 360 °, periodic"), HasSubstr("position      0 … 360 °")));
  ASSERT_EQ(stride({"cam", "export", "made/Cam.cam.toml", "--points", "4", "-o", "t.txt"}).exitCode,
            0);
  EXPECT_EQ(readFile(scratch_.path() / "t.txt"), "0;0\r\n120;120\r\n240;240\r\n360;360\r\n");
}

TEST_F(Projects, WhatRoundingHasLeftOfACamIsNotShown) {
  const std::string cams = STRIDE_SOURCE_DIR "/tests/golden/projects/cam_smooth/";
  EXPECT_THAT(stride({"cam", "check", cams + "Peak.cam.toml"}).out,
              AllOf(HasSubstr("position      0 … 1\n"), Not(HasSubstr("e-1"))));
  EXPECT_THAT(stride({"cam", "bounds", cams + "Peak.cam.toml", "--master-vel", "1e-9"}).out,
              AllOf(HasSubstr("position      0 … 1 u\n"), HasSubstr("e-09 u/s\n")));
}

TEST_F(Projects, BeforeTheFirstRunThereIsNothingToReset) {
  ASSERT_EQ(stride({"new", "p"}).exitCode, 0);
  for (const char *kind : {"warm", "cold", "origin"}) {
    const ProcessResult reset = stride({"reset", kind, "p"});
    EXPECT_EQ(reset.exitCode, 0) << reset.err;
    EXPECT_EQ(reset.out, "Nothing to reset: there are no retained data in `p/retain/p`.\n");
  }
}

TEST_F(Projects, TheHelpOfCtlSaysNothingOfSimulations) {
  for (const char *command : {"--help", "read"})
    EXPECT_THAT(stride({"ctl", command, "--help"}).out,
                AllOf(HasSubstr("Exit codes: 0 done, 1 it could not be done"),
                      Not(HasSubstr("simulation"))));
  EXPECT_THAT(command({STRIDE_BINARY_DIR "/stride-host", "sim", "--help"}).out,
              HasSubstr("130 a simulation was interrupted"));
}

TEST_F(Projects, ANoteIsShownOnceWithAllItsPlaces) {
  std::string program = "PROGRAM Main\nVAR a, b : LREAL; c, d : BOOL; END_VAR\n";
  for (int i = 0; i < 12; ++i)
    program += "c := a = b;\n";
  write("p/Main.st", program + "d := b <> a;\nEND_PROGRAM\n");
  write("p/stride.toml", "");
  write("p/More.st", "FUNCTION More : BOOL\nVAR_INPUT x, y : LREAL; END_VAR\n  More := x = y;\n"
                     "END_FUNCTION\n");
  const ProcessResult all = stride({"check", "p"});
  EXPECT_THAT(all.err, HasSubstr("Main.st:3:8\n"));
  EXPECT_THAT(all.err, HasSubstr("  = note: the same at 4:8, 5:8, 6:8, 7:8, 8:8, 9:8, 10:8, 11:8, "
                                 "12:8, 13:8 and 3 more places\n"));
  EXPECT_EQ(all.err.find("SE0491"), all.err.rfind("SE0491")) << all.err;
  // As warnings, and for tools, each is shown by itself.
  const std::string warnings = stride({"check", "p", "-W", "warning=SE0491"}).err;
  EXPECT_THAT(warnings, HasSubstr("warning: 14 warnings"));
  const std::string json = stride({"check", "p", "--format", "json"}).out;
  EXPECT_EQ(std::count(json.begin(), json.end(), '\n'), 14);
  write("p/Main.st",
        "PROGRAM Main\nVAR a, b : LREAL; c : BOOL; END_VAR\nc := a = b;\nEND_PROGRAM\n");
  EXPECT_THAT(stride({"check", "p"}).err, HasSubstr("  = note: the same at More.st:3:13\n"));
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
  write("p/stride.toml", toml + "[[axis]]\nname = \"Line\"\nkind = \"virtual\"\nunit = \"deg\"\n");
  write("p/Line.st", "VAR_GLOBAL linePower : MC_Power; END_VAR\nPROGRAM Serve\nlinePower(Axis := "
                     "Line);\nEND_PROGRAM\n");
  write("t2.csv", "t,Line.fSetPosition,Drive.fSetPosition,Main.Move.Velocity\n0,1,5,3\n1,2,6,3\n");
  ASSERT_EQ(stride({"plot", "t2.csv", "--project", "p", "-o", "t2.svg"}).exitCode, 0);
  EXPECT_THAT(readFile(scratch_.path() / "t2.svg"),
              AllOf(HasSubstr(">Position [deg]<"), HasSubstr(">Position [mm]<"),
                    HasSubstr(">Velocity [u/s]<")));
  const ProcessResult doc = stride({"doc", "p", "-o", "doc"});
  ASSERT_EQ(doc.exitCode, 0) << doc.err;
  EXPECT_EQ(shell("grep -rqF 'One technical unit is one mm.' doc").exitCode, 0);
  EXPECT_EQ(shell("grep -rqF 'One technical unit is one deg.' doc").exitCode, 0);
  const ProcessResult read =
      shell("\"$STRIDE\" run p --listen unix:s --for 60s --quiet & run=$!\n"
            "i=0; while [ ! -S s ] && [ $i -lt 400 ]; do sleep 0.05; i=$((i+1)); done\n"
            "\"$STRIDE\" ctl unix:s read Drive.fSetVelocity Line.fSetPosition Main.Target; "
            "\"$STRIDE\" ctl unix:s end; "
            "wait $run\n");
  EXPECT_THAT(read.out, ContainsRegex("^Drive.fSetVelocity = .* \\[mm/s\\]\nLine.fSetPosition = "
                                      "0.0 \\[deg\\]\nMain.Target = [0-9.]+\n"));
}

} // namespace
} // namespace stride::test
