// `stride import`: encodings, folders, what is written and what is not, hostile files.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char *kProgram =
    "PROGRAM Main\nVAR\n  n : INT;\nEND_VAR\nn := n + 3;\nEND_PROGRAM\n";

class Import : public ::testing::Test {
protected:
  ProcessResult import(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "import"});
    return runProcess(arguments, scratch_.path());
  }
  void write(const std::string &name, const std::string &text) {
    fs::create_directories((scratch_.path() / name).parent_path());
    writeFile(scratch_.path() / name, text);
  }
  std::string read(const std::string &name) { return readFile(scratch_.path() / name); }
  fs::path path(const std::string &name) { return scratch_.path() / name; }
  bool exists(const std::string &name) { return fs::exists(fs::symlink_status(path(name))); }

  ScratchDirectory scratch_;
};

TEST_F(Import, MakesAProjectThatChecksAndRuns) {
  write("Plant.EXP", kProgram);
  const ProcessResult result = import({"Plant.EXP"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(result.out,
            "Imported 1 object from 1 file into Plant: 0 left out, 0 changed, 0 to look at, "
            "0 errors in the check. Report: Plant/import-report.md\n");
  EXPECT_EQ(read("Plant/Main.st"), kProgram);
  const ProcessResult sim = runProcess(
      {STRIDE_BINARY_DIR "/stride", "sim", "Plant", "--for", "50ms", "--print", "Main.n"},
      scratch_.path());
  EXPECT_EQ(sim.out, "Main.n = 15\n") << sim.err;
  for (const fs::directory_entry &entry : fs::directory_iterator(scratch_.path()))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".stride-import")) << entry;
}

TEST_F(Import, ReadsEncodings) {
  const std::string head = "PROGRAM P (* ";
  const std::string tail = " *)\nEND_PROGRAM\n";
  write("a.EXP", head + "\xE4" + tail);
  write("u.EXP", "\xFF\xFE"s);
  std::string wide = "\xFF\xFE";
  for (const char c : head + "\xE4" + tail)
    wide += std::string(1, c) + '\0';
  write("u.EXP", wide);
  EXPECT_EQ(import({"a.EXP", "-o", "A"}).exitCode, 0);
  EXPECT_EQ(read("A/P.st"), head + "\xC3\xA4" + tail);
  EXPECT_THAT(read("A/import-report.md"), HasSubstr("read as Windows-1252; the first is a.EXP"));
  EXPECT_EQ(import({"a.EXP", "-o", "B", "--encoding", "cp1251"}).exitCode, 0);
  EXPECT_EQ(read("B/P.st"), head + "\xD0\xB4" + tail);
  EXPECT_EQ(import({"u.EXP", "-o", "C"}).exitCode, 0);
  EXPECT_EQ(read("C/P.st"), head + "\xC3\xA4" + tail);
  const ProcessResult wrong = import({"a.EXP", "-o", "D", "--encoding", "cp99999"});
  EXPECT_NE(wrong.exitCode, 0);
  EXPECT_THAT(wrong.err, HasSubstr("`cp99999` is no encoding"));
  EXPECT_FALSE(exists("D"));
}

TEST_F(Import, RefusesWhatIsNoText) {
  write("nul.EXP", "PROGRAM P\nn := \0 1;\nEND_PROGRAM\n"s);
  const ProcessResult nul = import({"nul.EXP", "-o", "Out"});
  EXPECT_EQ(nul.exitCode, 2);
  EXPECT_THAT(nul.err, HasSubstr("error[SE0896]: nul.EXP:2: file: it has a NUL character"));
  write("old.pro", "CoDeSys+\1\2");
  EXPECT_EQ(import({"old.pro", "-o", "Out"}).exitCode, 2);
  EXPECT_THAT(import({"missing.EXP", "-o", "Out"}).err,
              HasSubstr("missing.EXP:1: file: it cannot be read"));
  fs::create_directories(path("empty"));
  const ProcessResult empty = import({"empty", "-o", "Out"});
  EXPECT_EQ(empty.exitCode, 2);
  EXPECT_THAT(empty.err, HasSubstr("no file below it has an ending that is imported"));
  EXPECT_FALSE(exists("Out"));
  write("good.EXP", kProgram);
  const ProcessResult both = import({"nul.EXP", "good.EXP", "-o", "Out"});
  EXPECT_EQ(both.exitCode, 1);
  EXPECT_TRUE(exists("Out/Main.st"));
  EXPECT_THAT(read("Out/import-report.md"),
              HasSubstr("## Files that could not be read: 1\n\n- nul.EXP:2"));
}

