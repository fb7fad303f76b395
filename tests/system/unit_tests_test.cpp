// `stride test`: its exit codes, its selection, and the JUnit file.
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

constexpr const char *kTests = "{attribute 'test'}\n"
                               "FUNCTION_BLOCK Right\n"
                               "ASSERT_TRUE(TRUE);\n"
                               "END_FUNCTION_BLOCK\n"
                               "{attribute 'test'}\n"
                               "FUNCTION_BLOCK Wrong\n"
                               "VAR n : INT; END_VAR\n"
                               "ASSERT_EQ(n, 1, 'a <b> & \"c\"');\n"
                               "ASSERT_EQ(n, 2);\n"
                               "END_FUNCTION_BLOCK\n"
                               "{attribute 'test'}\n"
                               "FUNCTION_BLOCK Raises\n"
                               "VAR n : INT; END_VAR\n"
                               "n := 1 / n;\n"
                               "END_FUNCTION_BLOCK\n";

class UnitTests : public ::testing::Test {
protected:
  UnitTests() { writeFile(scratch_.path() / "t.st", kTests); }

  ProcessResult test(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "test", "t.st"});
    return runProcess(arguments, scratch_.path(),
                      {{"XDG_CACHE_HOME", (scratch_.path() / "cache").string()}});
  }

  ScratchDirectory scratch_;
};

TEST_F(UnitTests, WritesJunit) {
  const ProcessResult result = test({"--junit", "report.xml"});
  EXPECT_EQ(result.exitCode, 1) << result.out << result.err;
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file((scratch_.path() / "report.xml").c_str()));
  const pugi::xml_node suite = document.child("testsuites").child("testsuite");
  EXPECT_STREQ(suite.attribute("name").value(), "t");
  for (const pugi::xml_node node : {document.child("testsuites"), suite}) {
    EXPECT_EQ(node.attribute("tests").as_int(), 3);
    EXPECT_EQ(node.attribute("failures").as_int(), 1);
    EXPECT_EQ(node.attribute("errors").as_int(), 1);
    EXPECT_FALSE(node.attribute("time").empty());
  }
  std::vector<pugi::xml_node> cases;
  for (const pugi::xml_node one : suite.children("testcase")) {
    EXPECT_STREQ(one.attribute("classname").value(), "t");
    EXPECT_STREQ(one.attribute("file").value(), "t.st");
    EXPECT_GE(one.attribute("time").as_double(-1), 0);
    cases.push_back(one);
  }
  ASSERT_EQ(cases.size(), 3U);
  EXPECT_STREQ(cases[0].attribute("name").value(), "Right");
  EXPECT_TRUE(cases[0].first_child().empty());
  EXPECT_EQ(cases[1].attribute("line").as_int(), 6);
  const pugi::xml_node failure = cases[1].child("failure");
  EXPECT_STREQ(failure.attribute("type").value(), "ASSERT_EQ");
  EXPECT_STREQ(failure.attribute("message").value(), "expected 1, is 0: a <b> & \"c\"");
  EXPECT_THAT(failure.text().get(), HasSubstr("t.st:8:1: ASSERT_EQ: expected 1"));
  EXPECT_THAT(failure.text().get(), HasSubstr("t.st:9:1: ASSERT_EQ: expected 2, is 0"));
  const pugi::xml_node error = cases[2].child("error");
  EXPECT_STREQ(error.attribute("type").value(), "exception");
  EXPECT_THAT(error.attribute("message").value(), HasSubstr("division by zero at t.st:14:8"));
}

TEST_F(UnitTests, SelectsByName) {
  const ProcessResult right = test({"--filter", "R?ght"});
  EXPECT_EQ(right.exitCode, 0) << right.out << right.err;
  EXPECT_THAT(right.out, HasSubstr("running 1 test\ntest Right ... ok\n"));
  EXPECT_EQ(test({"--list"}).out, "Right\nWrong\nRaises\n");
  EXPECT_EQ(test({"--list"}).exitCode, 0);
}

TEST_F(UnitTests, SaysHowManyFailuresItLeavesOut) {
  std::string body;
  for (int i = 0; i < 60; ++i)
    body += "ASSERT_EQ(0, 1);\n";
  writeFile(scratch_.path() / "t.st", "{attribute 'test'}\n"
                                      "FUNCTION_BLOCK Wrong\n" +
                                          body + "END_FUNCTION_BLOCK\n");
  const ProcessResult result = test({"--junit", "report.xml"});
  EXPECT_EQ(result.exitCode, 1) << result.err;
  EXPECT_THAT(result.out, HasSubstr("t.st:52:1"));
  EXPECT_THAT(result.out, Not(HasSubstr("t.st:53:1")));
  EXPECT_THAT(result.out, HasSubstr("is 0\n  … and 10 more failures\n"));
  EXPECT_THAT(readFile(scratch_.path() / "report.xml"), HasSubstr("… and 10 more failures&#10;</"));
}

TEST_F(UnitTests, AnAssertionThatFailsAgainAndAgainDoesNotHideOthers) {
  writeFile(scratch_.path() / "t.st",
            "{attribute 'test'}\n"
            "FUNCTION_BLOCK Wrong\n"
            "VAR i : INT; END_VAR\n"
            "FOR i := 1 TO 200 DO ASSERT_EQ(i, 0); ASSERT_EQ(i MOD 200, 2); END_FOR;\n"
            "ASSERT_EQ(i, 7);\n"
            "END_FUNCTION_BLOCK\n");
  const std::string out = test({}).out;
  for (const char *shown : {"is 1\n", "is 2\n", "is 3\n", "is 4\n", "is 201\n"})
    EXPECT_THAT(out, HasSubstr(shown));
  EXPECT_THAT(out, Not(HasSubstr("is 5\n")));
  EXPECT_THAT(out, HasSubstr("… and 393 more failures\n"));
}

TEST_F(UnitTests, BadUse) {
  EXPECT_EQ(test({"--wrong"}).exitCode, 1);
  const ProcessResult report = test({"--filter", "Right", "--junit", "missing/report.xml"});
  EXPECT_EQ(report.exitCode, 1);
  EXPECT_THAT(report.err, HasSubstr("'missing/report.xml' cannot be written"));
  for (const std::vector<std::string> &list : {std::vector<std::string>{}, {"--list"}}) {
    std::vector<std::string> arguments = list;
    arguments.insert(arguments.end(), {"--filter", "R?ghtly"});
    const ProcessResult none = test(arguments);
    EXPECT_EQ(none.exitCode, 1);
    EXPECT_THAT(none.err, HasSubstr("no test is called 'R?ghtly'"));
    EXPECT_EQ(none.out, "");
  }
  writeFile(scratch_.path() / "t.st", "{attribute 'test'}\nFUNCTION_BLOCK Wrong\nx := 1;\n"
                                      "END_FUNCTION_BLOCK\n");
  const ProcessResult wrong = test({});
  EXPECT_EQ(wrong.exitCode, 1);
  EXPECT_THAT(wrong.err, HasSubstr("t.st:3:1"));
}

} // namespace
} // namespace stride::test
