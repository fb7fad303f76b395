// `stride fmt` on files: what is written, how, and what is not.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace stride::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Fmt : public ::testing::Test {
protected:
  ProcessResult fmt(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {STRIDE_BINARY_DIR "/stride", "fmt"});
    return runProcess(arguments, scratch_.path());
  }
  void write(const std::string &name, const std::string &text) {
    fs::create_directories((scratch_.path() / name).parent_path());
    writeFile(scratch_.path() / name, text);
  }
  std::string read(const std::string &name) { return readFile(scratch_.path() / name); }
  fs::path path(const std::string &name) { return scratch_.path() / name; }

  ScratchDirectory scratch_;
};

constexpr const char *kUgly = "program p var n:int; end_var n:=1; end_program";
constexpr const char *kPretty = "PROGRAM p\nVAR\n  n : INT;\nEND_VAR\nn := 1;\nEND_PROGRAM\n";

TEST_F(Fmt, KeepsEncodings) {
  write("latin1.st", "(* \xFC\xE4 *) program p\r\nend_program // \xA7\r\n");
  write("utf8.st", "(* \xC3\xBC *) program p\r\nend_program\r\n");
  write("mark.st", "\xEF\xBB\xBFprogram p end_program");
  write("latin1mark.st", "\xEF\xBB\xBF(* \xFC *) program p end_program");
  EXPECT_EQ(fmt({}).exitCode, 0);
  EXPECT_EQ(read("latin1.st"), "(* \xFC\xE4 *) PROGRAM p\nEND_PROGRAM // \xA7\n");
  EXPECT_EQ(read("utf8.st"), "(* \xC3\xBC *) PROGRAM p\nEND_PROGRAM\n");
  EXPECT_EQ(read("mark.st"), "\xEF\xBB\xBFPROGRAM p\nEND_PROGRAM\n");
  EXPECT_EQ(read("latin1mark.st"), "\xEF\xBB\xBF(* \xFC *) PROGRAM p\nEND_PROGRAM\n");
}

TEST_F(Fmt, KeepsPermissionsAndLinks) {
  write("real/a.st", kUgly);
  fs::permissions(path("real/a.st"), fs::perms(0750));
  fs::create_symlink("real/a.st", path("link.st"));
  EXPECT_EQ(fmt({"link.st"}).exitCode, 0);
  EXPECT_TRUE(fs::is_symlink(path("link.st")));
  EXPECT_EQ(read("real/a.st"), kPretty);
  EXPECT_EQ(fs::status(path("real/a.st")).permissions(), fs::perms(0750));
  EXPECT_EQ(std::distance(fs::directory_iterator(path("real")), {}), 1) << "nothing is left behind";
}

TEST_F(Fmt, DoesNotWriteWhatIsFormatted) {
  write("a.st", kPretty);
  const auto before = fs::file_time_type(std::chrono::seconds(1000));
  fs::last_write_time(path("a.st"), before);
  EXPECT_EQ(fmt({"--check"}).exitCode, 0);
  EXPECT_EQ(fmt({}).exitCode, 0);
  EXPECT_EQ(fs::last_write_time(path("a.st")), before);
}

TEST_F(Fmt, ChecksWithoutWriting) {
  write("a.st", kPretty);
  write("sub/b.st", kUgly);
  write("build/c.st", kUgly);
  const ProcessResult check = fmt({"--check"});
  EXPECT_EQ(check.exitCode, 1);
  EXPECT_EQ(check.out, "sub/b.st\n");
  const ProcessResult diff = fmt({"--diff"});
  EXPECT_EQ(diff.exitCode, 0);
  EXPECT_THAT(diff.out,
              HasSubstr("--- sub/b.st\n+++ sub/b.st, formatted\n@@ -1,1 +1,6 @@\n-program"));
  EXPECT_EQ(read("sub/b.st"), kUgly);
}

TEST_F(Fmt, OneWrongFileDoesNotKeepOthers) {
  write("a.st", "PROGRAM p n := ; END_PROGRAM");
  write("b.st", kUgly);
  const ProcessResult result = fmt({});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("a.st:1:16"));
  EXPECT_EQ(read("a.st"), "PROGRAM p n := ; END_PROGRAM");
  EXPECT_EQ(read("b.st"), kPretty);
}

TEST_F(Fmt, TakesTheNearestSettings) {
  write("stride.toml",
        "[fmt]\nindent = 4\n[project]\nname = 3 # wrong, which does not matter here\n");
  write("sub/a.st", kUgly);
  EXPECT_EQ(fmt({"sub/a.st"}).exitCode, 0);
  EXPECT_THAT(read("sub/a.st"), HasSubstr("\n    n : INT;"));
  write("sub/stride.toml", "[fmt]\nkeywords = \"keep\"\n");
  write("sub/a.st", kUgly);
  EXPECT_EQ(fmt({"sub"}).exitCode, 0);
  EXPECT_THAT(read("sub/a.st"), HasSubstr("var\n  n : int;"));
}

TEST_F(Fmt, BadUse) {
  EXPECT_EQ(fmt({"--wrong"}).exitCode, 1);
  const ProcessResult missing = fmt({"missing.st"});
  EXPECT_EQ(missing.exitCode, 1);
  EXPECT_THAT(missing.err, HasSubstr("there is no file or folder `missing.st`"));
  const ProcessResult empty = fmt({});
  EXPECT_EQ(empty.exitCode, 1);
  EXPECT_THAT(empty.err, HasSubstr("there are no `.st` files"));
}

} // namespace
} // namespace stride::test
