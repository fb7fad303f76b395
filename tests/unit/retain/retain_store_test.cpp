// The files of retained data on a disk that may lose its power after every call: whatever was not
// synced by then is on the disk, or is not, in any combination. In every case the newest image that
// was acknowledged, or a later one, is there, complete.
#include "runtime/app/checksum.hpp"
#include "runtime/app/retain_store.hpp"
#include "tests/support/text.hpp"
#include "tests/unit/retain/fake_disk.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

using namespace stride;
using app::RetainStore;
using test::FakeFiles;
using test::Generations;
using test::outcomes;
using test::PowerCut;

struct Counted {
  size_t cuts = 0;
  size_t ends = 0;
};

/// From a disk on: loads, saves up to `saves` times, and loses the power after every call; then
/// the same again from every disk that this can leave.
void cutEverywhere(const Generations &generations, const FakeFiles &from, uint32_t acknowledged,
                   int saves, int depth, Counted &counted) {
  for (int cut = 0;; ++cut) {
    const std::unique_ptr<FakeFiles> files = from.copy();
    files->callsLeft = cut;
    uint32_t safe = acknowledged;
    bool through = false;
    try {
      RetainStore store("/folder/file", *files);
      std::vector<std::string> problems;
      uint32_t generation = Generations::load(store, problems);
      ASSERT_GE(generation, acknowledged);
      // What was loaded is on the disk from now on.
      if (generation != 0)
        safe = generation;
      for (int i = 0; i < saves; ++i) {
        generations.save(store, ++generation);
        safe = generation;
      }
      through = true;
    } catch (const PowerCut &) {
      ++counted.cuts;
    }
    for (const std::vector<size_t> &order : outcomes(files->pending().size())) {
      const std::unique_ptr<FakeFiles> after = files->copy();
      after->restart(order);
      ++counted.ends;
      RetainStore store("/folder/file", *after);
      std::vector<std::string> problems;
      const uint32_t found = Generations::load(store, problems);
      ASSERT_GE(found, safe) << "cut " << cut;
      ASSERT_LE(found, safe + 1);
      if (depth > 1)
        cutEverywhere(generations, *after, found, saves, depth - 1, counted);
    }
    if (through)
      return;
  }
}

TEST(RetainStore, LosesNothingWhereverThePowerIsCut) {
  const Generations generations;
  const FakeFiles empty;
  Counted counted;
  cutEverywhere(generations, empty, 0, 3, 2, counted);
  EXPECT_GT(counted.cuts, 100U);
  EXPECT_GT(counted.ends, 10000U);
  RecordProperty("ends", static_cast<int>(counted.ends));
}

/// Kills of the process alone leave everything as the system sees it; a power failure may follow.
TEST(RetainStore, LosesNothingWhenAProcessIsKilledAndThePowerFailsLater) {
  const Generations generations;
  size_t ends = 0;
  for (int first = 0; first < 18; ++first) {
    for (int second = 0; second < 14; ++second) {
      FakeFiles files;
      uint32_t safe = 0;
      uint32_t generation = 0;
      for (const int cut : {first, second}) {
        files.callsLeft = cut;
        try {
          RetainStore store("/folder/file", files);
          std::vector<std::string> problems;
          generation = Generations::load(store, problems);
          ASSERT_GE(generation, safe);
          ASSERT_TRUE(problems.empty());
          for (int i = 0; i < 3; ++i) {
            generations.save(store, ++generation);
            safe = generation;
          }
        } catch (const PowerCut &) {
          files.processEnds();
        }
      }
      for (const std::vector<size_t> &order : outcomes(files.pending().size())) {
        const std::unique_ptr<FakeFiles> after = files.copy();
        after->restart(order);
        ++ends;
        RetainStore store("/folder/file", *after);
        std::vector<std::string> problems;
        ASSERT_GE(Generations::load(store, problems), safe) << first << ' ' << second;
      }
    }
  }
  EXPECT_GT(ends, 1000U);
}

/// A call that fails costs this save only, and never what was there before.
TEST(RetainStore, FailedCallsAreReportedAndTriedAgain) {
  const Generations generations;
  for (int failing = 0; failing < 24; ++failing) {
    FakeFiles files;
    files.failing = failing;
    RetainStore store("/folder/file", files);
    uint32_t safe = 0;
    int failures = 0;
    for (uint32_t generation = 1; generation <= 4; ++generation) {
      try {
        generations.save(store, generation);
        safe = generation;
      } catch (const app::Error &error) {
        ++failures;
        EXPECT_THAT(error.what(), ::testing::HasSubstr("No space left"));
        EXPECT_THAT(error.what(), ::testing::HasSubstr("make room"));
      }
      for (const std::vector<size_t> &order : outcomes(files.pending().size())) {
        const std::unique_ptr<FakeFiles> after = files.copy();
        after->restart(order);
        RetainStore again("/folder/file", *after);
        std::vector<std::string> problems;
        ASSERT_GE(Generations::load(again, problems), safe) << failing;
      }
    }
    EXPECT_EQ(failures, failing < files.calls ? 1 : 0);
    EXPECT_GE(safe, 3U);
  }
}

