// The cache of compiled code, where others may write: docs/security.md.
#include "tests/system/hostile_project.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

namespace stride::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class SharedCache : public HostileProject {
protected:
  /// The program counts as it should, and says or does not say that the cache is not used.
  void expectRun(bool trusted, const Environment &environment) {
    std::vector<std::string> command = {"/usr/bin/env", "-i", "PATH=/usr/bin:/bin"};
    for (const auto &[name, value] : environment)
      command.push_back(name + "=" + value);
    command.insert(command.end(), {STRIDE_BINARY_DIR "/stride", "sim", at("p/a.st").string(),
                                   "--for", "T#30ms", "--print", "PLC_PRG.n"});
    const ProcessResult result = runProcess(command, scratch_.path());
    EXPECT_EQ(result.out, "PLC_PRG.n = 3\n") << result.err;
    if (trusted)
      EXPECT_EQ(result.err, "");
    else
      EXPECT_THAT(result.err, HasSubstr("warning[SE0839]"));
  }
  std::string ownName() const { return "tmp/stride-" + std::to_string(::geteuid()); }
  /// All units and applications of the cache become something else.
  void damageAll(const fs::path &folder) {
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".so" || entry.path().extension() == ".o")
        writeFile(entry.path(), "wrong code");
  }
};

TEST_F(SharedCache, WithoutAHomeItIsInTheFolderForTemporaryFiles) {
  fs::create_directory(at("tmp"));
  const Environment temporary = {{"TMPDIR", at("tmp").string()}};
  expectRun(true, temporary);
  EXPECT_TRUE(fs::exists(at(ownName() + "/v1/CACHEDIR.TAG")));
  EXPECT_EQ(fs::status(at(ownName())).permissions(), fs::perms::owner_all);
  expectRun(true, temporary);
}

TEST_F(SharedCache, FoldersThatOthersMayWriteAreNotUsed) {
  fs::create_directory(at("tmp"));
  const Environment temporary = {{"TMPDIR", at("tmp").string()}};
  // Somebody was there before us.
  fs::create_directory(at(ownName()));
  ASSERT_EQ(::chmod(at(ownName()).c_str(), 0777), 0);
  expectRun(false, temporary);
  EXPECT_TRUE(fs::is_empty(at(ownName())));
  fs::remove(at(ownName()));
  link("../home", ownName());
  expectRun(false, temporary);
  expectHomeUntouched();
  fs::remove(at(ownName()));
  write(ownName(), "a file");
  expectRun(false, temporary);
  if (::geteuid() == 0) {
    fs::remove(at(ownName()));
    fs::create_directory(at(ownName()));
    ASSERT_EQ(::chown(at(ownName()).c_str(), 65534, 65534), 0);
    expectRun(false, temporary);
  }
}

TEST_F(SharedCache, EveryFolderAboveIsLookedAt) {
  if (::geteuid() != 0)
    GTEST_SKIP() << "folders of somebody else need root";
  const auto cache = [&](const std::string &name) {
    return Environment{{"XDG_CACHE_HOME", at(name).string()}, {"TMPDIR", scratch_.path().string()}};
  };
  fs::create_directories(at("up/middle/mine"));
  expectRun(true, cache("up/middle/mine"));
  // At, below and above what is let through.
  for (const auto &[mode, trusted] : std::vector<std::pair<mode_t, bool>>{
           {0755, true}, {0775, true}, {0777, false}, {01777, true}, {0757, false}, {0700, true}}) {
    ASSERT_EQ(::chmod(at("up").c_str(), mode), 0);
    expectRun(trusted, cache("up/middle/mine"));
  }
  // A group that somebody else is in.
  ASSERT_EQ(::chown(at("up").c_str(), 0, 100), 0);
  for (const auto &[mode, trusted] :
       std::vector<std::pair<mode_t, bool>>{{0755, true}, {0775, false}, {01775, true}}) {
    ASSERT_EQ(::chmod(at("up").c_str(), mode), 0);
    expectRun(trusted, cache("up/middle/mine"));
  }
  ASSERT_EQ(::chmod(at("up").c_str(), 0755), 0);
  ASSERT_EQ(::chown(at("up").c_str(), 65534, 0), 0);
  expectRun(false, cache("up/middle/mine"));
  ASSERT_EQ(::chown(at("up").c_str(), 0, 0), 0);
  // Links: ours, ours through a folder that is open to all, somebody else's, and round in circles.
  link("middle/mine", "up/link");
  expectRun(true, cache("up/link"));
  fs::create_directories(at("open/mine"));
  ASSERT_EQ(::chmod(at("open").c_str(), 0777), 0);
  link("../open/mine", "up/out");
  expectRun(false, cache("up/out"));
  ASSERT_EQ(::lchown(at("up/link").c_str(), 65534, 65534), 0);
  expectRun(false, cache("up/link"));
  link("round", "up/round");
  expectRun(false, cache("up/round"));
}

