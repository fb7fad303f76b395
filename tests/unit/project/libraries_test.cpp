// Libraries of one's own: versions, where they are looked for, what is compiled.
#include "compiler/project/library_graph.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

namespace stc {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(LibraryVersions, AreOneToFourNumbers) {
  EXPECT_EQ(parseVersion("1"), (Version{1, 0, 0, 0}));
  EXPECT_EQ(parseVersion("1.20.3"), (Version{1, 20, 3, 0}));
  EXPECT_EQ(parseVersion("3.5.17.40"), (Version{3, 5, 17, 40}));
  for (const char *wrong : {"", "1.", ".1", "1..2", "1.2.3.4.5", "v1", "1.2a", "-1", "4294967296"})
    EXPECT_FALSE(parseVersion(wrong)) << wrong;
}

TEST(LibraryVersions, FitUpToTheFirstNumberThatIsNot0) {
  const auto version = [](const char *text) { return *parseVersion(text); };
  EXPECT_FALSE(fits(version("1.1.9"), "1.2"));
  EXPECT_TRUE(fits(version("1.2"), "1.2"));
  EXPECT_TRUE(fits(version("1.10"), "1.2"));
  EXPECT_FALSE(fits(version("2.0"), "1.2"));
  EXPECT_TRUE(fits(version("0.3.4"), "0.3.1"));
  EXPECT_FALSE(fits(version("0.4"), "0.3.1"));
  EXPECT_FALSE(fits(version("1.2.4"), "=1.2.3"));
  EXPECT_TRUE(fits(version("1.2.3.0"), "=1.2.3"));
  EXPECT_TRUE(fits(version("7"), "*"));
  EXPECT_TRUE(fits(version("7"), ""));
  EXPECT_TRUE(fits(version("7"), "0"));
}

class Libraries : public ::testing::Test {
protected:
  Libraries() { ::setenv("STRIDE_LIBRARIES", (folder() / "installed").c_str(), 1); }
  ~Libraries() override { ::unsetenv("STRIDE_LIBRARIES"); }

  void write(const std::string &name, const std::string &text) {
    fs::create_directories((folder() / name).parent_path());
    stride::test::writeFile(folder() / name, text);
  }
  /// A library with a function that says its version.
  void install(const std::string &version) {
    const std::string at = "installed/Known/" + version;
    write(at + "/stride.toml", "[library]\nname = \"Known\"\nversion = \"" + version + "\"\n");
    write(at + "/Known.st", "FUNCTION Known : STRING\nKnown := '" + version + "';\nEND_FUNCTION\n");
  }
  /// Codes and messages of errors, and of warnings.
  std::vector<std::string> check(const std::string &path) {
    const Project project(folder() / path, Purpose::Build, {}, index_);
    std::vector<std::string> said;
    for (const Diagnostic &d : project.diagnostics())
      said.push_back(codeName(d.code) + " " + d.message);
    generated_.clear();
    if (project.hasErrors())
      return said;
    for (GeneratedFile &file : generateApplication(project.program(), project.appConfig()))
      EXPECT_TRUE(generated_.emplace(file.path, std::move(file.text)).second) << file.path;
    return said;
  }
  [[nodiscard]] fs::path folder() const { return scratch_.path(); }

