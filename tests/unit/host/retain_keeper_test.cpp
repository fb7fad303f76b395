// Retained data while an application runs: consistent per task, reported once when they cannot be
// saved, handed on to a new build.
#include "runtime/host/retain_keeper.hpp"
#include "runtime/host/retain_reset.hpp"
#include "runtime/task/fault.hpp"
#include "tests/support/text.hpp"
#include "tests/unit/app/app_model.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace stride;
using host::RetainKeeper;
using host::RetainSettings;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The first and the last word of the state are equal at the end of every cycle only.
constexpr uint64_t kWords = 64;

void cycle(Ctx *ctx) {
  auto *const words = static_cast<volatile uint64_t *>(ctx->state);
  const uint64_t next = words[0] + 1;
  for (uint64_t i = 0; i < kWords; ++i)
    words[i] = next;
}

struct Build : test::AppModel {
  explicit Build(uint64_t hash) {
    root("", "Main",
         structure(
             "Main",
             {{"x", array(elementary(Kind::ULINT), 1, static_cast<int64_t>(kWords)), kSymRetain}},
             nullptr, Kind::Program));
    finish();
    app().buildHash = hash;
    task.name = "Task";
    task.kind = TaskKind::Cyclic;
    task.intervalNs = 1'000'000;
    task.core = kNoIndex;
    task.run = cycle;
    app().tasks = &task;
    app().taskCount = 1;
  }
  TaskDesc task{};
  std::vector<uint64_t> memory = std::vector<uint64_t>(kWords + 2);
  std::byte *state() { return reinterpret_cast<std::byte *>(memory.data()); }
};

class Lines {
public:
  RetainKeeper::Say say() {
    return [this](std::string_view line) {
      const std::lock_guard lock(mutex_);
      lines_.emplace_back(line);
    };
  }
  std::vector<std::string> get() {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
};

/// The disk is full until it is not.
class FullDisk final : public app::RetainFiles {
public:
  std::atomic<bool> full{true};
  bool folderFails = false;
  std::atomic<int> tries{0};

  int create(const std::string &path, int &handle) override {
    return app::systemFiles().create(path, handle);
  }
  int write(int handle, std::span<const std::byte> bytes) override {
    ++tries;
    return full ? ENOSPC : app::systemFiles().write(handle, bytes);
  }
  int sync(int handle) override { return app::systemFiles().sync(handle); }
  int close(int handle) override { return app::systemFiles().close(handle); }
  int rename(const std::string &from, const std::string &to) override {
    return app::systemFiles().rename(from, to);
  }
  int remove(const std::string &path) override { return app::systemFiles().remove(path); }
  int syncFolder(const std::string &folder) override {
    return folderFails ? EIO : app::systemFiles().syncFolder(folder);
  }
  int read(const std::string &path, std::vector<std::byte> &bytes) override {
    return app::systemFiles().read(path, bytes);
  }
};

uint64_t savedGeneration(const std::string &file) {
  app::RetainStore store(file);
  std::vector<std::string> problems;
  const std::optional<app::RetainImage> image = store.load(problems);
  EXPECT_TRUE(problems.empty());
  if (!image)
    return 0;
  std::vector<uint64_t> words(kWords);
  EXPECT_EQ(image->values.size(), kWords * 8);
  std::memcpy(words.data(), image->values.data(), kWords * 8);
  for (const uint64_t word : words)
    EXPECT_EQ(word, words[0]) << "of the middle of a cycle";
  return words[0];
}

class RetainKeeperTest : public ::testing::Test {
protected:
  test::ScratchDirectory scratch;
  std::string file = (scratch.path() / "kept").string();
  RetainSettings settings{file, 5'000'000};
  Lines lines;
  host::Messages messages{host::Output::Wait::Always};

