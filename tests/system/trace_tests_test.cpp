// `stride test` with [[test]]: simulations whose traces are compared with files of the project.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <filesystem>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char *kMain = "PROGRAM Main\n"
                              "VAR\n"
                              "  n : INT;\n"
                              "  x : LREAL := 0.25;\n"
                              "  d : INT := 4;\n"
                              "END_VAR\n"
                              "n := n + 1;\n"
                              "x := x * 1.5;\n"
                              "n := n + 4 / d;\n"
                              "END_PROGRAM\n";

constexpr const char *kUnitTest = "{attribute 'test'}\n"
                                  "FUNCTION_BLOCK Adds\n"
                                  "ASSERT_EQ(1 + 1, 2);\n"
                                  "END_FUNCTION_BLOCK\n";

class TraceTests : public ::testing::Test {
protected:
  TraceTests() {
    fs::create_directory(project_);
    writeFile(project_ / "Main.st", kMain);
    configure("name = \"Grows\"\nfor = \"T#50ms\"\ntrace = [\"Main.n\", \"Main.x\"]\n");
  }

  /// stride.toml with these tests; `[[test]]` stands before the first.
  void configure(const std::string &tests) const {
    writeFile(project_ / "stride.toml", "[project]\nname = \"p\"\n\n[[task]]\nname = \"Task\"\n"
                                        "interval = \"T#10ms\"\nprograms = [\"Main\"]\n\n"
                                        "[[test]]\n" +
                                            tests);
  }

  ProcessResult test(std::vector<std::string> arguments = {}) const {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "test"});
    return runProcess(arguments, project_,
                      {{"XDG_CACHE_HOME", (scratch_.path() / "cache").string()}});
  }

  void bless() const {
    const ProcessResult result = test({"--bless"});
    ASSERT_EQ(result.exitCode, 0) << result.out << result.err;
  }

  /// Main.st with one part changed.
  void edit(const std::string &from, const std::string &to) const {
    std::string text = kMain;
    text.replace(text.find(from), from.size(), to);
    writeFile(project_ / "Main.st", text);
  }

  ScratchDirectory scratch_;
  fs::path project_ = scratch_.path() / "project";
};

TEST_F(TraceTests, WriteWhatIsExpectedOnlyWhenToldTo) {
  const ProcessResult first = test();
  EXPECT_EQ(first.exitCode, 1);
  EXPECT_EQ(first.out, "running 1 trace\n"
                       "trace Grows ... FAILED\n"
                       "  there is no `tests/Grows.csv`\n"
                       "  = the trace: `build/tests/Grows.csv`\n"
                       "  = if it is right, `stride test --bless --filter Grows` writes it to "
                       "`tests/Grows.csv`\n"
                       "\n"
                       "trace result: FAILED. 0 passed; 1 failed\n");
  EXPECT_FALSE(fs::exists(project_ / "tests"));
  EXPECT_EQ(readFile(project_ / "build/.gitignore"), "*\n");
  const ProcessResult blessed = test({"--bless"});
  EXPECT_EQ(blessed.exitCode, 0);
  EXPECT_THAT(blessed.out, HasSubstr("trace Grows ... written to `tests/Grows.csv`\n"));
  const std::string expected = readFile(project_ / "tests/Grows.csv");
  EXPECT_THAT(expected, StartsWith("t,Main.n,Main.x\n0,2,0.375\n0.01,4,0.5625\n"));
  EXPECT_EQ(readFile(project_ / "build/tests/Grows.csv"), expected);
  const ProcessResult second = test();
  EXPECT_EQ(second.exitCode, 0);
  EXPECT_THAT(second.out,
              HasSubstr("trace Grows ... ok\n\ntrace result: ok. 1 passed; 0 failed\n"));
  EXPECT_FALSE(fs::exists(project_ / "build/tests/Grows.csv")); // it was that of a failure
}

TEST_F(TraceTests, ShowWhatDiffers) {
  bless();
  const std::string expected = readFile(project_ / "tests/Grows.csv");
  edit("x * 1.5", "x * 1.25");
  const ProcessResult result = test();
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.out, HasSubstr("  `Main.x` at 0 s: expected 0.375, is 0.3125; 5 of 5 rows "
                                    "differ, by "));
  EXPECT_THAT(result.out, Not(HasSubstr("`Main.n`")));
  EXPECT_THAT(readFile(project_ / "build/tests/Grows.csv"), HasSubstr("\n0,2,0.3125\n"));
  EXPECT_EQ(readFile(project_ / "tests/Grows.csv"), expected);
  bless(); // takes the change
  EXPECT_THAT(readFile(project_ / "tests/Grows.csv"), HasSubstr("\n0,2,0.3125\n"));
}

TEST_F(TraceTests, CompareNumbersWithinTheTolerance) {
  constexpr const char *kTest = "name = \"Grows\"\nfor = \"T#20ms\"\ntrace = [\"Main.x\"]\n";
  configure(kTest);
  bless();
  edit("0.25", "0.2505"); // 0.00075 more in the first cycle, 0.001125 in the second
  configure(std::string(kTest) + "tolerance = 0.00113\n");
  EXPECT_EQ(test().exitCode, 0);
  configure(std::string(kTest) + "tolerance = 0.00112\n");
  EXPECT_THAT(test().out, HasSubstr("`Main.x` at 0.01 s: expected 0.5625, is 0.56362"));
}

