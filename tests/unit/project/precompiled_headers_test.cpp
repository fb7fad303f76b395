// The headers of all units of a project: when they are compiled first, and that the cache has them.
#include "compiler/project/file_system.hpp"
#include "compiler/project/precompiled_headers.hpp"
#include "tests/support/text.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>

namespace stc {
namespace {

namespace fs = std::filesystem;

TEST(PrecompiledHeaders, ProjectsOfSeveralUnitsHaveThem) {
  Toolchain toolchain;
  EXPECT_FALSE(precompilesHeaders(toolchain, 1));
  EXPECT_FALSE(precompilesHeaders(toolchain, 7));
  EXPECT_TRUE(precompilesHeaders(toolchain, 8));
  toolchain.launcher = "/usr/bin/distcc";
  EXPECT_FALSE(precompilesHeaders(toolchain, 8));
}

class Headers : public ::testing::Test {
protected:
  Headers() {
    ::setenv("XDG_CACHE_HOME", (scratch_.path() / "cache").c_str(), 1);
    cache_ = UserCache::open();
    stride::test::writeFile(log_, "");
  }

  /// Precompiles for a build in the folder, with a compiler that notes its calls and writes `text`.
  std::optional<PrecompilingFailed> precompile(const std::string &build, uint64_t identity,
                                               const std::string &text) {
    const fs::path sources = scratch_.path() / build / "src";
    fs::create_directories(sources);
    // The shell gets the rest of the command as $0, $1 …: -x c++-header HEADER -o COMPILED.
    const std::string script =
        fmt::format("test \"$0 $1 $3\" = '-x c++-header -o' && echo call >> {} && cp \"$2\" {} && "
                    "{} > \"$4\"",
                    log_.string(), seen_.string(), text);
    return precompileHeaders(*cache_, ContentHash().add(identity), {"sh", "-c", script}, sources,
                             scratch_.path() / build);
  }
  std::string compiled(const std::string &build) {
    return stride::test::readFile(scratch_.path() / build / "src/headers__.h.gch");
  }
  size_t calls() { return stride::test::readFile(log_).size() / 5; }

  stride::test::ScratchDirectory scratch_;
  fs::path log_ = scratch_.path() / "log";
  fs::path seen_ = scratch_.path() / "seen";
  std::optional<UserCache> cache_;
};

TEST_F(Headers, TheSecondBuildHasThemOfTheCache) {
  ASSERT_TRUE(cache_);
  EXPECT_FALSE(precompile("first", 1, "printf one"));
  EXPECT_EQ(stride::test::readFile(seen_), "#include \"runtime/iec/ops.h\"\n");
  EXPECT_EQ(compiled("first"), "one");
  EXPECT_FALSE(precompile("second", 1, "printf other"));
  EXPECT_TRUE(compiled("second").starts_with("one")) << compiled("second");
  EXPECT_EQ(stride::test::readFile(scratch_.path() / "second/src/headers__.h"),
            stride::test::readFile(seen_));
  EXPECT_EQ(calls(), 1U);
  // Another compiler, other flags:
  EXPECT_FALSE(precompile("third", 2, "printf two"));
  EXPECT_EQ(compiled("third"), "two");
  EXPECT_EQ(calls(), 2U);
}

TEST_F(Headers, WhatIsDamagedIsCompiledAgain) {
  ASSERT_TRUE(cache_);
  EXPECT_FALSE(precompile("first", 1, "printf one"));
  for (const auto &entry : fs::recursive_directory_iterator(cache_->folder()))
    if (entry.path().extension() == ".gch")
      stride::test::writeFile(entry.path(), "on");
  EXPECT_FALSE(precompile("second", 1, "printf again"));
  EXPECT_EQ(compiled("second"), "again");
}

TEST_F(Headers, SaysWhatFailed) {
  ASSERT_TRUE(cache_);
  const std::optional<PrecompilingFailed> failed =
      precompile("first", 1, "{ echo no >&2; exit 3; }");
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->result.status, 3);
  EXPECT_EQ(failed->result.output, "no\n");
  EXPECT_EQ(failed->job.command.front(), "sh");
  // Nothing of it is kept.
  EXPECT_FALSE(precompile("second", 1, "printf good"));
  EXPECT_EQ(compiled("second"), "good");
}

TEST_F(Headers, SaysThatTheyCannotBeWritten) {
  ASSERT_TRUE(cache_);
  const fs::path inTheWay = scratch_.path() / "file";
  stride::test::writeFile(inTheWay, "");
  const auto failed =
      precompileHeaders(*cache_, ContentHash(), {"true"}, inTheWay, scratch_.path());
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->result.status, 0);
}

TEST(NewFile, IsWrittenWithItsFolderAndNeverOverAnother) {
  const stride::test::ScratchDirectory scratch;
  const fs::path path = scratch.path() / "some/folder/file.h";
  EXPECT_TRUE(writeNewFile(path, "text"));
  EXPECT_TRUE(writeNewFile(scratch.path() / "some/folder/empty.h", ""));
  EXPECT_FALSE(writeNewFile(path, "other"));
  EXPECT_EQ(errno, EEXIST);
  EXPECT_EQ(stride::test::readFile(path), "text");
  EXPECT_FALSE(writeNewFile(path / "below", "text"));
  EXPECT_EQ(errno, ENOTDIR);
}

} // namespace
} // namespace stc