TEST_F(Import, OverwritesOnlyWhenTold) {
  write("a.EXP", kProgram);
  write("Out/Main.st", "mine");
  write("Out/Other.st", "FUNCTION F : INT\nEND_FUNCTION\n");
  EXPECT_EQ(import({"a.EXP", "-o", "Out"}).exitCode, 1);
  EXPECT_EQ(read("Out/Main.st"), "mine");
  const ProcessResult forced = import({"a.EXP", "-o", "Out", "--force", "--fmt"});
  EXPECT_EQ(forced.exitCode, 0) << forced.err;
  EXPECT_EQ(read("Out/Main.st"), kProgram);
  EXPECT_THAT(forced.out, HasSubstr("1 further .st file is in Out"));
  EXPECT_TRUE(exists("Out/Other.st"));
}

TEST_F(Import, WritesThroughNoLinks) {
  write("a.EXP", "(* @PATH := '\\/Sub' *)\n"s + kProgram);
  write("victim/Main.st", "precious");
  fs::create_directories(path("Out"));
  fs::create_directory_symlink(path("victim"), path("Out/Sub"));
  EXPECT_EQ(import({"a.EXP", "-o", "Out", "--force"}).exitCode, 1);
  EXPECT_EQ(read("victim/Main.st"), "precious");
  fs::remove(path("Out/Sub"));
  fs::create_directories(path("Out/Sub"));
  fs::create_symlink(path("victim/Main.st"), path("Out/Sub/Main.st"));
  EXPECT_EQ(import({"a.EXP", "-o", "Out", "--force"}).exitCode, 0);
  EXPECT_EQ(read("victim/Main.st"), "precious") << "the link is replaced, not followed";
  EXPECT_FALSE(fs::is_symlink(path("Out/Sub/Main.st")));
}

TEST_F(Import, NamesOfFilesLeadNowhere) {
  write("a.EXP", "(* @PATH := '\\/..\\/..\\/build\\/.git' *)\n"
                 "(* @GLOBAL_VARIABLE_LIST := '../../../evil' *)\nVAR_GLOBAL\nEND_VAR\n"s);
  EXPECT_EQ(import({"a.EXP", "-o", "deep/er/Out"}).exitCode, 0);
  EXPECT_TRUE(exists("deep/er/Out/_./_./_build/_git/_________evil.st") ||
              exists("deep/er/Out/__/__/_build/_git/_________evil.st") ||
              exists("deep/er/Out/_./_./_build/_git/_________evil.st"))
      << read("deep/er/Out/import-report.md");
  EXPECT_FALSE(exists("evil.st"));
  EXPECT_FALSE(exists("deep/evil.st"));
}

TEST_F(Import, StrictWritesNothingWithLosses) {
  write("a.EXP", kProgram + "VISUALISATION V\nEND_VISUALISATION\n"s);
  const ProcessResult strict = import({"a.EXP", "-o", "Out", "--strict"});
  EXPECT_EQ(strict.exitCode, 1);
  EXPECT_THAT(strict.err, HasSubstr("error[SE0897]: a.EXP:7: VISUALISATION V"));
  EXPECT_FALSE(exists("Out"));
  write("b.EXP", kProgram);
  EXPECT_EQ(import({"b.EXP", "-o", "Out", "--strict"}).exitCode, 0);
}