TEST_F(SharedCache, FoldersThatStrideMakesAreTheUsersAlone) {
  const ProcessResult result =
      runProcess({"sh", "-c", "umask 0; exec " STRIDE_BINARY_DIR "/stride sim p --for T#30ms"},
                 scratch_.path(), {{"XDG_CACHE_HOME", at("new/cache").string()}});
  EXPECT_EQ(result.err, "");
  for (const char *name : {"new", "new/cache", "new/cache/stride", "new/cache/stride/v1"})
    EXPECT_EQ(fs::status(at(name)).permissions(), fs::perms::owner_all) << name;
}

TEST_F(SharedCache, WhatIsNoFileInItDoesNotHinder) {
  succeed({"sim", "p", "--for", "T#30ms"});
  // A folder in the place of each result.
  std::vector<fs::path> results;
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(at("cache/stride/v1")))
    if (entry.is_regular_file() && entry.path().filename() != "CACHEDIR.TAG")
      results.push_back(entry.path());
  ASSERT_GE(results.size(), 3U);
  for (const fs::path &path : results) {
    fs::remove(path);
    fs::create_directories(path / "inside");
  }
  expectRun(true, {{"XDG_CACHE_HOME", at("cache").string()}});
  succeed({"sim", "p", "--for", "T#30ms"});
  // A pipe in the place of the mark is not waited for.
  fs::remove(at("cache/stride/v1/CACHEDIR.TAG"));
  ASSERT_EQ(::mkfifo(at("cache/stride/v1/CACHEDIR.TAG").c_str(), 0600), 0);
  expectRun(false,
            {{"XDG_CACHE_HOME", at("cache").string()}, {"TMPDIR", scratch_.path().string()}});
}

TEST_F(SharedCache, ACacheThatGoesAwayOrIsFullIsNoDefectOfStride) {
  // A compiler that does it.
  write("gone", "#!/bin/sh\ncase \"$*\" in *-c*) rm -rf " + at("cache").string() +
                    ";; esac\nexec g++ \"$@\"\n");
  write("full", "#!/bin/sh\ncase \"$*\" in *' -c '*) echo 'fatal error: error writing to x.s: No "
                "space left on device'; exit 1;; esac\nexec g++ \"$@\"\n");
  for (const char *name : {"gone", "full"}) {
    ASSERT_EQ(::chmod(at(name).c_str(), 0755), 0);
    const ProcessResult result = stride({"build", "p"}, {{"STRIDE_CXX", at(name).string()}});
    EXPECT_EQ(result.exitCode, 1) << name;
    EXPECT_THAT(result.err, AllOf(HasSubstr("error[SE0833]"), Not(HasSubstr("defect")))) << name;
  }
  succeed({"build", "p"});
}

TEST_F(SharedCache, AFileThatMayNotGrowEndsNothing) {
  succeed({"build", "p"});
  const std::string before = read("p/build/app.so");
  write("p/a.st", std::string(kCounter) + "FUNCTION More : INT\nMore := 1;\nEND_FUNCTION\n");
  const ProcessResult result =
      runProcess({"sh", "-c", "ulimit -f 4; exec " STRIDE_BINARY_DIR "/stride build p"},
                 scratch_.path(), {{"XDG_CACHE_HOME", at("cache").string()}});
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_THAT(result.err, HasSubstr("error[SE0833]"));
  EXPECT_EQ(read("p/build/app.so"), before);
  for (const fs::directory_entry &entry : fs::directory_iterator(at("p/build")))
    EXPECT_THAT(entry.path().filename().string(), ::testing::AnyOf("app.so", ".gitignore"));
}

TEST_F(SharedCache, AFolderWithoutOurMarkIsSomebodyElses) {
  const std::string thesis = (fs::path("cache/stride/v1") / "work" / "thesis.txt").string();
  write(thesis, "years of work");
  fs::permissions(at("cache/stride"), fs::perms::owner_all);
  fs::permissions(at("cache/stride/v1"), fs::perms::owner_all);
  expectRun(false,
            {{"XDG_CACHE_HOME", at("cache").string()}, {"TMPDIR", scratch_.path().string()}});
  EXPECT_EQ(read(thesis), "years of work");
  EXPECT_FALSE(fs::exists(at("cache/stride/v1/CACHEDIR.TAG")));
}

TEST_F(SharedCache, WhatIsDamagedIsMadeAnew) {
  succeed({"sim", "p/a.st", "--for", "T#30ms"});
  damageAll(at("cache/stride/v1"));
  EXPECT_EQ(stride({"sim", "p/a.st", "--for", "T#30ms", "--print", "PLC_PRG.n"}).out,
            "PLC_PRG.n = 3\n");
  // Cut off, as after a loss of power; one byte of it changed.
  for (const bool cut : {true, false})
    for (const fs::directory_entry &entry :
         fs::recursive_directory_iterator(at("cache/stride/v1"))) {
      if (entry.path().extension() != ".so" && entry.path().extension() != ".o")
        continue;
      std::string text = readFile(entry.path());
      if (cut)
        text.resize(text.size() / 2);
      else
        text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
      writeFile(entry.path(), text);
      const ProcessResult result =
          stride({"sim", "p/a.st", "--for", "T#30ms", "--print", "PLC_PRG.n"});
      EXPECT_EQ(result.out, "PLC_PRG.n = 3\n") << entry.path() << result.err;
    }
}

} // namespace
} // namespace stride::test
