// The files of retained data on a disk that may lose its power after every call: whatever was not
// synced by then is on the disk, or is not, in any combination. In every case the newest image that
// was acknowledged, or a later one, is there, complete.
#include "runtime/app/checksum.hpp"
#include "runtime/app/retain_store.hpp"
#include "tests/support/text.hpp"
#include "tests/unit/app/app_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <unistd.h>

namespace {

using namespace stride;
using app::RetainImage;
using app::RetainLayout;
using app::RetainStore;

/// What was done and is not known to be on the disk.
struct Written {
  int file;
  size_t offset;
  std::vector<std::byte> bytes;
};
struct Named {
  std::string name;
  int file; ///< -1: the name goes away.
};
using Pending = std::variant<Written, Named>;

using Bytes = std::vector<std::byte>;

/// The disk as it is after a power failure.
struct Disk {
  std::map<int, Bytes> files;
  std::map<std::string, int> names;

  void apply(const Pending &pending) {
    if (const auto *written = std::get_if<Written>(&pending)) {
      Bytes &bytes = files[written->file];
      bytes.resize(std::max(bytes.size(), written->offset + written->bytes.size()));
      std::copy(written->bytes.begin(), written->bytes.end(),
                bytes.begin() + static_cast<ptrdiff_t>(written->offset));
    } else if (const auto *named = std::get_if<Named>(&pending)) {
      if (named->file < 0)
        names.erase(named->name);
      else
        names[named->name] = named->file;
    }
  }
};

/// The power is gone.
struct PowerCut {};

/// A disk with a cache in front of it. Write, sync and rename come as the calls of the interface
/// do; every write is split, so that it can be torn.
class FakeFiles final : public app::RetainFiles {
public:
  int callsLeft = 1 << 30; ///< The power is gone behind so many calls.
  int failing = -1;        ///< This call, counted from 0, fails with `error`.
  int error = ENOSPC;
  int calls = 0;

  int create(const std::string &path, int &handle) override {
    return call([&] {
      // Emptying an existing file is like a new one in its place, in any order with the rest.
      handle = ++lastFile_;
      disk_.files[handle] = {};
      seen_.files[handle] = {};
      change({Named{path, handle}});
    });
  }
  int write(int handle, std::span<const std::byte> bytes) override {
    return call([&] {
      const size_t piece = std::max<size_t>(1, bytes.size() / 3 + 1);
      for (size_t at = 0; at < bytes.size(); at += piece) {
        const auto part = bytes.subspan(at, std::min(piece, bytes.size() - at));
        change({Written{handle, seen_.files[handle].size(), {part.begin(), part.end()}}});
      }
    });
  }
  int sync(int handle) override {
    return call([&] {
      std::vector<Pending> left;
      for (const Pending &pending : pending_) {
        const auto *written = std::get_if<Written>(&pending);
        if (written != nullptr && written->file == handle)
          disk_.apply(pending);
        else
          left.push_back(pending);
      }
      pending_ = std::move(left);
    });
  }
  int close(int) override {
    return call([] {});
  }
  int rename(const std::string &from, const std::string &to) override {
    return call([&] {
      const int file = seen_.names.at(from);
      // Both names of one rename change together, or the old one stays.
      change({Named{to, file}});
      change({Named{from, -1}});
    });
  }
  int remove(const std::string &path) override {
    if (!seen_.names.contains(path))
      return ENOENT;
    return call([&] { change({Named{path, -1}}); });
  }
  int syncFolder(const std::string &) override {
    return call([&] {
      std::vector<Pending> left;
      for (const Pending &pending : pending_) {
        if (std::holds_alternative<Named>(pending))
          disk_.apply(pending);
        else
          left.push_back(pending);
      }
      pending_ = std::move(left);
    });
  }
  int read(const std::string &path, std::vector<std::byte> &bytes) override {
    const auto found = seen_.names.find(path);
    if (found == seen_.names.end())
      return ENOENT;
    bytes = seen_.files[found->second];
    return 0;
  }

  const std::vector<Pending> &pending() const { return pending_; }
  /// After the failure, with these of the pending changes, in this order.
  void restart(const std::vector<size_t> &order) {
    for (const size_t i : order)
      disk_.apply(pending_[i]);
    pending_.clear();
    seen_ = disk_;
    callsLeft = 1 << 30;
    failing = -1;
  }
  /// The process ends, the machine goes on.
  void processEnds() { callsLeft = 1 << 30; }

  FakeFiles() = default;
  std::unique_ptr<FakeFiles> copy() const {
    auto other = std::make_unique<FakeFiles>();
    other->disk_ = disk_;
    other->seen_ = seen_;
    other->pending_ = pending_;
    other->lastFile_ = lastFile_;
    return other;
  }

private:
  template <class Do> int call(Do action) {
    if (callsLeft == 0)
      throw PowerCut();
    --callsLeft;
    if (calls++ == failing)
      return error;
    action();
    return 0;
  }
  void change(Pending pending) {
    seen_.apply(pending);
    pending_.push_back(std::move(pending));
  }