TEST_F(TraceTests, TakeScriptsAndValuesAndSomeRows) {
  configure("name = \"Driven\"\nfor = \"T#100ms\"\ntrace = [\"Main.n\"]\nscript = \"a.script\"\n"
            "set = [\"T#20ms,Main.d=1\", \"Main.x=8\"]\nevery = \"T#30ms\"\n");
  writeFile(project_ / "a.script", "at T#50ms: Main.n := 100\n");
  bless();
  EXPECT_EQ(readFile(project_ / "tests/Driven.csv"),
            "t,Main.n\n0,2\n0.03,14\n0.06,110\n0.09,125\n");
  writeFile(project_ / "a.script", "at T#50ms: Main.n := 101\n");
  EXPECT_THAT(test().out,
              HasSubstr("`Main.n` at 0.06 s: expected 110, is 111; 2 of 4 rows differ"));
}

TEST_F(TraceTests, FailWithTheSimulation) {
  bless();
  edit("d : INT := 4", "d : INT := 0");
  const ProcessResult divided = test();
  EXPECT_EQ(divided.exitCode, 1);
  EXPECT_THAT(divided.out, HasSubstr("trace Grows ... FAILED\n  the simulation has failed:\n"));
  EXPECT_THAT(divided.out, HasSubstr("division by zero at Main.st:9:12"));
  const ProcessResult blessed = test({"--bless"});
  EXPECT_EQ(blessed.exitCode, 1); // half a trace is not what is expected
  EXPECT_THAT(readFile(project_ / "tests/Grows.csv"), HasSubstr("\n0.04,"));
  edit("d : INT := 4", "e : INT := 4"); // an error of the compiler
  const ProcessResult wrong = test();
  EXPECT_EQ(wrong.exitCode, 1);
  EXPECT_THAT(wrong.err, HasSubstr("Main.st:9:"));
  EXPECT_EQ(wrong.out, "");
}

TEST_F(TraceTests, SayWhichVariableIsNotThere) {
  configure("name = \"Grows\"\nfor = \"T#50ms\"\ntrace = [\"Main.m\"]\n");
  const ProcessResult result = test();
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.out, HasSubstr("the simulation has failed:\n  error: symbol 'Main.m'"));
}

TEST_F(TraceTests, RunAfterUnitTests) {
  writeFile(project_ / "Tests.st", kUnitTest);
  configure("name = \"Grows\"\nfor = \"T#50ms\"\ntrace = [\"Main.n\"]\n\n"
            "[[test]]\nname = \"Shrinks\"\nfor = \"T#20ms\"\ntrace = [\"Main.x\"]\n");
  EXPECT_EQ(test({"--list"}).out, "Adds\nGrows\nShrinks\n");
  EXPECT_EQ(test({"--bless", "--filter", "Grows"}).exitCode, 0);
  EXPECT_FALSE(fs::exists(project_ / "tests/Shrinks.csv"));
  EXPECT_THAT(test({"--filter", "Adds"}).out, Not(HasSubstr("trace")));
  const ProcessResult all = test({"--junit", "report.xml"});
  EXPECT_EQ(all.exitCode, 1);
  EXPECT_THAT(all.out, HasSubstr("test result: ok. 1 passed; 0 failed\n\nrunning 2 traces\n"));
  pugi::xml_document report;
  ASSERT_TRUE(report.load_file((project_ / "report.xml").c_str()));
  const pugi::xml_node suites = report.child("testsuites");
  EXPECT_EQ(suites.attribute("tests").as_int(), 3);
  EXPECT_EQ(suites.attribute("failures").as_int(), 1);
  const pugi::xml_node traces = suites.find_child_by_attribute("name", "p traces");
  EXPECT_EQ(traces.attribute("tests").as_int(), 2);
  EXPECT_STREQ(
      suites.find_child_by_attribute("name", "p").child("testcase").attribute("name").value(),
      "Adds");
  const pugi::xml_node failed = traces.find_child_by_attribute("name", "Shrinks").child("failure");
  EXPECT_STREQ(failed.attribute("message").value(), "there is no `tests/Shrinks.csv`");
  EXPECT_TRUE(traces.find_child_by_attribute("name", "Grows").first_child().empty());
}

TEST_F(TraceTests, ReportsOfTracesAloneBeginAnew) {
  bless();
  writeFile(project_ / "report.xml", "<testsuites tests=\"7\"><testsuite/></testsuites>");
  EXPECT_EQ(test({"--junit", "report.xml"}).exitCode, 0);
  pugi::xml_document report;
  ASSERT_TRUE(report.load_file((project_ / "report.xml").c_str()));
  EXPECT_EQ(report.child("testsuites").attribute("tests").as_int(), 1);
  EXPECT_EQ(test({"--junit", "nowhere/report.xml"}).exitCode, 1);
}

TEST_F(TraceTests, AreNamedByFilterAndBless) {
  EXPECT_EQ(test({"--filter", "Gr?ws*", "--bless"}).exitCode, 0);
  EXPECT_THAT(test({"--filter", "Adds"}).err, HasSubstr("no test is called 'Adds'"));
  writeFile(project_ / "Tests.st", kUnitTest);
  const ProcessResult none = test({"--filter", "Adds", "--bless"});
  EXPECT_NE(none.exitCode, 0);
  EXPECT_THAT(none.err, HasSubstr("there is no [[test]]"));
}

TEST_F(TraceTests, WriteThroughNoLinks) {
  fs::create_directories(scratch_.path() / "elsewhere");
  fs::create_directory_symlink("../elsewhere", project_ / "tests");
  const ProcessResult result = test({"--bless"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.out, HasSubstr("`tests/Grows.csv` cannot be"));
  EXPECT_TRUE(fs::is_empty(scratch_.path() / "elsewhere"));
}

} // namespace
} // namespace stride::test
