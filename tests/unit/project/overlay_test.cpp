// What an editor has not saved goes before the disk.
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"
#include "compiler/source/render.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <fstream>

namespace stc {
namespace {

namespace fs = std::filesystem;
using stride::test::ScratchDirectory;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Unsaved : public ::testing::Test {
protected:
  void SetUp() override {
    write("Main.st", "PROGRAM Main\nVAR n : INT; END_VAR\nn := F(n);\nEND_PROGRAM\n");
    write("lib/F.st", "FUNCTION F : INT\nVAR_INPUT a : INT; END_VAR\nF := a;\nEND_FUNCTION\n");
  }

  void write(const std::string &name, const std::string &text) {
    fs::create_directories((folder() / name).parent_path());
    std::ofstream(folder() / name, std::ios::binary) << text;
  }

  /// What a check says: file, line and column of the first place, and the message.
  std::vector<std::string> check(const fs::path &path) {
    const Project project(path, Purpose::Check, {}, index_, &overlay_);
    std::vector<std::string> said;
    for (const Diagnostic &d : project.diagnostics()) {
      if (d.severity != Severity::Error)
        continue;
      std::string place;
      if (!d.labels.empty() && d.labels[0].span.valid()) {
        const LineColumn at = project.sources().position(d.labels[0].span);
        place = project.sources().file(d.labels[0].span.file).name() + ":" +
                std::to_string(at.line) + ":" + std::to_string(at.column) + " ";
      }
      said.push_back(place + d.message);
    }
    return said;
  }
  std::vector<std::string> check() { return check(folder()); }

  [[nodiscard]] fs::path folder() const { return scratch_.path(); }

  ScratchDirectory scratch_;
  Overlay overlay_;
  EmbeddedLibraryIndex index_{standardLibrary()};
};

TEST_F(Unsaved, TextGoesBeforeTheFile) {
  EXPECT_THAT(check(), IsEmpty());
  overlay_.set(folder() / "lib" / "F.st", "FUNCTION F : INT\nVAR_INPUT b : INT; END_VAR\n"
                                          "F := gone;\nEND_FUNCTION\n");
  EXPECT_THAT(check(), ElementsAre("lib/F.st:3:6 cannot find `gone`"));
  overlay_.remove(folder() / "lib" / ".." / "lib" / "F.st");
  EXPECT_THAT(check(), IsEmpty());
}

TEST_F(Unsaved, AFileHasOneNameWhateverLeadsToIt) {
  fs::create_directory_symlink(folder() / "lib", folder() / "other");
  overlay_.set(folder() / "other" / "F.st", "FUNCTION F : INT\n1;\nEND_FUNCTION\n");
  const std::string *text = overlay_.find(folder() / "lib" / "F.st");
  ASSERT_NE(text, nullptr);
  EXPECT_THAT(*text, HasSubstr("1;"));
  EXPECT_EQ(overlay_.find(folder() / "lib" / "G.st"), nullptr);
}

TEST_F(Unsaved, NewFilesBelongToTheProject) {
  write("Main.st", "PROGRAM Main\nVAR n : INT; END_VAR\nn := F(n) + G(n);\nEND_PROGRAM\n");
  EXPECT_THAT(check(), ElementsAre("Main.st:3:13 cannot find `G`"));
  const std::string g = "FUNCTION G : INT\nVAR_INPUT a : INT; END_VAR\nG := -a;\nEND_FUNCTION\n";
  for (const char *notRead : {".hidden/G.st", "build/G.st", "G.txt", ".G.st", "own/deep/G.st"}) {
    overlay_.set(folder() / notRead, g);
    if (std::string_view(notRead).starts_with("own"))
      overlay_.set(folder() / "own/stride.toml", ""); // a project of its own
    EXPECT_THAT(check(), ElementsAre("Main.st:3:13 cannot find `G`")) << notRead;
    overlay_.remove(folder() / notRead);
  }
  overlay_.set(folder() / "new" / "G.st", g);
  EXPECT_THAT(check(), IsEmpty());
  overlay_.set(folder().parent_path() / "elsewhere.st", "PROGRAM Main\nEND_PROGRAM\n");
  EXPECT_THAT(check(), IsEmpty());
}

TEST_F(Unsaved, ConfigurationAndCams) {
  overlay_.set(folder() / "stride.toml", "[[task]]\nname = \"T\"\nprograms = [\"Mian\"]\n");
  EXPECT_THAT(check(), ElementsAre("stride.toml:1:3 a task needs `interval`",
                                   "stride.toml:3:13 there is no PROGRAM `Mian`"));
  overlay_.set(folder() / "stride.toml",
               "[[task]]\nname = \"T\"\ninterval = \"T#4ms\"\nprograms = [\"Main\"]\n");
  EXPECT_THAT(check(), IsEmpty());
  overlay_.set(folder() / "Lift.cam.toml", "[master]\nstart = 5\nend = 5\n");
  EXPECT_THAT(check(), ElementsAre(HasSubstr("Lift.cam.toml:")));
}

TEST_F(Unsaved, ASingleFileThatTheDiskDoesNotHave) {
  EXPECT_THAT(check(folder() / "New.st"), ElementsAre(HasSubstr("there is no file or folder")));
  overlay_.set(folder() / "New.st", "PROGRAM P\nx := 1;\nEND_PROGRAM\n");
  EXPECT_THAT(check(folder() / "New.st"), ElementsAre(HasSubstr(":2:1 cannot find `x`")));
}

TEST_F(Unsaved, NoLongerThanFilesMayBe) {
  overlay_.set(folder() / "lib" / "F.st", std::string((size_t{16} << 20U) + 1, ' '));
  EXPECT_THAT(check(), ElementsAre(HasSubstr("F.st` cannot be read: it is longer than 16 MiB"),
                                   "Main.st:3:6 cannot find `F`"));
}

} // namespace
} // namespace stc