/// What is to be done about it depends on what is wrong.
TEST(RetainStore, SaysWhatHelps) {
  const Generations generations;
  struct Case {
    int error;
    const char *help;
  };
  for (const auto &[error, help] :
       {Case{ENOSPC, "make room on that disk"}, Case{EDQUOT, "make room on that disk"},
        Case{EACCES, "the right to write there"}, Case{EPERM, "the right to write there"},
        Case{EROFS, "the right to write there"}, Case{EIO, ""}}) {
    FakeFiles files;
    files.failing = 0;
    files.error = error;
    RetainStore store("/folder/file", files);
    try {
      generations.save(store, 1);
      FAIL();
    } catch (const app::Error &caught) {
      const std::string text = caught.what();
      EXPECT_THAT(text, ::testing::StartsWith("cannot write '/folder/file.new': " +
                                              std::string(std::strerror(error))));
      EXPECT_THAT(text, ::testing::HasSubstr(help));
      EXPECT_EQ(text.find('\n') != std::string::npos, *help != 0) << text;
    }
  }
}

/// A service may have been started without it: files get number 0 then, as any other.
TEST(RetainStore, WorksWhereStandardInputIsClosed) {
  const Generations generations;
  const test::ScratchDirectory scratch;
  const int input = ::dup(STDIN_FILENO);
  ::close(STDIN_FILENO);
  RetainStore store((scratch.path() / "retain").string());
  EXPECT_NO_THROW(generations.save(store, 1));
  EXPECT_NO_THROW(generations.save(store, 2));
  std::vector<std::string> problems;
  EXPECT_EQ(Generations::load(store, problems), 2U);
  EXPECT_THAT(problems, ::testing::IsEmpty());
  if (input >= 0) {
    ::dup2(input, STDIN_FILENO);
    ::close(input);
  }
}

TEST(RetainStore, FallsBackToTheOtherFileAndSaysWhy) {
  const Generations generations;
  const test::ScratchDirectory scratch;
  const std::string file = (scratch.path() / "retain").string();
  {
    RetainStore store(file);
    for (uint32_t i = 1; i <= 5; ++i)
      generations.save(store, i);
    EXPECT_EQ(store.sequence(), 5U);
  }
  {
    RetainStore store(file);
    std::vector<std::string> problems;
    EXPECT_EQ(Generations::load(store, problems), 5U);
    EXPECT_TRUE(problems.empty());
  }
  std::string bytes = test::readFile(file + ".a"); // 1, 3, 5
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  test::writeFile(file + ".a", bytes);
  {
    RetainStore store(file);
    std::vector<std::string> problems;
    EXPECT_EQ(Generations::load(store, problems), 4U);
    EXPECT_THAT(problems,
                ::testing::ElementsAre("'" + file + ".a' is not used: its checksum is wrong"));
    generations.save(store, 6);
  }
  RetainStore store(file);
  std::vector<std::string> problems;
  EXPECT_EQ(Generations::load(store, problems), 6U);
  EXPECT_TRUE(problems.empty());
  EXPECT_FALSE(std::filesystem::exists(file + ".new"));
}

TEST(RetainStore, KeepsWhatANewerStrideWrote) {
  const Generations generations;
  const test::ScratchDirectory scratch;
  const std::string file = (scratch.path() / "retain").string();
  {
    RetainStore store(file);
    generations.save(store, 1);
  }
  std::string bytes = test::readFile(file + ".a");
  bytes[8] = 9;
  const std::span<const std::byte> all = std::as_bytes(std::span(bytes));
  const uint64_t sum = app::crc64(all.subspan(28), app::crc64(all.first(20)));
  std::memcpy(bytes.data() + 20, &sum, sizeof sum);
  test::writeFile(file + ".a", bytes);
  RetainStore store(file);
  std::vector<std::string> problems;
  try {
    static_cast<void>(store.load(problems));
    FAIL();
  } catch (const app::Error &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("version 9"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("stride reset origin"));
  }
}

TEST(RetainStore, SaysWhereItCannotWrite) {
  const Generations generations;
  RetainStore store("/proc/stride/retain");
  try {
    generations.save(store, 1);
    FAIL();
  } catch (const app::Error &error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("cannot write '/proc/stride/retain.new'"));
  }
}

/// A process that was started with its standard input closed gives the file that number.
TEST(RetainStore, SavesAlsoWhereTheFirstFreeHandleIs0) {
  const Generations generations;
  const test::ScratchDirectory scratch;
  RetainStore store((scratch.path() / "retain").string());
  const int input = ::dup(0);
  ::close(0);
  EXPECT_NO_THROW(generations.save(store, 3));
  if (input >= 0) {
    ::dup2(input, 0);
    ::close(input);
  }
  std::vector<std::string> problems;
  EXPECT_EQ(Generations::load(store, problems), 3U);
}

TEST(RetainLock, OneAtATime) {
  const test::ScratchDirectory scratch;
  const std::string file = (scratch.path() / "sub" / "retain").string();
  {
    const app::RetainLock first(file);
    EXPECT_THROW(app::RetainLock second(file), app::Error);
  }
  EXPECT_NO_THROW(app::RetainLock third(file));
}

} // namespace
