#include "compiler/project/project.hpp"

#include "compiler/project/file_system.hpp"
#include "compiler/project/library_index.hpp"

#include <cerrno>
#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace stc {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class ProjectTest : public ::testing::Test {
protected:
  ProjectTest() {
    std::string name = (fs::temp_directory_path() / "stride-project-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~ProjectTest() override { fs::remove_all(folder_); }

  void write(const std::string &name, const std::string &text) {
    ASSERT_TRUE(writeFile(folder_ / name, text));
  }

  std::vector<std::string> open(const fs::path &path, Purpose purpose = Purpose::Check) {
    const Project project(path, purpose, {}, index_);
    names_.clear();
    for (size_t i = 1; i <= project.sources().size(); ++i)
      if (const std::string &name = project.sources().file(static_cast<FileId>(i)).name();
          !name.starts_with('<'))
        names_.push_back(name);
    std::vector<std::string> codes;
    for (const Diagnostic &d : project.diagnostics())
      codes.push_back(codeName(d.code));
    return codes;
  }

  fs::path folder_;
  EmbeddedLibraryIndex index_{standardLibrary()};
  std::vector<std::string> names_;
};

constexpr const char *kProgram = "PROGRAM PLC_PRG\nEND_PROGRAM\n";

// Through a link, so that a fault costs a link and not the device.
TEST_F(ProjectTest, WritesIntoADeviceInsteadOfReplacingIt) {
  const fs::path path = folder_ / "device";
  fs::create_symlink("/dev/full", path);
  EXPECT_FALSE(writeFile(path, "text"));
  EXPECT_EQ(errno, ENOSPC);
  EXPECT_TRUE(fs::is_character_file(path));
  fs::remove(path);
  fs::create_symlink("/dev/null", path);
  EXPECT_TRUE(writeFile(path, "text"));
  EXPECT_TRUE(fs::is_character_file(path));
}

TEST_F(ProjectTest, SaysWhyALinkToItselfCannotBeRead) {
  fs::create_symlink("loop.st", folder_ / "loop.st");
  EXPECT_THAT(open(folder_ / "loop.st"), ElementsAre(codeName(Code::UnreadableFile)));
  EXPECT_THAT(open(folder_ / "none.st"), ElementsAre(codeName(Code::PathNotFound)));
}

TEST_F(ProjectTest, ReadsAFolderSortedAndSkipsWhatIsNotItsOwn) {
  write("stride.toml", "");
  write("b.st", kProgram);
  write("a/z.ST", "FUNCTION_BLOCK Z\nEND_FUNCTION_BLOCK\n");
  write("build/x.st", "nonsense");
  write(".git/x.st", "nonsense");
  write("readme.txt", "nonsense");
  write("other/stride.toml", "[project]\n");
  write("other/x.st", "nonsense");
  EXPECT_THAT(open(folder_), IsEmpty());
  EXPECT_THAT(names_, ElementsAre("stride.toml", "a/z.ST", "b.st"));
}

TEST_F(ProjectTest, SeveralFilesWithoutAManifestAreAWarning) {
  write("b.st", kProgram);
  EXPECT_THAT(open(folder_), IsEmpty());
  write("c.st", "FUNCTION C : INT\nEND_FUNCTION\n");
  EXPECT_THAT(open(folder_), ElementsAre("SE0856"));
  EXPECT_THAT(open(folder_ / "b.st"), IsEmpty());
}

TEST_F(ProjectTest, TakesASingleFile) {
  write("b.st", kProgram);
  EXPECT_THAT(open(folder_ / "b.st"), IsEmpty());
  EXPECT_THAT(names_, ElementsAre((folder_ / "b.st").string()));
}

TEST_F(ProjectTest, TakesTheManifestForItsFolder) {
  write("b.st", kProgram);
  write("stride.toml", "[project]\nname = \"P\"\n");
  EXPECT_THAT(open(folder_ / "stride.toml"), IsEmpty());
  EXPECT_THAT(names_, ElementsAre("stride.toml", "b.st"));
}

TEST_F(ProjectTest, MissingPath) { EXPECT_THAT(open(folder_ / "nothing"), ElementsAre("SE0830")); }

TEST_F(ProjectTest, FolderWithoutSources) { EXPECT_THAT(open(folder_), ElementsAre("SE0831")); }

TEST_F(ProjectTest, EmptyFile) {
  write("a.st", "(* nothing *)\n");
  EXPECT_THAT(open(folder_ / "a.st"), ElementsAre("SE0832"));
}

TEST_F(ProjectTest, UnreadableFile) {
  write("a.st", kProgram);
  fs::permissions(folder_ / "a.st", fs::perms::none);
  if (::access((folder_ / "a.st").c_str(), R_OK) == 0)
    GTEST_SKIP() << "this user may read everything";
  EXPECT_THAT(open(folder_ / "a.st"), ElementsAre("SE0101"));
}

TEST_F(ProjectTest, BrokenManifestIsTheOnlyError) {
  write("a.st", "PROGRAM P\nDrive.x := 1;\nEND_PROGRAM\n");
  write("stride.toml", "[[bus]\n");
  EXPECT_THAT(open(folder_), ElementsAre("SE0801"));
}

TEST_F(ProjectTest, BuildNeedsAProgram) {
  write("a.st", "FUNCTION_BLOCK B\nEND_FUNCTION_BLOCK\n");
  EXPECT_THAT(open(folder_, Purpose::Check), IsEmpty());
  EXPECT_THAT(open(folder_, Purpose::Build), ElementsAre("SE0815"));
}

} // namespace
} // namespace stc