  stride::test::ScratchDirectory scratch_;
  EmbeddedLibraryIndex index_{standardLibrary()};
  std::map<std::string, std::string> generated_;
};

constexpr const char *kUser =
    "PROGRAM PLC_PRG\nVAR s : STRING; END_VAR\ns := Known();\nEND_PROGRAM\n";

TEST_F(Libraries, TheLatestInstalledVersionThatFitsIsTaken) {
  for (const char *version : {"1.2", "1.10", "2.0"})
    install(version);
  const auto versionFor = [this](const std::string &wanted) -> std::string {
    write("p/stride.toml", "[[library]]\nname = \"Known\"\n" + wanted);
    write("p/Main.st", kUser);
    if (const std::vector<std::string> said = check("p"); !said.empty())
      return said.front();
    const std::string &code = generated_.at("Known/Known.cpp");
    const size_t at = code.find("= \"") != std::string::npos ? code.find("= \"") : 0;
    for (const char *version : {"1.2", "1.10", "2.0"})
      if (code.find("\"" + std::string(version) + "\"") != std::string::npos)
        return version;
    return code.substr(at);
  };
  EXPECT_EQ(versionFor(""), "2.0");
  EXPECT_EQ(versionFor("version = \"1.1\"\n"), "1.10");
  EXPECT_EQ(versionFor("version = \"=1.2\"\n"), "1.2");
  EXPECT_EQ(versionFor("version = \"3\"\n"),
            "SE0851 no version of the library `Known` that is installed fits \"3\"");
}

TEST_F(Libraries, WhatIsGeneratedOfOneDoesNotDependOnItsUser) {
  install("1.2");
  write("p/stride.toml", "[[library]]\nname = \"Known\"\n");
  write("p/Main.st", kUser);
  ASSERT_THAT(check("p"), IsEmpty());
  const std::string source = generated_.at("Known/Known.cpp");
  const std::string header = generated_.at("st/Known/Known.h");
  EXPECT_EQ(source.find("user"), std::string::npos);
  EXPECT_NE(source.find("<Known>/Known.st"), std::string::npos); // not where it lies
  write("q/stride.toml", "[project]\nlayout = \"v2.3\"\n[[library]]\nname = \"Known\"\n");
  write("q/Main.st", kUser);
  write("q/Check.st", "FUNCTION CheckBounds : DINT\nVAR_INPUT index, lower, upper : DINT; END_VAR\n"
                      "CheckBounds := index;\nEND_FUNCTION\n");
  check("q");
  EXPECT_EQ(generated_.at("Known/Known.cpp"), source);
  EXPECT_EQ(generated_.at("st/Known/Known.h"), header);
}

TEST_F(Libraries, ALibraryOfStrideIsBuiltWhenAParameterOfItIsSet) {
  write("p/stride.toml", "");
  write(
      "p/Main.st",
      "PROGRAM PLC_PRG\nVAR n : INT; END_VAR\nn := Util.TextBlockSize.iBlockSize;\nEND_PROGRAM\n");
  ASSERT_THAT(check("p"), IsEmpty());
  EXPECT_FALSE(generated_.contains("Util/BASE64.cpp"));
  write("p/stride.toml", "[[library]]\nname = \"Util\"\nparameters = { iBlockSize = 9 }\n");
  ASSERT_THAT(check("p"), IsEmpty());
  EXPECT_TRUE(generated_.contains("Util/BASE64.cpp"));
}

TEST_F(Libraries, NamesOfWhatALibraryUsesAreNotSeenThroughIt) {
  write("low/stride.toml", "[library]\nname = \"Low\"\nversion = \"1\"\n");
  write("low/Low.st", "FUNCTION Low1 : INT\nLow1 := 1;\nEND_FUNCTION\n");
  write("high/stride.toml", "[library]\nname = \"High\"\nversion = \"1\"\n"
                            "[[library.uses]]\nname = \"Low\"\npath = \"../low\"\n");
  write("high/High.st", "FUNCTION High1 : INT\nHigh1 := Low1();\nEND_FUNCTION\n");
  write("p/stride.toml", "[[library]]\nname = \"High\"\npath = \"../high\"\n");
  write("p/Main.st", "PROGRAM PLC_PRG\nVAR n : INT; END_VAR\nn := High1() + Low1() + "
                     "Low.Low1();\nEND_PROGRAM\n");
  EXPECT_THAT(check("p"), ElementsAre("SE0301 cannot find `Low1`", "SE0301 cannot find `Low`"));
  write("low/Low.st", "FUNCTION Low1 : INT\nLow1 := High1();\nEND_FUNCTION\n");
  EXPECT_THAT(check("p"), Contains("SE0301 cannot find `High1`"));
}

TEST_F(Libraries, OneThatNeedsItsNamespaceHidesNothing) {
  write("lib/stride.toml", "[library]\nname = \"Lib\"\nversion = \"1\"\nqualified_only = true\n");
  write("lib/TON.st", "FUNCTION_BLOCK TON\nVAR_OUTPUT own : INT; END_VAR\nown := 1;\n"
                      "END_FUNCTION_BLOCK\n\nTYPE Color : (Red, Blue); END_TYPE\n");
  write("p/stride.toml", "[[library]]\nname = \"Lib\"\npath = \"../lib\"\n");
  write("p/Main.st", "PROGRAM PLC_PRG\nVAR a : TON; b : Lib.TON; c : Lib.Color; END_VAR\n"
                     "a(IN := TRUE, PT := T#1s);\nb();\nc := Lib.Color.Red;\nEND_PROGRAM\n");
  EXPECT_THAT(check("p"), IsEmpty());
  write("p/Main.st", "PROGRAM PLC_PRG\nVAR c : Color; END_VAR\nEND_PROGRAM\n");
  EXPECT_THAT(check("p"), ElementsAre("SE0302 cannot find type `Color`"));
}

TEST_F(Libraries, OneThatTwoOthersNeedIsThereOnce) {
  write("low/stride.toml", "[library]\nname = \"Low\"\nversion = \"1\"\n");
  write("low/Low.st", "VAR_GLOBAL\n  count : INT;\nEND_VAR\n");
  for (const char *name : {"A", "B"}) {
    const std::string at(name);
    write(at + "/stride.toml", "[library]\nname = \"" + at +
                                   "\"\nversion = \"1\"\n[[library.uses]]\nname = \"Low\"\n"
                                   "path = \"../low\"\nnamespace = \"Of" +
                                   at + "\"\n");
    write(at + "/" + at + ".st",
          "FUNCTION Of" + at + "1 : INT\nOf" + at + ".count := count + 1;\nEND_FUNCTION\n");
  }
  write("p/stride.toml", "[[library]]\nname = \"A\"\npath = \"../A\"\n"
                         "[[library]]\nname = \"B\"\npath = \"../B/../B\"\n");
  write("p/Main.st", "PROGRAM PLC_PRG\nOfA1();\nOfB1();\nEND_PROGRAM\n");
  EXPECT_THAT(check("p"), IsEmpty());
  size_t lists = 0;
  for (const auto &[path, text] : generated_)
    lists += path.find("Low__globals__.h") != std::string::npos ? 1 : 0;
  EXPECT_EQ(lists, 1U);
}

TEST_F(Libraries, SourcesThatAreNotThereAreNamed) {
  write("p/stride.toml", "[project]\nsources = [\"src\", \"Main.st\"]\n");
  write("p/Main.st", "PROGRAM PLC_PRG\nEND_PROGRAM\n");
  EXPECT_THAT(check("p"), ElementsAre("SE0830 there is no file or folder `src`"));
}

} // namespace
} // namespace stc