  Disk disk_; ///< What is safe.
  Disk seen_; ///< What the processes see.
  std::vector<Pending> pending_;
  int lastFile_ = 0;
};

/// Every subset of `count` things in every order (orders only up to four things: the combinations
/// grow with the factorial).
std::vector<std::vector<size_t>> outcomes(size_t count) {
  std::vector<std::vector<size_t>> out;
  for (size_t set = 0; set < size_t{1} << count; ++set) {
    std::vector<size_t> order;
    for (size_t i = 0; i < count; ++i)
      if ((set >> i & 1U) != 0)
        order.push_back(i);
    out.push_back(order);
    if (order.size() > 4) {
      std::reverse(order.begin(), order.end());
      out.push_back(order);
      continue;
    }
    while (std::next_permutation(order.begin(), order.end()))
      out.push_back(order);
  }
  return out;
}

/// Values that show which generation they are, and whether they are complete.
class Generations {
public:
  Generations() {
    model_.root("G", "x", model_.array(model_.elementary(Kind::UDINT), 0, 9), kSymRetain);
    layout_.emplace(model_.finish(), app::kRetained);
    encoded_ = layout_->encode();
  }
  void save(RetainStore &store, uint32_t generation) const {
    std::vector<uint32_t> values(10, generation);
    store.save("model", 1, encoded_, std::as_bytes(std::span(values)));
  }
  /// 0: there is none.
  static uint32_t load(RetainStore &store, std::vector<std::string> &problems) {
    const std::optional<RetainImage> image = store.load(problems);
    if (!image)
      return 0;
    std::vector<uint32_t> values(10);
    EXPECT_EQ(image->values.size(), 40U);
    std::memcpy(values.data(), image->values.data(), 40);
    EXPECT_TRUE(std::all_of(values.begin(), values.end(), [&](uint32_t value) {
      return value == values[0];
    })) << "torn";
    return values[0];
  }

private:
  test::AppModel model_;
  std::optional<RetainLayout> layout_;
  std::vector<std::byte> encoded_;
};

struct Counted {
  size_t cuts = 0;
  size_t ends = 0;
};

/// From a disk on: loads, saves up to `saves` times, and loses the power behind every call; then
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

/// The sequence number of the image in a file; 0: there is none, or it is no image.
uint64_t sequenceIn(FakeFiles &files, const char *ending) {
  std::vector<std::byte> bytes;
  if (files.read(std::string("/folder/file") + ending, bytes) != 0)
    return 0;
  try {
    return app::decodeImage(bytes).head.sequence;
  } catch (const app::Error &) {
    return 0;
  }
}

/// What each file holds before a start: so many saves old, 0: no file, -1: one that is torn.
struct Before {
  int a, b;
};

/// The first save after a start goes to the older file: if it turns out to be damaged later, the
/// image that was loaded is still there.
TEST(RetainStore, TheFirstSaveAfterAStartKeepsTheImageThatWasLoaded) {
  const Generations generations;
  for (const Before before : {Before{0, 0}, Before{1, 0}, Before{0, 1}, Before{1, 2}, Before{2, 1},
                              Before{3, 2}, Before{2, 3}, Before{5, 2}, Before{2, 5}, Before{-1, 4},
                              Before{4, -1}, Before{-1, 0}, Before{0, -1}}) {
    SCOPED_TRACE(std::to_string(before.a) + " and " + std::to_string(before.b));
    FakeFiles files;
    const auto put = [&](const char *ending, int sequence) {
      if (sequence == 0)
        return;
      FakeFiles other;
      RetainStore store("/folder/file", other);
      for (int i = 0; i < std::max(sequence, 1); ++i)
        generations.save(store, static_cast<uint32_t>(std::max(sequence, 1)));
      std::vector<std::byte> bytes;
      ASSERT_EQ(other.read(sequence % 2 == 0 ? "/folder/file.b" : "/folder/file.a", bytes), 0);
      if (sequence < 0)
        bytes.back() ^= std::byte{1};
      int handle = -1;
      ASSERT_EQ(files.create(std::string("/folder/file") + ending, handle), 0);
      ASSERT_EQ(files.write(handle, bytes), 0);
    };
    put(".a", before.a);
    put(".b", before.b);
    const int newest = std::max({before.a, before.b, 0});

    RetainStore store("/folder/file", files);
    std::vector<std::string> problems;
    EXPECT_EQ(Generations::load(store, problems), static_cast<uint32_t>(newest));
    EXPECT_EQ(problems.size(), before.a < 0 || before.b < 0 ? 1U : 0U);
    const auto held = [&] { return std::set{sequenceIn(files, ".a"), sequenceIn(files, ".b")}; };
    uint64_t last = static_cast<uint64_t>(newest);
    for (int i = 0; i < 3; ++i) {
      generations.save(store, 77);
      EXPECT_EQ(held(), (std::set<uint64_t>{last, last + 1})) << "after save " << i + 1;
      ++last;
    }
  }
}

/// Whatever the files' times say: the newest image is the last to go.
TEST(RetainStore, ClearingNeverLeavesOnlyAnOlderImage) {
  const Generations generations;
  for (uint32_t saves = 1; saves <= 3; ++saves) {
    FakeFiles filled;
    {
      RetainStore store("/folder/file", filled);
      for (uint32_t i = 1; i <= saves; ++i)
        generations.save(store, i);
    }
    bool through = false;
    for (int cut = 0; !through; ++cut) {
      const std::unique_ptr<FakeFiles> files = filled.copy();
      files->callsLeft = cut;
      try {
        RetainStore("/folder/file", *files).clear();
        through = true;
      } catch (const PowerCut &) {
        through = false;
      }
      for (const std::vector<size_t> &order : outcomes(files->pending().size())) {
        const std::unique_ptr<FakeFiles> after = files->copy();
        after->restart(order);
        RetainStore store("/folder/file", *after);
        std::vector<std::string> problems;
        const uint32_t found = Generations::load(store, problems);
        EXPECT_TRUE(found == saves || found == 0) << found << " of " << saves;
        EXPECT_FALSE(through && found != 0);
      }
    }
  }
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