TEST_F(Import, FoldersInCirclesEnd) {
  write("in/a/one.EXP", kProgram);
  fs::create_directory_symlink(path("in"), path("in/a/again"));
  fs::create_symlink(path("in/a/one.EXP"), path("in/two.EXP"));
  const ProcessResult result = import({"in", "in/a/one.EXP", "-o", "Out"});
  EXPECT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("1 object from 1 file"));
}

TEST_F(Import, SaysWhatItCannotRead) {
  // Nobody reads a link that leads to itself; root reads what has no permissions.
  fs::create_symlink("loop.EXP", path("loop.EXP"));
  const ProcessResult loop = import({"loop.EXP", "-o", "Out"});
  EXPECT_EQ(loop.exitCode, 2);
  EXPECT_THAT(loop.err, HasSubstr("loop.EXP"));
  EXPECT_FALSE(fs::exists(path("Out")));
  if (::geteuid() == 0)
    return;
  write("a.EXP", kProgram);
  fs::permissions(path("a.EXP"), fs::perms::none);
  const ProcessResult result = import({"a.EXP", "-o", "Out"});
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(result.err, HasSubstr("Permission denied"));
}

TEST_F(Import, MakesALibrary) {
  write("a.EXP",
        "FUNCTION Twice : INT\nVAR_INPUT\n  n : INT;\nEND_VAR\nTwice := 2 * n;\nEND_FUNCTION\n"s +
            kProgram);
  const ProcessResult result = import({"a.EXP", "-o", "Parts", "--library"});
  EXPECT_EQ(result.exitCode, 1) << "a library has no programs";
  EXPECT_EQ(read("Parts/stride.toml"), "[library]\nname = \"Parts\"\nversion = \"1.0.0\"\n");
  EXPECT_FALSE(exists("Parts/Main.st"));
  write("use/stride.toml",
        "[project]\nname = \"use\"\n[[library]]\nname = \"Parts\"\npath = \"../Parts\"\n");
  write("use/Main.st", "PROGRAM Main\nVAR\n  n : INT;\nEND_VAR\nn := Twice(21);\nEND_PROGRAM\n");
  const ProcessResult sim =
      runProcess({STRIDE_BINARY_DIR "/stride", "sim", "use", "--for", "10ms", "--print", "Main.n"},
                 scratch_.path());
  EXPECT_EQ(sim.out, "Main.n = 42\n") << sim.err;
  EXPECT_NE(import({"a.EXP", "-o", "no-name", "--library"}).exitCode, 0);
}

TEST_F(Import, LargeFilesAreReadQuickly) {
  std::string text;
  for (int i = 0; text.size() < 10'000'000; ++i)
    text += "FUNCTION F" + std::to_string(i) + " : INT\nVAR_INPUT\n  n : INT;\nEND_VAR\n(* " +
            std::string(100000, 'x') + " *)\nF" + std::to_string(i) + " := n + " +
            std::to_string(i % 100) + ";\nEND_FUNCTION\n";
  for (int i = 0; i < 100'000; ++i) // sections that do not end: none may look through all others
    text += "_OPEN" + std::to_string(i) + "\n";
  write("big.EXP", text);
  const ProcessResult result = import({"big.EXP", "-o", "Out"});
  EXPECT_EQ(result.exitCode, 1) << "sections without end are a loss";
  EXPECT_THAT(result.out, HasSubstr("1 left out, 0 changed, 0 to look at, 0 errors in the check"));
}

TEST_F(Import, AFullDiskOrAFileInTheWayLeavesNothingHalf) {
  write("a.EXP", kProgram);
  write("file", "x");
  const ProcessResult result = import({"a.EXP", "-o", "file/Out"});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("error[SE0833]"));
  EXPECT_EQ(read("file"), "x");
}

} // namespace
} // namespace stride::test
