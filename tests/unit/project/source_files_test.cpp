// Which files belong to a project, and which project a folder belongs to.
#include "compiler/project/source_files.hpp"
#include "tests/support/text.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace stc {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class SourceFiles : public ::testing::Test {
protected:
  void touch(const std::string &name) {
    fs::create_directories((folder() / name).parent_path());
    stride::test::writeFile(folder() / name, "");
  }
  void link(const std::string &name, const std::string &target) {
    fs::create_directories((folder() / name).parent_path());
    fs::create_directory_symlink(target, folder() / name);
  }
  std::vector<std::string> find(const std::vector<std::string> &roots) {
    std::vector<fs::path> paths;
    for (const std::string &root : roots)
      paths.push_back((folder() / root).lexically_normal());
    found_ = findSources(sources_, paths);
    std::vector<std::string> names;
    for (const fs::path &file : found_.files)
      names.push_back(file.lexically_relative(folder()).string());
    return names;
  }
  [[nodiscard]] fs::path folder() const { return scratch_.path(); }

  stride::test::ScratchDirectory scratch_;
  Sources sources_;
  FoundFiles found_;
};

TEST_F(SourceFiles, SeveralFoldersAndFilesAreTakenOnce) {
  touch("p/src/a.st");
  touch("p/src/deep/b.st");
  touch("p/old/c.st");
  touch("shared/d.st");
  touch("p/one.st");
  EXPECT_THAT(find({"p/src", "shared", "p/one.st", "p/src/deep"}),
              ElementsAre("p/one.st", "p/src/a.st", "p/src/deep/b.st", "shared/d.st"));
}

TEST_F(SourceFiles, LinksToFoldersAreFollowedEachFileOnce) {
  touch("p/main.st");
  touch("p/sub/own.st");
  touch("shared/a.st");
  touch("shared/deep/b.st");
  touch("shared/build/no.st");
  touch("shared/other/stride.toml");
  touch("shared/other/no.st");
  link("p/x", "../shared");
  link("p/y", "../shared/deep");
  link("p/z", "sub");
  link("shared/deep/back", "..");
  EXPECT_THAT(find({"p"}), ElementsAre("p/main.st", "p/sub/own.st", "p/x/a.st", "p/x/deep/b.st"));
  EXPECT_THAT(found_.notFollowed, IsEmpty());
}

TEST_F(SourceFiles, ALinkToAFolderAroundItIsRefused) {
  touch("p/main.st");
  link("p/sub/up", "../..");
  EXPECT_THAT(find({"p"}), ElementsAre("p/main.st"));
  ASSERT_THAT(found_.notFollowed, SizeIs(1));
  EXPECT_EQ(found_.notFollowed[0].first, folder() / "p/sub/up");
  link("p/sub/here", ".");
  find({"p"});
  EXPECT_THAT(found_.notFollowed, SizeIs(2));
}

TEST_F(SourceFiles, ALinkToADiskIsRefused) {
  touch("p/main.st");
  fs::create_directories(folder() / "large");
  for (int i = 0; i < 10'000; ++i)
    ASSERT_EQ(::symlink("nowhere", (folder() / "large" / std::to_string(i)).c_str()), 0);
  link("p/large", "../large");
  EXPECT_THAT(find({"p"}), ElementsAre("p/main.st"));
  EXPECT_THAT(found_.notFollowed, IsEmpty()); // 10,000 are allowed
  touch("large/one more.st");
  EXPECT_THAT(find({"p"}), ElementsAre("p/main.st"));
  EXPECT_THAT(found_.notFollowed, SizeIs(1));
}

TEST_F(SourceFiles, AProjectIsFoundFromBelow) {
  touch("p/stride.toml");
  touch("p/src/deep/a.st");
  touch("q/a.st");
  EXPECT_EQ(findProjectFolder(folder() / "p"), folder() / "p");
  EXPECT_EQ(findProjectFolder(folder() / "p/src/deep"), folder() / "p");
  EXPECT_EQ(findProjectFolder(folder() / "q"), folder() / "q");
  const fs::path before = fs::current_path();
  fs::current_path(folder() / "p/src");
  EXPECT_EQ(findProjectFolder("."), "..");
  fs::current_path(folder() / "p");
  EXPECT_EQ(findProjectFolder("."), ".");
  fs::current_path(before);
}

TEST_F(SourceFiles, SomebodyElsesProjectIsNotTaken) {
  if (::geteuid() != 0)
    GTEST_SKIP() << "only root can give files away";
  touch("p/stride.toml");
  touch("p/mine/a.st");
  ASSERT_EQ(::chown((folder() / "p/stride.toml").c_str(), 12345, 12345), 0);
  EXPECT_EQ(findProjectFolder(folder() / "p/mine"), folder() / "p/mine");
}

} // namespace
} // namespace stc
