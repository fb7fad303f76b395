#include "compiler/project/output_folder.hpp"
#include "compiler/project/user_cache.hpp"
#include "compiler/source/content_hash.hpp"
#include "tests/support/text.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <future>

namespace stc {
namespace {

namespace fs = std::filesystem;
using stride::test::readFile;
using stride::test::ScratchDirectory;
using stride::test::writeFile;

class Cache : public ::testing::Test {
protected:
  Cache() {
    ::setenv("XDG_CACHE_HOME", scratch_.path().c_str(), 1);
    cache_ = UserCache::open();
  }

  std::string key(int number) { return ContentHash().add(uint64_t(number)).hex(); }
  fs::path file(const std::string &text) {
    fs::path path = scratch_.path() / "file";
    writeFile(path, text);
    return path;
  }

  ScratchDirectory scratch_;
  std::optional<UserCache> cache_;
};

TEST_F(Cache, GivesBackWhatWasPublished) {
  ASSERT_TRUE(cache_);
  EXPECT_EQ(cache_->problem(), "");
  EXPECT_FALSE(cache_->content(key(1), ".o"));
  for (const std::string &text : {std::string(), std::string("text"), std::string(70000, '\0')}) {
    ASSERT_TRUE(cache_->publish(key(1), ".o", file(text)));
    EXPECT_TRUE(cache_->mayHave(key(1), ".o"));
    EXPECT_FALSE(cache_->content(key(1), ".so"));
    EXPECT_EQ(cache_->content(key(1), ".o"), text);
    const fs::path to = scratch_.path() / "copy";
    fs::remove(to);
    ASSERT_TRUE(cache_->fetch(key(1), ".o", to));
    EXPECT_TRUE(readFile(to).starts_with(text));
  }
}

TEST_F(Cache, WhatIsNotWholeIsNotThere) {
  ASSERT_TRUE(cache_->publish(key(2), ".o", file("some object")));
  const std::string whole = readFile(cache_->place(key(2), ".o"));
  for (size_t length = 0; length < whole.size(); ++length) {
    writeFile(cache_->place(key(2), ".o"), whole.substr(0, length));
    EXPECT_FALSE(cache_->content(key(2), ".o")) << length;
    EXPECT_FALSE(fs::exists(cache_->place(key(2), ".o")));
  }
  for (size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x20);
    writeFile(cache_->place(key(2), ".o"), changed);
    EXPECT_FALSE(cache_->content(key(2), ".o")) << at;
  }
}

TEST_F(Cache, OneAtATimeDoesWhatHasAKey) {
  std::optional<CacheLock> first = cache_->lock(key(3));
  ASSERT_TRUE(first);
  EXPECT_TRUE(cache_->lock(key(4))); // something else
  std::future<bool> second =
      std::async(std::launch::async, [&] { return cache_->lock(key(3)).has_value(); });
  EXPECT_EQ(second.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout);
  first.reset();
  EXPECT_TRUE(second.get());
  EXPECT_TRUE(fs::is_empty(cache_->folder() / "locks"));
}

TEST_F(Cache, AWorkFolderGoesUnlessItIsKept) {
  fs::path gone;
  fs::path kept;
  {
    std::optional<WorkFolder> one = cache_->makeWorkFolder();
    std::optional<WorkFolder> two = cache_->makeWorkFolder();
    ASSERT_TRUE(one && two);
    gone = one->path();
    kept = two->path();
    EXPECT_NE(gone, kept);
    writeFile(gone / "file", "text");
    two->keep();
  }
  EXPECT_FALSE(fs::exists(gone));
  EXPECT_TRUE(fs::exists(kept));
}

TEST_F(Cache, TheLatestBuildIsAlwaysFound) {
  ASSERT_TRUE(cache_->setLatest(key(5), file("x")));
  ASSERT_TRUE(cache_->publish(key(6), ".so", file("new")));
  ASSERT_TRUE(cache_->setLatest(key(5), cache_->place(key(6), ".so")));
  EXPECT_EQ(fs::canonical(cache_->latest(key(5))), cache_->place(key(6), ".so"));
  EXPECT_EQ(cache_->content(key(6), ".so"), "new");
}

TEST(OutputFolderTest, FollowsNoLinkBelowItself) {
  const ScratchDirectory scratch;
  fs::create_directories(scratch.path() / "outside");
  writeFile(scratch.path() / "outside" / "file", "precious");
  fs::create_directories(scratch.path() / "p");
  fs::create_directory_symlink("p", scratch.path() / "named");
  fs::create_directory_symlink("../outside", scratch.path() / "p" / "linked");
  fs::create_symlink("../outside/file", scratch.path() / "p" / "result");
  const std::optional<OutputFolder> folder = OutputFolder::open(scratch.path() / "named");
  ASSERT_TRUE(folder);
  for (const char *name : {"linked/file", "linked/new", "linked/a/b"}) {
    EXPECT_FALSE(folder->write(name, "x")) << name;
    EXPECT_EQ(errno, ELOOP) << name;
    EXPECT_FALSE(folder->remove(name)) << name;
    EXPECT_FALSE(folder->read(name, 64)) << name;
  }
  for (const char *name : {"../outside/file", "a/../../outside/file", "/etc/x", "", "a/"})
    EXPECT_FALSE(folder->write(name, "x")) << name;
  EXPECT_FALSE(folder->read("result", 64));
  EXPECT_TRUE(folder->write("result", "mine"));
  EXPECT_TRUE(folder->write("deep/er/file", "text"));
  EXPECT_EQ(folder->read("deep/er/file", 5), "text");
  EXPECT_EQ(folder->read("deep/er/file", 4), "text");
  EXPECT_FALSE(folder->read("deep/er/file", 3));
  EXPECT_TRUE(folder->hasFile("deep/er/file"));
  EXPECT_FALSE(folder->hasFile("deep/er") || folder->hasFile("linked/file") ||
               folder->hasFile("deep/other"));
  EXPECT_EQ(readFile(scratch.path() / "p/result"), "mine");
  EXPECT_EQ(readFile(scratch.path() / "outside/file"), "precious");
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path() / "outside"), {}), 1);
}

} // namespace
} // namespace stc