  template <class Done> void runUntil(task::TaskSet &tasks, Done done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    bool reached = done();
    for (int64_t i = 0; !reached && std::chrono::steady_clock::now() < end; ++i) {
      tasks.runCycle(0, i * 1'000'000, 0);
      std::this_thread::yield();
      reached = done();
    }
    EXPECT_TRUE(reached);
  }
};

TEST_F(RetainKeeperTest, SavesWholeCyclesWhileTheTaskRuns) {
  Build build(1);
  task::TaskSet tasks(build.app(), build.state(), task::hostApi(), task::LoopLimit::Budget);
  uint64_t last = 0;
  {
    RetainKeeper keeper(build.app(), build.state(), settings, lines.say());
    EXPECT_FALSE(keeper.keepsRetains());
    keeper.addHooks(tasks);
    keeper.startSaving();
    for (int i = 0; i < 20; ++i)
      runUntil(tasks, [&] {
        const uint64_t saved = savedGeneration(file);
        const bool newer = saved > last;
        last = saved;
        return newer;
      });
    EXPECT_TRUE(keeper.finish());
  }
  EXPECT_EQ(savedGeneration(file), build.memory[0]);
  const uint64_t reached = build.memory[0];
  std::fill(build.memory.begin(), build.memory.end(), 0);
  RetainKeeper again(build.app(), build.state(), settings, lines.say());
  EXPECT_TRUE(again.keepsRetains());
  again.restore();
  EXPECT_EQ(build.memory[kWords - 1], reached);
  EXPECT_THAT(lines.get(), ElementsAre());
}

TEST_F(RetainKeeperTest, AFullDiskIsSaidOnceAndTriedAgain) {
  Build build(1);
  task::TaskSet tasks(build.app(), build.state(), task::hostApi(), task::LoopLimit::Budget);
  FullDisk disk;
  RetainKeeper keeper(build.app(), build.state(), settings, lines.say(), disk);
  keeper.addHooks(tasks);
  keeper.startSaving();
  runUntil(tasks, [&] { return disk.tries >= 5; });
  EXPECT_THAT(lines.get(),
              ElementsAre(AllOf(StartsWith("warning: retained data are not saved: cannot write"),
                                HasSubstr("No space left"))));
  disk.full = false;
  runUntil(tasks, [&] { return lines.get().size() > 1; });
  EXPECT_EQ(lines.get()[1], "note: retained data are saved again");
  EXPECT_TRUE(keeper.finish());
}

TEST_F(RetainKeeperTest, AnOnlineChangeHandsThemOn) {
  Build before(1);
  Build after(2);
  task::TaskSet tasks(before.app(), before.state(), task::hostApi(), task::LoopLimit::Budget);
  RetainKeeper keeper(before.app(), before.state(), settings, lines.say());
  keeper.addHooks(tasks);
  keeper.startSaving();
  runUntil(tasks, [&] { return savedGeneration(file) > 0; });
  after.memory = before.memory;
  keeper.prepareChange(after.app(), after.state());
  tasks.rebind(after.app(), after.state());
  keeper.change();
  const uint64_t atChange = before.memory[0];
  std::fill(before.memory.begin(), before.memory.end(), 0);
  tasks.runCycle(0, 0, 0); // before it is saved
  keeper.adopt();
  runUntil(tasks, [&] { return savedGeneration(file) > atChange + 1; });
  EXPECT_TRUE(keeper.finish());
  app::RetainStore store(file);
  std::vector<std::string> problems;
  EXPECT_EQ(store.load(problems)->head.buildHash, 2U);
}

TEST_F(RetainKeeperTest, BehindAnOnlineChangeATaskThatWaitsIsSavedAsItWasAtTheChange) {
  Build before(1);
  Build after(2);
  for (Build *build : {&before, &after}) {
    build->task.kind = TaskKind::Event;
    build->task.intervalNs = 0;
    build->task.event = [](Ctx *) -> BOOL { return 0; };
  }
  task::TaskSet tasks(before.app(), before.state(), task::hostApi(), task::LoopLimit::Budget);
  RetainKeeper keeper(before.app(), before.state(), settings, lines.say());
  keeper.addHooks(tasks);
  tasks.runCycle(0, 0, 0);
  keeper.startSaving();
  after.memory = before.memory;
  keeper.prepareChange(after.app(), after.state());
  tasks.rebind(after.app(), after.state());
  keeper.change();
  // Its event comes, and it is in the middle of a cycle when the new build begins to be saved.
  std::fill_n(after.memory.begin(), kWords / 2, 77);
  keeper.adopt();
  const auto newBuildSaved = [&] {
    app::RetainStore store(file);
    std::vector<std::string> problems;
    const std::optional<app::RetainImage> image = store.load(problems);
    return image && image->head.buildHash == 2;
  };
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!newBuildSaved() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(newBuildSaved());
  EXPECT_EQ(savedGeneration(file), 1U);
}

TEST_F(RetainKeeperTest, AResetToOriginIsNotDoneBeforeTheFolderIsDurable) {
  Build build(1);
  FullDisk disk;
  disk.full = false;
  {
    RetainKeeper keeper(build.app(), build.state(), settings, lines.say(), disk);
    EXPECT_TRUE(keeper.finish());
  }
  disk.folderFails = true;
  EXPECT_THROW(host::resetRetained(host::ResetKind::Origin, file, messages, disk), app::Error);
  disk.folderFails = false;
  EXPECT_NO_THROW(host::resetRetained(host::ResetKind::Origin, file, messages, disk));
  EXPECT_EQ(savedGeneration(file), 0U);
}

/// A reset says what is wrong with the other image, and counts what it keeps.
TEST_F(RetainKeeperTest, AResetSaysWhatItCannotUse) {
  Build build(1);
  for (int i = 0; i < 2; ++i) {
    RetainKeeper keeper(build.app(), build.state(), settings, lines.say());
    EXPECT_TRUE(keeper.finish());
  }
  std::string bytes = test::readFile(file + ".a");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  test::writeFile(file + ".a", bytes);
  ::testing::internal::CaptureStderr();
  EXPECT_TRUE(host::resetRetained(host::ResetKind::Warm, file, messages, app::systemFiles()));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "warning: retained data: '" + file + ".a' is not used: its checksum is wrong\n");
}

} // namespace
